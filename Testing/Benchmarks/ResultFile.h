#ifndef ResultFile_h
#define ResultFile_h

#include "Result.h"

/// Results as comma-separated values with the columns benchmark, row, quantity, median, smallest,
/// largest, bar, aim; a goal that is not set is left empty.
void writeResults(const std::string& path, const std::vector<Result>& results);

/// Throws std::runtime_error when the file is missing or of another kind.
std::vector<Result> readResults(const std::string& path);

#endif
