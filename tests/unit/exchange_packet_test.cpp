// Packets written and read back: every bit, all kinds of data, and packets that must not be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "exchange/append_surface.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Packet, FindsAnArrayByName) {
  const auto arrays = sample_surface().cell_data;
  EXPECT_EQ(&find_array(arrays, "stress", "here"), &arrays[1]);
}

TEST(Packet, SaysWhichArraysThereAre) {
  try {
    find_array(sample_surface().cell_data, "strain", "a/file.vtu");
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("a/file.vtu"), HasSubstr("'strain'"),
                                    HasSubstr("principal_stretches, stress, area_ratio")));
  }
}

/// Writes, reads, and reports what differs; nothing may be printed on the way.
std::string round_trip(const SurfacePacket& packet) {
  const TemporaryFolder folder;
  SurfacePacket back;
  const auto error = error_of([&] {
    write_surface(folder / "surface.vtu", packet);
    back = read_surface(folder / "surface.vtu");
  });
  return error == "(no error)" ? difference(packet, back) : error;
}

std::string round_trip(const GridPacket& packet) {
  const TemporaryFolder folder;
  GridPacket back;
  const auto error = error_of([&] {
    write_grid(folder / "grid.vti", packet);
    back = read_grid(folder / "grid.vti");
  });
  return error == "(no error)" ? difference(packet, back) : error;
}

TEST(Surface, KeepsEveryBit) {
  EXPECT_EQ(round_trip(sample_surface()), "");
}

TEST(Surface, KeepsEachAwkwardNumberAlone) {
  // Alone: an array of one kind, such as NaN only, has no range of values, which VTK writes beside the
  // numbers.
  for (const double number : awkward_numbers()) {
    auto packet = sample_surface();
    packet.points.assign(18, number);
    packet.point_data = {{"scalar", 1, std::vector<double>(6, number)},
                         {"vector", 3, std::vector<double>(18, number)}};
    packet.cell_data = {{"scalar", 1, std::vector<double>(8, number)},
                        {"tensor", 9, std::vector<double>(72, number)}};
    packet.field_data = {{"one", 1, {number}}};
    EXPECT_EQ(round_trip(packet), "") << number;
  }
}

TEST(Surface, KeepsEmptyArraysAndNoArrays) {
  auto packet = sample_surface();
  packet.point_data.clear();
  packet.cell_data.clear();
  packet.field_data = {{"history", 1, {}}, {"step", 1, {3}}, {"nothing", 4, {}}};
  EXPECT_EQ(round_trip(packet), "");
  packet.field_data.clear();
  EXPECT_EQ(round_trip(packet), "");
}

TEST(Surface, KeepsASurfaceWithoutTriangles) {
  SurfacePacket packet;
  packet.points = {1, 2, 3};
  packet.point_data = {{"velocity", 3, {4, 5, 6}}};
  EXPECT_EQ(round_trip(packet), "");
  EXPECT_EQ(round_trip(SurfacePacket{}), "");
}

TEST(Surface, KeepsOddNames) {
  auto packet = sample_surface();
  packet.field_data = {
      {"it's (a) [name]; 100 % {odd}", 1, {1}}, {" with  spaces ", 1, {2}}, {"#~^|/\\*?!", 1, {3}}};
  EXPECT_EQ(round_trip(packet), "");
}

TEST(Surface, KeepsALargeOne) {
  // More than one of VTK's blocks of 32768 bytes, and node numbers above 16 bits.
  SurfacePacket packet;
  const std::int64_t n_nodes = 70000;
  packet.points = awkward_numbers(3 * n_nodes, 0);
  for (std::int64_t k = 0; k + 2 < n_nodes; ++k)
    packet.triangles.insert(packet.triangles.end(), {k, k + 1, k + 2});
  packet.point_data = {{"velocity", 3, awkward_numbers(3 * n_nodes, 5)}};
  EXPECT_EQ(round_trip(packet), "");
}

TEST(Grid, KeepsEveryBit) {
  EXPECT_EQ(round_trip(sample_grid()), "");
}

TEST(Grid, KeepsEachAwkwardNumberAlone) {
  for (const double number : awkward_numbers()) {
    auto packet = sample_grid();
    packet.point_data = {{"density", 1, std::vector<double>(24, number)},
                         {"force", 3, std::vector<double>(72, number)}};
    EXPECT_EQ(round_trip(packet), "") << number;
  }
}

TEST(Grid, KeepsSlicesLinesAndSingleNodes) {
  for (const std::array<int, 3> nodes : {std::array{5, 1, 4}, {1, 3, 2}, {2, 3, 1}, {1, 6, 1}, {1, 1, 1}}) {
    GridPacket packet;
    packet.nodes = nodes;
    packet.origin = {10.5, 20.5, 30.5};
    packet.point_data = {{"velocity", 3, awkward_numbers(3 * nodes[0] * nodes[1] * nodes[2], 8)}};
    EXPECT_EQ(round_trip(packet), "") << nodes[0] << nodes[1] << nodes[2];
  }
}

TEST(Grid, SharesItsFrameWithTheSurfaces) {
  EXPECT_EQ(GridPacket{}.origin, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ(GridPacket{}.spacing, (std::array<double, 3>{1, 1, 1}));
}

TEST(Files, HoldAppendedRawDoublesAnd64BitNodes) {
  const TemporaryFolder folder;
  write_surface(folder / "surface.vtu", sample_surface());
  write_grid(folder / "grid.vti", sample_grid());
  for (const char* name : {"surface.vtu", "grid.vti"}) {
    const auto text = read_text(folder / name);
    const auto head = text.substr(0, text.find("<AppendedData"));
    EXPECT_THAT(text, HasSubstr("<AppendedData encoding=\"raw\">"));
    EXPECT_THAT(head, AllOf(HasSubstr("header_type=\"UInt64\""), HasSubstr("Float64")));
    EXPECT_THAT(head, ::testing::Not(HasSubstr("Float32")));
    EXPECT_THAT(head, ::testing::Not(HasSubstr("compressor")));
    EXPECT_THAT(head, ::testing::Not(HasSubstr("type=\"String\"")));
  }
  EXPECT_THAT(read_text(folder / "surface.vtu"), HasSubstr("type=\"Int64\" Name=\"connectivity\""));
}

TEST(Files, AreTheSameWheneverThePacketIs) {
  const TemporaryFolder folder;
  for (const char* name : {"first", "second"}) {
    write_surface(folder / (std::string(name) + ".vtu"), sample_surface());
    write_grid(folder / (std::string(name) + ".vti"), sample_grid());
  }
  EXPECT_TRUE(read_text(folder / "first.vtu") == read_text(folder / "second.vtu"));
  EXPECT_TRUE(read_text(folder / "first.vti") == read_text(folder / "second.vti"));
}

/// The error of writing a packet that `damage` was done to; nothing may be left in the folder.
template <class Packet>
std::string write_error(Packet packet, void (*damage)(Packet&)) {
  const TemporaryFolder folder;
  damage(packet);
  const auto message = error_of([&] {
    if constexpr (std::is_same_v<Packet, SurfacePacket>) write_surface(folder / "out", packet);
    if constexpr (std::is_same_v<Packet, GridPacket>) write_grid(folder / "out", packet);
  });
  EXPECT_THAT(folder.names(), IsEmpty());
  return message;
}

TEST(Surface, RefusesToWriteWhatIsNotASurface) {
  const auto error = [](void (*damage)(SurfacePacket&)) { return write_error(sample_surface(), damage); };
  EXPECT_THAT(error([](SurfacePacket& p) { p.points.pop_back(); }),
              HasSubstr("17 coordinates and 24 corners"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.triangles.pop_back(); }),
              HasSubstr("18 coordinates and 23 corners"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.triangles[4] = 6; }),
              HasSubstr("triangle 1 has node 6, outside 0 to 5"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.triangles[9] = -1; }), HasSubstr("triangle 3 has node -1"));
}

TEST(Surface, RefusesToWriteArraysThatDoNotFit) {
  const auto error = [](void (*damage)(SurfacePacket&)) { return write_error(sample_surface(), damage); };
  EXPECT_THAT(error([](SurfacePacket& p) { p.point_data[0].values.pop_back(); }),
              HasSubstr("point data array 'velocity' has 17 values, expected 6 tuples of 3 components"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.cell_data[1].components = 3; }),
              HasSubstr("cell data array 'stress' has 72 values, expected 8 tuples of 3 components"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.field_data[2].components = 7; }),
              HasSubstr("field data array 'history' has 40 values, not a multiple of its 7 components"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.cell_data[2].components = 0; }), HasSubstr("has 0 components"));
  EXPECT_THAT(error([](SurfacePacket& p) { p.cell_data[2].name = ""; }),
              HasSubstr("cell data array '' has no name"));
  for (const char* name : {"a<b", "a>b", "a&b", "a\"b", "a\nb", "\xc3\xa4"}) {
    auto packet = sample_surface();
    packet.cell_data[0].name = name;
    EXPECT_THAT(write_error<SurfacePacket>(packet, [](SurfacePacket&) {}), HasSubstr("use printable ASCII"))
        << name;
  }
  EXPECT_THAT(error([](SurfacePacket& p) { p.point_data[2].name = "velocity"; }),
              HasSubstr("two point data arrays are named 'velocity'"));
}

TEST(Grid, RefusesToWriteWhatIsNotAGrid) {
  const auto error = [](void (*damage)(GridPacket&)) { return write_error(sample_grid(), damage); };
  EXPECT_THAT(error([](GridPacket& p) { p.nodes[1] = 0; }), HasSubstr("0 nodes along y, at least 1"));
  EXPECT_THAT(error([](GridPacket& p) { p.spacing[2] = 0; }), HasSubstr("spacing 0 along z"));
  EXPECT_THAT(error([](GridPacket& p) { p.origin[0] = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("origin nan"));
  EXPECT_THAT(error([](GridPacket& p) { p.nodes[0] = 5; }), HasSubstr("expected 30 tuples of 19 components"));
}

TEST(Packet, IsAppendedWithItsData) {
  auto whole = sample_surface();
  const auto one = sample_surface();
  append_surface(whole, one);
  const auto n = one.points.size();
  ASSERT_EQ(whole.points.size(), 2 * n);
  // By their bits, for one of them is no number.
  EXPECT_EQ(std::memcmp(whole.points.data() + n, one.points.data(), n * sizeof(double)), 0);
  ASSERT_EQ(whole.triangles.size(), 2 * one.triangles.size());
  for (std::size_t k = 0; k < one.triangles.size(); ++k)
    EXPECT_EQ(whole.triangles[one.triangles.size() + k], one.triangles[k] + static_cast<std::int64_t>(n / 3));
  for (std::size_t k = 0; k < one.cell_data.size(); ++k)
    EXPECT_EQ(whole.cell_data[k].values.size(), 2 * one.cell_data[k].values.size());
  EXPECT_EQ(whole.field_data.size(), one.field_data.size());
}

TEST(Packet, IsNotAppendedWithoutAnArrayOfTheFirst) {
  auto whole = sample_surface();
  auto lacking = sample_surface();
  lacking.cell_data.pop_back();
  EXPECT_THROW(append_surface(whole, lacking), std::invalid_argument);
  auto other = sample_surface();
  other.cell_data.back().components += 1;
  whole = sample_surface();
  EXPECT_THROW(append_surface(whole, other), std::invalid_argument);
}

}  // namespace
}  // namespace tanktread::exchange::testing
