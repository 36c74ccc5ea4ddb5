// What a comparison of two outputs finds, gathered line by line.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "exchange/difference.hpp"

namespace tanktread::driver {

struct DifferenceOptions {
  std::set<std::string> ignored;  ///< names of arrays, columns and files that are left out
  double tolerance = 0;           ///< max |a - b| up to which an array counts as equal; 0: bit for bit
};

/// How the values of an array are spoken of.
struct ArrayWords {
  std::function<std::string(std::int64_t)> place;  ///< where a value is, by its index
  std::string first_a, first_b;  ///< the first two that differ; empty: the numbers with 17 digits
};

class DifferenceReport {
 public:
  explicit DifferenceReport(DifferenceOptions options) : options_(std::move(options)) {}

  /// Whether an array, column or file of that name is to be left out; counts it if so.
  bool leaves_out(const std::string& name);

  /// What is added from now on is of this file.
  void begin_file(const std::string& name);
  /// An array or column; makes a line of it if it differs by more than the tolerance, which does not hold for
  /// node numbers.
  void add(const exchange::ArrayDifference& difference, const ArrayWords& words);
  /// Another difference of the file.
  void add(const std::string& what);

  bool different() const { return n_files_different_ > 0; }
  /// One a difference.
  const std::vector<std::string>& lines() const { return lines_; }
  /// "identical: 9 files, 41 arrays" or "different: 3 of 41 arrays, 2 of 9 files".
  std::string summary() const;

 private:
  DifferenceOptions options_;
  std::vector<std::string> lines_;
  std::string file_;
  bool file_is_different_ = false;
  int n_files_ = 0, n_files_different_ = 0, n_arrays_ = 0, n_arrays_different_ = 0, n_arrays_near_ = 0;
  int n_ignored_ = 0;
};

}  // namespace tanktread::driver
