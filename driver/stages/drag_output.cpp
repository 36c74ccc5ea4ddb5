#include "driver/stages/drag_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "driver/system/membrane_files.hpp"
#include "exchange/atomic_file.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/orientation.hpp"
#include "membrane/shape.hpp"

namespace tanktread::driver {
namespace {

std::string file_of(std::int64_t step) {
  return fmt::format("membrane/membrane_{:010}.vtu", step);
}

}  // namespace

DragOutput::DragOutput(std::filesystem::path directory, const Case& the_case, const Parameters& parameters,
                       const std::vector<membrane::TriangleMesh>& starts)
    : directory_(std::move(directory)), case_(the_case), parameters_(parameters), starts_(starts) {}

void DragOutput::begin() const {
  std::filesystem::create_directories(directory_ / "membrane");
  exchange::write_series(directory_ / "membrane.pvd", {});
  exchange::write_text(directory_ / "drag.csv",
                       "step,shear_time,capsule,axial_diameter,transverse_diameter,volume_ratio,area_ratio,"
                       "elastic_energy,load_power,speed\n");
}

void DragOutput::add_row(const DragMotion& motion, std::int64_t step) const {
  std::string rows;
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const auto& membrane = motion.membranes()[k];
    const auto& points = membrane.positions();
    const auto& start = starts_[k];
    const auto& capsule = case_.capsules[k];
    const auto& direction = capsule.load.direction;
    const auto along = Eigen::Vector3d(direction[0], direction[1], direction[2]).stableNormalized();
    const auto volume = [&](const Eigen::Matrix3Xd& of) {
      return membrane::volume_moments(of, start.triangles).volume;
    };
    const auto area = [&](const Eigen::Matrix3Xd& of) { return membrane::surface_area(of, start.triangles); };
    rows += fmt::format("{},{:.17g},{}", step, shear_time(step), k);
    for (const double value :
         {membrane::extent_along(points, along) / (2 * capsule.radius),
          membrane::largest_extent_across(points, along) / (2 * capsule.radius),
          volume(points) / volume(start.points), area(points) / area(start.points), membrane.elastic_energy(),
          membrane.load_at(step).cwiseProduct(motion.velocity()[k]).sum(), speed_of(motion, k)})
      rows += fmt::format(",{:.17g}", value);
    rows += "\n";
  }
  exchange::append_text(directory_ / "drag.csv", rows);
}

DragOutput::State DragOutput::state_of(const DragMotion& motion, std::int64_t step) const {
  return {membrane_file(motion.membranes(), motion.velocity(), motion.force(), step, shear_time(step)), step};
}

void DragOutput::write(const State& state) {
  const auto file = file_of(state.step);
  exchange::write_surface(directory_ / file, state.surface);
  exchange::append_to_series(directory_ / "membrane.pvd", {shear_time(state.step), file});
  last_written_ = state.step;
}

void DragOutput::add_file(const DragMotion& motion, std::int64_t step) {
  write(state_of(motion, step));
}

void DragOutput::remember(const DragMotion& motion, std::int64_t step) {
  remembered_ = state_of(motion, step);
}

std::filesystem::path DragOutput::keep_remembered() {
  if (!remembered_) return {};
  if (remembered_->step != last_written_) write(*remembered_);
  return directory_ / file_of(remembered_->step);
}

double DragOutput::speed_of(const DragMotion& motion, std::size_t k) const {
  return std::sqrt(motion.velocity()[k].colwise().squaredNorm().maxCoeff()) /
         (parameters_.shear_rate * case_.capsules[k].radius);
}

double DragOutput::speed(const DragMotion& motion) const {
  double largest = 0;
  for (std::size_t k = 0; k < starts_.size(); ++k) largest = std::max(largest, speed_of(motion, k));
  return largest;
}

}  // namespace tanktread::driver
