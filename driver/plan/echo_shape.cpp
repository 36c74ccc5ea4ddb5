#include "driver/plan/echo_shape.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <numbers>

#include "driver/case/case_geometry.hpp"

namespace tanktread::driver {
namespace {

double square_metre(const SiScales& si) {
  return si.length_m * si.length_m;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void put_mesh(EchoTable& table, const MeshCase& mesh) {
  if (mesh.file.empty()) {
    table.row("mesh", fmt::format("{}, level {}", mesh.shape, mesh.level), "",
              fmt::format("{} triangles", 20 << (2 * mesh.level)));
  } else {
    table.row("mesh", file_name(mesh.file));
  }
  const auto put_three = [&](const char* name, const std::optional<std::array<double, 3>>& values,
                             const char* note) {
    if (!values) return;
    table.row(name, fmt::format("{:.6g}, {:.6g}, {:.6g}", (*values)[0], (*values)[1], (*values)[2]), "",
              note);
  };
  put_three("axis along", mesh.direction, "its z, by the shortest turn");
  put_three("Euler angles", mesh.euler_angles, "degrees; about z, the new x, the new z");
}

}  // namespace

void put_shape(EchoTable& table, const Subject& subject, std::size_t number_of_it,
               const ShapeNumbers& numbers) {
  const auto& capsule = subject.the_case.capsules[number_of_it];
  put_mesh(table, capsule.mesh);
  table.row("mean mesh edge", fmt::format("{:.4g}", numbers.mean_edge),
            in_si(subject, numbers.mean_edge, metre, "m"), "grid steps; 0.5 to 2 is good",
            numbers.mean_edge > 0);
  const double sphere = 4 * std::numbers::pi * capsule.radius * capsule.radius;
  table.row("membrane area", number(numbers.area), in_si(subject, numbers.area, square_metre, "m^2"),
            fmt::format("{:.4g} of 4 pi a^2", numbers.area / sphere), numbers.area > 0);
  table.row("reduced volume", fmt::format("{:.4f}", numbers.reduced_volume), "",
            "V/(4 pi/3 (A/(4 pi))^(3/2))", numbers.reduced_volume > 0);
  const auto& stress_free = capsule.stress_free;
  table.row("stress-free shape", stress_free.file.empty() ? stress_free.shape : file_name(stress_free.file),
            "",
            numbers.stress_free_reduced_volume > 0
                ? fmt::format("reduced volume {:.4f}, of equal area", numbers.stress_free_reduced_volume)
                : "",
            has_own_stress_free_shape(capsule));
}

}  // namespace tanktread::driver
