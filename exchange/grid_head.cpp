#include "exchange/grid_head.hpp"

#include <fmt/format.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <charconv>
#include <cmath>
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
std::vector<double> numbers_in(const std::string& text) {
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

std::vector<double> numbers_of(vtkXMLDataElement& element, const char* attribute, std::size_t n,
                               const fs::path& file) {
  const char* text = element.GetAttribute(attribute);
  if (text == nullptr) return {};
  auto numbers = numbers_in(text);
  const bool are_finite =
      std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
  if (numbers.size() != n || !are_finite)
    refuse_attribute(attribute, text, fmt::format("{} finite numbers", n), file);
  return numbers;
}

Extent extent_of(vtkXMLDataElement& element, const char* attribute, const fs::path& file) {
  constexpr double greatest = std::numeric_limits<int>::max();
  const char* found = element.GetAttribute(attribute);
  const std::string text = found != nullptr ? found : "";
  const auto numbers = numbers_in(text);
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

double cells_of(const Extent& extent) {
  return size_of(extent, true);
}

double points_of_extent(vtkXMLDataElement& element, const char* attribute, const fs::path& file) {
  return element.GetAttribute(attribute) != nullptr ? size_of(extent_of(element, attribute, file), false) : 0;
}

void check_grid_head(vtkXMLDataElement& grid, const fs::path& file) {
  numbers_of(grid, "Origin", 3, file);
  numbers_of(grid, "Spacing", 3, file);
  numbers_of(grid, "Direction", 9, file);
  if (grid.GetAttribute("WholeExtent") == nullptr) return;  // which VTK says
  const auto whole = cells_of(extent_of(grid, "WholeExtent", file));
  double filled = 0;
  for (int k = 0; k < grid.GetNumberOfNestedElements(); ++k) {
    auto& piece = *grid.GetNestedElement(k);
    if (std::string_view(piece.GetName()) == "Piece" && piece.GetAttribute("Extent") != nullptr)
      filled += cells_of(extent_of(piece, "Extent", file));
  }
  if (filled == whole) return;
  throw FileError(
      fmt::format("{}: the grid has {:.10g} cells (WholeExtent), its pieces have {:.10g} (Extent): a part is "
                  "missing or there twice; write the whole grid as one piece",
                  file.string(), whole, filled));
}

}  // namespace tanktread::exchange
