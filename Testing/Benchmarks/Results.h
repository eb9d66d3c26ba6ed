#ifndef Results_h
#define Results_h

#include "Result.h"

/// The results of a benchmark program: its tables for the reader, its file for BenchmarkReport.
class Results
{
public:
  /// The file is `program`.csv in the current folder.
  explicit Results(std::string program);

  /// `values`: one for each round.
  void add(const std::string& benchmark, const std::string& row, const std::string& quantity,
    const std::vector<double>& values, const Goal& goal = {});

  /// Prints the tables and writes the file. Throws std::runtime_error when it cannot be written.
  void finish() const;

private:
  std::string program_;
  std::vector<Result> results_;
};

#endif
