// What crosses a border between components, as plain arrays: surfaces and grids with named data.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace tanktread::exchange {

/// Named numbers: `components` a tuple (point, cell or entry), component fastest.
struct Array {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// A surface of triangles with data on its points and cells, and numbers of the whole (step, time, version
/// ...).
struct SurfacePacket {
  std::vector<double> points;           ///< 3 a node
  std::vector<std::int64_t> triangles;  ///< 3 a triangle
  std::vector<Array> point_data, cell_data, field_data;
};

/// Data on the nodes of a Cartesian grid, x fastest, or on a block of them.
struct GridPacket {
  std::array<int, 3> nodes = {0, 0, 0};
  std::array<double, 3> origin = {0.5, 0.5,
                                  0.5};  ///< position of node (0, 0, 0): one frame with the surfaces
  std::array<double, 3> spacing = {1, 1, 1};
  /// Of a piece of a grid: the place of its first node in the whole, whose origin is that above.
  std::array<int, 3> begin = {0, 0, 0};
  std::vector<Array> point_data, field_data;
};

/// Where the first node of a grid, or of a piece, lies.
std::array<double, 3> first_node(const GridPacket& packet);

/// A file could not be read or written, or is not what it should be. The message names the file, what is
/// wrong, and VTK's own words.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The array of that name; null: there is none.
const Array* find_optional_array(const std::vector<Array>& arrays, const std::string& name);

/// The array of that name. @throws FileError naming `where` and the arrays that are there
const Array& find_array(const std::vector<Array>& arrays, const std::string& name, const std::string& where);

}  // namespace tanktread::exchange
