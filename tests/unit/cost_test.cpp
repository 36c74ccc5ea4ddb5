// What a plan says a run will take, against what a run takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/plan/duration.hpp"
#include "driver/plan/plan.hpp"
#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "tests/unit/case_samples.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::HasSubstr;

Cost cost_of(const std::vector<std::string>& assignments, const Probe& probe = {}) {
  const auto the_case = parse(least_case, assignments);
  return predict_cost(the_case, parameters(the_case), sizes_of(membrane_shapes(the_case).meshes), probe);
}

const FilesCost& files(const Cost& cost, const std::string& name) {
  for (const auto& kind : cost.files) {
    if (kind.name == name) return kind;
  }
  throw std::out_of_range(name);
}

TEST(Cost, CountsAllOutputs) {
  // 1/g = 6 * 36/0.1 = 2160 steps; 0.01 shear times are 22 steps (21.6), written at 0, 2, 4 ... 22.
  const auto cost = cost_of({"run.shear_time=0.01", "output.membrane_every=1e-3", "output.fluid_every=1e18",
                             "run.checkpoint_every=1e-3", "output.observables_every=0"});
  EXPECT_EQ(files(cost, "observables").n_written, 0);
  EXPECT_EQ(files(cost, "membrane files").n_written, 12);
  EXPECT_EQ(files(cost, "membrane files").n_kept, 12);
  EXPECT_EQ(files(cost, "fluid files").n_written, 2);
  EXPECT_EQ(files(cost, "checkpoints").n_written, 12);
  EXPECT_EQ(files(cost, "checkpoints").n_kept, 2);
  EXPECT_EQ(cost.disk_peak_bytes() - cost.disk_bytes(), files(cost, "checkpoints").bytes);
}

TEST(Cost, TakesTheTimesOfTheProbe) {
  Probe probe;
  probe.mlups = 2;
  probe.observables_seconds = 0.01;
  probe.measures_seconds = 0.02;
  probe.energy_seconds = 0.04;
  probe.membrane_file_seconds = 0.5;
  probe.grid_seconds_per_byte = 1e-6;
  const auto cost =
      cost_of({"run.shear_time=0.01", "output.membrane_every=1e-3", "output.fluid_every=0",
               "output.observables_every=1e-3", "output.measures_every=1e18", "output.energy_every=1e-3"},
              probe);
  const double n_nodes = 36 * 40 * 44;
  EXPECT_DOUBLE_EQ(cost.step_seconds, 22 * n_nodes / 2e6);
  // 12 membrane files; two checkpoints, each a membrane file and 22 doubles a node; 12, 2, 12 rows.
  EXPECT_DOUBLE_EQ(cost.write_seconds(),
                   12 * 0.5 + 2 * (0.5 + 1e-6 * 22 * 8 * n_nodes) + 12 * 0.01 + 2 * 0.02 + 12 * 0.04);
}

TEST(Cost, ARowOfTheEnergiesIsLongerByTwoColumnsOfEach) {
  const auto energy_bytes = [](const std::vector<std::string>& assignments) {
    return files(cost_of(assignments), "energy").bytes;
  };
  const double without = energy_bytes({});
  const double one = energy_bytes({"membrane.bending_modulus=0.01"});
  const double two = energy_bytes({"membrane.bending_modulus=0.01", "membrane.volume_modulus=1"});
  EXPECT_GT(one, without);
  EXPECT_DOUBLE_EQ(two - one, one - without);
}

TEST(Cost, TriesTheCase) {
  const auto the_case =
      parse(least_case, {"run.shear_time=0.01", "output.measures_every=0.01", "output.energy_every=0.01"});
  const auto probe = try_case(the_case, parameters(the_case), membrane_shapes(the_case));
  EXPECT_EQ(probe.breakdown, "");
  EXPECT_GT(probe.mlups, 0);
  EXPECT_GT(probe.observables_seconds, 0);
  EXPECT_GT(probe.measures_seconds, 0);
  EXPECT_GT(probe.energy_seconds, 0);
  EXPECT_GT(probe.membrane_file_seconds, 0);
  EXPECT_GT(probe.grid_seconds_per_byte, 0);
}

TEST(Cost, ACaseThatBreaksDownAtOnceIsWarnedOf) {
  const auto plan = make_plan(parse(least_case, {"flow.speed_limit=1e-6"}));
  EXPECT_EQ(plan.cost.mlups, 0);
  EXPECT_THAT(plan.cost.breakdown, HasSubstr("speed_limit"));
  EXPECT_THAT(plan.echo, HasSubstr("warning: the first steps of the case, tried now, break down: step 1"));
}

TEST(Cost, ABoxBeyondAllMemoryIsRefusedBeforeItIsTried) {
  const auto the_case = parse(least_case, {"flow.box=[100000, 100000, 100000]"});
  try {
    make_plan(the_case);
    ADD_FAILURE() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("case.toml: flow.box = [100000, 100000, 100000]: needs about 3.52e+05 TB"));
  }
}

TEST(Cost, SinglePrecisionHalvesTheLattice) {
  const double n_nodes = 100.0 * 100 * 100;
  const auto memory = [](const std::string& storage) {
    return cost_of({"flow.box=[100, 100, 100]", "flow.storage=" + storage}).memory_bytes;
  };
  EXPECT_EQ(memory("double") - memory("single"), 19 * 4 * n_nodes);
}

TEST(Cost, AViscosityContrastTakesMarksAndViscosities) {
  const double n_nodes = 36 * 40 * 44;
  const auto one = cost_of({}), contrast = cost_of({"flow.viscosity_ratio=5"});
  for (const std::string kind : {"fluid files", "checkpoints"})
    EXPECT_EQ(files(contrast, kind).bytes - files(one, kind).bytes, 8 * n_nodes) << kind;
  // Of 642 membrane nodes the slopes of six weights an axis and a normal, of two sets of stencils.
  EXPECT_EQ(contrast.memory_bytes - one.memory_bytes, 20 * n_nodes + 642 * 2 * (3 * 6 + 3) * 8);
  EXPECT_EQ(cost_of({"flow.viscosity_ratio=5", "coupler.shear_dipole=false"}).memory_bytes - one.memory_bytes,
            20 * n_nodes);
  EXPECT_EQ(files(contrast, "membrane files").bytes, files(one, "membrane files").bytes);
}

TEST(Cost, AnEndThatNoRunReachesIsRefused) {
  EXPECT_THROW(make_plan(parse(least_case, {"run.shear_time=1e18"})), InputError);
}

TEST(Duration, OfAllLengths) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(405), "6 min 45 s");
  EXPECT_EQ(duration_text(3 * 3600 + 60), "3 h 01 min");
  EXPECT_EQ(duration_text(5 * 86400), "5.0 days");
  EXPECT_EQ(duration_text(1e22), "3.17e+14 years");  // beyond what an integer of seconds holds
}

}  // namespace
