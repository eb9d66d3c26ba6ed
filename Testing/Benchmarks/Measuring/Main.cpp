// SPDX-License-Identifier: BSD-3-Clause
#include "Measuring/Program.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char* argv[])
{
  try
  {
    run({ argc, argv });
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
