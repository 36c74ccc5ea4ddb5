// What couplers of the parts of a grid refuse, in the words of the whole grid's; and what else they say of
// their part.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_dipole_support.hpp"
#include "tests/unit/coupler_parts.hpp"

namespace tanktread::coupler::part_errors_test {
namespace {

using namespace test;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::array<int, 3> nodes_of_box = {24, 20, 18};

/// The first error of calls that may throw, by its precedence.
template <class Error>
class First {
 public:
  template <class Call>
  void look_at(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      if (!first_ || error.precedence < first_->precedence) first_.emplace(error);
    }
  }
  std::string message() const { return first_ ? first_->what() : ""; }

 private:
  std::optional<Error> first_;
};

template <class Error, class Call>
std::string message_of(const Call& call) {
  First<Error> first;
  first.look_at(call);
  return first.message();
}

/// A message without its numbers.
std::string kind_of(const std::string& message) {
  std::string kind;
  std::ranges::copy_if(message, std::back_inserter(kind), [](char c) { return std::isalpha(c) != 0; });
  return kind;
}

/// Three surfaces all over the box.
Sheared scene() {
  Sheared sheared;
  sheared.add(sphere(90, 5.0, {12.1, 9.7, 9.2}), {12.1, 9.7, 9.2}, 0);
  sheared.add(sphere(60, 3.0, {5.0, 6.0, 8.0}), {5.0, 6.0, 8.0}, 0.2);
  sheared.add(sphere(70, 4.0, {18.0, 12.0, 7.0}), {18.0, 12.0, 7.0}, -0.1);
  return sheared;
}

double any_of(const std::vector<double>& numbers, std::mt19937_64& generator) {
  return numbers[generator() % numbers.size()];
}

/// Some numbers of some surfaces are no longer what they must be.
void spoil(std::vector<Numbers>& surfaces, const std::vector<double>& with, std::mt19937_64& generator) {
  for (std::size_t k = 0, n = 1 + generator() % 4; k < n; ++k) {
    Numbers& surface = surfaces[generator() % surfaces.size()];
    surface[generator() % surface.size()] = any_of(with, generator);
  }
}

std::deque<Coupler> couplers_of(const Grid& grid, const std::array<int, 3>& division, const Kernel& kernel,
                                int threads) {
  std::deque<Coupler> couplers;
  for (const GridPart& part : parts_of(grid, division)) couplers.emplace_back(grid, part, kernel, threads);
  return couplers;
}

const double infinity = std::numeric_limits<double>::infinity();

TEST(CouplerPartErrors, OfPositionsAndDipolesAreThoseOfTheWhole) {
  std::set<std::string> kinds;
  for (unsigned seed = 1; seed <= 240; ++seed) {
    std::mt19937_64 generator(seed);
    const Grid grid = grids_of(nodes_of_box)[seed % 4];
    const Kernel& kernel = kernels()[seed % kernels().size()];
    Sheared spoilt = scene();
    // Off by a whole box, on a wall, far off, nowhere.
    if (seed % 3 != 0) spoil(spoilt.nodes, {0.2, 17.9, 40, -60, 1.1e9, infinity, std::nan("")}, generator);
    if (seed % 3 != 1) spoil(spoilt.normals, {std::nan(""), -infinity}, generator);
    Coupler whole(grid, kernel, 1);
    const std::string message = message_of<StencilError>([&] { build(whole, spoilt); });
    First<StencilError> first;
    for (Coupler& coupler :
         couplers_of(grid, divisions[seed / 4 % divisions.size()], kernel, seed % 20 == 0 ? 3 : 1))
      first.look_at([&] { build(coupler, spoilt); });
    ASSERT_EQ(first.message(), message) << seed;
    kinds.insert(kind_of(message));
  }
  // Three walls, three axes each for what is not finite and what is too far, normals; or none.
  EXPECT_GT(kinds.size(), 9U);
}

TEST(CouplerPartErrors, OfACorrectionAreThoseOfTheWhole) {
  std::set<std::string> kinds;
  const Grid grid = {nodes_of_box, {true, false, true}};
  const Sheared sheared = scene();
  for (unsigned seed = 1; seed <= 120; ++seed) {
    std::mt19937_64 generator(seed);
    const Kernel& kernel = kernels()[seed % kernels().size()];
    std::vector<Numbers> normals = sheared.normals, force = sheared.nodes, velocity = sheared.nodes;
    if (seed % 3 != 0) spoil(normals, {std::nan(""), infinity}, generator);
    if (seed % 3 != 1) spoil(force, {std::nan(""), infinity}, generator);
    const std::vector<std::span<const double>> normal_spans(normals.begin(), normals.end()),
        force_spans(force.begin(), force.end());
    const std::vector<std::span<double>> targets(velocity.begin(), velocity.end());
    Coupler whole(grid, kernel, 1);
    build(whole, sheared.nodes);
    const std::string message = message_of<CorrectionError>(
        [&] { TangentialCorrection(whole, 0.2).add(whole, normal_spans, force_spans, targets); });
    EXPECT_EQ(velocity, sheared.nodes);
    First<CorrectionError> first;
    for (Coupler& coupler :
         couplers_of(grid, divisions[seed % divisions.size()], kernel, seed % 20 == 0 ? 3 : 1)) {
      build(coupler, sheared.nodes);
      Numbers on_grid(3 * coupler.grid_nodes().size());
      first.look_at(
          [&] { TangentialCorrection(coupler, 0.2).spread(coupler, normal_spans, force_spans, on_grid); });
    }
    ASSERT_NE(message, "");
    ASSERT_EQ(first.message(), message) << seed;
    kinds.insert(kind_of(message));
  }
  EXPECT_EQ(kinds.size(), 2U);
}

TEST(CouplerPartErrors, AfterAnErrorTheOldStencilsStay) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  Coupler coupler(grid, {{12, 0, 0}, {12, 20, 18}}, kernel("peskin4"), 2);
  const std::vector<Numbers> good = {{13.5, 4.5, 4.5, 3.5, 4.5, 4.5, 14.5, 4.5, 4.5}};
  build(coupler, good);
  const std::vector<std::int64_t> nodes(coupler.grid_nodes().begin(), coupler.grid_nodes().end());
  EXPECT_THROW(build(coupler, std::vector<Numbers>{{13.5, std::nan(""), 4.5}}), StencilError);
  EXPECT_TRUE(std::ranges::equal(coupler.grid_nodes(), nodes));
  EXPECT_THAT(coupler.home_nodes(0), ElementsAre(0, 2));
  EXPECT_THROW(coupler.home_nodes(1), std::invalid_argument);
}

TEST(CouplerPartErrors, APartMustLieInTheGrid) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  for (const GridPart& part : {GridPart{{-1, 0, 0}, {4, 4, 4}}, GridPart{{0, 17, 0}, {4, 4, 4}},
                               GridPart{{0, 0, 0}, {4, 4, 0}}, GridPart{{0, 0, 2147483647}, {4, 4, 4}}})
    EXPECT_THROW(Coupler(grid, part, kernel("stockie6")), std::invalid_argument);
  EXPECT_EQ(complaint([&] {
              Coupler(grid, {{0, 0, 9}, {24, 20, 10}}, kernel("stockie6"));
            }),
            "coupler: a part of 10 grid nodes from 9 on along z, of a grid of 18");
}

TEST(CouplerPartErrors, ArraysOfAnotherSizeAreRefused) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  Coupler coupler(grid, {{12, 0, 0}, {12, 20, 18}}, kernel("peskin4"), 1);
  const std::vector<Numbers> nodes = {{13.5, 4.5, 4.5, 3.5, 4.5, 4.5}};
  build(coupler, nodes);
  const std::span<const double> whole(nodes[0]), short_one = whole.first(3);  // as if of the nodes at home
  Numbers velocity(6), on_grid(3 * coupler.grid_nodes().size());
  const std::span<double> target(velocity), short_target = target.first(3);
  const TangentialCorrection correction(coupler, 0.2);
  EXPECT_THROW(coupler.interpolate(on_grid, {&short_target, 1}), std::invalid_argument);
  EXPECT_THROW(coupler.spread({&short_one, 1}, on_grid), std::invalid_argument);
  EXPECT_THROW(correction.spread(coupler, {&short_one, 1}, {&short_one, 1}, on_grid), std::invalid_argument);
  EXPECT_THROW(correction.spread(coupler, {&short_one, 1}, {&whole, 1}, on_grid), std::invalid_argument);
  EXPECT_THROW(correction.spread(coupler, {&whole, 1}, {&whole, 1}, velocity), std::invalid_argument);
  EXPECT_THROW(correction.add_from(coupler, {&whole, 1}, on_grid, {&short_target, 1}), std::invalid_argument);
  EXPECT_THROW(correction.add_from(coupler, {&short_one, 1}, on_grid, {&short_target, 1}),
               std::invalid_argument);
  EXPECT_THROW(correction.add_from(coupler, {&whole, 1}, velocity, {&target, 1}), std::invalid_argument);
  EXPECT_THROW(correction.add_from(coupler, {}, on_grid, {&target, 1}), std::invalid_argument);
  const Coupler other(grid, kernel("cosine4"), 1);
  EXPECT_THROW(correction.spread(other, {}, {}, {}), std::invalid_argument);
  EXPECT_THROW(correction.add_from(other, {}, {}, {}), std::invalid_argument);
}

TEST(CouplerPartRegion, IsThePartAndWhatItsStencilsReach) {
  const auto expect = [](const Grid& grid, const GridPart& part, const char* name, const GridPart& expected) {
    const GridPart region = Coupler(grid, part, kernel(name)).region();
    EXPECT_EQ(region.begin, expected.begin);
    EXPECT_EQ(region.nodes, expected.nodes);
  };
  const Grid periodic = {{24, 20, 18}, {true, true, true}}, walls = {{24, 20, 18}, {false, false, false}};
  // x: round the face, y: as long as the axis with what is reached, z: not cut.
  expect(periodic, {{0, 0, 0}, {12, 10, 18}}, "stockie6", {{-5, 0, 0}, {22, 20, 18}});
  expect(periodic, {{12, 10, 0}, {12, 9, 18}}, "stockie6", {{7, 5, 0}, {22, 19, 18}});
  expect(periodic, {{12, 10, 0}, {12, 9, 18}}, "linear2", {{11, 9, 0}, {14, 11, 18}});
  expect(walls, {{0, 10, 4}, {12, 10, 3}}, "peskin4", {{0, 7, 1}, {15, 13, 9}});
  expect(walls, {{0, 3, 0}, {24, 15, 18}}, "peskin4", {{0, 0, 0}, {24, 20, 18}});
  const GridPart whole = Coupler(periodic, kernel("roma3")).region();
  EXPECT_EQ(whole.begin, (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(whole.nodes, periodic.nodes);
}

TEST(CouplerPartRegion, IsWhereGridNodesAreNumbered) {
  const Grid grid = {nodes_of_box, {true, true, true}};
  // 14 x 20 x 18, from x = 23 on.
  Coupler coupler(grid, {{0, 0, 0}, {12, 20, 18}}, kernel("linear2"), 1);
  build(coupler, std::vector<Numbers>{{24.0, 5.5, 6.5}});  // between x = 23 and 0, at y = 5, z = 6
  const std::int64_t first = 0 + 14 * (5 + 20 * 6);
  EXPECT_THAT(coupler.grid_nodes(), ElementsAre(first, first + 1, first + 14, first + 15, first + 280,
                                                first + 281, first + 294, first + 295));
  EXPECT_THAT(coupler.home_nodes(0), ElementsAre(0));
}

TEST(CouplerPartHome, IsTheCellAroundANode) {
  const Grid grid = {nodes_of_box, {true, true, false}};
  const std::vector<Numbers> nodes = {
      {12.0, 3, 3, 11.999, 3, 3, 24.0, 3, 3, -1e-17, 3, 3, 12.0 - 2400, 3, 3, 2411.5, 3, 3, 0.0, 3, 3},
      {},
      {13, 3, 17.5, 3, 3, 3}};
  Coupler left(grid, {{0, 0, 0}, {12, 20, 18}}, kernel("linear2"), 1),
      right(grid, {{12, 0, 0}, {12, 20, 18}}, kernel("linear2"), 1), whole(grid, kernel("linear2"), 1);
  for (Coupler* coupler : {&left, &right, &whole}) build(*coupler, nodes);
  EXPECT_THAT(left.home_nodes(0), ElementsAre(1, 2, 5, 6));
  EXPECT_THAT(right.home_nodes(0), ElementsAre(0, 3, 4));
  EXPECT_THAT(left.home_nodes(1), IsEmpty());
  EXPECT_THAT(left.home_nodes(2), ElementsAre(1));
  EXPECT_THAT(right.home_nodes(2), ElementsAre(0));
  EXPECT_THAT(whole.home_nodes(0), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(whole.home_nodes(1), IsEmpty());
  EXPECT_THAT(whole.home_nodes(2), ElementsAre(0, 1));
}

std::atomic<int> n_weighed = 0;

TEST(CouplerPartHome, NodesFarAwayAreNotWeighed) {
  Kernel counting = kernel("cosine4");
  counting.weights = [](int n, const double* first_distances, double* weights) {
    n_weighed += n;
    kernel("cosine4").weights(n, first_distances, weights);
  };
  const Grid grid = {{240, 20, 18}, {true, true, true}};
  const std::vector<Numbers> nodes = {sphere(1000, 4, {100, 10, 9}), sphere(50, 4, {20, 10, 9})};
  Coupler coupler(grid, {{10, 0, 0}, {20, 20, 18}}, counting, 2);
  build(coupler, nodes);
  EXPECT_EQ(n_weighed.exchange(0), 3 * 50);
  const auto touched = std::vector(coupler.grid_nodes().begin(), coupler.grid_nodes().end());
  const Numbers force = random_numbers(150, -1, 1, 1),
                expected = spread(coupler, {Numbers(3000, 1.0), force});
  // The far surface may as well be given without nodes.
  const std::vector<std::span<const double>> surfaces = {{}, nodes[1]};
  const std::vector<ShearDipole> dipoles = {{{}, 0.3}, {}};
  coupler.build(surfaces, dipoles);
  EXPECT_TRUE(std::ranges::equal(coupler.grid_nodes(), touched));
  EXPECT_TRUE(same_bits(spread(coupler, {{}, force}), expected));
}

}  // namespace
}  // namespace tanktread::coupler::part_errors_test
