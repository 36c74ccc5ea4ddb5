#include "driver/plan/probe.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "driver/observe/energy.hpp"
#include "driver/observe/measures.hpp"
#include "driver/observe/observables.hpp"
#include "driver/packets/fluid_files.hpp"
#include "driver/system/components.hpp"
#include "driver/system/membrane_files.hpp"
#include "driver/system/step.hpp"
#include "driver/units/schedule.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::int64_t membrane_nodes_of(const System& system) {
  std::int64_t n = 0;
  for (const auto& velocity : system.node_velocity) n += velocity.cols();
  return n;
}

void measure_speed(System& system, std::int64_t last_step, Probe& probe) {
  constexpr double probe_seconds = 1.0;
  constexpr int n_warm_up = 2, n_least = 3;
  const auto n_enough = std::max<std::int64_t>(n_least, last_step / 10);
  for (int k = 0; k < n_warm_up; ++k) advance(system);
  const double fluid_before = system.seconds.fluid;
  double seconds = 0;
  std::int64_t n_steps = 0;
  while (n_steps < n_least || (seconds < probe_seconds && n_steps < n_enough)) {
    seconds += seconds_of([&] { advance(system); });
    ++n_steps;
  }
  const auto steps = static_cast<double>(n_steps);
  const double node_steps = steps * static_cast<double>(system.fluid->shape().size());
  const double fluid_seconds = system.seconds.fluid - fluid_before;
  probe.mlups = 1e-6 * node_steps / seconds;
  probe.fluid_node_seconds = fluid_seconds / node_steps;
  if (const auto n_nodes = membrane_nodes_of(system); n_nodes > 0)
    probe.membrane_node_seconds = (seconds - fluid_seconds) / (steps * static_cast<double>(n_nodes));
}

/// A folder of its own among the temporary files, removed with what it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    auto pattern = (fs::temp_directory_path() / "tanktread-probe-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw exchange::FileError(pattern + ": cannot be made");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The box of fluid files, or as many of its layers along z as make a file of at most 32 MB.
Ranges3 sampled_box(const Case& the_case) {
  constexpr double most_bytes = 32e6, node_bytes = 7 * 8;
  const auto& box = the_case.flow.box;
  auto range =
      the_case.output.fluid_box.value_or(Ranges3{{{0, box[0] - 1}, {0, box[1] - 1}, {0, box[2] - 1}}});
  const double layer = node_bytes * (range[0][1] - range[0][0] + 1) * (range[1][1] - range[1][0] + 1);
  const double n_layers = std::clamp(most_bytes / layer, 1.0, 1.0 + range[2][1] - range[2][0]);
  range[2][1] = range[2][0] + static_cast<int>(n_layers) - 1;
  return range;
}

void measure_writing(const System& system, const Case& the_case, Probe& probe) {
  const TemporaryFolder folder;
  const auto membrane = folder.path() / "membrane.vtu", series = folder.path() / "membrane.pvd",
             grid = folder.path() / "fluid.vti";
  probe.membrane_file_seconds = seconds_of([&] {
    exchange::write_surface(membrane, membrane_file(system.membranes, system.node_velocity, system.node_force,
                                                    system.step, system.shear_time()));
    exchange::write_series(series, {{0, "membrane.vtu"}});
  });
  const auto content = flow_file(*system.fluid, sampled_box(the_case), system.step, system.shear_time());
  const double seconds = seconds_of([&] { exchange::write_grid(grid, content); });
  probe.grid_seconds_per_byte = seconds / static_cast<double>(fs::file_size(grid));
}

/// What a row of each table takes to find: of the energies, the passes over all of the fluid.
void measure_rows(const System& system, const Case& the_case, Probe& probe) {
  probe.observables_seconds = seconds_of([&] { observe(system, the_case); });
  if (the_case.output.measures_every > 0)
    probe.measures_seconds = seconds_of([&] { measure(system, the_case); });
  if (the_case.output.energy_every > 0)
    probe.energy_seconds = seconds_of([&] { energy_budget(system, the_case); });
}

}  // namespace

Probe try_case(const Case& the_case, const Parameters& parameters, const MembraneShapes& shapes,
               Sharing sharing) {
  Probe probe;
  try {
    auto system = make_system(the_case, parameters, shapes, sharing);
    measure_speed(system, last_step_of(the_case, parameters), probe);
    measure_rows(system, the_case, probe);
    measure_writing(system, the_case, probe);
  } catch (const RunError& error) {
    probe.breakdown = error.what();
  } catch (const exchange::FileError&) {
    // No place for temporary files: the time to write stays unknown, and the plan says so.
  } catch (const fs::filesystem_error&) {
  }
  return probe;
}

}  // namespace tanktread::driver
