// The speed of a fluid step, and how near it comes to what the memory allows.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "fluid/lattice_boltzmann.hpp"
#include "tests/bench/bandwidth.hpp"

namespace tanktread {
namespace {

fluid::Storage storage_of(const benchmark::State& state) {
  return state.range(1) == 4 ? fluid::Storage::single_precision : fluid::Storage::double_precision;
}

/// Shear flow in a box of n^3 nodes: walls across z, as in every case with a capsule.
std::unique_ptr<fluid::Fluid> shear_flow(const benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {n, n, n};
  settings.storage = storage_of(state);
  settings.walls = fluid::WallPair{2, {-4e-3, 0, 0}, {4e-3, 0, 0}};
  settings.start = fluid::Start::developed;
  return fluid::make_lattice_boltzmann(settings);
}

/// About the nodes that a membrane's stencils touch (four wide along each axis): those within 2.6 grid steps
/// of a sphere of radius n/(2 pi).
std::vector<std::int64_t> shell(const fluid::GridShape& shape) {
  std::vector<std::int64_t> nodes;
  const double centre = 0.5 * shape.nx, radius = shape.nx / (2.0 * 3.14159265358979);
  for (int z = 0; z < shape.nz; ++z)
    for (int y = 0; y < shape.ny; ++y)
      for (int x = 0; x < shape.nx; ++x)
        if (std::abs(std::hypot(x + 0.5 - centre, y + 0.5 - centre, z + 0.5 - centre) - radius) < 2.6)
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
void count(benchmark::State& state, std::int64_t n_nodes, int steps_per_iteration, double seconds) {
  const double node_steps =
      static_cast<double>(state.iterations()) * steps_per_iteration * static_cast<double>(n_nodes);
  const int bytes_per_node = fluid::lattice_boltzmann_bytes_per_node(storage_of(state));
  const double bytes_per_second = node_steps * bytes_per_node / seconds;
  const auto& bandwidth = bench::measured_bandwidth();
  state.counters["MLUPS"] = 1e-6 * node_steps / seconds;
  state.counters["bytes_per_node"] = bytes_per_node;
  state.counters["GB_per_s"] = 1e-9 * bytes_per_second;
  state.counters["share_of_copy"] = bytes_per_second / bandwidth.copy();
  state.counters["share_of_in_place"] = bytes_per_second / bandwidth.in_place;
}

/// Two steps an iteration: one of each turn of the in-place update.
void fluid_step(benchmark::State& state) {
  const auto flow = shear_flow(state);
  const Stopwatch watch;
  for (auto _ : state) {
    flow->step();
    benchmark::DoNotOptimize(flow->step());
  }
  count(state, flow->shape().size(), 2, watch.seconds());
}

/// What a step could reach if it did no arithmetic: as many numbers, in 19 streams side by side, each loaded
/// and stored in place, on as many threads.
template <typename Number>
void load_and_store(benchmark::State& state) {
  constexpr int n_streams = 19, line = 64 / sizeof(Number);
  const std::int64_t n = state.range(0) * state.range(0) * state.range(0) / line * line;
  const std::int64_t stride = n + 27 * line;  // not the same sets of the cache for all
  const auto numbers = std::make_unique_for_overwrite<Number[]>(n_streams * stride);
  const auto pass = [&](Number factor) {
#pragma omp parallel for schedule(static)
    for (std::int64_t begin = 0; begin < n; begin += line) {
      for (int stream = 0; stream < n_streams; ++stream) {
        Number* at = &numbers[stream * stride + begin];
#pragma omp simd
        for (int k = 0; k < line; ++k) at[k] = at[k] * factor;
      }
    }
  };
  pass(0);  // each thread touches first what it passes over later
  const Stopwatch watch;
  for (auto _ : state) {
    pass(1);
    benchmark::ClobberMemory();
  }
  count(state, n, 1, watch.seconds());
}

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + numbers.size() / 2;
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// The same with what a membrane asks for in each step: the velocity on a shell of nodes, and forces on them.
/// What that adds is small beside what a busy machine does to a time, so steps with and without it take
/// turns.
void fluid_step_with_shell(benchmark::State& state) {
  const auto flow = shear_flow(state);
  const auto nodes = shell(flow->shape());
  std::vector<double> velocity(3 * nodes.size()), force(3 * nodes.size());
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = k % 2 == 0 ? 1e-6 : -1e-6;
  const auto push_and_step = [&] {
    flow->velocity(nodes, velocity);
    flow->clear_force();
    flow->add_force(nodes, force);
    flow->step();
  };
  double seconds = 0.0;
  std::vector<double> with_shell, without;
  for (auto _ : state) {
    for (int k = 0; k < 2; ++k) push_and_step();  // not timed: the velocities below are those of pushed nodes
    const Stopwatch pushed;
    for (int k = 0; k < 2; ++k) push_and_step();
    with_shell.push_back(pushed.seconds());
    flow->clear_force();
    const Stopwatch plain;
    for (int k = 0; k < 2; ++k) flow->step();
    without.push_back(plain.seconds());
    state.SetIterationTime(with_shell.back());
    seconds += with_shell.back();
  }
  count(state, flow->shape().size(), 2, seconds);
  state.counters["shell_nodes"] = static_cast<double>(nodes.size());
  state.counters["ms_a_step"] = 500.0 * median(without);
  state.counters["ms_more"] = 500.0 * (median(with_shell) - median(without));
}

/// The nodes of a sphere of radius 19 in the middle of the box, as inside a capsule.
std::vector<std::int64_t> ball(const fluid::GridShape& shape) {
  std::vector<std::int64_t> nodes;
  const double centre = 0.5 * shape.nx, radius = 19.0;
  for (int z = 0; z < shape.nz; ++z)
    for (int y = 0; y < shape.ny; ++y)
      for (int x = 0; x < shape.nx; ++x)
        if (std::hypot(x + 0.5 - centre, y + 0.5 - centre, z + 0.5 - centre) < radius)
          nodes.push_back(shape.index(x, y, z));
  return nodes;
}

/// A step where the fluid in a sphere has five times the viscosity, against one with the same everywhere. The
/// two flows take turns, as above. What it takes to change the viscosity of some nodes is timed apart.
void fluid_step_with_contrast(benchmark::State& state) {
  const auto with_ball = shear_flow(state), without = shear_flow(state);
  const auto nodes = ball(with_ball->shape());
  with_ball->set_viscosity(nodes, std::vector<double>(nodes.size(), 5.0 / 6.0));
  // Some hundred of them, far apart: no two in one pack.
  std::vector<std::int64_t> changing;
  for (std::size_t k = 0; k < nodes.size(); k += 97) changing.push_back(nodes[k]);
  const std::vector<double> inside(changing.size(), 5.0 / 6.0), outside(changing.size(), 1.0 / 6.0);
  const auto time_of_steps = [](fluid::Fluid& flow) {
    for (int k = 0; k < 2; ++k) flow.step();  // not timed: the other flow was in the cache
    const Stopwatch watch;
    for (int k = 0; k < 2; ++k) flow.step();
    return watch.seconds();
  };
  double seconds = 0.0;
  std::vector<double> times_with, times_without, times_of_change;
  for (auto _ : state) {
    times_with.push_back(time_of_steps(*with_ball));
    times_without.push_back(time_of_steps(*without));
    const Stopwatch change;
    with_ball->set_viscosity(changing, outside);
    with_ball->set_viscosity(changing, inside);
    times_of_change.push_back(change.seconds());
    state.SetIterationTime(times_with.back());
    seconds += times_with.back();
  }
  count(state, with_ball->shape().size(), 2, seconds);
  state.counters["inside_nodes"] = static_cast<double>(nodes.size());
  state.counters["ms_a_step"] = 500.0 * median(times_without);
  state.counters["ratio"] = median(times_with) / median(times_without);
  state.counters["ns_a_node_changed"] = 5e8 * median(times_of_change) / static_cast<double>(changing.size());
}

/// What free_velocity() on the shell takes, where a membrane asks for it: after velocity(), between two
/// steps.
void free_velocity_on_shell(benchmark::State& state) {
  const auto flow = shear_flow(state);
  const auto nodes = shell(flow->shape());
  std::vector<double> velocity(3 * nodes.size()), force(3 * nodes.size(), 1e-6), mobility(nodes.size());
  std::vector<double> of_last_step, of_next_step;
  for (auto _ : state) {
    double seconds = 0.0;
    for (int k = 0; k < 2; ++k) {  // each turn of the in-place update
      flow->clear_force();
      flow->add_force(nodes, force);
      flow->step();
      const Stopwatch last;
      flow->velocity(nodes, velocity);
      of_last_step.push_back(last.seconds());
      const Stopwatch next;
      flow->free_velocity(nodes, velocity, mobility);
      of_next_step.push_back(next.seconds());
      seconds += of_next_step.back();
      for (std::size_t i = 0; i < force.size(); ++i) force[i] = -force[i];
    }
    state.SetIterationTime(seconds);
  }
  state.counters["shell_nodes"] = static_cast<double>(nodes.size());
  state.counters["ms_velocity"] = 1000.0 * median(of_last_step);
  state.counters["ms_free_velocity"] = 1000.0 * median(of_next_step);
}

void sizes_of(benchmark::internal::Benchmark* benchmark, const std::vector<std::int64_t>& bytes) {
  benchmark->ArgNames({"nodes_per_edge", "bytes_of_number"})->Unit(benchmark::kMillisecond);
  for (const auto n : {60, 120, 128})  // the last is a power of two
    for (const auto b : bytes) benchmark->Args({n, b});
}
void sizes(benchmark::internal::Benchmark* benchmark) {
  sizes_of(benchmark, {8, 4});
}
BENCHMARK(fluid_step)->Apply(sizes)->UseRealTime();
BENCHMARK(fluid_step_with_shell)->Apply(sizes)->UseManualTime();
BENCHMARK(fluid_step_with_contrast)
    ->Apply([](auto* benchmark) {
      benchmark->ArgNames({"nodes_per_edge", "bytes_of_number"})->Unit(benchmark::kMillisecond);
      for (const int bytes : {8, 4}) benchmark->Args({120, bytes});
    }) -> UseManualTime();
BENCHMARK(free_velocity_on_shell)->Apply(sizes)->UseManualTime();
BENCHMARK(load_and_store<double>)->Apply([](auto* benchmark) { sizes_of(benchmark, {8}); }) -> UseRealTime();
BENCHMARK(load_and_store<float>)->Apply([](auto* benchmark) { sizes_of(benchmark, {4}); }) -> UseRealTime();

}  // namespace
}  // namespace tanktread

int main(int argc, char** argv) {
  return tanktread::bench::run(argc, argv);
}
