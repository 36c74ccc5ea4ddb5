#include "exchange/raw_grid_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "exchange/content_hash.hpp"
#include "exchange/file_head.hpp"
#include "exchange/grid_head.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

bool has(vtkXMLDataElement& element, const char* attribute, std::string_view value) {
  const char* found = element.GetAttribute(attribute);
  return found != nullptr && found == value;
}

/// The numbers of an array as the head tells of them.
struct Told {
  std::string name;
  int components = 1;
  std::uint64_t position = 0;  ///< of its length
  int n_tuples = 0;            ///< of field data
};

/// A head in our form, read element by element; whatever is otherwise is for VTK.
class Head {
 public:
  Head(vtkXMLDataParser& parser, const path& file)
      : file_(file), numbers_(static_cast<std::uint64_t>(parser.GetAppendedDataPosition())) {
    auto& root = *parser.GetRootElement();
    auto* image = root.FindNestedElementWithName("ImageData");
    is_ours_ = image != nullptr && has_raw_numbers(root) && take_frame(*image);
    for (int k = 0; is_ours_ && k < image->GetNumberOfNestedElements(); ++k)
      is_ours_ = take_element(*image->GetNestedElement(k));
    is_ours_ = is_ours_ && n_pieces_ == 1;
  }

  bool is_ours() const { return is_ours_; }

  GridPacket grid;
  std::vector<Told> point_data, field_data;

 private:
  bool take_frame(vtkXMLDataElement& element) {
    if (element.GetAttribute("WholeExtent") == nullptr) return false;
    extent_ = extent_of(element, "WholeExtent", file_);
    const auto origin = numbers_of(element, "Origin", 3, file_);
    const auto spacing = numbers_of(element, "Spacing", 3, file_);
    if (origin.empty() || spacing.empty()) return false;
    if (numbers_of(element, "Direction", 9, file_) != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1})
      return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = extent_[2 * axis], last = extent_[2 * axis + 1];
      if (last < first) return false;
      grid.begin[axis] = static_cast<int>(first);
      grid.nodes[axis] = static_cast<int>(last - first + 1);
      grid.origin[axis] = origin[axis];
      grid.spacing[axis] = spacing[axis];
    }
    return true;
  }

  bool take_element(vtkXMLDataElement& element) {
    const std::string_view name = element.GetName();
    if (name == "FieldData") return take_arrays(element, field_data);
    return name == "Piece" && take_piece(element);
  }

  bool take_piece(vtkXMLDataElement& piece) {
    if (++n_pieces_ > 1 || piece.GetAttribute("Extent") == nullptr ||
        extent_of(piece, "Extent", file_) != extent_) {
      return false;
    }
    for (int k = 0; k < piece.GetNumberOfNestedElements(); ++k) {
      auto& element = *piece.GetNestedElement(k);
      const std::string_view name = element.GetName();
      if (name == "CellData" && element.GetNumberOfNestedElements() == 0) continue;
      if (name != "PointData" || !take_arrays(element, point_data)) return false;
    }
    return true;
  }

  bool take_arrays(vtkXMLDataElement& element, std::vector<Told>& arrays) const {
    for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
      auto& array = *element.GetNestedElement(k);
      const char* name = array.GetAttribute("Name");
      long long offset = -1;
      Told told;
      if (name == nullptr || !has(array, "type", "Float64") || !has(array, "format", "appended") ||
          array.GetScalarAttribute("offset", offset) != 1 || offset < 0) {
        return false;
      }
      if (std::ranges::find(arrays, name, &Told::name) != arrays.end()) return false;
      told.name = name;
      told.position = numbers_ + static_cast<std::uint64_t>(offset);
      array.GetScalarAttribute("NumberOfComponents", told.components);
      array.GetScalarAttribute("NumberOfTuples", told.n_tuples);
      if (told.components < 1 || told.n_tuples < 0) return false;
      arrays.push_back(told);
    }
    return true;
  }

  const path& file_;
  std::uint64_t numbers_;
  Extent extent_{};
  int n_pieces_ = 0;
  bool is_ours_ = false;
};

[[noreturn]] void refuse(const path& file, const std::string& why) {
  throw FileError(fmt::format("{}: cannot be read: {}", file.string(), why));
}

/// @return whether all were there
bool read_at(const Descriptor& open, std::uint64_t position, void* to, std::size_t n_bytes,
             const path& file) {
  auto* next = static_cast<char*>(to);
  while (n_bytes > 0) {
    const auto n = ::pread(open.number(), next, n_bytes, static_cast<off_t>(position));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(file, std::strerror(errno));
    if (n == 0) return false;
    next += n;
    position += static_cast<std::uint64_t>(n);
    n_bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

/// Whether an array has as many numbers as it should, by the length before them.
bool has_length(const Descriptor& open, const Told& told, std::uint64_t n_values, const path& file) {
  std::uint64_t length = 0;
  return read_at(open, told.position, &length, sizeof length, file) && length == n_values * sizeof(double);
}

}  // namespace

std::optional<RawGridFile::Identity> RawGridFile::identity_of(const Descriptor& open) {
  struct stat status {};
  if (::fstat(open.number(), &status) != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                  status.st_mtim.tv_nsec};
}

std::uint64_t RawGridFile::n_values(const Array& shape) const {
  auto n = static_cast<std::uint64_t>(shape.components);
  for (const int along : grid_.nodes) n *= static_cast<std::uint64_t>(along);
  return n;
}

std::optional<RawGridFile> RawGridFile::open(const path& file, bool convert) {
  const WholeFile whole(file, "ImageData");
  check_head(whole, "ImageData", !convert);
  std::ifstream stream(whole.content(), std::ios::binary);
  vtkNew<vtkXMLDataParser> parser;
  parse_head(*parser, stream, file);
  Head head(*parser, file);
  const Descriptor open(whole.content(), O_RDONLY);
  const auto identity = open.is_open() ? identity_of(open) : std::nullopt;
  if (!head.is_ours() || !identity) return std::nullopt;
  RawGridFile result;
  result.name_ = file;
  result.identity_ = *identity;
  result.grid_ = std::move(head.grid);
  for (const auto& told : head.point_data) {
    const Array shape{told.name, told.components, {}};
    if (!has_length(open, told, result.n_values(shape), file)) return std::nullopt;
    result.positions_.push_back(told.position + sizeof(std::uint64_t));
    result.grid_.point_data.push_back(shape);
  }
  for (const auto& told : head.field_data) {
    const auto n = static_cast<std::uint64_t>(told.components) * static_cast<std::uint64_t>(told.n_tuples);
    if (!has_length(open, told, n, file)) return std::nullopt;
    Array array{told.name, told.components, std::vector<double>(n)};
    if (!read_at(open, told.position + sizeof n, array.values.data(), n * sizeof(double), file))
      return std::nullopt;
    result.grid_.field_data.push_back(std::move(array));
  }
  result.hash_ = take_hash(result.grid_.field_data);
  return result;
}

void RawGridFile::check_content() const {
  if (!hash_) return;
  constexpr std::uint64_t most = std::uint64_t{1} << 17;
  GridHash hash(grid_, grid_.point_data.size());
  std::vector<double> values;
  for (const auto& shape : grid_.point_data) {
    const Opened opened(*this, shape.name);
    const auto n = n_values(shape);
    hash.begin_array({shape.name, shape.components}, n);
    for (std::uint64_t first = 0; first < n; first += most) {
      values.resize(std::min(most, n - first));
      opened.read(first, values);
      hash.add(values);
    }
  }
  check_hash(*hash_, hash.with(grid_.field_data), name_);
}

RawGridFile::Opened::Opened(const RawGridFile& file, const std::string& array)
    : name_(file.name_), open_(name_, O_RDONLY) {
  if (!open_.is_open()) refuse(name_, std::strerror(errno));
  if (identity_of(open_) != file.identity_)
    refuse(name_, "it has changed while it was read; write or copy it again");
  const auto found = std::ranges::find(file.grid_.point_data, array, &Array::name);
  position_ = file.positions_.at(static_cast<std::size_t>(found - file.grid_.point_data.begin()));
}

void RawGridFile::Opened::read(std::uint64_t first, std::span<double> values) const {
  if (!read_at(open_, position_ + first * sizeof(double), values.data(), values.size_bytes(), name_))
    refuse(name_, "it has become shorter while it was read; write or copy it again");
}

}  // namespace tanktread::exchange
