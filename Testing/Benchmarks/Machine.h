#ifndef Machine_h
#define Machine_h

#include <string>

/// The machine, the programs' versions and today's date as lines of a Markdown list.
std::string describeMachine();

#endif
