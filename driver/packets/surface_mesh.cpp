#include "driver/packets/surface_mesh.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "driver/program/errors.hpp"
#include "exchange/content_hash.hpp"

namespace tanktread::driver {

exchange::SurfacePacket surface_packet(const membrane::TriangleMesh& mesh) {
  exchange::SurfacePacket packet;
  packet.points = to_values(mesh.points);
  packet.triangles.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  return packet;
}

membrane::TriangleMesh to_mesh(const exchange::SurfacePacket& packet) {
  using Indices = Eigen::Matrix<std::int64_t, 3, Eigen::Dynamic>;
  const auto n_triangles = static_cast<Eigen::Index>(packet.triangles.size() / 3);
  return {to_matrix(packet.points),
          Eigen::Map<const Indices>(packet.triangles.data(), 3, n_triangles).cast<int>()};
}

std::string geometry_hash(const exchange::SurfacePacket& packet) {
  exchange::SurfacePacket geometry;
  geometry.points = packet.points;
  geometry.triangles = packet.triangles;
  return fmt::format("{:016x}", exchange::content_hash(geometry));
}

membrane::MeshReport inspected(const membrane::TriangleMesh& mesh, const std::string& file) {
  try {
    return membrane::inspect(mesh);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

void require_no_defects(const membrane::MeshReport& report, const std::string& file) {
  std::string message;
  for (const auto& defect : membrane::defects(report)) {
    message += fmt::format("{}{}: {}", message.empty() ? "" : "\n", file, defect);
  }
  if (message.empty()) return;
  if (report.closed && report.parts.size() > 1) {
    message += fmt::format(
        "\n{}: python3 -m tanktread_post convert-surface IN OUT --body N writes part N of 0 to {}", file,
        report.parts.size() - 1);
  }
  throw InputError(message);
}

Eigen::Matrix3Xd to_matrix(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::Matrix3Xd>(values.data(), 3, static_cast<Eigen::Index>(values.size() / 3));
}

std::vector<double> to_values(const Eigen::Matrix3Xd& matrix) {
  return {matrix.data(), matrix.data() + matrix.size()};
}

}  // namespace tanktread::driver
