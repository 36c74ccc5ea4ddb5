#include "driver/plan/shape_numbers.hpp"

#include "membrane/meridian.hpp"

namespace tanktread::driver {
namespace {

double reduced_volume_of(const membrane::MeshReport& report) {
  return membrane::reduced_volume(report.volume, report.area);
}

}  // namespace

ShapeNumbers shape_numbers(const CapsuleShape& shape) {
  const auto start = membrane::inspect(shape.mesh);
  return {start.edge_mean, start.area, reduced_volume_of(start),
          reduced_volume_of(membrane::inspect({shape.stress_free, shape.mesh.triangles}))};
}

}  // namespace tanktread::driver
