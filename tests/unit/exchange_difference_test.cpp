// Two packets compared: what differs, by how much and where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "exchange/difference.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// "kind name: problem or number of values that differ" of each array that is not identical.
template <class Packet>
std::vector<std::string> different(const Packet& a, const Packet& b) {
  std::vector<std::string> lines;
  for (const auto& array : differences(a, b)) {
    if (array.identical()) continue;
    lines.push_back(array.kind + " " + array.name + ": " +
                    (array.problem.empty() ? std::to_string(array.n_different) : array.problem));
  }
  return lines;
}

template <class Packet>
ArrayDifference difference_of(const std::string& name, const Packet& a, const Packet& b) {
  for (const auto& array : differences(a, b)) {
    if (array.name == name) return array;
  }
  throw std::runtime_error("no array " + name);
}

ArrayDifference of_values(const std::vector<double>& a, const std::vector<double>& b) {
  return value_difference("field data", "array", 1, a, b);
}

double nan_with(std::uint64_t payload) {
  return std::bit_cast<double>(std::uint64_t{0x7ff8000000000000} | payload);
}

TEST(Difference, ListsAllArraysOfPacketsThatAreTheSame) {
  const auto surface = differences(sample_surface(), sample_surface());
  EXPECT_EQ(surface.size(), 2U + 3U + 3U + 3U);
  EXPECT_EQ(differences(sample_grid(), sample_grid()).size(), 3U + 3U + 2U);
  EXPECT_THAT(different(sample_surface(), sample_surface()), IsEmpty());
  EXPECT_THAT(different(sample_grid(), sample_grid()), IsEmpty());
  for (const auto& array : surface) EXPECT_EQ(array.max, 0) << array.name << ": inf - inf or NaN - NaN";
}

TEST(Difference, FindsASingleBitOfEachValue) {
  const auto packet = sample_surface();
  for (std::size_t k = 0; k < packet.cell_data[1].values.size(); ++k) {
    auto other = packet;
    auto& value = other.cell_data[1].values[k];
    value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1);
    EXPECT_THAT(different(packet, other), ElementsAre("cell data stress: 1"));
    const auto stress = difference_of("stress", packet, other);
    EXPECT_EQ(stress.first, static_cast<std::int64_t>(k));
    EXPECT_EQ(stress.largest, static_cast<std::int64_t>(k));
    EXPECT_EQ(stress.components, 9);
    EXPECT_EQ(stress.n_values, 72);
  }
}

TEST(Difference, FindsGeometry) {
  auto surface = sample_surface(false);
  surface.points[7] += 1;
  std::swap(surface.triangles[3], surface.triangles[4]);
  EXPECT_THAT(different(sample_surface(false), surface),
              ElementsAre("points points: 1", "triangles triangles: 2"));
  auto grid = sample_grid();
  grid.nodes = {3, 4, 2};
  grid.origin[1] = 0.25;
  grid.spacing[2] = 2;
  EXPECT_THAT(different(sample_grid(), grid),
              ElementsAre("geometry nodes: 2", "geometry origin: 1", "geometry spacing: 1"));
}

TEST(Difference, GoesByNameNotByOrder) {
  auto other = sample_surface();
  std::reverse(other.cell_data.begin(), other.cell_data.end());
  EXPECT_THAT(different(sample_surface(), other), IsEmpty());
  other.cell_data[0].name = "density";
  EXPECT_THAT(different(sample_surface(), other), ElementsAre("cell data area_ratio: only in the first",
                                                              "cell data density: only in the second"));
  other = sample_surface();
  std::swap(other.field_data, other.point_data);
  other.point_data.clear();
  EXPECT_EQ(different(sample_surface(), other).size(), 3U + 3U + 3U) << "of another kind";
}

TEST(Difference, SaysWhichShapesDiffer) {
  auto surface = sample_surface();
  surface.points.resize(15);
  surface.triangles.resize(21);
  surface.field_data[2].components = 2;
  EXPECT_THAT(different(sample_surface(), surface),
              ElementsAre("points points: 6 x 3 against 5 x 3", "triangles triangles: 8 x 3 against 7 x 3",
                          "field data history: 40 x 1 against 20 x 2"));
}

TEST(Difference, MeasuresTheLargestAndTheMean) {
  // Differences 0, 3, 0, -4: all numbers are exact, and the root of (9 + 16)/4 is 2.5.
  const auto found = of_values({1, 5, 2, 1}, {1, 2, 2, 5});
  EXPECT_EQ(found.n_different, 2);
  EXPECT_EQ(found.first, 1);
  EXPECT_EQ(found.first_a, 5);
  EXPECT_EQ(found.first_b, 2);
  EXPECT_EQ(found.max, 4);
  EXPECT_EQ(found.largest, 3);
  EXPECT_EQ(found.rms, 2.5);
}

TEST(Difference, StaysWithinTheRangeOfDoubles) {
  // Squares of these would be infinite or 0. Powers of two: exact.
  for (const double size : {0x1p1000, 0x1p-1000}) {
    EXPECT_EQ(of_values({size, size}, {0, 0}).rms, size);
    EXPECT_EQ(of_values({0, 0, 0, size}, {0, 0, 0, 0}).rms, size / 2);
  }
}

TEST(Difference, CountsZerosOfOtherSignButMeasuresNone) {
  const auto found = of_values({0, 1, 0.0}, {0, 1, -0.0});
  EXPECT_EQ(found.n_different, 1);
  EXPECT_EQ(found.first, 2);
  EXPECT_EQ(found.largest, 2);
  EXPECT_EQ(found.max, 0);
  EXPECT_EQ(found.rms, 0);
}

TEST(Difference, KnowsNanByItsBits) {
  EXPECT_TRUE(of_values({nan_with(1), 1}, {nan_with(1), 1}).identical());
  const auto found = of_values({1, nan_with(1), nan_with(3), 7}, {2, nan_with(2), 1, 1});
  EXPECT_EQ(found.n_different, 4);
  EXPECT_TRUE(std::isnan(found.max));
  EXPECT_TRUE(std::isnan(found.rms));
  EXPECT_EQ(found.largest, 1);
  // A NaN in both that is the same does not hide how large the other differences are.
  EXPECT_EQ(of_values({nan_with(1), 1}, {nan_with(1), 3}).max, 2);
}

TEST(Difference, MeasuresInfinities) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(of_values({inf, -inf}, {inf, -inf}).identical());
  // What is the same in both does not hide how large the other differences are: the root of 8^2/4 is 4.
  EXPECT_EQ(of_values({inf, 0, 0, 8}, {inf, 0, 0, 0}).rms, 4);
  EXPECT_EQ(of_values({inf, 1}, {1, 1}).max, inf);
  EXPECT_EQ(of_values({inf, 1}, {1, 1}).rms, inf);
  EXPECT_EQ(of_values({inf, 1}, {-inf, 1}).max, inf);
}

TEST(Difference, HasNothingToSayOfEmptyArrays) {
  const auto found = of_values({}, {});
  EXPECT_TRUE(found.identical());
  EXPECT_EQ(found.rms, 0);
  EXPECT_THAT(different(SurfacePacket{}, SurfacePacket{}), IsEmpty());
}

}  // namespace
}  // namespace tanktread::exchange::testing
