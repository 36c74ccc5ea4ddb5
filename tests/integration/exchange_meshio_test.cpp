// meshio reads what we write, to the bit, and we read what meshio writes. Without meshio these tests fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Whether exchange_meshio.py succeeds with these arguments; its words go to this test's output.
bool meshio(const std::string& arguments) {
  const std::string command = TANKTREAD_PYTHON " " TANKTREAD_MESHIO_SCRIPT " " + arguments;
  return std::system(command.c_str()) == 0;
}

template <class Number>
void dump(const std::filesystem::path& file, const std::vector<Number>& values) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(Number)));
}

void dump(const std::filesystem::path& folder, const SurfacePacket& packet) {
  std::filesystem::create_directory(folder);
  dump(folder / "points", packet.points);
  dump(folder / "triangles", packet.triangles);
  for (const auto& array : packet.point_data) dump(folder / ("point_" + array.name), array.values);
  for (const auto& array : packet.cell_data) dump(folder / ("cell_" + array.name), array.values);
  for (const auto& array : packet.field_data) dump(folder / ("field_" + array.name), array.values);
}

/// Whether meshio finds in the file of `written` the numbers of `expected`.
bool meshio_finds(const SurfacePacket& written, const SurfacePacket& expected) {
  const TemporaryFolder folder;
  write_surface(folder / "surface.vtu", written);
  dump(folder / "surface", expected);
  return meshio("check " + (folder / "").string());
}

TEST(Meshio, ReadsOurSurfacesToTheBit) {
  EXPECT_TRUE(meshio_finds(sample_surface(), sample_surface()));
}

TEST(Meshio, ReadsSurfacesWithFieldDataOfAnyLength) {
  // Among them an empty history, as of a membrane that has none, and lengths that meshio reads only with
  // padding.
  const TemporaryFolder folder;
  int n_padded = 0;
  for (std::size_t n = 0; n < 60; ++n) {
    auto packet = sample_surface();
    packet.field_data = {{"step", 1, {1}}, {"history", 1, awkward_numbers(n, n)}};
    const auto name = "surface" + std::to_string(n);
    write_surface(folder / (name + ".vtu"), packet);
    dump(folder / name, packet);
    EXPECT_EQ(difference(read_surface(folder / (name + ".vtu")), packet), "");
    n_padded += read_text(folder / (name + ".vtu")).find("padding_for_meshio") != std::string::npos ? 1 : 0;
  }
  EXPECT_TRUE(meshio("check " + (folder / "").string()));
  EXPECT_GT(n_padded, 0) << "no length was a difficult one";
  EXPECT_LT(n_padded, 30);
}

TEST(Meshio, WouldSeeASingleBit) {
  auto other = sample_surface();
  other.field_data[2].values[7] = -other.field_data[2].values[7];
  EXPECT_FALSE(meshio_finds(sample_surface(), other));
}

class MeshioWrites : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(meshio("write " + (folder_ / "").string())); }
  const TemporaryFolder folder_;
};

TEST_F(MeshioWrites, CompressedAndPlainSurfaces) {
  for (const char* name : {"zlib.vtu", "plain.vtu"}) {
    EXPECT_THAT(message_of([&] { read_surface(folder_ / name); }), HasSubstr("is of type int, not double"))
        << name;
    const auto packet = read_surface(folder_ / name, true);
    EXPECT_THAT(packet.points, ElementsAre(0, 0, 0, 1, 0, 0.1, 1, 1, 1.0 / 3, 0, 1, -2.5)) << name;
    EXPECT_THAT(packet.triangles, ElementsAre(0, 1, 2, 0, 2, 3)) << name;
    EXPECT_EQ(difference(packet.point_data, {{"speed", 1, {0.1, 1.0 / 3, 1e-310, -0.0}}}), "") << name;
    EXPECT_EQ(difference(packet.cell_data, {{"label", 1, {7, 8}}}), "") << name;
  }
}

TEST_F(MeshioWrites, SurfacesInSinglePrecision) {
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "float32.vtu"); }),
              HasSubstr("points is of type float, not double"));
  const auto packet = read_surface(folder_ / "float32.vtu", true);
  EXPECT_EQ(packet.points[5], static_cast<double>(0.1F));
  EXPECT_EQ(packet.points[8], static_cast<double>(1.0F / 3.0F));
}

TEST_F(MeshioWrites, CellsThatAreNotTriangles) {
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "quads.vtu", true); }), HasSubstr("cell 0 is a Quad"));
}

}  // namespace
}  // namespace tanktread::exchange::testing
