// Stencils with shear dipoles: beside others without, for any number of threads, across periodic faces, next
// to walls; and which are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_dipole_support.hpp"

namespace tanktread::coupler::dipole_layout_test {
namespace {

using namespace test;
using ::testing::HasSubstr;

const Grid box = {{24, 20, 22}, {true, true, true}};
constexpr std::size_t n_box_nodes = 24 * 20 * 22;

/// Two that share grid nodes, and one across three faces.
Sheared three_surfaces(const Numbers& lengths) {
  const std::vector<Vector> centres = {{11.0, 9.0, 12.0}, {12.0, 9.0, 11.0}, {23.5, 0.3, 21.0}};
  const std::vector<int> n_nodes = {150, 121, 80};
  Sheared sheared;
  for (std::size_t s = 0; s < centres.size(); ++s)
    sheared.add(sphere(n_nodes[s], 4.5, centres[s]), centres[s], lengths[s]);
  return sheared;
}

class CouplerDipoleLayout : public ::testing::TestWithParam<Kernel> {
 protected:
  Coupler coupler_{box, GetParam(), 1};
  const std::vector<Numbers> force_ = {random_numbers(450, -1, 1, 1), random_numbers(363, -1, 1, 2),
                                       random_numbers(240, -1, 1, 3)};
  const Numbers field_ = random_numbers(3 * n_box_nodes, -1, 1, 4);

  Numbers velocity(const Coupler& coupler, const std::vector<std::size_t>& sizes) const {
    return interpolate(coupler, picked(coupler, field_), sizes);
  }
  static Numbers grid_force(const Coupler& coupler, const std::vector<Numbers>& force) {
    return unpicked(coupler, box, spread(coupler, force));
  }
};
INSTANTIATE_TEST_SUITE_P(All, CouplerDipoleLayout, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(CouplerDipoleLayout, OfNoLengthHaveTheBitsOfNone) {
  const Sheared sheared = three_surfaces({0, 0, 0});
  build(coupler_, sheared.nodes);
  const Numbers without = velocity(coupler_, sheared.sizes()), force_without = grid_force(coupler_, force_);
  const auto build_others =
      [&] {  // of which nothing may stay; twice, for the old stencils' memory is used again
        for (int k = 0; k < 2; ++k) build(coupler_, three_surfaces({0.1, 0.2, 0.3}));
        EXPECT_FALSE(same_bits(velocity(coupler_, sheared.sizes()), without));
      };
  build_others();
  build(coupler_, sheared);
  EXPECT_TRUE(same_bits(velocity(coupler_, sheared.sizes()), without));
  EXPECT_TRUE(same_bits(grid_force(coupler_, force_), force_without));
  build_others();
  build(coupler_, sheared.nodes);
  EXPECT_TRUE(same_bits(velocity(coupler_, sheared.sizes()), without));
  EXPECT_TRUE(same_bits(grid_force(coupler_, force_), force_without));
}

TEST_P(CouplerDipoleLayout, OfSeveralSurfacesAreThoseOfEachAlone) {
  const Sheared sheared = three_surfaces({0.3, 0, -0.2});  // the middle one has none
  build(coupler_, sheared);
  const Numbers together = velocity(coupler_, sheared.sizes()), force_together = grid_force(coupler_, force_);
  std::vector<Numbers> alone;
  Numbers force_alone(force_together.size(), 0.0);
  for (std::size_t s = 0; s < 3; ++s) {
    if (s == 1) {
      build(coupler_, std::vector<Numbers>{sheared.nodes[s]});
    } else {
      build(coupler_, sheared.one(s));
    }
    alone.push_back(velocity(coupler_, {sheared.sizes()[s]}));
    const Numbers of_one = grid_force(coupler_, {force_[s]});
    for (std::size_t k = 0; k < of_one.size(); ++k) force_alone[k] += of_one[k];
  }
  EXPECT_TRUE(same_bits(together, joined(alone)));
  // At most 100 parts at a grid node, of sizes up to 3, in another order: 100 * 300 eps/2.
  for (std::size_t k = 0; k < force_alone.size(); ++k)
    ASSERT_NEAR(force_together[k], force_alone[k], 15000 * eps) << k;
}

TEST_P(CouplerDipoleLayout, OfSeveralSurfacesAreThoseOfOneOfAllTheirNodes) {
  const Sheared sheared = three_surfaces({0.3, 0.3, 0.3});
  build(coupler_, sheared);
  const Numbers several = velocity(coupler_, sheared.sizes()), several_force = grid_force(coupler_, force_);
  build(coupler_, Sheared{{joined(sheared.nodes)}, {joined(sheared.normals)}, {0.3}});
  EXPECT_TRUE(same_bits(velocity(coupler_, {351}), several));
  EXPECT_TRUE(same_bits(grid_force(coupler_, {joined(force_)}), several_force));
}

TEST_P(CouplerDipoleLayout, HaveTheSameBitsForAnyNumberOfThreads) {
  const Sheared sheared = three_surfaces({0.3, 0, -0.2});
  build(coupler_, sheared);
  const Numbers by_one = velocity(coupler_, sheared.sizes()), force_by_one = grid_force(coupler_, force_);
  for (const int threads : {2, 3, 5}) {
    Coupler coupler(box, GetParam(), threads);
    build(coupler, sheared);
    EXPECT_TRUE(same_bits(velocity(coupler, sheared.sizes()), by_one)) << threads;
    EXPECT_TRUE(same_bits(grid_force(coupler, force_), force_by_one)) << threads;
  }
}

TEST_P(CouplerDipoleLayout, AcrossAPeriodicFaceAreAsInTheMiddle) {
  const Sheared sheared = three_surfaces({0.3, 0.3, 0.3}).one(0);
  build(coupler_, sheared);
  const Numbers middle = velocity(coupler_, {150}), force_middle = grid_force(coupler_, {force_[0]});
  for (int axis = 0; axis < 3; ++axis) {
    const int shift = box.nodes[axis] / 2;
    const auto shifted_node = [&](std::size_t node) {
      auto index = indices_of(box, static_cast<std::int64_t>(node));
      index[axis] = (index[axis] + shift) % box.nodes[axis];
      return (std::size_t{1} * index[2] * box.nodes[1] + index[1]) * box.nodes[0] + index[0];
    };
    Numbers shifted_field(field_.size());
    for (std::size_t node = 0; node < n_box_nodes; ++node)
      std::copy_n(&field_[3 * node], 3, &shifted_field[3 * shifted_node(node)]);
    build(coupler_, Sheared{{shifted(sheared.nodes[0], axis, shift)}, sheared.normals, sheared.lengths});
    // The same products in the same order; only fused multiply-adds may come out differently: half an eps
    // of each of 216 terms, whose sizes add up to 23 (coupler_dipole_test.cpp).
    const Numbers across = interpolate(coupler_, picked(coupler_, shifted_field), {150});
    for (std::size_t k = 0; k < middle.size(); ++k) ASSERT_NEAR(across[k], middle[k], 23 * 216 * eps) << axis;
    const Numbers force_across = grid_force(coupler_, {force_[0]});
    for (std::size_t k = 0; k < force_middle.size(); ++k) {
      ASSERT_NEAR(force_across[3 * shifted_node(k / 3) + k % 3], force_middle[k], 150 * 3 * eps) << axis;
    }
  }
}

// As near to the walls as a kernel may: at the upper one the window moves by one node, whose weight is zero.
// The field is the same as seen from the node, so that it gets the same four steps further in, there by 1e-9
// nearer to the middle, where linear2 has the slope towards the inside. That changes weights and slopes by up
// to 1e-9 times the second derivative of a kernel (8) and fields of up to 12 at three points: 3e-7.
TEST_P(CouplerDipoleLayout, NextToAWallAreAsFurtherIn) {
  const Grid walled = {{12, 10, 14}, {true, true, false}};
  Coupler coupler(walled, GetParam(), 1);
  const auto velocity_at = [&](double z) {
    build(coupler, Sheared{{{5.25, 4.5, z}}, {{0, 0.6, 0.8}}, {0.3}});
    const Numbers field = on_grid_nodes(coupler, walled, [&](const Vector& x) {
      const double r = x[2] - z;
      return Vector{std::sin(r), std::cos(1.3 * r), r * r - r};
    });
    return interpolate(coupler, field, {1});
  };
  const double nearest = GetParam().half_width - 0.5;
  const std::array<double, 2> of_lower = {nearest, nearest + 4 + 1e-9},
                              of_upper = {14 - nearest, 10 - nearest - 1e-9};
  for (const auto& [at_wall, further_in] : {of_lower, of_upper}) {
    const Numbers expected = velocity_at(further_in), found = velocity_at(at_wall);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 3e-7) << at_wall << " " << c;
    // And no force is lost beyond it.
    const Vector force = {1.0, -2.0, 0.5};
    const Numbers on_grid = spread(coupler, {{1.0, -2.0, 0.5}});
    Vector sum = {};
    for (std::size_t k = 0; k < on_grid.size(); ++k) sum[k % 3] += on_grid[k];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], force[c], 2 * 2900 * eps) << at_wall;
  }
}

TEST_P(CouplerDipoleLayout, DoNotChangeTheTangentialCorrection) {
  const Sheared sheared = three_surfaces({0.3, 0, -0.2});
  const auto corrected = [&] {
    std::vector<Numbers> target = {Numbers(450), Numbers(363), Numbers(240)};
    const std::vector<std::span<double>> targets(target.begin(), target.end());
    const std::vector<std::span<const double>> normals(sheared.normals.begin(), sheared.normals.end()),
        force(force_.begin(), force_.end());
    TangentialCorrection(coupler_, 0.2).add(coupler_, normals, force, targets);
    return joined(target);
  };
  build(coupler_, sheared.nodes);
  const Numbers without = corrected();
  build(coupler_, sheared);
  EXPECT_TRUE(same_bits(corrected(), without));
}

/// The message of what a call throws as `Error`; empty if it throws none.
template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class CouplerDipoleRefusals : public ::testing::Test {
 protected:
  void SetUp() override {
    build(coupler_, good_);
    field_ = random_numbers(3 * coupler_.grid_nodes().size(), -1, 1, 5);
    velocity_ = interpolate(coupler_, field_, good_.sizes());
  }
  /// Every refusal leaves the old stencils, with their dipoles.
  void TearDown() override {
    EXPECT_TRUE(same_bits(interpolate(coupler_, field_, good_.sizes()), velocity_));
  }

  template <class Error = std::invalid_argument>
  std::string refusal(const Sheared& sheared) {
    return message_of<Error>([&] { build(coupler_, sheared); });
  }

  const Sheared good_ = three_surfaces({0.3, 0, -0.2});
  Coupler coupler_{box, kernels().front(), 2};
  Numbers field_, velocity_;
};

TEST_F(CouplerDipoleRefusals, OfDipolesThatAreNotOneASurface) {
  Sheared other = good_;
  other.lengths.pop_back();
  EXPECT_EQ(refusal(other), "coupler: 2 shear dipoles for 3 surfaces");
  other = good_;
  other.nodes.pop_back();
  EXPECT_EQ(refusal(other), "coupler: 3 shear dipoles for 2 surfaces");
}

TEST_F(CouplerDipoleRefusals, OfNormalsThatAreNotOneANode) {
  Sheared other = good_;
  other.normals[2].resize(237);
  EXPECT_THAT(refusal(other),
              AllOf(HasSubstr("surface 2 "), HasSubstr("237 numbers of normals; 240 and a finite length")));
}

TEST_F(CouplerDipoleRefusals, OfALengthThatIsNotFinite) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Sheared other = good_;
    other.lengths[1] = value;
    EXPECT_THAT(refusal(other), AllOf(HasSubstr("the shear dipole of surface 1 has the length "),
                                      HasSubstr("a finite length are needed")));
  }
}

TEST_F(CouplerDipoleRefusals, NameTheNodeWhoseNormalIsNotFinite) {
  Sheared other = good_;
  other.normals[2][3 * 17 + 1] = std::nan("");
  other.normals[2][3 * 30] = std::nan("");
  EXPECT_EQ(refusal<StencilError>(other),
            "coupler: surface 2, node 17: its normal, which the shear dipole needs, is not finite");
}

TEST_F(CouplerDipoleRefusals, OfPositionsLeaveTheDipolesToo) {
  Sheared other = three_surfaces({0.1, 0.1, 0.1});
  other.nodes[1][3 * 8] = std::nan("");
  EXPECT_THAT(refusal<StencilError>(other), HasSubstr("surface 1, node 8"));
}

TEST(CouplerDipoleKernels, NeedAKernelWithSlopesAndNormalsOnlyForALength) {
  Kernel plain = kernel("peskin4");
  plain.name = "plain";
  plain.slopes = nullptr;
  Coupler coupler(box, plain, 1);
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              build(coupler, three_surfaces({0, 0.3, 0}));
            }),
            "coupler: kernel 'plain' has no slopes, which a shear dipole needs");
  Sheared without = three_surfaces({0, 0, 0});
  without.normals = {{}, {1, 2}, Numbers(240, std::nan(""))};
  build(coupler, without);
  build(coupler, without.nodes);
}

}  // namespace
}  // namespace tanktread::coupler::dipole_layout_test
