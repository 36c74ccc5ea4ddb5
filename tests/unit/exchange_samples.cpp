#include "tests/unit/exchange_samples.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

namespace tanktread::exchange::testing {
namespace {

namespace fs = std::filesystem;

Array awkward_array(const std::string& name, int components, std::size_t n_tuples, std::size_t first) {
  return {name, components, awkward_numbers(n_tuples * static_cast<std::size_t>(components), first)};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  auto name = (fs::temp_directory_path() / "tanktread-exchange-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<double> awkward_numbers() {
  using limits = std::numeric_limits<double>;
  return {std::bit_cast<double>(std::uint64_t{0x7ff8000000000000}),  // quiet NaN
          std::bit_cast<double>(std::uint64_t{0x7ff8dead0000beef}),  // with a payload
          std::bit_cast<double>(std::uint64_t{0xfff8000000000001}),  // negative
          std::bit_cast<double>(std::uint64_t{0x7ff0000000000001}),  // signalling
          limits::infinity(),
          -limits::infinity(),
          0.0,
          -0.0,
          limits::denorm_min(),
          -limits::denorm_min(),
          std::bit_cast<double>(std::uint64_t{0x000fffffffffffff}),  // the largest subnormal
          limits::min(),
          limits::max(),
          limits::lowest(),
          limits::epsilon(),
          0.1,
          1.0 / 3.0,
          -12345678.901234567};
}

std::vector<double> awkward_numbers(std::size_t n, std::size_t first) {
  const auto numbers = awkward_numbers();
  std::vector<double> values;
  for (std::size_t k = 0; k < n; ++k) values.push_back(numbers[(first + k) % numbers.size()]);
  return values;
}

SurfacePacket sample_surface(bool awkward_points) {
  SurfacePacket packet;
  packet.points =
      awkward_points ? awkward_numbers(18, 0) : std::vector<double>{1.1, 0,  0, -1, 0, 0, 0, 1.0 / 3, 0,  //
                                                                    0,   -1, 0, 0,  0, 1, 0, 0,       -0.7};
  packet.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  packet.point_data = {awkward_array("velocity", 3, 6, 1), awkward_array("elastic_force", 3, 6, 2),
                       awkward_array("total_force", 3, 6, 3)};
  packet.cell_data = {awkward_array("principal_stretches", 2, 8, 4), awkward_array("stress", 9, 8, 5),
                      awkward_array("area_ratio", 1, 8, 6)};
  packet.field_data = {{"step", 1, {12345}}, {"shear_time", 1, {0.1}}, awkward_array("history", 1, 40, 7)};
  return packet;
}

GridPacket sample_grid() {
  GridPacket packet;
  packet.nodes = {4, 3, 2};
  packet.spacing = {1, 0.1, 1.0 / 3};
  packet.origin = {0.5, 0.5, 1.0 / 7};
  packet.point_data = {awkward_array("populations", 19, 24, 0), awkward_array("force", 3, 24, 1),
                       awkward_array("density", 1, 24, 2)};
  packet.field_data = {{"step", 1, {7}}, awkward_array("odd numbers", 2, 9, 3)};
  return packet;
}

std::string difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::to_string(a.size()) + " values, " + std::to_string(b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::memcmp(&a[k], &b[k], sizeof(double)) != 0) return "value " + std::to_string(k);
  }
  return "";
}

std::string difference(const std::vector<Array>& a, const std::vector<Array>& b) {
  if (a.size() != b.size()) return std::to_string(a.size()) + " arrays, " + std::to_string(b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].name != b[k].name) return "names '" + a[k].name + "', '" + b[k].name + "'";
    if (a[k].components != b[k].components) return a[k].name + ": number of components";
    const auto values = difference(a[k].values, b[k].values);
    if (!values.empty()) return a[k].name + ": " + values;
  }
  return "";
}

std::string difference(const SurfacePacket& a, const SurfacePacket& b) {
  const auto points = difference(a.points, b.points);
  if (!points.empty()) return "points: " + points;
  if (a.triangles != b.triangles) return "triangles";
  return difference(a.point_data, b.point_data) + difference(a.cell_data, b.cell_data) +
         difference(a.field_data, b.field_data);
}

std::string difference(const GridPacket& a, const GridPacket& b) {
  if (a.nodes != b.nodes) return "nodes";
  if (a.origin != b.origin) return "origin";
  if (a.spacing != b.spacing) return "spacing";
  return difference(a.point_data, b.point_data) + difference(a.field_data, b.field_data);
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put_text(const fs::path& file, const std::string& text) {
  fs::remove(file);  // some file systems wait for the disk when a file is cut and written anew
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.what();
  }
  return "(no error)";
}

std::string error_of(const std::function<void()>& call) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const auto message = message_of(call);
  const auto errors = ::testing::internal::GetCapturedStderr(),
             output = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(errors, "");
  EXPECT_EQ(output, "");
  return message;
}

}  // namespace tanktread::exchange::testing
