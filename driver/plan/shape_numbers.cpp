#include "driver/plan/shape_numbers.hpp"

#include "membrane/meridian.hpp"

namespace tanktread::driver {
namespace {

double reduced_volume_of(const membrane::MeshReport& report) {
  return membrane::reduced_volume(report.volume, report.area);
}

}  // namespace

std::vector<ShapeNumbers> shape_numbers(const MembraneShapes& shapes) {
  std::vector<ShapeNumbers> all;
  for (std::size_t k = 0; k < shapes.meshes.size(); ++k) {
    const auto start = membrane::inspect(shapes.meshes[k]);
    all.push_back({start.edge_mean, start.area, reduced_volume_of(start),
                   reduced_volume_of(membrane::inspect(shapes.reference(k)))});
  }
  return all;
}

}  // namespace tanktread::driver
