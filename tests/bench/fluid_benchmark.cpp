// The speed of a fluid step, and how near it comes to what the memory allows.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "fluid/lattice_boltzmann.hpp"
#include "tests/bench/bandwidth.hpp"

namespace tanktread {
namespace {

/// Shear flow in a box of n^3 nodes: walls across z, as in every case with a capsule.
std::unique_ptr<fluid::Fluid> shear_flow(int n) {
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {n, n, n};
  settings.walls = fluid::WallPair{2, {-4e-3, 0, 0}, {4e-3, 0, 0}};
  settings.start = fluid::Start::developed;
  return fluid::make_lattice_boltzmann(settings);
}

/// The nodes that a membrane's stencils touch: those within two grid steps of a sphere of radius n/(2 pi).
std::vector<std::int64_t> shell(const fluid::GridShape& shape) {
  std::vector<std::int64_t> nodes;
  const double centre = 0.5 * shape.nx, radius = shape.nx / (2.0 * 3.14159265358979);
  for (int z = 0; z < shape.nz; ++z)
    for (int y = 0; y < shape.ny; ++y)
      for (int x = 0; x < shape.nx; ++x)
        if (std::abs(std::hypot(x + 0.5 - centre, y + 0.5 - centre, z + 0.5 - centre) - radius) < 2.0)
          nodes.push_back(shape.index(x, y, z));
  return nodes;
}

/// The time since it was made, in seconds.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// MLUPS, and what the step moves to and from memory at the least, in GB/s and as a share of the copy and of
/// the update in place that this very run has measured.
void count(benchmark::State& state, const fluid::Fluid& flow, int steps_per_iteration, double seconds) {
  const double node_steps = static_cast<double>(state.iterations()) * steps_per_iteration *
                            static_cast<double>(flow.shape().size());
  const double bytes_per_second = node_steps * fluid::lattice_boltzmann_bytes_per_node / seconds;
  const auto& bandwidth = bench::measured_bandwidth();
  state.counters["MLUPS"] = 1e-6 * node_steps / seconds;
  state.counters["bytes_per_node"] = fluid::lattice_boltzmann_bytes_per_node;
  state.counters["GB_per_s"] = 1e-9 * bytes_per_second;
  state.counters["share_of_copy"] = bytes_per_second / bandwidth.copy();
  state.counters["share_of_in_place"] = bytes_per_second / bandwidth.in_place;
}

/// Two steps an iteration: one of each turn of the in-place update.
void fluid_step(benchmark::State& state) {
  const auto flow = shear_flow(static_cast<int>(state.range(0)));
  const Stopwatch watch;
  for (auto _ : state) {
    flow->step();
    benchmark::DoNotOptimize(flow->step());
  }
  count(state, *flow, 2, watch.seconds());
}

/// The same with what a membrane asks for in each step: the velocity on a shell of nodes, and forces on them.
void fluid_step_with_shell(benchmark::State& state) {
  const auto flow = shear_flow(static_cast<int>(state.range(0)));
  const auto nodes = shell(flow->shape());
  std::vector<double> velocity(3 * nodes.size()), force(3 * nodes.size());
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = k % 2 == 0 ? 1e-6 : -1e-6;
  const Stopwatch watch;
  for (auto _ : state) {
    for (int turn = 0; turn < 2; ++turn) {
      flow->velocity(nodes, velocity);
      flow->clear_force();
      flow->add_force(nodes, force);
      benchmark::DoNotOptimize(flow->step());
    }
  }
  count(state, *flow, 2, watch.seconds());
  state.counters["shell_nodes"] = static_cast<double>(nodes.size());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("nodes_per_edge")->Arg(60)->Arg(120)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(fluid_step)->Apply(sizes);
BENCHMARK(fluid_step_with_shell)->Apply(sizes);

}  // namespace
}  // namespace tanktread

int main(int argc, char** argv) {
  return tanktread::bench::run(argc, argv);
}
