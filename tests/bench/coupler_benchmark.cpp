// What the immersed boundary of a step costs: the stencils, the way to the membrane and the way back.
#include <benchmark/benchmark.h>

#include <span>
#include <vector>

#include "coupler/coupler.hpp"
#include "tests/bench/bandwidth.hpp"
#include "tests/unit/coupler_support.hpp"

namespace tanktread::coupler {
namespace {

/// A box of 120^3 nodes with walls across z, and a capsule of as many nodes as a sphere of 5120 triangles
/// (level 4) has, at the thesis's size. Between two builds it moves by what a fast step moves it.
class Capsule {
 public:
  explicit Capsule(const Kernel& kernel)
      : coupler_(grid, kernel),
        positions_{test::sphere(n_nodes, radius, {60.0, 60.0, 60.0}),
                   test::sphere(n_nodes, radius, {60.05, 60.01, 59.99})},
        node_values_(test::random_numbers(3 * n_nodes, -1.0, 1.0, 1)) {
    build();
    grid_values_ = test::random_numbers(3 * coupler_.grid_nodes().size(), -1.0, 1.0, 2);
  }

  void build() {
    const std::span<const double> surface[] = {positions_[++n_builds_ % 2]};
    coupler_.build(surface);
    // The two places touch numbers of grid nodes that differ a little.
    grid_values_.resize(3 * coupler_.grid_nodes().size());
  }
  void interpolate() {
    const std::span<double> surface[] = {node_values_};
    coupler_.interpolate(grid_values_, surface);
  }
  void spread() {
    const std::span<const double> surface[] = {node_values_};
    coupler_.spread(surface, grid_values_);
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

  Coupler coupler_;
  std::vector<double> positions_[2];
  std::vector<double> node_values_, grid_values_;
  int n_builds_ = 0;
};

void coupler_build(benchmark::State& state, const char* name) {
  Capsule capsule(kernel(name));
  for (auto _ : state) {
    capsule.build();
    benchmark::ClobberMemory();
  }
  capsule.count(state);
}

void coupler_interpolate(benchmark::State& state, const char* name) {
  Capsule capsule(kernel(name));
  for (auto _ : state) {
    capsule.interpolate();
    benchmark::ClobberMemory();
  }
  capsule.count(state);
}

void coupler_spread(benchmark::State& state, const char* name) {
  Capsule capsule(kernel(name));
  for (auto _ : state) {
    capsule.spread();
    benchmark::ClobberMemory();
  }
  capsule.count(state);
}

/// All that a step asks for, in its order: to the membrane with the old stencils, back with the new ones.
void coupler_step(benchmark::State& state, const char* name) {
  Capsule capsule(kernel(name));
  for (auto _ : state) {
    capsule.interpolate();
    capsule.build();
    capsule.spread();
    benchmark::ClobberMemory();
  }
  capsule.count(state);
}

void every_kernel(const char* what, void (*run)(benchmark::State&, const char*)) {
  for (const auto& kernel : kernels()) {
    benchmark::RegisterBenchmark((std::string(what) + "/" + kernel.name).c_str(), run, kernel.name.c_str())
        ->Unit(benchmark::kMicrosecond)
        ->UseRealTime();
  }
}

}  // namespace
}  // namespace tanktread::coupler

int main(int argc, char** argv) {
  using namespace tanktread::coupler;
  every_kernel("coupler_build", coupler_build);
  every_kernel("coupler_interpolate", coupler_interpolate);
  every_kernel("coupler_spread", coupler_spread);
  every_kernel("coupler_step", coupler_step);
  return tanktread::bench::run(argc, argv);
}
