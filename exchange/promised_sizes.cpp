#include "exchange/promised_sizes.hpp"

#include <fmt/format.h>
#include <vtkXMLDataElement.h>

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "exchange/grid_head.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;

/// How much larger numbers may be than they are in the file as text: 8 bytes may be a digit and a blank.
constexpr double growth_of_text = 4;

std::string name_of(vtkXMLDataElement& element) {
  const char* name = element.GetAttribute("Name");
  return name != nullptr ? name : "";
}

/// A count of the element's; `absent` if it says none.
std::int64_t count_of(vtkXMLDataElement& element, const char* attribute, std::int64_t least,
                      std::int64_t absent, const fs::path& file) {
  const char* text = element.GetAttribute(attribute);
  if (text == nullptr) return absent;
  std::int64_t count = 0;
  const char* end = text + std::strlen(text);
  const auto [stop, error] = std::from_chars(text, end, count);
  if (error != std::errc() || stop != end || count < least) {
    refuse_attribute(attribute, text, fmt::format("a whole number from {} on", least), file);
  }
  return count;
}

double bytes_a_number(vtkXMLDataElement& array) {
  const char* found = array.GetAttribute("type");
  const std::string_view type = found != nullptr ? found : "";
  if (type == "Bit") return 0.125;
  if (type.ends_with("64")) return 8;
  if (type.ends_with("32")) return 4;
  return type.ends_with("16") ? 2 : 1;
}

/// Arrays held against what the file can hold.
class Promises {
 public:
  Promises(vtkXMLDataElement& root, std::uint64_t n_bytes, const fs::path& file)
      : root_(root), n_bytes_(n_bytes), file_(file) {}

  /// `what` is in the message.
  void check(const std::string& what, double n_numbers, double n_bytes_each) const {
    if (fits_in_file(root_, n_numbers, n_bytes_each, n_bytes_)) return;
    throw FileError(fmt::format(
        "{}: its head promises {} of {:.10g} numbers, which a file of {} bytes cannot hold: it is "
        "damaged; write or copy it again",
        file_.string(), what, n_numbers, n_bytes_));
  }

  /// All arrays of an element (PointData ...); those of field data say their own number of tuples.
  void check_arrays(vtkXMLDataElement* element, double n_tuples) const {
    for (int k = 0; element != nullptr && k < element->GetNumberOfNestedElements(); ++k) {
      auto& array = *element->GetNestedElement(k);
      const auto n_own = count_of(array, "NumberOfTuples", 0, -1, file_);
      const auto n_components = static_cast<double>(count_of(array, "NumberOfComponents", 1, 1, file_));
      check(fmt::format("an array '{}'", name_of(array)),
            (n_own >= 0 ? static_cast<double>(n_own) : n_tuples) * n_components, bytes_a_number(array));
    }
  }

 private:
  vtkXMLDataElement& root_;
  std::uint64_t n_bytes_;
  const fs::path& file_;
};

void check_piece(vtkXMLDataElement& piece, const Promises& promises, const fs::path& file) {
  // At least its type is in the file of each cell; and VTK makes room for the types at once.
  const auto n_cells = static_cast<double>(count_of(piece, "NumberOfCells", 0, 0, file));
  promises.check("cells", n_cells, 1);
  const auto n_points = static_cast<double>(count_of(piece, "NumberOfPoints", 0, 0, file)) +
                        points_of_extent(piece, "Extent", file);
  promises.check_arrays(piece.FindNestedElementWithName("Points"), n_points);
  promises.check_arrays(piece.FindNestedElementWithName("PointData"), n_points);
  // Of a grid the cells are fewer than the nodes.
  promises.check_arrays(piece.FindNestedElementWithName("CellData"), n_cells);
  promises.check_arrays(piece.FindNestedElementWithName("Cells"), n_cells);
}

}  // namespace

bool fits_in_file(vtkXMLDataElement& root, double n_numbers, double n_bytes_each, std::uint64_t n_bytes) {
  const double growth = root.GetAttribute("compressor") != nullptr ? growth_of_compressed : growth_of_text;
  return n_numbers * n_bytes_each <= growth * static_cast<double>(n_bytes);
}

void check_promised_sizes(vtkXMLDataElement& root, std::uint64_t n_bytes, const fs::path& file) {
  const Promises promises(root, n_bytes, file);
  for (int k = 0; k < root.GetNumberOfNestedElements(); ++k) {
    auto& data_set = *root.GetNestedElement(k);
    const auto n_points = points_of_extent(data_set, "WholeExtent", file);
    promises.check_arrays(data_set.FindNestedElementWithName("FieldData"), 0);
    for (int j = 0; j < data_set.GetNumberOfNestedElements(); ++j) {
      auto& piece = *data_set.GetNestedElement(j);
      if (std::string_view(piece.GetName()) != "Piece") continue;
      check_piece(piece, promises, file);
      // VTK makes room for the whole grid, of which a piece may be but a part.
      promises.check_arrays(piece.FindNestedElementWithName("PointData"), n_points);
    }
  }
}

}  // namespace tanktread::exchange
