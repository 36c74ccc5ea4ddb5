// Marks of nodes inside capsules: to a file and back, and the viscosities that go by them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "driver/packets/packet_files.hpp"
#include "driver/units/flow_units.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/integration/program.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace exchange = tanktread::exchange;

constexpr Box box = {4, 3, 2};

/// Marks of all nodes: 0, 1 and 2 in turn.
std::vector<std::int32_t> sample_marks() {
  std::vector<std::int32_t> marks(24);
  for (std::size_t node = 0; node < marks.size(); ++node) marks[node] = static_cast<std::int32_t>(node % 3);
  return marks;
}

GridMarks sample_news(const std::vector<std::int64_t>& nodes) {
  GridMarks news{std::make_shared<const std::vector<std::int64_t>>(nodes), {}};
  for (const auto node : nodes) news.capsule.push_back(sample_marks()[static_cast<std::size_t>(node)]);
  return news;
}

void expect_same(const GridMarks& a, const GridMarks& b) {
  EXPECT_EQ(*a.nodes, *b.nodes);
  EXPECT_EQ(a.capsule, b.capsule);
}

TEST(InsidePacket, ComesBackFromItsFile) {
  const TemporaryDirectory directory;
  for (const std::vector<std::int64_t>& nodes :
       {std::vector<std::int64_t>{0, 5, 6, 22}, std::vector<std::int64_t>{}}) {
    const auto news = sample_news(nodes);
    const auto file = marks_file(news, sample_marks(), box, 7);
    EXPECT_EQ(step_of(file.field_data, "file"), 7);
    exchange::write_grid(directory / "inside.vti", file);
    const auto again = exchange::read_grid(directory / "inside.vti");
    expect_same(grid_marks_of(again, 2, box, "inside.vti"), news);
  }
}

TEST(InsidePacket, WithoutTheNewsAllNodesHaveTheirMark) {
  auto file = marks_file(sample_news({3}), sample_marks(), box, 0);
  file.point_data.pop_back();
  std::vector<std::int64_t> all(24);
  std::iota(all.begin(), all.end(), 0);
  expect_same(grid_marks_of(file, 2, box, "inside.vti"), sample_news(all));
}

TEST(InsidePacket, MarksOfNoCapsuleAreRefused) {
  const auto refusal = [](double mark, std::size_t n_capsules, const Box& of_case) -> std::string {
    auto file = marks_file(sample_news({4, 9}), sample_marks(), box, 0);
    file.point_data[0].values[9] = mark;
    try {
      grid_marks_of(file, n_capsules, of_case, "inside.vti");
    } catch (const exchange::FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(2, 2, box), "");
  for (const double mark : {-1.0, 3.0, 1.5, 1e300, -std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THAT(refusal(mark, 2, box),
                AllOf(HasSubstr("inside.vti: 'inside' of node 9 is "), HasSubstr("from 1 to 2")))
        << mark;
  }
  EXPECT_THAT(refusal(2, 1, box), HasSubstr("from 1 to 1"));
  EXPECT_THAT(refusal(1, 2, {4, 3, 3}), HasSubstr("a grid of 4 x 3 x 2 nodes"));
}

TEST(InsidePacket, AMarkHasTheViscosityOfItsCapsule) {
  // nu = (0.8 - 1/2)/3.
  const auto the_case = parse(full_case, {"flow.viscosity_ratio=5", "capsule.1.viscosity_ratio=0.25"});
  const double nu = flow_parameters(the_case).kinematic_viscosity;
  EXPECT_NEAR(nu, 0.1, 1e-16);
  EXPECT_THAT(viscosities_of_marks(the_case), ElementsAre(nu, 5 * nu, 0.25 * nu));
  // Of the settings exactly, so that nodes that a capsule has left are as if it had never been there.
  EXPECT_THAT(viscosities_of_marks(parse(full_case)), ElementsAre(nu, nu, nu));
  const auto flow = flow_parameters(the_case);
  EXPECT_DOUBLE_EQ(inner_relaxation_time(flow, 1), 0.8);
  EXPECT_DOUBLE_EQ(inner_relaxation_time(flow, 5), 2.0);
  EXPECT_DOUBLE_EQ(inner_relaxation_time(flow, 0.25), 0.575);
}

}  // namespace
