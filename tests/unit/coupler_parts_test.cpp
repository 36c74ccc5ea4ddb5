// The parts of a grid, each coupled by itself, together have the bits of the whole, wherever it is cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "coupler/tangential_correction.hpp"
#include "tests/unit/coupler_dipole_support.hpp"
#include "tests/unit/coupler_parts.hpp"

namespace tanktread::coupler::parts_test {
namespace {

using namespace test;

// Regions of halves are as long as some of the axes, or not.
constexpr std::array<int, 3> nodes_of_box = {24, 20, 18};

std::vector<std::span<const double>> spans_of(const std::vector<Numbers>& arrays) {
  return {arrays.begin(), arrays.end()};
}
std::vector<std::span<double>> targets_of(std::vector<Numbers>& arrays) {
  return {arrays.begin(), arrays.end()};
}

/// Moves coordinates to where the kernel does not reach beyond a wall, some just there.
Numbers between_walls(const Grid& grid, const Kernel& kernel, Numbers nodes) {
  const double margin = kernel.half_width - 0.5;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!grid.periodic[k % 3]) nodes[k] = std::clamp(nodes[k], margin, grid.nodes[k % 3] - margin);
  }
  return nodes;
}

/// Nodes at corners, on edges and faces of cells of the grid, where all its cuts are, and off them by the
/// least that there is.
Numbers nodes_at_cuts() {
  Numbers nodes;
  for (const double x : {0.0, 3.0, 12.0, 16.5, 18.0, 24.0}) {
    for (const double y : {-1e-17, 5.0, 10.0, 20.0}) {
      for (const double z : {0.0, 3.5, std::nextafter(9.0, 0.0), 9.0, 18.0})
        nodes.insert(nodes.end(), {x, y, z});
    }
  }
  return nodes;
}

/// All that a call of a coupler needs.
struct Scene {
  Scene(const Grid& the_grid, const Kernel& kernel, bool with_dipoles) : grid(the_grid) {
    Numbers far = sphere(120, 4.2, {23.7, 0.3, 17.6});
    for (std::size_t k = 0; k < far.size(); ++k) {  // each node at another image
      const int image = static_cast<int>(k * k % 11) - 5;
      if (grid.periodic[k % 3]) far[k] += 1000.0 * image * grid.nodes[k % 3];
    }
    for (const Numbers& nodes :
         {sphere(200, 5.0, {12.1, 9.7, 9.2}), nodes_at_cuts(), far, Numbers{},
          random_numbers(903, -30, 50, 1), Numbers{-1073741823.75, 1073741824.0, -0.0, 24.0, -20.0, 1e9}})
      surfaces.push_back(between_walls(grid, kernel, nodes));
    const Numbers lengths = {0.3, 0, 0.1, 0.2, -0.25, -0.15};
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const unsigned seed = 10 * static_cast<unsigned>(s);
      normals.push_back(random_numbers(surfaces[s].size(), -1, 1, seed));
      force.push_back(random_numbers(surfaces[s].size(), -1, 1, seed + 1));
      length.push_back(with_dipoles ? lengths[s] : 0);
    }
    field = random_numbers(3 * count_of(grid.nodes), -1, 1, 2);
  }

  void build(Coupler& coupler) const {
    std::vector<ShearDipole> dipoles;
    for (std::size_t s = 0; s < surfaces.size(); ++s) dipoles.push_back({normals[s], length[s]});
    coupler.build(spans_of(surfaces), dipoles);
  }
  std::vector<Numbers> arrays_of(double number) const {
    std::vector<Numbers> arrays;
    for (const auto& surface : surfaces) arrays.emplace_back(surface.size(), number);
    return arrays;
  }
  static TangentialCorrection correction(const Coupler& coupler) {
    return {coupler, TangentialCorrection::Shortfalls{{0.1, 0.3, 0.0, 0.2, 0.5, 0.7}}};
  }

  Grid grid;
  std::vector<Numbers> surfaces, normals, force;
  Numbers length, field;
};

/// What a coupler, or those of all parts, made of a scene.
struct Made {
  explicit Made(const Scene& scene)
      : velocity(scene.arrays_of(std::nan(""))),
        corrected(scene.arrays_of(0.25)),
        force(3 * count_of(scene.grid.nodes), 0.0),
        correction(force.size(), 0.0),
        touched(count_of(scene.grid.nodes), 0) {}
  std::vector<Numbers> velocity, corrected;
  Numbers force, correction;  ///< on the whole grid
  std::vector<char> touched;  ///< by whether a stencil does
};

Made made_by_whole(const Scene& scene, const Kernel& kernel) {
  Coupler coupler(scene.grid, kernel, 1);
  scene.build(coupler);
  Made made(scene);
  coupler.interpolate(picked(coupler, scene.field), targets_of(made.velocity));
  made.force = unpicked(coupler, scene.grid, spread(coupler, scene.force));
  const auto correction = Scene::correction(coupler);
  Numbers on_grid(3 * coupler.grid_nodes().size());
  correction.spread(coupler, spans_of(scene.normals), spans_of(scene.force), on_grid);
  made.correction = unpicked(coupler, scene.grid, on_grid);
  correction.add(coupler, spans_of(scene.normals), spans_of(scene.force), targets_of(made.corrected));
  for (const std::int64_t node : coupler.grid_nodes()) made.touched[node] = 1;
  return made;
}

/// A coupler of one part, and what it is given: forces and normals only of the nodes that can touch it.
class PartCoupler {
 public:
  PartCoupler(const Scene& scene, const GridPart& part, const Kernel& kernel, int threads)
      : scene_(scene), part_(part), coupler_(scene.grid, part, kernel, threads), given_(scene) {
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      for (std::size_t k = 0; k < scene.surfaces[s].size(); k += 3) {
        if (is_near(&scene.surfaces[s][k], kernel.half_width + 0.5)) continue;
        std::fill_n(&given_.normals[s][k], 3, std::nan(""));
        std::fill_n(&given_.force[s][k], 3, std::nan(""));
      }
    }
    given_.build(coupler_);
  }

  void interpolate_and_spread(Made& made) const {
    check_nodes(made);
    std::vector<Numbers> velocity = scene_.arrays_of(std::nan(""));
    coupler_.interpolate(on_region(scene_.field), targets_of(velocity));
    take_those_at_home(velocity, made.velocity);
    keep_own(spread(coupler_, given_.force), made.force);
    Numbers on_grid(3 * coupler_.grid_nodes().size(), std::nan(""));
    Scene::correction(coupler_).spread(coupler_, spans_of(given_.normals), spans_of(given_.force), on_grid);
    keep_own(on_grid, made.correction);
  }

  /// @param made correction: complete
  void correct(Made& made) const {
    std::vector<Numbers> velocity = scene_.arrays_of(0.25);
    Scene::correction(coupler_).add_from(coupler_, spans_of(given_.normals), on_region(made.correction),
                                         targets_of(velocity));
    take_those_at_home(velocity, made.corrected);
  }

  const Coupler& coupler() const { return coupler_; }

 private:
  /// Whether a position is within `reach` of the part, or on an axis that is walled.
  bool is_near(const double* position, double reach) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (!scene_.grid.periodic[axis]) continue;
      const double period = scene_.grid.nodes[axis], middle = part_.begin[axis] + 0.5 * part_.nodes[axis];
      if (std::abs(std::remainder(position[axis] - middle, period)) > 0.5 * part_.nodes[axis] + reach)
        return false;
    }
    return true;
  }

  void check_nodes(Made& made) const {
    const auto nodes = coupler_.grid_nodes();
    EXPECT_TRUE(std::ranges::is_sorted(nodes, std::ranges::less_equal{}));
    for (const std::int64_t node : nodes) {
      ASSERT_GE(node, 0);
      ASSERT_LT(node, count_of(coupler_.region().nodes));
      const std::int64_t of_grid = node_of_grid(scene_.grid, coupler_.region(), node);
      if (has_node(scene_.grid, part_, of_grid)) made.touched[of_grid] = 1;
    }
  }

  /// Numbers of the whole grid at the nodes of the coupler.
  Numbers on_region(const Numbers& whole) const {
    Numbers numbers;
    for (const std::int64_t node : coupler_.grid_nodes()) {
      const std::int64_t k = 3 * node_of_grid(scene_.grid, coupler_.region(), node);
      numbers.insert(numbers.end(), &whole[k], &whole[k] + 3);
    }
    return numbers;
  }

  /// Puts the numbers at nodes of the part where they are in the whole grid.
  void keep_own(const Numbers& numbers, Numbers& whole) const {
    const auto nodes = coupler_.grid_nodes();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::int64_t node = node_of_grid(scene_.grid, coupler_.region(), nodes[k]);
      if (has_node(scene_.grid, part_, node)) std::copy_n(&numbers[3 * k], 3, &whole[3 * node]);
    }
  }

  /// Those of others must be as they were, and nobody may have taken one before.
  void take_those_at_home(const std::vector<Numbers>& velocity, std::vector<Numbers>& all) const {
    for (std::size_t s = 0; s < velocity.size(); ++s) {
      const auto home = coupler_.home_nodes(s);
      std::size_t next = 0;
      for (std::size_t node = 0; node < velocity[s].size() / 3; ++node) {
        const bool is_home = next < home.size() && home[next] == static_cast<std::int32_t>(node);
        next += is_home;
        for (std::size_t k = 3 * node; k < 3 * node + 3; ++k) {
          const bool untouched = std::isnan(velocity[s][k]) || velocity[s][k] == 0.25;
          if (!is_home) {
            ASSERT_TRUE(untouched);
          } else {
            ASSERT_TRUE(std::isnan(all[s][k]) || all[s][k] == 0.25) << "at home in two parts";
            all[s][k] = velocity[s][k];
          }
        }
      }
      ASSERT_EQ(next, home.size());  // ascending, of the surface
    }
  }

  const Scene& scene_;
  GridPart part_;
  Coupler coupler_;
  Scene given_;
};

void expect_the_whole(const Scene& scene, const Kernel& kernel, const Made& whole,
                      const std::array<int, 3>& division, int threads) {
  Made made(scene);
  std::vector<std::unique_ptr<PartCoupler>> parts;
  std::vector<std::size_t> at_home(scene.surfaces.size(), 0);
  for (const GridPart& part : parts_of(scene.grid, division)) {
    parts.push_back(std::make_unique<PartCoupler>(scene, part, kernel, threads));
    parts.back()->interpolate_and_spread(made);
    for (std::size_t s = 0; s < at_home.size(); ++s)
      at_home[s] += parts.back()->coupler().home_nodes(s).size();
  }
  for (const auto& part : parts) part->correct(made);
  for (std::size_t s = 0; s < at_home.size(); ++s) {
    EXPECT_EQ(at_home[s], scene.surfaces[s].size() / 3);
    EXPECT_TRUE(same_bits(made.velocity[s], whole.velocity[s])) << "surface " << s;
    EXPECT_TRUE(same_bits(made.corrected[s], whole.corrected[s])) << "surface " << s;
  }
  EXPECT_EQ(made.touched, whole.touched);
  EXPECT_TRUE(same_bits(made.force, whole.force));
  EXPECT_TRUE(same_bits(made.correction, whole.correction));
}

std::string text_of(const Grid& grid, const std::array<int, 3>& division) {
  std::string text = "periodic";
  for (const bool periodic : grid.periodic) text += periodic ? " 1" : " 0";
  for (const int n : division) text += " / " + std::to_string(n);
  return text;
}

class CouplerParts : public ::testing::TestWithParam<Kernel> {};
INSTANTIATE_TEST_SUITE_P(All, CouplerParts, ::testing::ValuesIn(kernels()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(CouplerParts, TogetherHaveTheBitsOfTheWhole) {
  for (const Grid& grid : grids_of(nodes_of_box)) {
    for (const bool with_dipoles : {false, true}) {
      const Scene scene(grid, GetParam(), with_dipoles);
      const Made whole = made_by_whole(scene, GetParam());
      for (const auto& division : divisions) {
        SCOPED_TRACE(text_of(grid, division) + (with_dipoles ? ", with dipoles" : ""));
        expect_the_whole(scene, GetParam(), whole, division, 1);
        if (division == divisions[3]) expect_the_whole(scene, GetParam(), whole, division, 3);
        if (HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace tanktread::coupler::parts_test
