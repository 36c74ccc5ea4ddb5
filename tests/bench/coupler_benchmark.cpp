// What the immersed boundary of a step costs: the stencils, the way to the membrane and the way back, without
// and with the dipoles of a surface between two fluids; and which grid nodes are inside.
#include <benchmark/benchmark.h>

#include <span>
#include <vector>

#include "coupler/coupler.hpp"
#include "coupler/inside.hpp"
#include "coupler/node_normals.hpp"
#include "coupler/tangential_correction.hpp"
#include "tests/bench/bandwidth.hpp"
#include "tests/unit/coupler_closed_surfaces.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

/// A box of 120^3 nodes with walls across z, and a capsule of as many nodes as a sphere of 5120 triangles
/// (level 4) has, at the thesis's size. Between two builds it moves by what a fast step moves it.
class Capsule {
 public:
  /// @param dipole_length of its surface, grid steps (ShearDipole); 0: none
  explicit Capsule(const Kernel& kernel, double dipole_length = 0)
      : coupler_(grid, kernel),
        positions_{test::sphere(n_nodes, radius, {60.0, 60.0, 60.0}),
                   test::sphere(n_nodes, radius, {60.05, 60.01, 59.99})},
        node_velocity_(3 * n_nodes),
        node_force_(test::random_numbers(3 * n_nodes, -1.0, 1.0, 1)),
        normals_(test::sphere(n_nodes, 1.0, {0.0, 0.0, 0.0})),
        dipole_length_(dipole_length) {
    build();
  }

  void build() {
    const std::span<const double> surface[] = {positions_[++n_builds_ % 2]};
    const ShearDipole dipoles[] = {{normals_, dipole_length_}};
    coupler_.build(surface, dipoles);
    // The two places touch numbers of grid nodes that differ a little.
    grid_velocity_.resize(3 * coupler_.grid_nodes().size(), 0.5);
    grid_force_.resize(grid_velocity_.size());
  }
  void interpolate() {
    const std::span<double> surface[] = {node_velocity_};
    coupler_.interpolate(grid_velocity_, surface);
  }
  void spread() {
    const std::span<const double> surface[] = {node_force_};
    coupler_.spread(surface, grid_force_);
  }

  /// What the tangential correction adds to a step: normals, spread, interpolation.
  void correct() {
    const std::span<const double> positions[] = {positions_[n_builds_ % 2]}, force[] = {node_force_};
    const std::span<const int> triangles[] = {triangles_};
    const std::span<double> velocity[] = {node_velocity_};
    const auto normals = node_normals_.find(positions, triangles);
    correction_.add(coupler_, normals, force, velocity);
  }

  /// All that a step asks for, in its order: to the membrane with the old stencils, back with the new ones.
  void step() {
    interpolate();
    build();
    spread();
  }

  /// Membrane nodes a second, and the grid nodes that their stencils touch.
  void count(benchmark::State& state) const {
    state.counters["nodes_per_second"] =
        benchmark::Counter(n_nodes, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["grid_nodes"] = static_cast<double>(coupler_.grid_nodes().size());
  }

 private:
  static constexpr Grid grid = {{120, 120, 120}, {true, true, false}};
  static constexpr int n_nodes = 2562;
  static constexpr double radius = 19.1;

  /// As many as the sphere has, between nodes that follow each other on the spiral.
  static std::vector<int> some_triangles() {
    std::vector<int> triangles;
    for (int t = 0; t < 5120; ++t) {
      const int first = t % (n_nodes - 2);
      triangles.insert(triangles.end(), {first, first + 1, first + 2});
    }
    return triangles;
  }

  Coupler coupler_;
  NodeNormals node_normals_;
  TangentialCorrection correction_{coupler_, 1.0 / 6.0};
  std::vector<double> positions_[2];
  // What comes out of one call never goes into another: numbers that shrink round after round end below the
  // normal doubles, which some processors are slow at.
  std::vector<double> node_velocity_, node_force_, grid_velocity_, grid_force_;
  std::vector<double> normals_;
  double dipole_length_;
  std::vector<int> triangles_ = some_triangles();
  int n_builds_ = 0;
};

void every_kernel(const char* what, void (Capsule::*work)(), double dipole_length = 0) {
  for (const auto& kernel : kernels()) {
    const auto run = [&kernel, work, dipole_length](benchmark::State& state) {
      Capsule capsule(kernel, dipole_length);
      for (auto _ : state) {
        (capsule.*work)();
        benchmark::ClobberMemory();
      }
      capsule.count(state);
    };
    benchmark::RegisterBenchmark((std::string(what) + "/" + kernel.name).c_str(), run)
        ->Unit(benchmark::kMicrosecond)
        ->UseRealTime();
  }
}

/// Spheres of the thesis's size, `across` along each axis of a box with 120^3 nodes for each.
void inside(benchmark::State& state, bool anew) {
  const int across = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
  const int length = 120 * across;
  InsideMarks marks({{length, length, length}, {true, true, false}}, threads);
  const auto spheres_at = [&](const test::Vector& place) {
    std::vector<test::Surface> spheres;
    for (int k = 0; k < across * across * across; ++k) {
      const test::Vector corner = {120.0 * (k % across), 120.0 * (k / across % across),
                                   120.0 * (k / (across * across))};
      spheres.push_back(test::moved(test::moved(test::ellipsoid(4, {19.1, 19.1, 19.1}), place), corner));
    }
    return spheres;
  };
  const auto here = spheres_at({60.0, 60.0, 60.0}), there = spheres_at({60.05, 60.01, 59.99});
  const test::Spans spans[] = {test::Spans(here), test::Spans(there)};
  int n_updates = 0;
  for (auto _ : state) {
    const auto& [positions, triangles] = spans[++n_updates % 2];
    anew ? marks.mark(positions, triangles) : marks.update(positions, triangles);
    benchmark::ClobberMemory();
  }
  state.counters["changes"] = static_cast<double>(marks.changes().size());
}

}  // namespace
}  // namespace tanktread::coupler

int main(int argc, char** argv) {
  using namespace tanktread::coupler;
  every_kernel("coupler_build", &Capsule::build);
  every_kernel("coupler_interpolate", &Capsule::interpolate);
  every_kernel("coupler_spread", &Capsule::spread);
  every_kernel("coupler_step", &Capsule::step);
  every_kernel("coupler_correct", &Capsule::correct);
  // Between two fluids: how much more the same calls take with slopes and dipoles.
  constexpr double dipole_length = -0.25;
  every_kernel("coupler_build_dipole", &Capsule::build, dipole_length);
  every_kernel("coupler_interpolate_dipole", &Capsule::interpolate, dipole_length);
  every_kernel("coupler_spread_dipole", &Capsule::spread, dipole_length);
  every_kernel("coupler_step_dipole", &Capsule::step, dipole_length);
  for (const bool anew : {false, true}) {
    benchmark::RegisterBenchmark(anew ? "coupler_inside_mark" : "coupler_inside_update", inside, anew)
        ->ArgNames({"across", "threads"})
        ->ArgsProduct({{1, 2}, {1, 2}})
        ->Unit(benchmark::kMicrosecond)
        ->UseRealTime();
  }
  return tanktread::bench::run(argc, argv);
}
