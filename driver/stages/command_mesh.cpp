#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>

#include "driver/case/schema.hpp"
#include "driver/packets/surface_mesh.hpp"
#include "driver/program/commands.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/number_option.hpp"
#include "driver/program/output_file.hpp"
#include "exchange/vtk_files.hpp"
#include "membrane/revolved_mesh.hpp"

namespace tanktread::driver {
namespace {

std::string yes_or_no(bool value) {
  return value ? "yes" : "no";
}

std::string report_text(const membrane::MeshReport& report, const std::string& hash) {
  std::string text;
  text += fmt::format("nodes               {}\n", report.n_nodes);
  text += fmt::format("triangles           {}\n", report.n_triangles);
  text += fmt::format("edges               {}\n", report.n_edges);
  text += fmt::format("edge length         {:.6g} to {:.6g}, mean {:.6g}\n", report.edge_min, report.edge_max,
                      report.edge_mean);
  text += fmt::format("area                {:.10g}\n", report.area);
  text += fmt::format("volume              {:.10g}\n", report.volume);
  text += fmt::format("centre              {:.6g}, {:.6g}, {:.6g}\n", report.centre[0], report.centre[1],
                      report.centre[2]);
  text += fmt::format("closed              {}\n", yes_or_no(report.closed));
  text += fmt::format("winding consistent  {}, outward {}\n", yes_or_no(report.consistent_winding),
                      yes_or_no(report.outward));
  text += fmt::format("Euler number        {}\n", report.euler_characteristic);
  text += fmt::format("parts               {}\n", report.parts.size());
  for (std::size_t k = 0; k < report.parts.size() && report.parts.size() > 1; ++k) {
    const auto& part = report.parts[k];
    text += fmt::format("  part {:<12} {} triangles, volume {:.6g}, Euler number {}\n", k, part.n_triangles,
                        part.volume, part.euler_characteristic);
  }
  text += fmt::format("hash                {}\n", hash);
  return text;
}

/// What the commands that write a shape have in common.
struct ShapeArguments {
  int level = 3;
  double radius = 1;
  std::array<double, 3> centre = {0, 0, 0};
  double aspect_ratio = 0, reduced_volume = 0;  ///< of a spheroid; 0: not given
  std::string file;
};

void write_shape(const ShapeArguments& arguments, const membrane::TriangleMesh& shape) {
  try {
    exchange::write_surface(arguments.file, surface_packet(shape));
  } catch (const exchange::FileError& error) {
    throw InputError(error.what());
  }
  fmt::print("{}: {} nodes, {} triangles\n", arguments.file, shape.points.cols(), shape.triangles.cols());
}

/// A subcommand `mesh NAME` that writes the shape that `make` makes of the arguments.
template <class Make>
CLI::App& add_shape_command(CLI::App& mesh, int& exit_code, const std::string& name,
                            const std::string& description, const std::string& meaning_of_radius,
                            const std::shared_ptr<ShapeArguments>& arguments, Make make) {
  auto* command = mesh.add_subcommand(name, description);
  add_number(*command, "--level", arguments->level, "Subdivisions of the icosahedron",
             find_key("capsule.N.mesh.level")->range)
      ->capture_default_str();
  add_number(*command, "--radius", arguments->radius, meaning_of_radius, positive())->capture_default_str();
  add_number(*command, "--centre", arguments->centre, "Centre x y z, grid steps", {})->capture_default_str();
  command->add_option("file", arguments->file, "File to write (.vtu)")->required();
  command->callback([=, &exit_code] {
    check_output({"mesh " + name, arguments->file}, surface_output());
    write_shape(*arguments, make(*arguments));
    exit_code = 0;
  });
  return *command;
}

constexpr const char* radius_of_equal_volume = "Radius of the sphere of equal volume, grid steps";

membrane::TriangleMesh revolved(const membrane::Meridian& meridian, const ShapeArguments& arguments) {
  auto mesh = membrane::revolved_mesh(meridian, arguments.level);
  mesh.points.colwise() += Eigen::Map<const Eigen::Vector3d>(arguments.centre.data());
  return mesh;
}

void add_sphere_command(CLI::App& mesh, int& exit_code) {
  add_shape_command(
      mesh, exit_code, "sphere", "Write a sphere of 20 * 4^level triangles", "Radius, grid steps",
      std::make_shared<ShapeArguments>(), [](const ShapeArguments& arguments) {
        const auto& centre = arguments.centre;
        return membrane::icosphere(arguments.level, arguments.radius, {centre[0], centre[1], centre[2]});
      });
}

void add_biconcave_command(CLI::App& mesh, int& exit_code) {
  add_shape_command(mesh, exit_code, "biconcave",
                    "Write the red cell at rest, its axis along z, of the triangles of a sphere",
                    radius_of_equal_volume, std::make_shared<ShapeArguments>(),
                    [](const ShapeArguments& arguments) {
                      return revolved(membrane::biconcave_meridian(arguments.radius), arguments);
                    });
}

void add_spheroid_command(CLI::App& mesh, int& exit_code) {
  const auto arguments = std::make_shared<ShapeArguments>();
  auto& command = add_shape_command(
      mesh, exit_code, "spheroid", "Write a spheroid, its axis along z, of the triangles of a sphere",
      radius_of_equal_volume, arguments, [](const ShapeArguments& given) {
        if (given.aspect_ratio == 0 && given.reduced_volume == 0)
          throw InputError("mesh spheroid: give --aspect-ratio or --reduced-volume");
        const double aspect_ratio =
            given.aspect_ratio > 0
                ? given.aspect_ratio
                : membrane::spheroid_aspect_ratio(given.reduced_volume, membrane::Spheroid::oblate);
        return revolved(membrane::spheroid_meridian(given.radius, aspect_ratio), given);
      });
  auto* ratio = add_number(command, "--aspect-ratio", arguments->aspect_ratio, "Its axis over its diameter",
                           find_key("capsule.N.mesh.aspect_ratio")->range);
  add_number(command, "--reduced-volume", arguments->reduced_volume,
             "Of an oblate one, its volume over that of the sphere of its area",
             find_key("capsule.N.mesh.reduced_volume")->range)
      ->excludes(ratio);
}

void add_info_command(CLI::App& mesh, int& exit_code) {
  auto* command = mesh.add_subcommand("info", "Say what a surface is like, and whether it can be a membrane");
  auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "Surface of triangles (.vtu, or .pvtu in pieces)")->required();
  command->callback([=, &exit_code] {
    try {
      const auto packet = exchange::read_surface(*file, true);
      const auto report = inspected(to_mesh(packet), *file);
      fmt::print("{}", report_text(report, geometry_hash(packet)));
      require_no_defects(report, *file);
    } catch (const exchange::FileError& error) {
      throw InputError(error.what());
    }
    fmt::print("a membrane can be made of it\n");
    exit_code = 0;
  });
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto* mesh = app.add_subcommand("mesh", "Make and inspect membrane meshes");
  mesh->require_subcommand(1);
  add_sphere_command(*mesh, exit_code);
  add_biconcave_command(*mesh, exit_code);
  add_spheroid_command(*mesh, exit_code);
  add_info_command(*mesh, exit_code);
}

}  // namespace tanktread::driver
