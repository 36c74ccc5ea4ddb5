#include "driver/packets/packet_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;
using exchange::FileError;

const Array& vector_array(const std::vector<Array>& arrays, const std::string& array,
                          const std::string& name) {
  const auto& found = exchange::find_array(arrays, array, name);
  if (found.components != 3) {
    throw FileError(
        fmt::format("{}: the array '{}' has {} components; a vector has 3", name, array, found.components));
  }
  return found;
}

const Array* optional_scalars(const std::vector<Array>& arrays, const std::string& array,
                              const std::string& name) {
  const auto* found = exchange::find_optional_array(arrays, array);
  if (found != nullptr && found->components != 1) {
    throw FileError(
        fmt::format("{}: the array '{}' has {} components; 1 is needed", name, array, found->components));
  }
  return found;
}

/// The number of the capsule of each triangle.
std::vector<std::size_t> capsule_numbers(const exchange::SurfacePacket& file, const std::string& name) {
  std::vector<std::size_t> numbers(file.triangles.size() / 3, 0);
  const auto* array = optional_scalars(file.cell_data, "capsule", name);
  if (array == nullptr) return numbers;
  std::size_t last = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double value = array->values[k];
    const bool is_next = k > 0 && value == static_cast<double>(last + 1);
    if (value != static_cast<double>(last) && !is_next) {
      throw FileError(
          fmt::format("{}: triangle {} is of capsule {} and follows one of capsule {}; 'capsule' must count "
                      "the capsules from 0, their triangles one after the other",
                      name, k, value, last));
    }
    last = numbers[k] = static_cast<std::size_t>(value);
  }
  return numbers;
}

/// Splits the triangles among the capsules, corners still counted through the whole file.
std::vector<Eigen::Matrix3Xi> split_triangles(const exchange::SurfacePacket& file, const std::string& name) {
  const auto numbers = capsule_numbers(file, name);
  std::vector<Eigen::Matrix3Xi> triangles(numbers.empty() ? 1 : numbers.back() + 1);
  std::vector<Eigen::Index> n_triangles(triangles.size(), 0);
  for (const std::size_t capsule : numbers) ++n_triangles[capsule];
  auto corner = file.triangles.begin();
  for (std::size_t capsule = 0; capsule < triangles.size(); ++capsule) {
    triangles[capsule].resize(3, n_triangles[capsule]);
    for (int& of_capsule : triangles[capsule].reshaped()) of_capsule = static_cast<int>(*corner++);
  }
  return triangles;
}

/// The mobility of a packet, on the whole grid.
Array mobility_on_grid(const GridVectors& vectors, std::size_t n_nodes) {
  Array mobility{mobility_array, 1, std::vector<double>(n_nodes)};
  for (std::size_t k = 0; k < vectors.nodes->size(); ++k)
    mobility.values[static_cast<std::size_t>((*vectors.nodes)[k])] = vectors.mobility[k];
  return mobility;
}

}  // namespace

exchange::SurfacePacket surface_file(const Surfaces& surfaces, std::int64_t step, std::size_t first_number) {
  exchange::SurfacePacket file;
  Array capsule{"capsule", 1, {}};
  for (std::size_t k = 0; k < surfaces.positions.size(); ++k) {
    const auto first_node = static_cast<std::int64_t>(file.points.size() / 3);
    const auto& points = surfaces.positions[k];
    file.points.insert(file.points.end(), points.data(), points.data() + points.size());
    for (const int corner : surfaces.triangles[k].reshaped()) file.triangles.push_back(first_node + corner);
    capsule.values.insert(capsule.values.end(), static_cast<std::size_t>(surfaces.triangles[k].cols()),
                          static_cast<double>(first_number + k));
  }
  file.cell_data = {std::move(capsule)};
  file.field_data = packet_header(step);
  return file;
}

void add_vectors(exchange::SurfacePacket& file, const std::string& name,
                 std::span<const Eigen::Matrix3Xd> vectors) {
  Array array{name, 3, {}};
  for (const auto& matrix : vectors) {
    array.values.insert(array.values.end(), matrix.data(), matrix.data() + matrix.size());
  }
  file.point_data.push_back(std::move(array));
}

Surfaces surfaces_of(const exchange::SurfacePacket& file, const std::string& name) {
  check_schema_version(file.field_data, name);
  Surfaces surfaces;
  surfaces.triangles = split_triangles(file, name);
  Eigen::Index first = 0;
  const auto n_points = static_cast<Eigen::Index>(file.points.size() / 3);
  const Eigen::Map<const Eigen::Matrix3Xd> points(file.points.data(), 3, n_points);
  for (std::size_t k = 0; k < surfaces.triangles.size(); ++k) {
    auto& triangles = surfaces.triangles[k];
    const bool is_last = k + 1 == surfaces.triangles.size();
    const Eigen::Index end = is_last || triangles.size() == 0 ? n_points : triangles.maxCoeff() + 1;
    if (triangles.size() == 0 || triangles.minCoeff() < first || triangles.maxCoeff() >= end) {
      throw FileError(fmt::format(
          "{}: the nodes of capsule {} must lie together and follow those of the capsule before", name, k));
    }
    triangles.array() -= static_cast<int>(first);
    surfaces.positions.emplace_back(points.middleCols(first, end - first));
    first = end;
  }
  return surfaces;
}

NodeVectors vectors_of(const exchange::SurfacePacket& file, const std::string& array,
                       const Surfaces& surfaces, const std::string& name) {
  const auto& found = vector_array(file.point_data, array, name);
  NodeVectors vectors;
  const double* first = found.values.data();
  for (const auto& positions : surfaces.positions) {
    vectors.emplace_back(Eigen::Map<const Eigen::Matrix3Xd>(first, 3, positions.cols()));
    first += positions.size();
  }
  return vectors;
}

void check_sizes(const NodeVectors& vectors, const NodeVectors& like, const std::string& name) {
  if (vectors.size() != like.size()) {
    throw FileError(fmt::format("{}: {} capsules, expected {}", name, vectors.size(), like.size()));
  }
  for (std::size_t k = 0; k < like.size(); ++k) {
    if (vectors[k].cols() == like[k].cols()) continue;
    throw FileError(
        fmt::format("{}: capsule {} has {} nodes, expected {}", name, k, vectors[k].cols(), like[k].cols()));
  }
}

exchange::GridPacket grid_file(const GridVectors& vectors, const std::string& array, const Box& box,
                               std::int64_t step) {
  const std::size_t n_nodes = std::size_t(box[0]) * std::size_t(box[1]) * std::size_t(box[2]);
  Array values{array, 3, std::vector<double>(3 * n_nodes)},
      touched{touched_array, 1, std::vector<double>(n_nodes)};
  for (std::size_t k = 0; k < vectors.nodes->size(); ++k) {
    const auto node = static_cast<std::size_t>((*vectors.nodes)[k]);
    std::copy_n(&vectors.values[3 * k], 3, &values.values[3 * node]);
    touched.values[node] = 1;
  }
  exchange::GridPacket file;
  file.nodes = box;
  file.point_data = {std::move(values)};
  if (!vectors.mobility.empty()) file.point_data.push_back(mobility_on_grid(vectors, n_nodes));
  file.point_data.push_back(std::move(touched));
  file.field_data = packet_header(step);
  return file;
}

void check_grid(const exchange::GridPacket& file, const Box& box, const std::string& name) {
  if (file.nodes == box && file.origin == std::array{0.5, 0.5, 0.5} &&
      file.spacing == std::array{1.0, 1.0, 1.0})
    return;
  throw FileError(
      fmt::format("{}: a grid of {} x {} x {} nodes from ({}, {}, {}) with spacing ({}, {}, {}); the case "
                  "has flow.box = [{}, {}, "
                  "{}], from (0.5, 0.5, 0.5) with spacing 1: use files of the whole box of that case",
                  name, file.nodes[0], file.nodes[1], file.nodes[2], file.origin[0], file.origin[1],
                  file.origin[2], file.spacing[0], file.spacing[1], file.spacing[2], box[0], box[1], box[2]));
}

GridVectors grid_vectors_of(const exchange::GridPacket& file, const std::string& array, const Box& box,
                            const std::string& name) {
  check_schema_version(file.field_data, name);
  check_grid(file, box, name);
  const auto& found = vector_array(file.point_data, array, name);
  const auto* touched = optional_scalars(file.point_data, touched_array, name);
  const auto* of_nodes = optional_scalars(file.point_data, mobility_array, name);
  std::vector<double> mobility;
  if (touched == nullptr) {
    std::vector<std::int64_t> all(found.values.size() / 3);
    std::iota(all.begin(), all.end(), 0);
    if (of_nodes != nullptr) mobility = of_nodes->values;
    return {std::make_shared<const std::vector<std::int64_t>>(std::move(all)), found.values,
            std::move(mobility)};
  }
  std::vector<std::int64_t> nodes;
  std::vector<double> values;
  for (std::size_t node = 0; node < touched->values.size(); ++node) {
    if (touched->values[node] == 0) continue;
    nodes.push_back(static_cast<std::int64_t>(node));
    const auto first = found.values.begin() + static_cast<std::ptrdiff_t>(3 * node);
    values.insert(values.end(), first, first + 3);
    if (of_nodes != nullptr) mobility.push_back(of_nodes->values[node]);
  }
  return {std::make_shared<const std::vector<std::int64_t>>(std::move(nodes)), std::move(values),
          std::move(mobility)};
}

exchange::GridPacket marks_file(const GridMarks& news, std::span<const std::int32_t> all, const Box& box,
                                std::int64_t step) {
  Array inside{"inside", 1, {all.begin(), all.end()}},
      touched{touched_array, 1, std::vector<double>(all.size())};
  for (const auto node : *news.nodes) touched.values[static_cast<std::size_t>(node)] = 1;
  exchange::GridPacket file;
  file.nodes = box;
  file.point_data = {std::move(inside), std::move(touched)};
  file.field_data = packet_header(step);
  return file;
}

GridMarks grid_marks_of(const exchange::GridPacket& file, std::size_t n_capsules, const Box& box,
                        const std::string& name) {
  check_schema_version(file.field_data, name);
  check_grid(file, box, name);
  const auto* inside = optional_scalars(file.point_data, "inside", name);
  if (inside == nullptr) throw FileError(name + ": array 'inside' is missing");
  const auto* touched = optional_scalars(file.point_data, touched_array, name);
  std::vector<std::int64_t> nodes;
  GridMarks marks;
  for (std::size_t node = 0; node < inside->values.size(); ++node) {
    if (touched != nullptr && touched->values[node] == 0) continue;
    const double mark = inside->values[node];
    if (!(mark >= 0 && mark <= static_cast<double>(n_capsules) && mark == std::floor(mark))) {
      throw FileError(fmt::format(
          "{}: 'inside' of node {} is {}; it is 0 outside, else the number of a capsule from 1 to {}", name,
          node, mark, n_capsules));
    }
    nodes.push_back(static_cast<std::int64_t>(node));
    marks.capsule.push_back(static_cast<std::int32_t>(mark));
  }
  marks.nodes = std::make_shared<const std::vector<std::int64_t>>(std::move(nodes));
  return marks;
}

std::vector<Array> packet_header(std::int64_t step) {
  return {{"step", 1, {static_cast<double>(step)}}, {"schema_version", 1, {schema_version}}};
}

std::int64_t step_of(const std::vector<Array>& field_data, const std::string& name) {
  const auto* array = exchange::find_optional_array(field_data, "step");
  if (array == nullptr) return 0;
  if (array->values.size() != 1 || array->values[0] < 0 || array->values[0] > 9e15 ||
      array->values[0] != std::floor(array->values[0])) {
    throw FileError(fmt::format("{}: 'step' must be one whole number, 0 or above", name));
  }
  return static_cast<std::int64_t>(array->values[0]);
}

void check_schema_version(const std::vector<Array>& field_data, const std::string& name) {
  const auto* array = exchange::find_optional_array(field_data, "schema_version");
  if (array == nullptr) return;
  if (array->values.size() == 1 && array->values[0] >= 1 && array->values[0] <= schema_version) return;
  throw FileError(fmt::format(
      "{}: schema version {} cannot be read, only up to {}; use the program that wrote it", name,
      array->values.empty() ? std::numeric_limits<double>::quiet_NaN() : array->values[0], schema_version));
}

}  // namespace tanktread::driver
