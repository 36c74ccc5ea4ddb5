// How the capsules of a case are divided among files.
#include "driver/system/surface_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace tanktread::driver;
using ::testing::ElementsAre;
using Pair = std::pair<std::size_t, std::size_t>;

std::vector<Pair> ranges(const std::vector<std::int64_t>& n_triangles, std::int64_t most) {
  std::vector<Pair> result;
  for (const auto& range : ranges_of_pieces(n_triangles, most)) result.emplace_back(range.first, range.end);
  return result;
}

TEST(SurfaceFiles, APieceHasAsManyTrianglesAsItMay) {
  EXPECT_THAT(ranges({80, 80, 80, 80, 80}, 160), ElementsAre(Pair(0, 2), Pair(2, 4), Pair(4, 5)));
  EXPECT_THAT(ranges({80, 80, 80, 80, 80}, 239), ElementsAre(Pair(0, 2), Pair(2, 4), Pair(4, 5)));
  EXPECT_THAT(ranges({80, 80, 80, 80, 80}, 400), ElementsAre(Pair(0, 5)));
  EXPECT_THAT(ranges({80, 80, 80}, std::numeric_limits<std::int64_t>::max()), ElementsAre(Pair(0, 3)));
}

TEST(SurfaceFiles, ACapsuleIsNeverCut) {
  EXPECT_THAT(ranges({20, 320, 20, 20}, 100), ElementsAre(Pair(0, 1), Pair(1, 2), Pair(2, 4)));
  EXPECT_THAT(ranges({320, 320}, 1), ElementsAre(Pair(0, 1), Pair(1, 2)));
}

TEST(SurfaceFiles, WithoutCapsulesThereIsOneFileWithoutAny) {
  EXPECT_THAT(ranges({}, 100), ElementsAre(Pair(0, 0)));
}

}  // namespace
