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

void add_sphere_command(CLI::App& mesh, int& exit_code) {
  struct Arguments {
    int level = 3;
    double radius = 1;
    std::array<double, 3> centre = {0, 0, 0};
    std::string file;
  };
  auto* command = mesh.add_subcommand("sphere", "Write a sphere of 20 * 4^level triangles");
  auto arguments = std::make_shared<Arguments>();
  add_number(*command, "--level", arguments->level, "Subdivisions of the icosahedron",
             find_key("capsule.N.mesh.level")->range)
      ->capture_default_str();
  add_number(*command, "--radius", arguments->radius, "Radius, grid steps", positive())
      ->capture_default_str();
  add_number(*command, "--centre", arguments->centre, "Centre x y z, grid steps", {})->capture_default_str();
  command->add_option("file", arguments->file, "File to write (.vtu)")->required();
  command->callback([=, &exit_code] {
    check_output({"mesh sphere", arguments->file}, surface_output());
    const auto& centre = arguments->centre;
    const auto sphere =
        membrane::icosphere(arguments->level, arguments->radius, {centre[0], centre[1], centre[2]});
    try {
      exchange::write_surface(arguments->file, surface_packet(sphere));
    } catch (const exchange::FileError& error) {
      throw InputError(error.what());
    }
    fmt::print("{}: {} nodes, {} triangles\n", arguments->file, sphere.points.cols(),
               sphere.triangles.cols());
    exit_code = 0;
  });
}

void add_info_command(CLI::App& mesh, int& exit_code) {
  auto* command = mesh.add_subcommand("info", "Say what a surface is like, and whether it can be a membrane");
  auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "Surface of triangles (.vtu)")->required();
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
  add_info_command(*mesh, exit_code);
}

}  // namespace tanktread::driver
