#include "exchange/grid_text.hpp"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "exchange/content_hash.hpp"
#include "exchange/vtk_arrays.hpp"
#include "exchange/vtk_calls.hpp"

namespace tanktread::exchange {
namespace {

/// Where a text stands that VTK is known to write.
std::size_t place_of(std::string_view text, std::string_view what, std::size_t from = 0) {
  const auto place = text.find(what, from);
  if (place == std::string_view::npos)
    throw std::logic_error(fmt::format("VTK's writer of grids does not write '{}'", what));
  return place;
}

/// An attribute's value and its end, in the room that VTK leaves for it.
std::string in_room(const std::string& value) {
  return fmt::format("{:<22}", value + '"');
}

std::string in_room(double value) {
  return in_room(fmt::format("{:.11g}", value));
}

std::string line_of(const ArrayShape& shape, const NormRange& range, std::uint64_t offset) {
  const auto components =
      shape.components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", shape.components);
  return fmt::format(
      "        <DataArray type=\"Float64\" Name=\"{}\"{} format=\"appended\" "
      "RangeMin=\"{}RangeMax=\"{}offset=\"{:<21}/>\n",
      shape.name, components, in_room(range[0]), in_room(range[1]), fmt::format("{}\"", offset));
}

/// Puts a value in the place of the first one of that name from a place on.
void put_attribute(std::string& head, std::size_t from, const std::string& name, double value) {
  const auto place = place_of(head, name + "=\"", from) + name.size() + 2;
  const auto text = in_room(value);
  head.replace(place, text.size(), text);
}

std::string without_point_data(const GridPacket& grid, const std::filesystem::path& file) {
  const std::vector<Array> hash = {to_array(0)};
  vtkNew<vtkImageData> image;
  const auto& [x, y, z] = grid.begin;
  image->SetExtent(x, x + grid.nodes[0] - 1, y, y + grid.nodes[1] - 1, z, z + grid.nodes[2] - 1);
  image->SetOrigin(grid.origin.data());
  image->SetSpacing(grid.spacing.data());
  add_arrays(hash, any_size, *image->GetFieldData(), "field data", file);
  add_arrays(grid.field_data, any_size, *image->GetFieldData(), "field data", file);
  vtkNew<vtkXMLImageDataWriter> writer;
  return text_with(*writer, *image, file);
}

}  // namespace

void widen(NormRange& range, const ArrayShape& shape, std::span<const double> values) {
  const auto components = static_cast<std::size_t>(shape.components);
  for (std::size_t first = 0; first < values.size(); first += components) {
    double least = values[first], greatest = least;
    if (components > 1) {
      double sum = 0;
      for (const double value : values.subspan(first, components)) sum += value * value;
      least = std::sqrt(std::min(sum, no_norms[0]));  // where VTK begins to look for the least sum
      greatest = std::sqrt(sum);
    }
    if (std::isnan(greatest)) continue;
    range = {std::min(range[0], least), std::max(range[1], greatest)};
  }
}

GridText::GridText(const GridPacket& grid, const std::vector<ArrayShape>& point_data,
                   const std::filesystem::path& file)
    : point_data_(point_data), n_nodes_(1) {
  for (const int n : grid.nodes) n_nodes_ *= static_cast<std::uint64_t>(n);
  const auto text = without_point_data(grid, file);
  constexpr std::string_view begin = "\n   _";
  const auto numbers = place_of(text, begin, place_of(text, "<AppendedData")) + begin.size();
  const auto end = text.rfind("\n  </AppendedData>");
  head_ = text.substr(0, numbers);
  field_numbers_ = text.substr(numbers, end - numbers);
  after_ = text.substr(end);
}

std::string GridText::before(const std::array<double, 2>& hash, const std::vector<NormRange>& ranges) const {
  std::string lines;
  std::uint64_t offset = field_numbers_.size();
  for (std::size_t k = 0; k < point_data_.size(); ++k) {
    lines += line_of(point_data_[k], ranges[k], offset);
    offset +=
        sizeof offset + n_nodes_ * static_cast<std::uint64_t>(point_data_[k].components) * sizeof(double);
  }
  auto head = head_;
  head.insert(place_of(head, "      </PointData>"), lines);
  const auto of_hash = place_of(head, fmt::format("Name=\"{}\"", content_hash_name));
  put_attribute(head, of_hash, "RangeMin", std::min(hash[0], hash[1]));
  put_attribute(head, of_hash, "RangeMax", std::max(hash[0], hash[1]));
  auto numbers = field_numbers_;  // the hash is the first of them, after its length
  std::memcpy(&numbers[sizeof offset], hash.data(), sizeof hash);
  return head + numbers;
}

}  // namespace tanktread::exchange
