#include "driver/diff/difference_report.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace tanktread::driver {
namespace {

using exchange::ArrayDifference;

/// Numbers that name nodes: next to each other does not mean alike.
bool counts_nodes(const ArrayDifference& difference) {
  return difference.kind == "triangles" || (difference.kind == "geometry" && difference.name == "nodes");
}

std::string number_text(double value) {
  if (std::isnan(value)) return fmt::format("nan ({:#018x})", std::bit_cast<std::uint64_t>(value));
  return fmt::format("{:.17g}", value);
}

std::string title(const ArrayDifference& difference) {
  return difference.kind == difference.name ? difference.name
                                            : fmt::format("{} {}", difference.kind, difference.name);
}

std::string line_of(const ArrayDifference& difference, const ArrayWords& words) {
  if (!difference.problem.empty()) return fmt::format("{}: {}", title(difference), difference.problem);
  return fmt::format("{}: max {:.6g}, rms {:.6g}, {} of {} values; largest at {}; first at {}: {} against {}",
                     title(difference), difference.max, difference.rms, difference.n_different,
                     difference.n_values, words.place(difference.largest), words.place(difference.first),
                     words.first_a.empty() ? number_text(difference.first_a) : words.first_a,
                     words.first_b.empty() ? number_text(difference.first_b) : words.first_b);
}

std::string count_text(int n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

bool DifferenceReport::leaves_out(const std::string& name) {
  const bool ignored = options_.ignored.contains(name);
  n_ignored_ += ignored ? 1 : 0;
  return ignored;
}

void DifferenceReport::begin_file(const std::string& name) {
  file_ = name;
  file_is_different_ = false;
  ++n_files_;
}

void DifferenceReport::add(const ArrayDifference& difference, const ArrayWords& words) {
  if (leaves_out(difference.name)) return;
  ++n_arrays_;
  if (difference.identical()) return;
  const double tolerance = counts_nodes(difference) ? 0 : options_.tolerance;
  if (difference.problem.empty() && tolerance > 0 && difference.max <= tolerance) {
    ++n_arrays_near_;
    return;
  }
  ++n_arrays_different_;
  add(line_of(difference, words));
}

void DifferenceReport::add(const std::string& what) {
  lines_.push_back(fmt::format("{}: {}", file_, what));
  n_files_different_ += file_is_different_ ? 0 : 1;
  file_is_different_ = true;
}

std::string DifferenceReport::summary() const {
  std::string text;
  if (different()) {
    text = fmt::format("different: {} of {}, {} of {}", n_arrays_different_, count_text(n_arrays_, "array"),
                       n_files_different_, count_text(n_files_, "file"));
  } else {
    text = options_.tolerance > 0 ? fmt::format("equal within {}", options_.tolerance) : "identical";
    text += fmt::format(": {}, {}", count_text(n_files_, "file"), count_text(n_arrays_, "array"));
  }
  if (n_arrays_near_ > 0)
    text += fmt::format(", {} equal within the tolerance but not bit for bit", n_arrays_near_);
  if (n_ignored_ > 0) text += fmt::format(", {} ignored", n_ignored_);
  return text;
}

}  // namespace tanktread::driver
