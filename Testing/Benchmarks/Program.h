#ifndef Program_h
#define Program_h

#include <cstdio>
#include <cstdlib>
#include <exception>

/// What main() returns: runs a program that reports errors as exceptions.
inline int runProgram(void (*run)(int argc, char* argv[]), int argc, char* argv[])
{
  try
  {
    run(argc, argv);
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}

#endif
