#include "exchange/grid_head.hpp"

#include <fmt/format.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;

/// The numbers of an attribute; as many as there are up to the first word that is none, which counts as a
/// NaN.
std::vector<double> numbers_of(const char* text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    double number = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    const bool is_number = error == std::errc() && stop == end;
    numbers.push_back(is_number ? number : std::numeric_limits<double>::quiet_NaN());
  }
  return numbers;
}

void check_numbers(vtkXMLDataElement& grid, const char* attribute, std::size_t n, const fs::path& file) {
  const char* text = grid.GetAttribute(attribute);
  if (text == nullptr) return;
  const auto numbers = numbers_of(text);
  const bool are_finite =
      std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
  if (numbers.size() != n || !are_finite)
    refuse_attribute(attribute, text, fmt::format("{} finite numbers", n), file);
}

using Extent = std::array<std::int64_t, 6>;

Extent extent_of(vtkXMLDataElement& element, const char* attribute, const fs::path& file) {
  constexpr double greatest = std::numeric_limits<int>::max();
  const char* text = element.GetAttribute(attribute);
  const auto numbers = numbers_of(text);
  Extent extent{};
  bool fits = numbers.size() == extent.size();
  for (std::size_t k = 0; k < extent.size() && fits; ++k) {
    fits = std::abs(numbers[k]) < greatest && numbers[k] == std::floor(numbers[k]);
    if (fits) extent[k] = static_cast<std::int64_t>(numbers[k]);
  }
  for (std::size_t k = 0; k < extent.size() && fits; k += 2)
    fits = static_cast<double>(extent[k + 1] - extent[k]) < greatest;
  if (!fits)
    refuse_attribute(attribute, text,
                     "six whole numbers of 32 bits, the first and last node along x, y and z", file);
  return extent;
}

/// Of nodes or, which pieces of a grid share none of, cells; a grid of one node along an axis has one cell
/// there.
double size_of(const Extent& extent, bool of_cells) {
  double size = 1;
  for (std::size_t k = 0; k < extent.size(); k += 2) {
    const auto n_nodes = std::max<std::int64_t>(extent[k + 1] - extent[k] + 1, 0);
    size *= static_cast<double>(of_cells && n_nodes > 1 ? n_nodes - 1 : n_nodes);
  }
  return size;
}

}  // namespace

void refuse_attribute(const std::string& attribute, const std::string& found, const std::string& expected,
                      const fs::path& file) {
  throw FileError(
      fmt::format("{}: its head has {}=\"{}\", which is not {}: it is damaged; write or copy it again",
                  file.string(), attribute, found, expected));
}

double points_of_extent(vtkXMLDataElement& element, const char* attribute, const fs::path& file) {
  return element.GetAttribute(attribute) != nullptr ? size_of(extent_of(element, attribute, file), false) : 0;
}

void check_grid_head(vtkXMLDataElement& grid, const fs::path& file) {
  check_numbers(grid, "Origin", 3, file);
  check_numbers(grid, "Spacing", 3, file);
  check_numbers(grid, "Direction", 9, file);
  if (grid.GetAttribute("WholeExtent") == nullptr) return;  // which VTK says
  const auto whole = size_of(extent_of(grid, "WholeExtent", file), true);
  double filled = 0;
  for (int k = 0; k < grid.GetNumberOfNestedElements(); ++k) {
    auto& piece = *grid.GetNestedElement(k);
    if (std::string_view(piece.GetName()) == "Piece" && piece.GetAttribute("Extent") != nullptr)
      filled += size_of(extent_of(piece, "Extent", file), true);
  }
  if (filled == whole) return;
  throw FileError(
      fmt::format("{}: the grid has {:.10g} cells (WholeExtent), its pieces have {:.10g} (Extent): a part is "
                  "missing or there twice; write the whole grid as one piece",
                  file.string(), whole, filled));
}

}  // namespace tanktread::exchange
