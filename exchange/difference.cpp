#include "exchange/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/same_bits.hpp"

namespace tanktread::exchange {
namespace {

/// |a - b|, 0 for the same bits, where inf - inf would be NaN.
double distance(double a, double b) {
  return same_bits(a, b) ? 0 : std::abs(a - b);
}

std::string shape(int components, std::size_t n_values) {
  return fmt::format("{} x {}", n_values / static_cast<std::size_t>(std::max(components, 1)), components);
}

/// The root mean square of the distances, the largest of which is `max`: in units of it, so that no square
/// leaves the range of doubles.
double root_mean_square(std::span<const double> a, std::span<const double> b, double max) {
  if (max == 0 || !std::isfinite(max)) return max;
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double relative = distance(a[k], b[k]) / max;
    sum += relative * relative;
  }
  return max * std::sqrt(sum / static_cast<double>(a.size()));
}

ArrayDifference not_compared(const std::string& kind, const std::string& name, const std::string& problem) {
  ArrayDifference difference;
  difference.kind = kind;
  difference.name = name;
  difference.problem = problem;
  return difference;
}

ArrayDifference array_difference(const std::string& kind, const Array& a, const Array& b) {
  if (a.components == b.components && a.values.size() == b.values.size()) {
    return value_difference(kind, a.name, a.components, a.values, b.values);
  }
  return not_compared(kind, a.name,
                      fmt::format("{} against {}", shape(a.components, a.values.size()),
                                  shape(b.components, b.values.size())));
}

void add(std::vector<ArrayDifference>& all, const std::string& kind, const std::vector<Array>& a,
         const std::vector<Array>& b) {
  for (const auto& array : a) {
    const Array* other = find_optional_array(b, array.name);
    all.push_back(other != nullptr ? array_difference(kind, array, *other)
                                   : not_compared(kind, array.name, "only in the first"));
  }
  for (const auto& array : b) {
    if (find_optional_array(a, array.name) == nullptr)
      all.push_back(not_compared(kind, array.name, "only in the second"));
  }
}

/// Integers below 2^53, which doubles hold.
template <class List>
Array as_array(const std::string& name, int components, const List& integers) {
  return {name, components, std::vector<double>(integers.begin(), integers.end())};
}

}  // namespace

ArrayDifference value_difference(const std::string& kind, const std::string& name, int components,
                                 std::span<const double> a, std::span<const double> b) {
  ArrayDifference difference;
  difference.kind = kind;
  difference.name = name;
  difference.components = components;
  difference.n_values = static_cast<std::int64_t>(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (same_bits(a[k], b[k])) continue;
    const auto index = static_cast<std::int64_t>(k);
    const double d = distance(a[k], b[k]);
    if (difference.n_different++ == 0) {
      difference.first = difference.largest = index;
      difference.first_a = a[k];
      difference.first_b = b[k];
      difference.max = d;
    } else if (d > difference.max || (std::isnan(d) && !std::isnan(difference.max))) {
      difference.largest = index;
      difference.max = d;
    }
  }
  difference.rms = root_mean_square(a, b, difference.max);
  return difference;
}

std::vector<ArrayDifference> differences(const SurfacePacket& a, const SurfacePacket& b) {
  std::vector<ArrayDifference> all;
  all.push_back(array_difference("points", {"points", 3, a.points}, {"points", 3, b.points}));
  all.push_back(array_difference("triangles", as_array("triangles", 3, a.triangles),
                                 as_array("triangles", 3, b.triangles)));
  add(all, "point data", a.point_data, b.point_data);
  add(all, "cell data", a.cell_data, b.cell_data);
  add(all, "field data", a.field_data, b.field_data);
  return all;
}

std::vector<ArrayDifference> differences(const GridPacket& a, const GridPacket& b) {
  std::vector<ArrayDifference> all;
  all.push_back(array_difference("geometry", as_array("nodes", 3, a.nodes), as_array("nodes", 3, b.nodes)));
  all.push_back(value_difference("geometry", "origin", 3, first_node(a), first_node(b)));
  all.push_back(value_difference("geometry", "spacing", 3, a.spacing, b.spacing));
  add(all, "point data", a.point_data, b.point_data);
  add(all, "field data", a.field_data, b.field_data);
  return all;
}

}  // namespace tanktread::exchange
