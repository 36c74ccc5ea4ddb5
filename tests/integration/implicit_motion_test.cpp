// An implicit viscosity under a motion that is given.
#include <algorithm>
#include <cmath>

#include "driver/system/capsule_shape.hpp"
#include "driver/system/components.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/integration/implicit_stages_fixture.hpp"

namespace tanktread::testing {
namespace {

std::vector<double> numbers(const Eigen::MatrixXd& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

/// The columns of a capsule in an array of all.
template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> part(const exchange::Array& array, int capsule, int n_each) {
  return Eigen::Map<const Eigen::Matrix<double, rows, Eigen::Dynamic>>(
      array.values.data() + rows * n_each * capsule, rows, n_each);
}

// Under a motion that is given the stress is that of its velocity, in every step, to the last bit.
TEST_F(Implicit, ATwistMeetsTheStressOfItsVelocity) {
  stage({"membrane", "--motion", "twist", "--amplitude-deg", "20", "--period", "0.4", "--shear-time", "0.01",
         "--every", "0.002", "--out", path("twist")});
  const auto the_case = driver::read_case(path("case.toml"));
  const auto parameters = driver::parameters(the_case);
  const auto meshes = driver::membrane_shapes(the_case).meshes;
  for (const int capsule : {0, 1, 2}) {
    const auto viscosity = driver::implicit_viscosity(parameters.capsules[capsule], meshes[capsule], 1);
    ASSERT_EQ(viscosity == nullptr, capsule == 1);
    for (int step = 1; step <= 5; ++step) {
      const auto file =
          exchange::read_surface(path("twist/membrane/membrane_000000000" + std::to_string(step) + ".vtu"));
      constexpr int n_nodes = 42, n_triangles = 80;
      const auto vectors = [&](const char* name) {
        return part<3>(exchange::find_array(file.point_data, name, "file"), capsule, n_nodes);
      };
      const auto stress =
          part<9>(exchange::find_array(file.cell_data, "viscous_stress", "file"), capsule, n_triangles);
      if (viscosity == nullptr) {
        EXPECT_EQ(vectors("total_force"), vectors("elastic_force"));
        EXPECT_EQ(numbers(stress), std::vector<double>(9 * n_triangles));
        continue;
      }
      viscosity->set_positions(part<3>({"position", 3, file.points}, capsule, n_nodes));
      viscosity->accept(viscosity->stress_of(vectors("velocity")));
      EXPECT_GT(stress.norm(), 1e-4);
      EXPECT_EQ(numbers(stress), numbers(viscosity->rates().stress(viscosity->stress())));
      Eigen::Matrix3Xd force(3, n_nodes);
      viscosity->rates().multiply_transposed(viscosity->stress(), force);
      EXPECT_GT(force.norm(), 1e-4);
      EXPECT_EQ(numbers(vectors("total_force")), numbers(vectors("elastic_force") - force));
    }
  }
}

// The series has a file a step: its velocities are those of the run's moves. Without a spring the stress is
// that of the velocity before, which the run had one step earlier, at the positions before: the same but for
// the strain of a step, 2 U/L = 2e-3 of the rates at most.
TEST_F(Implicit, AMotionFromTheRunHasTheRunsElasticForces) {
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.membrane_every=0.002"});
  stage({"membrane", "--motion", path("out/membrane.pvd"), "--out", path("motion")});
  const auto run = exchange::read_surface(path("out/membrane/membrane_0000000012.vtu"));
  const auto motion = exchange::read_surface(path("motion/membrane/membrane_0000000012.vtu"));
  EXPECT_EQ(run.points, motion.points);
  EXPECT_EQ(exchange::find_array(run.point_data, "elastic_force", "run").values,
            exchange::find_array(motion.point_data, "elastic_force", "motion").values);
  const auto before = exchange::read_surface(path("out/membrane/membrane_0000000011.vtu"));
  const auto& of_run = exchange::find_array(before.cell_data, "viscous_stress", "run").values;
  const auto& of_motion = exchange::find_array(motion.cell_data, "viscous_stress", "motion").values;
  double largest = 0, difference = 0;
  for (int k = 0; k < 9 * 80; ++k) {
    largest = std::max(largest, std::abs(of_run[k]));
    difference = std::max(difference, std::abs(of_run[k] - of_motion[k]));
  }
  EXPECT_GT(largest, 1e-5);
  EXPECT_LT(difference, 2e-3 * largest);
  EXPECT_GT(difference, 0);
}

TEST_F(Implicit, AMotionMayBeginDeformed) {
  call({"run", path("case.toml"), "--output", path("out"), "--set", "output.membrane_every=0.002"});
  auto entries = exchange::read_series(path("out/membrane.pvd"));
  entries.erase(entries.begin(), entries.begin() + 6);
  exchange::write_series(path("out/late.pvd"), entries);
  stage({"membrane", "--motion", path("out/late.pvd"), "--out", path("late")});
}

}  // namespace
}  // namespace tanktread::testing
