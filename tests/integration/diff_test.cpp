// `tanktread diff` as a user runs it, on files made for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "tests/integration/diff_fixture.hpp"

namespace tanktread::testing {
namespace {

using namespace tanktread::exchange;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

double next_after(double value) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) + 1);
}

TEST_F(Diff, SaysThatFilesAreIdentical) {
  const auto ended = diff_surfaces([](SurfacePacket&) {});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.output, "identical: 1 file, 5 arrays\n");
}

TEST_F(Diff, FindsASingleBitAndSaysWhere) {
  const auto ended = diff_surfaces([](SurfacePacket& p) { p.point_data[0].values[10] = next_after(11); });
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.output,
            path("a.vtu") +
                ": point data velocity: max 1.77636e-15, rms 5.1279e-16, 1 of 12 values; largest at "
                "value 10 (node 3 at 0.5 0.25 2, component 1); first at value 10 (node 3 at 0.5 0.25 2, "
                "component 1): 11 against 11.000000000000002\n"
                "different: 1 of 5 arrays, 1 of 1 file\n");
}

TEST_F(Diff, FindsPointsTrianglesAndCells) {
  const auto ended = diff_surfaces([](SurfacePacket& p) {
    p.points[3] = 1.5;
    std::swap(p.triangles[1], p.triangles[2]);
    p.cell_data[0].values[2] = 4;
    p.field_data[0].values[0] = 8;
  });
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(
      ended.output,
      AllOf(HasSubstr("points: max 0.5, "), HasSubstr("node 1 at 1 0 0, component 0"),
            HasSubstr("triangles: max 1, "), HasSubstr("(triangle 0, component 1): 2 against 1"),
            HasSubstr("cell data area_ratio: max 2, rms 1, "), HasSubstr("value 2 (triangle 2)"),
            HasSubstr("field data step: max 1, "), HasSubstr("different: 4 of 5 arrays, 1 of 1 file")));
}

TEST_F(Diff, NamesMissingArraysAndOtherShapes) {
  const auto ended = diff_surfaces([](SurfacePacket& p) {
    p.point_data[0].name = "speed";
    p.cell_data[0] = {"area_ratio", 2, std::vector<double>(8, 1.0)};
  });
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("point data velocity: only in the first\n"),
                                  HasSubstr("point data speed: only in the second\n"),
                                  HasSubstr("cell data area_ratio: 4 x 1 against 4 x 2\n"),
                                  HasSubstr("different: 3 of 6 arrays")));
}

TEST_F(Diff, ShowsTheBitsOfNan) {
  auto packet = tetrahedron();
  for (const char* name : {"a.vtu", "b.vtu"}) {
    packet.cell_data[0].values[1] =
        std::bit_cast<double>(std::uint64_t{0x7ff8000000000000} | (name[0] == 'a' ? 1U : 2U));
    write_surface(directory_ / name, packet);
  }
  const auto ended = diff("a.vtu", "b.vtu", {"--tolerance", "1e300"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("max nan, rms nan"),
                                  HasSubstr("nan (0x7ff8000000000001) against nan (0x7ff8000000000002)")));
  EXPECT_EQ(diff("a.vtu", "a.vtu").exit_code, 0) << "the same NaN";
}

TEST_F(Diff, NamesTheNodeOfAGrid) {
  auto grid = small_grid();
  write_grid(directory_ / "a.vti", grid);
  grid.point_data[1].values[3 * (1 + 2 * (2 + 3 * 1)) + 2] = 0.25;
  grid.origin[1] = 7.5;
  write_grid(directory_ / "b.vti", grid);
  const auto ended = diff("a.vti", "b.vti");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("point data velocity: max 0.125, "),
                                  HasSubstr("value 35 (node 1 2 1, component 2): 0.125 against 0.25"),
                                  HasSubstr("geometry origin: max 7, "), HasSubstr("at y: 0.5 against 7.5")));
}

TEST_F(Diff, TakesATolerance) {
  const auto change = [](SurfacePacket& p) {
    p.point_data[0].values[10] += 0.5;
    p.cell_data[0].values[0] += 0.25;
  };
  const auto within = diff_surfaces(change, {"--tolerance", "0.5"});
  EXPECT_EQ(within.exit_code, 0);
  EXPECT_EQ(within.output,
            "equal within 0.5: 1 file, 5 arrays, 2 equal within the tolerance but not bit for bit\n");
  const auto beyond = diff_surfaces(change, {"--tolerance", "0.4"});
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_THAT(beyond.output, AllOf(HasSubstr("velocity"), Not(HasSubstr("area_ratio"))));
}

TEST_F(Diff, HasNoToleranceForNodeNumbersAndShapes) {
  const std::vector<std::string> much = {"--tolerance", "1000"};
  EXPECT_EQ(
      diff_surfaces([](SurfacePacket& p) { std::swap(p.triangles[1], p.triangles[2]); }, much).exit_code, 1);
  EXPECT_EQ(diff_surfaces([](SurfacePacket& p) { p.field_data.clear(); }, much).exit_code, 1);
}

TEST_F(Diff, LeavesOutWhatIsToBeIgnored) {
  const auto ended = diff_surfaces(
      [](SurfacePacket& p) {
        p.point_data[0].values[10] += 0.5;
        p.field_data.clear();
      },
      {"--ignore", "velocity", "--ignore", "step"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.output, "identical: 1 file, 3 arrays, 2 ignored\n");
}

TEST_F(Diff, ComparesTablesByColumn) {
  const std::string table = "# by hand\nstep,x,law\n0,0.5,skalak\n1,0.25,skalak\n2,0.125,skalak\n";
  EXPECT_EQ(diff_tables(table, table).output, "identical: 1 file, 3 arrays\n");
  const auto ended =
      diff_tables(table, "# by hand\nstep,x,law\n0,0.5,skalak\n1,0.75,skalak\n2,1.125,hooke\n");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(
      ended.output,
      AllOf(HasSubstr("a.csv: column x: max 1, "),
            HasSubstr("2 of 3 values; largest at row 3; first at row 2: "
                      "0.25 against 0.75\n"),
            HasSubstr("column law: 1 of 3 values, not all of them numbers; first at row 3: 'skalak' against "
                      "'hooke'\n"),
            HasSubstr("different: 2 of 3 arrays, 1 of 1 file")));
}

TEST_F(Diff, ComparesCellsAsTextUnlessThereIsATolerance) {
  const auto ended = diff_tables("x\n1\n2\n", "x\n1\n2.0\n");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output,
              HasSubstr("column x: max 0, rms 0, 1 of 2 values; largest at row 2; first at row 2: 2 "
                        "against 2.0"));
  EXPECT_EQ(diff_tables("x\n1\n2\n", "x\n1\n2.0\n", {"--tolerance", "1e-300"}).exit_code, 0);
  EXPECT_EQ(diff_tables("x\n1\na\n", "x\n1\nb\n", {"--tolerance", "1e300"}).exit_code, 1);
}

TEST_F(Diff, FindsColumnsByName) {
  EXPECT_EQ(diff_tables("a,b\n1,2\n", "b,a\n2,1\n").exit_code, 0);
  const auto ended = diff_tables("a,b\n1,2\n", "a,c\n1,2\n");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("column b: only in the first\n"),
                                  HasSubstr("column c: only in the second\n"), HasSubstr("2 of 3 arrays")));
  EXPECT_EQ(diff_tables("a,a\n1,2\n", "a,a\n1,3\n").exit_code, 1) << "two of one name";
  EXPECT_EQ(diff_tables("a,a\n1,2\n", "a,a\n1,2\n").exit_code, 0) << "two of one name";
}

TEST_F(Diff, SeesTheLineEndsOfATableAsSuch) {
  const auto ended = diff_tables("x,y\n1,2\n3,4\n", "x,y\r\n1,2\n3,4\r\n");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("0 lines with Windows line ends against 2\n"),
                                  HasSubstr("different: 0 of 2 arrays, 1 of 1 file")));
  EXPECT_EQ(diff_tables("x\r\n1\n", "x\n1\r\n").exit_code, 1) << "as many of them";
  EXPECT_EQ(diff_tables("x\r\n1\r\n", "x\r\n1\r\n").exit_code, 0);
}

TEST_F(Diff, SeesRowsCellsAndCommentsThatAreMissing) {
  const auto rows = diff_tables("x\n1\n2\n", "x\n1\n2\n3\n");
  EXPECT_EQ(rows.exit_code, 1);
  EXPECT_THAT(rows.output, AllOf(HasSubstr("2 rows against 3; the first 2 are compared\n"),
                                 HasSubstr("different: 0 of 1 array, 1 of 1 file")));
  EXPECT_EQ(diff_tables("x,y\n1,\n", "x,y\n1\n").exit_code, 1);
  EXPECT_EQ(diff_tables("x,y\n1,2\n", "x,y\n1,2,3\n").exit_code, 1);
  EXPECT_EQ(diff_tables("x\n1\n", "# new\nx\n1\n").exit_code, 1);
}

}  // namespace
}  // namespace tanktread::testing
