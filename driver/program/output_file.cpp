#include "driver/program/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "driver/program/errors.hpp"
#include "driver/program/output_directory.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

/// As far as the head of a VTK file reaches before its numbers: a few hundred bytes an array.
constexpr std::streamsize head_bytes = 1 << 16;

std::string head_of(const fs::path& file) {
  std::string head(head_bytes, '\0');
  std::ifstream input(file, std::ios::binary);
  input.read(head.data(), head_bytes);
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(input.gcount(), 0)));
  return head;
}

bool may_be_replaced(const fs::path& file, const OutputKind& kind) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  if (fs::file_size(file, error) == 0) return true;
  const auto head = head_of(file);
  return head.starts_with(kind.begins_with) && head.find(kind.has) != std::string::npos;
}

[[noreturn]] void refuse(const NamedFile& output, const std::string& why) {
  throw InputError(fmt::format("{} {}: {}", output.option, output.file.string(), why));
}

OutputKind vtk_output(const std::string& extension, const std::string& what, const std::string& type) {
  return {extension, what, fmt::format("<VTKFile type=\"{}\"", type), "Name=\"content_hash\""};
}

}  // namespace

OutputKind surface_output() {
  return vtk_output(".vtu", "a surface file of tanktread", "UnstructuredGrid");
}

OutputKind grid_output() {
  return vtk_output(".vti", "a grid file of tanktread", "ImageData");
}

OutputKind table_output(const std::string& header) {
  return {".csv", "a table with the same columns", header, ""};
}

void check_output(const NamedFile& output, const OutputKind& kind, const std::vector<NamedFile>& inputs) {
  const auto& file = output.file;
  const auto folder = fs::absolute(file).parent_path();
  if (fs::is_directory(file)) refuse(output, "is a folder; give the name of a file");
  if (file.extension() != kind.extension) {
    refuse(output, fmt::format("what is written is a {} file; give a name that ends in {}", kind.extension,
                               kind.extension));
  }
  if (!fs::is_directory(folder))
    refuse(output, fmt::format("there is no folder {}; make it, or give another name", folder.string()));
  if (const auto run = run_that_owns(file)) {
    refuse(
        output,
        fmt::format("is a place of the run in {}, which would no longer be whole; give a name outside of it",
                    run->string()));
  }
  if (!fs::exists(file)) return;
  for (const auto& input : inputs) {
    if (input.file.empty() || !fs::exists(input.file) || !fs::equivalent(file, input.file)) continue;
    refuse(output, fmt::format("is the file that {} names, which is read; give another name", input.option));
  }
  if (!may_be_replaced(file, kind)) {
    refuse(output, fmt::format("is there already and is not {}, so it is not replaced; give another name, or "
                               "remove it first",
                               kind.what));
  }
}

}  // namespace tanktread::driver
