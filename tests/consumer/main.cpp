// One step of an inflated capsule in a fluid at rest, with the five installed libraries and none of the
// driver; then the surface goes to a file and back. Usage: consumer FILE.vtu
#include <algorithm>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <vector>

#include "coupler/coupler.hpp"
#include "exchange/vtk_files.hpp"
#include "fluid/lattice_boltzmann.hpp"
#include "membrane/membrane.hpp"
#include "ranks/division.hpp"

namespace {

using namespace tanktread;

constexpr int box = 24;
constexpr double radius = 5.0, stretch = 1.05;

void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

Eigen::Matrix3Xd inflated(const membrane::TriangleMesh& sphere, const Eigen::Vector3d& centre) {
  return (stretch * (sphere.points.colwise() - centre)).colwise() + centre;
}

/// Spreads the nodal forces to the fluid and goes on by one step; the highest speed.
double step_with_force(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& force) {
  const coupler::Grid grid{{box, box, box}, {true, true, true}};
  coupler::Coupler coupling(grid, coupler::kernel("cosine4"));
  const std::vector<std::span<const double>> positions = {
      {points.data(), static_cast<std::size_t>(points.size())}};
  const std::vector<std::span<const double>> forces = {
      {force.data(), static_cast<std::size_t>(force.size())}};
  coupling.build(positions);
  std::vector<double> grid_force(3 * coupling.grid_nodes().size());
  coupling.spread(forces, grid_force);

  fluid::LatticeBoltzmannSettings settings;
  settings.shape = {box, box, box};
  const auto flow = fluid::make_lattice_boltzmann(settings);
  flow->add_force(coupling.grid_nodes(), grid_force);
  return flow->step();
}

void to_file_and_back(const membrane::TriangleMesh& mesh, const char* file) {
  exchange::SurfacePacket packet;
  packet.points.assign(mesh.points.data(), mesh.points.data() + mesh.points.size());
  packet.triangles.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  exchange::write_surface(file, packet);
  require(exchange::read_surface(file).points == packet.points,
          "the file does not hold the points written to it");
}

}  // namespace

int main(int argc, char** argv) try {
  require(argc == 2, "usage: consumer FILE.vtu");
  const Eigen::Vector3d centre = Eigen::Vector3d::Constant(0.5 * box);
  const auto sphere = membrane::icosphere(2, radius, centre);
  membrane::ElasticParameters parameters;
  parameters.shear_modulus = 0.01;
  membrane::Membrane capsule(sphere, membrane::make_elastic_law("skalak", parameters));
  const Eigen::Matrix3Xd points = inflated(sphere, centre);
  capsule.set_positions(points);
  Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, capsule.n_nodes());
  capsule.add_forces(force);
  require(force.cwiseProduct(points.colwise() - centre).sum() < 0,
          "an inflated capsule does not pull inwards");

  const double speed = step_with_force(points, force);
  require(speed > 0, "the capsule does not move the fluid");
  to_file_and_back(sphere, argv[1]);
  const auto halves = ranks::least_surface({{box, box, box}}, 2);
  require(halves.block(1).begin == ranks::Triple{0, 0, box / 2}, "half of the box does not begin in the middle");
  std::printf("consumer: highest speed %.3g after one step; all as it should be\n", speed);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "consumer: error: %s\n", error.what());
  return 1;
}
