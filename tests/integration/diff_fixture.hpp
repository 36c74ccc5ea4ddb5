// What the tests of `tanktread diff` share: small packets, and a directory to write them to and compare them
// in.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "exchange/vtk_files.hpp"
#include "tests/integration/program.hpp"

namespace tanktread::testing {

inline exchange::SurfacePacket tetrahedron() {
  exchange::SurfacePacket packet;
  packet.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0.25, 2};
  packet.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  packet.point_data = {{"velocity", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}};
  packet.cell_data = {{"area_ratio", 1, {1, 1.5, 2, 2.5}}};
  packet.field_data = {{"step", 1, {7}}};
  return packet;
}

inline exchange::GridPacket small_grid() {
  exchange::GridPacket packet;
  packet.nodes = {2, 3, 2};
  packet.point_data = {{"density", 1, std::vector<double>(12, 1.0)},
                       {"velocity", 3, std::vector<double>(36, 0.125)}};
  return packet;
}

class Diff : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  Ended diff(const std::string& a, const std::string& b, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"diff", path(a), path(b)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }
  void put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((directory_ / name).parent_path());
    std::ofstream(directory_ / name) << text;
  }
  /// The exit code and output for two surfaces, the second of them changed.
  Ended diff_surfaces(void (*change)(exchange::SurfacePacket&),
                      const std::vector<std::string>& more = {}) const {
    auto packet = tetrahedron();
    exchange::write_surface(directory_ / "a.vtu", packet);
    change(packet);
    exchange::write_surface(directory_ / "b.vtu", packet);
    return diff("a.vtu", "b.vtu", more);
  }
  Ended diff_tables(const std::string& a, const std::string& b,
                    const std::vector<std::string>& more = {}) const {
    put("a.csv", a);
    put("b.csv", b);
    return diff("a.csv", "b.csv", more);
  }
  /// A directory as a run leaves it.
  void put_output(const std::string& name) const {
    put(name + "/echo.toml", "title = \"a\"\n[flow]\n");
    put(name + "/observables.csv", "step,x\n0,0.5\n1,0.25\n");
    std::filesystem::create_directories(directory_ / name / "membrane");
    exchange::write_surface(directory_ / name / "membrane/m_0.vtu", tetrahedron());
    exchange::write_grid(directory_ / name / "fluid.vti", small_grid());
    exchange::write_series(directory_ / name / "membrane.pvd", {{0.5, "membrane/m_0.vtu"}});
  }
  const TemporaryDirectory directory_;
};

}  // namespace tanktread::testing
