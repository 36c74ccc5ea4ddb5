#include "driver/study/study_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "coupler/two_fluids.hpp"
#include "driver/study/study_check.hpp"

namespace tanktread::driver {
namespace {

/// The sheet's stencils, wherever it is put, must not reach beyond a wall, and a kernel must fit in the box.
void require_room_for_the_kernel(const LayersStudy& study) {
  const double reach = coupler::kernel(study.kernel).half_width, middle = study.sheet * study.height;
  require(
      middle >= reach && study.height - middle >= reach,
      fmt::format("sheet is {} of a height of {}, {:g} grid steps from a wall, and kernel '{}' needs {}; "
                  "give a greater height or put the sheet nearer to the middle",
                  study.sheet, study.height, std::min(middle, study.height - middle), study.kernel, reach));
}

double largest_size(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double number : numbers) largest = std::max(largest, std::abs(number));
  return largest;
}

double mean(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

double root_mean_square(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

/// What the coupler makes of the velocities of the levels for a node of the sheet.
double sheet_velocity(const LayersStudy& study, const std::vector<double>& velocity, double sheet_height,
                      double dipole_length) {
  const auto& kernel = coupler::kernel(study.kernel);
  const int width = static_cast<int>(std::ceil(2 * kernel.half_width));
  coupler::Coupler coupler({{width, width, study.height}, {true, true, false}}, kernel, 1);
  const std::array position = {0.5 * width, 0.5 * width, sheet_height}, normal = {0.0, 0.0, 1.0};
  const std::array<std::span<const double>, 1> sheets = {position};
  const std::array<coupler::ShearDipole, 1> dipoles = {{{normal, dipole_length}}};
  coupler.build(sheets, dipoles);
  std::vector<double> on_grid;
  for (const std::int64_t node : coupler.grid_nodes())
    on_grid.insert(on_grid.end(), {velocity[node / (width * width)], 0.0, 0.0});
  std::array<double, 3> of_node{};
  const std::array<std::span<double>, 1> of_sheets = {of_node};
  coupler.interpolate(on_grid, of_sheets);
  return of_node[0];
}

/// Errors at one place of the sheet.
struct ErrorsAtPlace {
  std::vector<double> nodes;
  double sheet, dipole;
};

ErrorsAtPlace errors_at_place(const LayersStudy& study, const std::vector<double>& velocity,
                              double sheet_height) {
  const auto layers = exact_layers(study, sheet_height);
  const double largest = layers.largest_speed();
  ErrorsAtPlace errors{velocity, 0, 0};
  for (int z = 0; z < study.height; ++z) errors.nodes[z] = (velocity[z] - layers.velocity(z + 0.5)) / largest;
  const double exact = layers.velocity(sheet_height);
  const double length =
      coupler::dipole_length(coupler::kernel(study.kernel), {layers.viscosity_above, layers.viscosity_below});
  errors.sheet = (sheet_velocity(study, velocity, sheet_height, 0) - exact) / largest;
  errors.dipole = (sheet_velocity(study, velocity, sheet_height, length) - exact) / largest;
  return errors;
}

std::string flow_name(LayersFlow flow) {
  return flow == LayersFlow::couette ? "couette" : "channel";
}

std::string form_name(NodeViscosity form) {
  switch (form) {
    case NodeViscosity::sharp:
      return "sharp";
    case NodeViscosity::harmonic:
      return "harmonic";
    case NodeViscosity::arithmetic:
      return "arithmetic";
  }
  throw std::logic_error("a viscosity of nodes has no name");
}

}  // namespace

LayersErrors layers_errors(const LayersStudy& study) {
  const auto heights = sheet_heights(study);
  require_room_for_the_kernel(study);
  std::vector<double> viscosities, velocity, of_nodes, of_sheet, of_dipole, bias(study.height);
  for (const double height : heights) {
    // Sharp viscosities are the same for many places, and so is the flow.
    if (const auto before = std::exchange(viscosities, node_viscosities(study, height));
        before != viscosities)
      velocity = steady_velocities(study, height);
    const auto errors = errors_at_place(study, velocity, height);
    of_nodes.push_back(root_mean_square(errors.nodes));
    of_sheet.push_back(errors.sheet);
    of_dipole.push_back(errors.dipole);
    for (std::size_t z = 0; z < bias.size(); ++z) bias[z] += errors.nodes[z] / study.n_places;
  }
  return {mean(of_nodes),         largest_size(of_nodes), root_mean_square(bias), mean(of_sheet),
          largest_size(of_sheet), mean(of_dipole),        largest_size(of_dipole)};
}

std::string layers_table(const std::vector<LayersStudy>& studies) {
  std::string table =
      "flow,form,kernel,magic_parameter,lambda,height,nodes_mean,nodes_largest,nodes_bias,sheet_mean,"
      "sheet_largest,dipole_mean,dipole_largest\n";
  for (const auto& study : studies) {
    const auto errors = layers_errors(study);
    table += fmt::format("{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                         flow_name(study.flow), form_name(study.form), study.kernel, study.magic_parameter,
                         study.viscosity_ratio, study.height, errors.nodes_mean, errors.nodes_largest,
                         errors.nodes_bias, errors.sheet_mean, errors.sheet_largest, errors.dipole_mean,
                         errors.dipole_largest);
  }
  return table;
}

}  // namespace tanktread::driver
