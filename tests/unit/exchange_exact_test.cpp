// Packets that another program computed: taken without a loss of digits, or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// One triangle with an array on its points, all as text.
std::string surface_text(const std::string& type, const std::string& points_type) {
  const auto array = [](const std::string& kind, const std::string& name, int components,
                        const std::string& values) {
    return "<DataArray type=\"" + kind + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"ascii\">" + values + "</DataArray>";
  };
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
         "NumberOfCells=\"1\"><PointData>" +
         array(type, "count", 1, "1 2 3") + "</PointData><Points>" +
         array(points_type, "Points", 3, "0 0 0 1 0 0 0 1 0") + "</Points><Cells>" +
         array("Int32", "connectivity", 1, "0 1 2") + array("Int32", "offsets", 1, "3") +
         array("UInt8", "types", 1, "5") + "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

std::string grid_text(const std::string& type) {
  return "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 1 0 0 0 0\" Origin=\"0 0 "
         "0\" "
         "Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 0 0 0\"><PointData><DataArray type=\"" +
         type +
         "\" Name=\"density\" format=\"ascii\">1 2</DataArray></PointData></Piece></ImageData></VTKFile>\n";
}

class ExactReading : public ::testing::Test {
 protected:
  std::string surface_error(const std::string& type, const std::string& points_type) {
    put_text(folder_ / "file.vtu", surface_text(type, points_type));
    EXPECT_EQ(error_of([&] { read_surface(folder_ / "file.vtu", true); }), "(no error)");
    return error_of([&] { read_exact_surface(folder_ / "file.vtu"); });
  }
  std::string grid_error(const std::string& type) {
    put_text(folder_ / "file.vti", grid_text(type));
    EXPECT_EQ(error_of([&] { read_grid(folder_ / "file.vti", true); }), "(no error)");
    return error_of([&] { read_exact_grid(folder_ / "file.vti"); });
  }

  TemporaryFolder folder_;
};

TEST_F(ExactReading, EveryBitOfOurOwnFilesComesBack) {
  write_surface(folder_ / "file.vtu", sample_surface());
  EXPECT_EQ(difference(read_exact_surface(folder_ / "file.vtu"), sample_surface()), "");
  write_grid(folder_ / "file.vti", sample_grid());
  EXPECT_EQ(difference(read_exact_grid(folder_ / "file.vti"), sample_grid()), "");
}

TEST_F(ExactReading, SinglePrecisionIsRefusedByName) {
  EXPECT_THAT(surface_error("Float32", "Int8"),
              AllOf(HasSubstr("file.vtu: array 'count' is of single precision (Float32)"),
                    HasSubstr("write it as Float64")));
  EXPECT_THAT(surface_error("Int8", "Float32"), HasSubstr("array 'Points' is of single precision"));
  EXPECT_THAT(grid_error("Float32"), HasSubstr("file.vti: array 'density' is of single precision"));
}

TEST_F(ExactReading, RealNumbersAsTextAreRefusedByName) {
  EXPECT_THAT(surface_error("Float64", "Int8"),
              AllOf(HasSubstr("file.vtu: array 'count' is written as text (ASCII)"),
                    HasSubstr("write it as binary or appended data")));
  EXPECT_THAT(grid_error("Float64"), HasSubstr("file.vti: array 'density' is written as text"));
}

TEST_F(ExactReading, IntegersAreWidened) {
  EXPECT_EQ(surface_error("Int64", "Int8"), "(no error)");
  EXPECT_EQ(read_exact_surface(folder_ / "file.vtu").point_data.at(0).values, (std::vector<double>{1, 2, 3}));
}

/// Changes one number of a file of ours, whose hash is then that of something else.
template <class Packet>
void change_a_number(const std::filesystem::path& file, const Packet& packet) {
  const auto& values = packet.point_data.back().values;
  const std::string bytes(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  auto text = read_text(file);
  text[text.find(bytes) + 1] ^= 1;
  put_text(file, text);
}

TEST_F(ExactReading, AHashThatAProgramKeptIsLeftUnread) {
  write_surface(folder_ / "file.vtu", sample_surface());
  change_a_number(folder_ / "file.vtu", sample_surface());
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "file.vtu"); }), HasSubstr("content_hash"));
  EXPECT_EQ(read_exact_surface(folder_ / "file.vtu").field_data.size(), sample_surface().field_data.size());
  write_grid(folder_ / "file.vti", sample_grid());
  change_a_number(folder_ / "file.vti", sample_grid());
  EXPECT_THAT(error_of([&] { read_grid(folder_ / "file.vti"); }), HasSubstr("content_hash"));
  EXPECT_EQ(read_exact_grid(folder_ / "file.vti").field_data.size(), sample_grid().field_data.size());
}

}  // namespace
}  // namespace tanktread::exchange::testing
