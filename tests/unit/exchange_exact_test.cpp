// Packets that another program computed: taken without a loss of digits, or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exchange_base64.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// An array as other programs write it, in line.
std::string array(const std::string& type, const std::string& name, int components,
                  const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"binary\">" + binary(type, values) + "</DataArray>";
}

const std::string as_text = "<DataArray type=\"Float64\" Name=\"count\" format=\"ascii\">1 2 3</DataArray>";

/// One triangle with an array on its points.
std::string surface_text(const std::string& point_array, const std::string& points_type = "Float64") {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><PointData>" +
         point_array + "</PointData><Points>" + array(points_type, "Points", 3, "0 0 0 1 0 0 0 1 0") +
         "</Points><Cells>" + array("Int32", "connectivity", 1, "0 1 2") + array("Int32", "offsets", 1, "3") +
         array("UInt8", "types", 1, "5") + "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

/// Three nodes.
std::string grid_text(const std::string& point_array) {
  return "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 "
         "2 0 "
         "0 0 0\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 2 0 0 0 0\"><PointData>" +
         point_array + "</PointData></Piece></ImageData></VTKFile>\n";
}

class ExactReading : public ::testing::Test {
 protected:
  /// What is said of a surface that may be read where a loss is allowed.
  std::string surface_error(const std::string& text) {
    put_text(folder_ / "file.vtu", text);
    EXPECT_EQ(error_of([&] { read_surface(folder_ / "file.vtu", true); }), "(no error)");
    return error_of([&] { surface_ = read_exact_surface(folder_ / "file.vtu"); });
  }
  std::string grid_error(const std::string& text) {
    put_text(folder_ / "file.vti", text);
    EXPECT_EQ(error_of([&] { read_grid(folder_ / "file.vti", true); }), "(no error)");
    return error_of([&] { grid_ = read_exact_grid(folder_ / "file.vti"); });
  }

  TemporaryFolder folder_;
  SurfacePacket surface_;
  GridPacket grid_;
};

TEST_F(ExactReading, EveryBitOfOurOwnFilesComesBack) {
  write_surface(folder_ / "file.vtu", sample_surface());
  EXPECT_EQ(difference(read_exact_surface(folder_ / "file.vtu"), sample_surface()), "");
  write_grid(folder_ / "file.vti", sample_grid());
  EXPECT_EQ(difference(read_exact_grid(folder_ / "file.vti"), sample_grid()), "");
}

TEST_F(ExactReading, SinglePrecisionIsRefusedByName) {
  const auto single = array("Float32", "count", 1, "1 2 3");
  EXPECT_THAT(surface_error(surface_text(single)),
              AllOf(HasSubstr("file.vtu: point data array 'count' is of single precision (Float32)"),
                    HasSubstr("write it as Float64")));
  EXPECT_THAT(surface_error(surface_text("", "Float32")),
              HasSubstr("file.vtu: the array of points is of single precision"));
  EXPECT_THAT(grid_error(grid_text(single)),
              HasSubstr("file.vti: point data array 'count' is of single precision"));
}

TEST_F(ExactReading, NumbersAsTextAreRefusedByName) {
  EXPECT_THAT(surface_error(surface_text(as_text)), HasSubstr("file.vtu: array 'count' is written as ASCII"));
  EXPECT_THAT(grid_error(grid_text(as_text)), HasSubstr("file.vti: array 'count' is written as ASCII"));
}

TEST_F(ExactReading, DoublesInLineAndWidenedIntegersAreTaken) {
  const std::vector<double> counts = {1, 2, 3};
  EXPECT_EQ(surface_error(surface_text(array("Int64", "count", 1, "1 2 3"))), "(no error)");
  EXPECT_EQ(surface_.point_data.at(0).values, counts);
  EXPECT_EQ(surface_.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(grid_error(grid_text(array("Float64", "count", 1, "1 2 3"))), "(no error)");
  EXPECT_EQ(grid_.point_data.at(0).values, counts);
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
