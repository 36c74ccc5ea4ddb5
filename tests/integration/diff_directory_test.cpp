// `tanktread diff` on directories and series, and on what cannot be compared.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/grid_pieces.hpp"
#include "exchange/surface_pieces.hpp"
#include "tests/integration/diff_fixture.hpp"

namespace tanktread::testing {
namespace {

using namespace tanktread::exchange;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(Diff, ComparesDirectories) {
  put_output("a");
  put_output("b");
  put("a/.lock", "one");
  put("b/.lock", "two");
  put("b/membrane/.m_1.vtu.1-2.tmp", "half");
  put("b/.hidden/file", "x");
  const auto ended = diff("a", "b");
  EXPECT_EQ(ended.exit_code, 0);
  // Tetrahedron 5, grid 5, columns 2, times 1.
  EXPECT_EQ(ended.output, "identical: 5 files, 13 arrays\n");
}

TEST_F(Diff, SaysWhichFilesOfDirectoriesDiffer) {
  put_output("a");
  put_output("b");
  put("a/membrane/m_1.vtu", "not looked at");
  put("b/progress.log", "x");
  put("b/echo.toml", "title = \"a\"\n[fluid]\n");
  put("b/observables.csv", "step,x\n0,0.5\n1,0.5\n");
  const auto ended = diff("a", "b");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.output,
            "echo.toml: 19 bytes against 20; first difference at byte 15, in line 2\n"
            "membrane/m_1.vtu: only in the first\n"
            "observables.csv: column x: max 0.25, rms 0.176777, 1 of 2 values; largest at row 2; first at "
            "row 2: 0.25 "
            "against 0.5\n"
            "progress.log: only in the second\n"
            "different: 1 of 13 arrays, 4 of 7 files\n");
  EXPECT_EQ(diff("a", "b",
                 {"--ignore", "echo.toml", "--ignore", "x", "--ignore", "membrane/m_1.vtu", "--ignore",
                  "progress.log"})
                .output,
            "identical: 4 files, 12 arrays, 4 ignored\n");
  EXPECT_EQ(diff("a", "b", {"--ignore", "m_1.vtu"}).exit_code, 1) << "a name without its folder, but not all";
}

TEST_F(Diff, ComparesSeriesAndTheirFiles) {
  put_output("a");
  put_output("b");
  EXPECT_EQ(diff("a/membrane.pvd", "b/membrane.pvd").output, "identical: 2 files, 6 arrays\n");
  auto packet = tetrahedron();
  packet.cell_data[0].values[3] = 0;
  write_surface(directory_ / "b/membrane/m_0.vtu", packet);
  write_series(directory_ / "b/membrane.pvd", {{0.75, "membrane/m_0.vtu"}, {1, "membrane/m_1.vtu"}});
  const auto ended = diff("a/membrane.pvd", "b/membrane.pvd");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(
      ended.output,
      AllOf(
          HasSubstr("membrane.pvd: an entry only in the second: 'membrane/m_1.vtu'\n"),
          HasSubstr(
              "series times: max 0.25, rms 0.25, 1 of 1 values; largest at entry 0 (membrane/m_0.vtu); first "
              "at entry 0 (membrane/m_0.vtu): 0.5 against 0.75\n"),
          HasSubstr("\nmembrane/m_0.vtu: cell data area_ratio: max 2.5, "),
          HasSubstr("\nmembrane/m_1.vtu: only in the second\n"),
          HasSubstr("different: 2 of 6 arrays, 3 of 3 files")));
}

/// small_grid() in two pieces that share the middle layer along y, "fluid.pvti" in that directory.
void put_pieces(const std::filesystem::path& directory, double density) {
  auto piece = small_grid();
  piece.nodes = {2, 2, 2};
  piece.point_data[0].values.assign(8, density);
  piece.point_data[1].values.resize(24);
  GridIndex index{
      {{0, 0, 0}, {2, 3, 2}}, piece.origin, piece.spacing, {{"density", 1}, {"velocity", 3}}, {}, {}};
  std::filesystem::create_directories(directory / "fluid");
  for (int k = 0; k < 2; ++k) {
    piece.begin = {0, k, 0};
    index.pieces.push_back({"fluid/" + std::to_string(k) + ".vti", {piece.begin, piece.nodes}});
    write_grid(directory / index.pieces.back().file, piece);
  }
  write_grid_index(directory / "fluid.pvti", index);
}

TEST_F(Diff, AGridInPiecesIsTheGridThatTheyMake) {
  for (const auto* name : {"a", "b"}) {
    put_output(name);
    write_series(directory_ / name / "fluid.pvd",
                 {{1, std::string("fluid.") + (*name == 'a' ? "vti" : "pvti")}});
  }
  std::filesystem::remove(directory_ / "b/fluid.vti");
  put_pieces(directory_ / "b", 1);
  EXPECT_EQ(diff("a", "b").output, "identical: 6 files, 14 arrays\n");
  EXPECT_EQ(diff("b", "a").exit_code, 0);
  EXPECT_EQ(diff("a/fluid.vti", "b/fluid.pvti").output, "identical: 1 file, 5 arrays\n");
  EXPECT_EQ(diff("a/fluid.pvd", "b/fluid.pvd").exit_code, 0);
  put_pieces(directory_ / "b", 2);
  const auto ended = diff("a", "b");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("fluid.vti: point data density: max 1, rms 1, 12 of 12 values"));
  std::filesystem::remove(directory_ / "b/fluid/1.vti");
  const auto broken = diff("a", "b");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.output, HasSubstr("fluid/1.vti: no such file, a piece of "));
}

/// Two tetrahedra in one surface, each a capsule, or in pieces, "membrane/m_0.pvtu" in that directory.
void put_tetrahedra(const std::filesystem::path& directory, bool in_pieces, double area_ratio) {
  auto whole = tetrahedron(), second = tetrahedron();
  second.cell_data[0].values[3] = area_ratio;
  second.field_data.push_back({"history_1", 1, {3}});
  std::filesystem::create_directories(directory / "membrane/m_0");
  if (in_pieces) {
    write_surface(directory / "membrane/m_0/0.vtu", whole);
    write_surface(directory / "membrane/m_0/1.vtu", second);
    return write_surface_index(
        directory / "membrane/m_0.pvtu",
        {{{"velocity", 3}}, {{"area_ratio", 1}}, whole.field_data, {"m_0/0.vtu", "m_0/1.vtu"}});
  }
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(whole.points, second.points);
  for (const auto corner : second.triangles) whole.triangles.push_back(4 + corner);
  append(whole.point_data[0].values, second.point_data[0].values);
  append(whole.cell_data[0].values, second.cell_data[0].values);
  whole.field_data.push_back(second.field_data[1]);
  write_surface(directory / "membrane/m_0.vtu", whole);
}

TEST_F(Diff, ASurfaceInPiecesIsTheSurfaceThatTheyMake) {
  for (const std::string name : {"a", "b"}) {
    put_output(name);
    std::filesystem::remove(directory_ / name / "membrane/m_0.vtu");
    put_tetrahedra(directory_ / name, name == "b", 2.5);
    write_series(directory_ / name / "membrane.pvd",
                 {{0.5, std::string("membrane/m_0.") + (name == "b" ? "pvtu" : "vtu")}});
  }
  EXPECT_EQ(diff("a", "b").output, "identical: 5 files, 14 arrays\n");
  EXPECT_EQ(diff("b", "a").exit_code, 0);
  EXPECT_EQ(diff("a/membrane/m_0.vtu", "b/membrane/m_0.pvtu").output, "identical: 1 file, 6 arrays\n");
  EXPECT_EQ(diff("a/membrane.pvd", "b/membrane.pvd").exit_code, 0);
  put_tetrahedra(directory_ / "b", true, 3.5);
  const auto ended = diff("a", "b");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("membrane/m_0.vtu: cell data area_ratio: max 1, rms 0.353553, 1 of 8 "
                                      "values; largest at value 7 (triangle 7)"));
  put_tetrahedra(directory_ / "b", false, 2.5);
  EXPECT_THAT(diff("a", "b").output, HasSubstr("membrane/m_0.pvtu: only in the second\n"
                                               "different: 0 of 14 arrays, 1 of 6 files"));
  std::filesystem::remove(directory_ / "b/membrane/m_0.vtu");
  std::filesystem::remove(directory_ / "b/membrane/m_0/1.vtu");
  const auto broken = diff("a", "b");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_THAT(broken.output, HasSubstr("m_0/1.vtu: no such file, a piece of "));
}

TEST_F(Diff, SeesTheOrderOfASeries) {
  write_series(directory_ / "a.pvd", {{1, "x.vtu"}, {2, "y.vtu"}});
  write_series(directory_ / "b.pvd", {{2, "y.vtu"}, {1, "x.vtu"}});
  const auto ended = diff("a.pvd", "b.pvd", {"--ignore", "x.vtu", "--ignore", "y.vtu"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("stand in another order"));
}

TEST_F(Diff, LooksOnceAtAFileThatASeriesNamesAgain) {
  put_output("a");
  put_output("b");
  for (const char* name : {"a", "b"})
    write_series(directory_ / name / "membrane.pvd", {{0.5, "membrane/m_0.vtu"}, {1, "membrane/m_0.vtu"}});
  EXPECT_EQ(diff("a/membrane.pvd", "b/membrane.pvd").output, "identical: 2 files, 6 arrays\n");
  write_series(directory_ / "b/membrane.pvd", {{0.5, "membrane/m_0.vtu"}});
  const auto ended = diff("a/membrane.pvd", "b/membrane.pvd");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("one of them at more times in one than in the other"));
}

TEST_F(Diff, RefusesWhatCannotBeCompared) {
  write_surface(directory_ / "a.vtu", tetrahedron());
  write_grid(directory_ / "a.vti", small_grid());
  put("folder/x", "");
  const auto expect_refused = [&](const Ended& ended, const std::string& words) {
    EXPECT_EQ(ended.exit_code, 2) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(words));
  };
  expect_refused(diff("a.vtu", "none.vtu"), "none.vtu: no such file or directory");
  expect_refused(diff("a.vtu", "a.vti"), "files of two kinds");
  expect_refused(diff("folder", "a.vti"), "folder: is a directory and ");
  expect_refused(diff("a.vti", "folder"), "folder: is a directory and ");
  expect_refused(diff("a.vtu", "a.vtu", {"--tolerance", "-1"}), "--tolerance -1");
  expect_refused(diff("a.vtu", "a.vtu", {"--tolerance", "nan"}), "--tolerance nan");
  put("broken.vtu", "no VTK file");
  expect_refused(diff("a.vtu", "broken.vtu"), "broken.vtu: does not end with");
  write_series(directory_ / "a.pvd", {{1, "gone.vtu"}});
  expect_refused(diff("a.pvd", "a.pvd"), "gone.vtu: no such file");
  expect_refused(run_program({"diff", path("a.vtu")}), "second");
}

TEST_F(Diff, NoticesAFileThatWasDamaged) {
  write_surface(directory_ / "a.vtu", tetrahedron());
  auto text = read_file(directory_ / "a.vtu");
  const double value = 2.5;  // the last of the cell data
  const auto place = text.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(place, std::string::npos);
  text[place] ^= 1;
  put("b.vtu", text);
  const auto ended = diff("a.vtu", "b.vtu");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.output, HasSubstr("b.vtu: the contents are not those that were written"));
}

}  // namespace
}  // namespace tanktread::testing
