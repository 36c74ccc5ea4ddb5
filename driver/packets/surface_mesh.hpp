// Membrane meshes to and from the packets of files.
#pragma once

#include <string>

#include "exchange/packet.hpp"
#include "membrane/mesh.hpp"

namespace tanktread::driver {

exchange::SurfacePacket surface_packet(const membrane::TriangleMesh& mesh);
membrane::TriangleMesh to_mesh(const exchange::SurfacePacket& packet);

/// A hash of the points and triangles of a surface, without its arrays: 16 hexadecimal digits. What a reader
/// gives counts and not the file's bytes, so that the same shape written anew (another encoding, single
/// precision widened) is the same. By exchange::content_hash.
std::string geometry_hash(const exchange::SurfacePacket& packet);

/// membrane::inspect, whose refusals name the file. @throws InputError
membrane::MeshReport inspected(const membrane::TriangleMesh& mesh, const std::string& file);

/// Refuses a mesh that cannot be a membrane. @throws InputError with every defect, each with the name of the
/// file
void require_no_defects(const membrane::MeshReport& report, const std::string& file);

/// 3 n numbers, component fastest, as a matrix with a column a node.
Eigen::Matrix3Xd to_matrix(const std::vector<double>& values);
std::vector<double> to_values(const Eigen::Matrix3Xd& matrix);

}  // namespace tanktread::driver
