// What a step of a membrane of 5120 triangles costs, without and with membrane viscosity, and what the
// energies beside its elastic law add.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "membrane/energy_terms.hpp"
#include "membrane/membrane.hpp"
#include "membrane/viscous_law.hpp"
#include "tests/bench/bandwidth.hpp"

namespace tanktread::membrane {
namespace {

/// Positions of a sphere that is sheared to and fro, so that strains and their increments are not zero.
std::vector<Eigen::Matrix3Xd> sheared(const TriangleMesh& sphere) {
  std::vector<Eigen::Matrix3Xd> positions;
  for (const double shear : {0.1, 0.11}) {
    Eigen::Matrix3Xd points = sphere.points;
    points.row(0) += shear * sphere.points.row(2);
    positions.push_back(points);
  }
  return positions;
}

/// One add_forces(), strain to nodal force. @param scheme of maxwell_schemes(), "": elastic
void membrane_step(benchmark::State& state, const std::string& scheme, int interval) {
  const auto sphere = icosphere(4, 19.1);
  std::shared_ptr<const ViscousLaw> viscous;
  if (!scheme.empty()) {
    ViscousParameters parameters;
    parameters.scheme = scheme;
    parameters.interval = interval;
    parameters.shear_viscosity = parameters.dilatational_viscosity = 30;
    parameters.shear_spring = parameters.dilatational_spring = 0.1;
    viscous = std::make_shared<const ViscousLaw>(parameters);
  }
  Membrane membrane(sphere, make_elastic_law("skalak", {.shear_modulus = 1e-3, .area_ratio = 1}), viscous,
                    static_cast<int>(state.range(0)));
  const auto positions = sheared(sphere);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, sphere.points.cols());
  std::size_t step = 0;
  for ([[maybe_unused]] auto iteration : state) {
    membrane.set_positions(positions[++step % 2]);
    membrane.add_forces(force);
    benchmark::DoNotOptimize(force.data());
  }
  state.counters["triangles_per_second"] =
      benchmark::Counter(membrane.n_triangles(), benchmark::Counter::kIsIterationInvariantRate);
}

/// One add_forces() of energy terms.
void energy_terms(benchmark::State& state, const std::vector<EnergyChoice>& choices) {
  const auto sphere = icosphere(4, 19.1);
  EnergyTerms terms(sphere, choices, static_cast<int>(state.range(0)));
  const auto positions = sheared(sphere);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, sphere.points.cols());
  std::size_t step = 0;
  for ([[maybe_unused]] auto iteration : state) {
    terms.add_forces(positions[++step % 2], force);
    benchmark::DoNotOptimize(force.data());
  }
  state.counters["triangles_per_second"] = benchmark::Counter(static_cast<double>(sphere.triangles.cols()),
                                                              benchmark::Counter::kIsIterationInvariantRate);
}

const EnergyChoice bending = {"bending", {{"bending_modulus", 1e-2}, {"spontaneous_curvature", 0.1}}};
const EnergyChoice global_area = {"global-area", {{"area_modulus", 1e-2}}};
const EnergyChoice local_area = {"local-area", {{"local_area_modulus", 1e-2}}};
const EnergyChoice volume = {"volume", {{"volume_modulus", 1e-2}}};
const std::vector<EnergyChoice> all_energies = {bending, global_area, local_area, volume};

BENCHMARK_CAPTURE(membrane_step, elastic, "", 1)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(membrane_step, fd, "fd", 1)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(membrane_step, int1, "int1", 1)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(membrane_step, int2, "int2", 1)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(membrane_step, fd_every_25, "fd", 25)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(energy_terms, bending, {bending})->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(energy_terms, global_area, {global_area})->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(energy_terms, local_area, {local_area})->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(energy_terms, volume, {volume})->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(energy_terms, all, all_energies)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace tanktread::membrane

int main(int argc, char** argv) {
  return tanktread::bench::run(argc, argv);
}
