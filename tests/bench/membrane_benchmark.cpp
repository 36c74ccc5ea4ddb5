// What a step of a membrane of 1280 and of 5120 triangles costs, without and with membrane viscosity, and
// what the energies beside its elastic law add.
#include <benchmark/benchmark.h>

#include <cmath>
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

/// The sphere of a benchmark, by its second argument: 20 * 4^level triangles with edges of some 1.2.
TriangleMesh sphere_of(const benchmark::State& state) {
  const auto level = static_cast<int>(state.range(1));
  return icosphere(level, std::ldexp(19.1, level - 4));
}

/// One add_forces(), strain to nodal force. @param scheme of maxwell_schemes(), "": elastic
/// @param energies beside the elastic law
void membrane_step(benchmark::State& state, const std::string& scheme, int interval,
                   const std::vector<EnergyChoice>& energies) {
  const auto sphere = sphere_of(state);
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
  if (!energies.empty()) {
    const auto threads = static_cast<int>(state.range(0));
    membrane.set_energy_terms(std::make_unique<EnergyTerms>(sphere, energies, threads));
  }
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
  const auto sphere = sphere_of(state);
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

void on_both_meshes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"threads", "level"})->ArgsProduct({{1, 2}, {3, 4}})->UseRealTime();
}

BENCHMARK_CAPTURE(membrane_step, elastic, "", 1, {})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(membrane_step, fd, "fd", 1, {})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(membrane_step, int1, "int1", 1, {})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(membrane_step, int2, "int2", 1, {})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(membrane_step, fd_every_25, "fd", 25, {})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(membrane_step, energies, "", 1, all_energies)->Apply(on_both_meshes);
BENCHMARK_CAPTURE(energy_terms, bending, {bending})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(energy_terms, global_area, {global_area})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(energy_terms, local_area, {local_area})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(energy_terms, volume, {volume})->Apply(on_both_meshes);
BENCHMARK_CAPTURE(energy_terms, all, all_energies)->Apply(on_both_meshes);

}  // namespace
}  // namespace tanktread::membrane

int main(int argc, char** argv) {
  return tanktread::bench::run(argc, argv);
}
