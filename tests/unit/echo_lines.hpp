// The echo of a case, and one of its lines, for tests.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "driver/plan/cost.hpp"
#include "driver/plan/echo.hpp"
#include "driver/plan/warnings.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/system/placement.hpp"

namespace tanktread::driver {

inline std::string echo_of(const Case& the_case, const Cost& cost = {},
                           const std::vector<ShapeNumbers>& shapes = {}) {
  const auto p = parameters(the_case);
  const Placement placement(the_case, membrane_shapes(the_case).meshes);
  std::vector<double> mean_edges;
  for (const auto& shape : shapes) mean_edges.push_back(shape.mean_edge);
  return echo(the_case, p, cost, warnings(the_case, p, mean_edges, placement), shapes);
}

/// The line of a name, its spaces drawn together, or "".
inline std::string line_of(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  " + name + "  ")) continue;
    std::istringstream words(line);
    std::string together;
    for (std::string word; words >> word;) together += (together.empty() ? "" : " ") + word;
    return together;
  }
  return "";
}

}  // namespace tanktread::driver
