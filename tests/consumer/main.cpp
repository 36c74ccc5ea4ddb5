// One step of a capsule at rest, with the four installed libraries and none of the driver.
#include <coupler/coupler.hpp>
#include <cstdio>
#include <exchange/packet.hpp>
#include <fluid/lattice_boltzmann.hpp>
#include <membrane/membrane.hpp>

int main() {
  using namespace tanktread;
  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {24, 24, 24};
  const auto flow = fluid::make_lattice_boltzmann(settings);
  const auto sphere = membrane::icosphere(2, 5.0, {12, 12, 12});
  membrane::ElasticParameters parameters;
  parameters.shear_modulus = 0.01;
  membrane::Membrane capsule(sphere, membrane::make_elastic_law("skalak", parameters));
  coupler::Coupler coupling({{24, 24, 24}, {true, true, true}}, coupler::kernel("cosine4"));

  const Eigen::Matrix3Xd stretched = (1.05 * (sphere.points.colwise() - Eigen::Vector3d(12, 12, 12))).colwise() + Eigen::Vector3d(12, 12, 12);
  capsule.set_positions(stretched);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, capsule.n_nodes());
  capsule.add_forces(force);
  const std::vector<std::span<const double>> positions = {{stretched.data(), static_cast<std::size_t>(stretched.size())}};
  const std::vector<std::span<const double>> forces = {{force.data(), static_cast<std::size_t>(force.size())}};
  coupling.build(positions);
  std::vector<double> grid_force(3 * coupling.grid_nodes().size());
  coupling.spread(forces, grid_force);
  flow->add_force(coupling.grid_nodes(), grid_force);
  const double speed = flow->step();

  const exchange::Array array{"speed", 1, {speed}};
  const bool moved = exchange::find_array({array}, "speed", "consumer").values[0] > 0.0;
  std::printf("consumer: highest speed %.3g: %s\n", speed, moved ? "as it should be" : "the capsule did not pull");
  return moved ? 0 : 1;
}
