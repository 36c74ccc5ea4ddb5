#include "exchange/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>

#include "exchange/shell_text.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

/// A format by its suffix and by how its files begin (empty: no own beginning).
struct Format {
  std::string_view suffix, beginning, name;
  bool convertible;  ///< by convert-surface
};

constexpr std::array formats = {
    Format{".stl", "solid", "an STL file", true},
    Format{".obj", "", "an OBJ file", true},
    Format{".ply", "ply\n", "a PLY file", true},
    Format{".ply", "ply\r", "a PLY file", true},
    Format{".off", "OFF", "an OFF file", true},
    Format{".msh", "$MeshFormat", "a Gmsh file", true},
    Format{".vtk", "# vtk DataFile", "a file in VTK's old format", false},
    Format{".xdmf", "", "an XDMF file", false},
    Format{".h5", "\x89HDF", "an HDF5 file", false},
    Format{".csv", "", "a table", false},
    Format{".toml", "", "a TOML file", false},
};

std::string suffix_of(const path& file) {
  auto suffix = file.extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

std::string beginning_of(const path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(32, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

std::optional<Format> format_of(const path& name, const path& content) {
  const auto beginning = beginning_of(content);
  if (beginning.starts_with("<?xml") || beginning.starts_with("<VTKFile")) return std::nullopt;
  for (const auto& format : formats) {
    if (!format.beginning.empty() && beginning.starts_with(format.beginning)) return format;
  }
  const auto suffix = suffix_of(name);
  for (const auto& format : formats) {
    if (suffix == format.suffix) return format;
  }
  return std::nullopt;
}

/// How a surface of another format becomes one of ours. convert-surface goes by the suffix.
std::string conversion(const path& name, std::string_view suffix) {
  if (suffix_of(name) == suffix) return "convert it: " + convert_command(name);
  auto renamed = name;
  renamed.replace_extension(suffix);
  return fmt::format("give it the suffix {} and convert it: {}", suffix, convert_command(renamed));
}

}  // namespace

std::string type_text(const std::string& type) {
  if (type == "UnstructuredGrid") return "a surface (.vtu)";
  if (type == "PUnstructuredGrid") return "the index of a surface in pieces (.pvtu)";
  if (type == "ImageData") return "a grid (.vti)";
  if (type == "PImageData") return "the index of a grid in pieces (.pvti)";
  if (type == "Collection") return "a series (.pvd)";
  if (type == "PolyData") return "a VTK file of polygons (.vtp)";
  return "a VTK file of type " + type;
}

std::string convert_command(const path& file) {
  auto target = file;
  target.replace_extension(".vtu");
  if (target == file) target.replace_filename(file.stem().string() + "-double.vtu");
  return fmt::format("python3 -m tanktread_post convert-surface {} {} (post/README.md)", shell_text(file),
                     shell_text(target));
}

std::string foreign_format(const path& name, const path& content, const std::string& type) {
  const auto format = format_of(name, content);
  if (!format) return "";
  std::string fix = "give " + type_text(type);
  if (type == "UnstructuredGrid" && format->convertible) fix = conversion(name, format->suffix);
  if (type == "UnstructuredGrid" && format->suffix == ".vtk")
    fix = "open it in ParaView, apply the filters Triangulate and Append Datasets, and save it as .vtu";
  return fmt::format("is {}, not {}; {}", format->name, type_text(type), fix);
}

std::string other_type(const path& name, const std::string& found, const std::string& type) {
  const bool to_convert = type == "UnstructuredGrid" && found == "PolyData";
  auto fix = "give " + type_text(type);
  if (to_convert) fix = conversion(name, ".vtp");
  if (found == "P" + type)  // which is told by its name
    fix = fmt::format("its name must end with {}", found == "PImageData" ? ".pvti" : ".pvtu");
  return fmt::format("is {}, not {}; {}", type_text(found), type_text(type), fix);
}

}  // namespace tanktread::exchange
