#include "driver/study/study_noise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/coupler.hpp"
#include "driver/study/study_check.hpp"

namespace tanktread::driver {
namespace {

void require_valid(const NoiseStudy& study) {
  require(study.nodes >= 1 && study.nodes <= NoiseStudy::most_nodes,
          fmt::format("nodes is {}, must be 1 to {}", study.nodes, NoiseStudy::most_nodes));
  require_positive("time step", study.time_step);
  require(study.n_positions >= 2 && study.n_positions <= NoiseStudy::most_positions,
          fmt::format("positions is {}, must be 2 to {}", study.n_positions, NoiseStudy::most_positions));
  require_positive("stream function", study.stream_function);
  require_positive("start height", study.start_height);
  require(std::isfinite(study.velocity_error),
          fmt::format("velocity error is {}, must be finite", study.velocity_error));
}

Eigen::Matrix2Xd velocities(const NoiseStudy& study, const Eigen::Matrix2Xd& positions) {
  Eigen::Matrix2Xd result(2, positions.cols());
  for (Eigen::Index k = 0; k < positions.cols(); ++k)
    result.col(k) = interpolated_velocity(study, positions.col(k));
  return result;
}

/// Eq. 2.41.
double strain_rate(const Eigen::Vector2d& velocity_change, const Eigen::Vector2d& displacement) {
  return velocity_change.dot(displacement) / displacement.squaredNorm();
}

/// Eq. 2.42.
double relative_error(const Eigen::Matrix2Xd& positions, const Eigen::Matrix2Xd& interpolated, int interval) {
  double error = 0, norm = 0;
  for (Eigen::Index k = interval; k < positions.cols(); ++k) {
    const Eigen::Vector2d displacement = positions.col(k) - positions.col(k - interval);
    const double exact =
        strain_rate(corner_flow(positions.col(k)) - corner_flow(positions.col(k - interval)), displacement);
    const double ours = strain_rate(interpolated.col(k) - interpolated.col(k - interval), displacement);
    error += std::pow(ours - exact, 2);
    norm += exact * exact;
  }
  return std::sqrt(error / norm);
}

}  // namespace

Eigen::Vector2d corner_flow(const Eigen::Vector2d& position) {
  const double x = position.x(), y = position.y();
  return {3.0 * (x * x - y * y), -6.0 * x * y};
}

Eigen::Matrix2Xd streamline_positions(const NoiseStudy& study) {
  require_valid(study);
  Eigen::Matrix2Xd positions(2, study.n_positions);
  double y = study.start_height;
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const double x = std::sqrt((study.stream_function + y * y * y) / (3.0 * y));
    positions.col(k) << x, y;
    y += study.time_step * corner_flow(positions.col(k)).y();
    require(y > 0, "the time step is too long: the point leaves the corner; make it smaller");
  }
  return positions;
}

Eigen::Vector2d interpolated_velocity(const NoiseStudy& study, const Eigen::Vector2d& position) {
  const coupler::Kernel& kernel = coupler::kernel(study.kernel);
  const Eigen::Vector2d in_steps = position * study.nodes;
  const int reach = static_cast<int>(std::ceil(kernel.half_width));
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const Eigen::Vector2d node = in_steps.array().floor() + Eigen::Array2d(i, j);
      const Eigen::Vector2d distance = node - in_steps;
      const double weight = kernel.function(distance.x()) * kernel.function(distance.y());
      velocity += weight * (1.0 + study.velocity_error) * corner_flow(node / study.nodes);
    }
  }
  return velocity;
}

double strain_rate_error(const NoiseStudy& study, int interval) {
  const Eigen::Matrix2Xd positions = streamline_positions(study);
  require(interval >= 1 && interval < study.n_positions,
          fmt::format("interval is {}, must be 1 to {}", interval, study.n_positions - 1));
  return relative_error(positions, velocities(study, positions), interval);
}

std::string noise_table(const NoiseStudy& study, const std::vector<int>& intervals) {
  std::string table = "kernel,nodes,velocity_error,N,l2_error\n";
  for (const int interval : intervals) {
    table += fmt::format("{},{},{},{},{:.6g}\n", study.kernel, study.nodes, study.velocity_error, interval,
                         strain_rate_error(study, interval));
  }
  return table;
}

}  // namespace tanktread::driver
