// Files that must not be read, and files made elsewhere: each error names the file, what is wrong and what to
// do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/exchange_base64.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A .vtu as another program may write it, its numbers in base64: two triangles on four points, with changes.
struct PlainSurface {
  std::string points_type = "Float64", connectivity = "0 1 2 0 2 3", offsets = "3 6", types = "5 5";
  std::string point_data, cell_data, field_data;

  std::string text() const {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
           "byte_order=\"LittleEndian\"><UnstructuredGrid><FieldData>" +
           field_data + "</FieldData><Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><PointData>" +
           point_data + "</PointData><CellData>" + cell_data + "</CellData><Points>" + "<DataArray type=\"" +
           points_type + "\" NumberOfComponents=\"3\" format=\"binary\">" +
           binary(points_type, "0 0 0 1 0 0 1 1 0 0 1 0.5") +
           "</DataArray></Points><Cells>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"binary\">" +
           binary("Int32", connectivity) +
           "</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"binary\">" +
           binary("Int32", offsets) +
           "</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">" +
           binary("UInt8", types) +
           "</DataArray>"
           "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
  }
};

std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"binary\">" + binary(type, values) +
         "</DataArray>";
}

/// Field data of one number, 3.
std::string single_number(const std::string& type, const std::string& name) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfTuples=\"1\" format=\"binary\">" +
         binary(type, "3") + "</DataArray>";
}

std::string plain_grid(const std::string& attributes, const std::string& cell_data = "") {
  return "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"2 "
         "3 0 1 0 0\" Origin=\"0.5 0 "
         "0\" "
         "Spacing=\"2 1 1\" " +
         attributes + "><Piece Extent=\"2 3 0 1 0 0\"><PointData>" + array("Float64", "density", "1 2 3 4") +
         "</PointData><CellData>" + cell_data + "</CellData></Piece></ImageData></VTKFile>\n";
}

class Reading : public ::testing::Test {
 protected:
  std::string surface_error(const std::string& text, bool convert = false) {
    put_text(folder_ / "file.vtu", text);
    return error_of([&] { surface_ = read_surface(folder_ / "file.vtu", convert); });
  }
  std::string grid_error(const std::string& text, bool convert = false) {
    put_text(folder_ / "file.vti", text);
    return error_of([&] { grid_ = read_grid(folder_ / "file.vti", convert); });
  }
  /// For many files: `message` of each is handed to `check`, what is printed is looked at once.
  template <class Damage>
  void each_error(const std::string& name, std::size_t n_files, Damage damage,
                  const std::function<void(std::size_t, const std::string&)>& check) {
    const auto whole = read_text(folder_ / name);
    std::vector<std::string> messages;
    EXPECT_EQ(error_of([&] {
                for (std::size_t k = 0; k < n_files; ++k) {
                  put_text(folder_ / "damaged", damage(whole, k));
                  messages.push_back(message_of([&] {
                    if (name.ends_with("vtu")) read_surface(folder_ / "damaged");
                    if (name.ends_with("vti")) read_grid(folder_ / "damaged");
                  }));
                }
              }),
              "(no error)");
    for (std::size_t k = 0; k < n_files; ++k) check(k, messages[k]);
  }
  const TemporaryFolder folder_;
  SurfacePacket surface_;
  GridPacket grid_;
};

TEST_F(Reading, RefusesWhatIsNotThere) {
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "none.vtu"); }), HasSubstr("none.vtu: no such file"));
  EXPECT_THAT(error_of([&] { read_grid(folder_ / "none.vti"); }), HasSubstr("none.vti: no such file"));
  EXPECT_THAT(error_of([&] { read_surface(folder_ / ""); }), HasSubstr("is a folder, not a file"));
}

TEST_F(Reading, TakesNumbersAsTextOnlyWhenAsked) {
  PlainSurface plain;
  plain.point_data = "<DataArray type=\"Float64\" Name=\"load\" format=\"ascii\">1 2 3 0.1</DataArray>";
  EXPECT_THAT(surface_error(plain.text()),
              AllOf(HasSubstr("array 'load' is written as ASCII"), HasSubstr("write it as binary")));
  EXPECT_EQ(surface_error(plain.text(), true), "(no error)");
  EXPECT_THAT(surface_.point_data.at(0).values, ElementsAre(1, 2, 3, 0.1));
}

TEST_F(Reading, RefusesFilesOfAnotherKind) {
  write_surface(folder_ / "surface.vtu", sample_surface());
  write_grid(folder_ / "grid.vti", sample_grid());
  write_series(folder_ / "series.pvd", {});
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "grid.vti"); }),
              HasSubstr("grid.vti: is a grid (.vti), not a surface (.vtu); give a surface"));
  EXPECT_THAT(error_of([&] { read_grid(folder_ / "surface.vtu"); }),
              HasSubstr("surface.vtu: is a surface (.vtu), not a grid (.vti); give a grid"));
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "series.pvd"); }),
              HasSubstr("series.pvd: is a series (.pvd), not a surface"));
  EXPECT_THAT(error_of([&] { read_series(folder_ / "surface.vtu"); }), HasSubstr("is not a .pvd series"));
  EXPECT_THAT(surface_error("<html></html>"), HasSubstr("not a VTK XML file"));
  EXPECT_THAT(surface_error("<VTKFile></VTKFile>"), HasSubstr("is not a VTK XML file (expected one of type"));
  EXPECT_THAT(surface_error(""), HasSubstr("does not end with </VTKFile>"));
}

struct Foreign {
  std::string name, text, said, surface_fix;
};

TEST_F(Reading, KnowsFilesOfOtherFormatsByNameAndByContent) {
  const std::string convert = "; convert it: python3 -m tanktread_post convert-surface ";
  const std::vector<Foreign> all = {
      {"cell.stl", std::string(84, '\0'), "is an STL file", convert},  // binary, which begins as it likes
      {"cell.STL", "solid x\nendsolid x\n", "is an STL file", convert},
      {"named.vtu", "solid x\nendsolid x\n", "is an STL file", "; give it the suffix .stl and convert it: "},
      {"cell.obj", "v 0 0 0\n", "is an OBJ file", convert},
      {"cell.ply", "ply\nformat ascii 1.0\n", "is a PLY file", convert},
      {"cell", "OFF\n4 4 0\n", "is an OFF file", "; give it the suffix .off and convert it: "},
      {"cell.msh", "$MeshFormat\n", "is a Gmsh file", convert},
      {"cell.vtk", "# vtk DataFile Version 3.0\n", "is a file in VTK's old format", "; open it in ParaView"},
      {"cell.vtp", "<VTKFile type=\"PolyData\"></VTKFile>", "is a VTK file of polygons (.vtp)", convert},
      {"case.toml", "[flow]\n", "is a TOML file", "; give a surface (.vtu)"},
  };
  for (const auto& foreign : all) {
    put_text(folder_ / foreign.name, foreign.text);
    const auto place = foreign.name + ": " + foreign.said + ", not ";
    EXPECT_THAT(error_of([&] { read_surface(folder_ / foreign.name, true); }),
                HasSubstr(place + "a surface (.vtu)" + foreign.surface_fix));
    EXPECT_THAT(error_of([&] { read_grid(folder_ / foreign.name); }),
                HasSubstr(place + "a grid (.vti); give a grid (.vti)"));
    if (foreign.name == "cell.vtp") continue;  // the reader of series speaks of its own type first
    EXPECT_THAT(error_of([&] { read_series(folder_ / foreign.name); }),
                HasSubstr(place + "a series (.pvd); give a series (.pvd)"));
  }
  // The command stands as a shell takes it.
  std::filesystem::create_directory(folder_ / "my cells");
  put_text(folder_ / "my cells/it's.stl", "solid\n");
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "my cells/it's.stl"); }),
              AllOf(HasSubstr(R"(my cells/it'\''s.stl' )"), HasSubstr(R"(my cells/it'\''s.vtu' )")));
}

TEST_F(Reading, RefusesAFileCutAnywhere) {
  write_surface(folder_ / "whole.vtu", sample_surface());
  write_grid(folder_ / "whole.vti", sample_grid());
  for (const std::string name : {"whole.vtu", "whole.vti"}) {
    const auto n_bytes = read_text(folder_ / name).find_last_not_of('\n') + 1;
    each_error(
        name, n_bytes, [](const std::string& whole, std::size_t length) { return whole.substr(0, length); },
        [](std::size_t length, const std::string& message) {
          EXPECT_THAT(message, AllOf(HasSubstr("damaged: "), HasSubstr("cut off"))) << length;
        });
  }
}

TEST_F(Reading, RefusesNumbersThatAreMissingInBetween) {
  // Such as a copy that lost a block: the end is there, and other numbers stand where an array's should be.
  write_surface(folder_ / "whole.vtu", sample_surface());
  const auto whole = read_text(folder_ / "whole.vtu");
  const auto first = whole.find('_', whole.find("<AppendedData")) + 1,
             last = whole.rfind("\n  </AppendedData>");
  for (const std::size_t lost : {std::size_t{1}, std::size_t{3}, std::size_t{8}, last - first}) {
    each_error(
        "whole.vtu", last - first - lost + 1,
        [&](std::string text, std::size_t start) { return text.erase(first + start, lost); },
        [&](std::size_t start, const std::string& message) {
          EXPECT_THAT(message, HasSubstr("damaged: the numbers of array '"))
              << lost << " bytes after " << start;
        });
  }
}

TEST_F(Reading, NeverCrashesNorPrintsWhateverTheHeadSays) {
  // Any byte of the XML changed: an error, or a packet if the byte is of no importance; error_of sees what is
  // printed.
  write_surface(folder_ / "whole.vtu", sample_surface());
  write_grid(folder_ / "whole.vti", sample_grid());
  for (const std::string name : {"whole.vtu", "whole.vti"}) {
    const auto n_bytes = read_text(folder_ / name).find("<AppendedData");
    std::size_t n_errors = 0;
    each_error(
        name, n_bytes,
        [](std::string text, std::size_t k) {
          text[k] = text[k] == '9' ? '<' : '9';
          return text;
        },
        [&](std::size_t, const std::string& message) { n_errors += message == "(no error)" ? 0 : 1; });
    EXPECT_GT(n_errors, n_bytes / 3) << name;  // spaces, ranges and names make up the rest
  }
}

TEST_F(Reading, RefusesCellsThatAreNotTriangles) {
  PlainSurface surface;
  EXPECT_EQ(surface_error(surface.text()), "(no error)");
  EXPECT_THAT(surface_.triangles, ElementsAre(0, 1, 2, 0, 2, 3));
  surface.types = "5 3", surface.offsets = "3 5", surface.connectivity = "0 1 2 0 2";
  EXPECT_THAT(
      surface_error(surface.text()),
      AllOf(HasSubstr("file.vtu: cell 1 is a Line of 2 nodes; only triangles"), HasSubstr("triangulate")));
  surface.types = "9 5", surface.offsets = "4 7", surface.connectivity = "0 1 2 3 0 2 3";
  EXPECT_THAT(surface_error(surface.text(), true), HasSubstr("cell 0 is a Quad of 4 nodes"));
  surface.types = "5 5";
  EXPECT_THAT(surface_error(surface.text()), HasSubstr("cell 0 is a Triangle of 4 nodes"));
}

TEST_F(Reading, RefusesNodesThatAreNotThere) {
  PlainSurface surface;
  surface.connectivity = "0 1 2 0 2 4";
  EXPECT_THAT(surface_error(surface.text()), HasSubstr("triangle 1 has node 4, outside 0 to 3"));
  surface.connectivity = "0 -1 2 0 2 3";
  EXPECT_THAT(surface_error(surface.text()), HasSubstr("triangle 0 has node -1"));
}

TEST_F(Reading, RefusesOffsetsThatLeaveTheConnectivity) {
  PlainSurface surface;
  for (const char* offsets : {"3 9", "3 3", "6 3", "-3 0", "1000000000 2000000000"}) {
    surface.offsets = offsets;
    EXPECT_THAT(surface_error(surface.text()), HasSubstr("file.vtu")) << offsets;
  }
  // Before VTK makes room for them: 8 GB here, and the terabytes of a flipped bit in a file of our own.
  EXPECT_THAT(surface_error(surface.text()),
              HasSubstr("file.vtu: its cells are said to have 2000000000 node numbers (the last offset)"));
  write_surface(folder_ / "whole.vtu", sample_surface());
  auto text = read_text(folder_ / "whole.vtu");
  const auto place = text.find("offset=\"", text.find("Name=\"offsets\"")) + 8;
  const auto first =
      text.find('_', text.find("<AppendedData")) + 1 + std::stoul(text.substr(place)) + sizeof(std::uint64_t);
  const auto last = first + 8 * (sample_surface().triangles.size() / 3 - 1);
  text[last + 5] = static_cast<char>(text[last + 5] ^ 1);
  put_text(folder_ / "flipped.vtu", text);
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "flipped.vtu"); }),
              HasSubstr("flipped.vtu: its cells are said to have 1.099511628e+12 node numbers"));
}

TEST_F(Reading, WidensOtherTypesOnlyWhenAsked) {
  PlainSurface surface;
  surface.points_type = "Float32";
  EXPECT_THAT(
      surface_error(surface.text()),
      HasSubstr("file.vtu: the array of points is of type float, not double; a packet keeps every bit"));
  // The fix that is named is one that a user can give.
  EXPECT_THAT(surface_error(surface.text()),
              AllOf(HasSubstr("write it as Float64, in numpy float64, or convert the surface: python3 -m "
                              "tanktread_post convert-surface "),
                    HasSubstr("file.vtu "), HasSubstr("file-double.vtu")));
  EXPECT_EQ(surface_error(surface.text(), true), "(no error)");
  EXPECT_EQ(surface_.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5}));
  for (const char* type :
       {"Float32", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"}) {
    surface = {};
    surface.point_data = array(type, "label", "1 2 3 44");
    EXPECT_THAT(surface_error(surface.text()), HasSubstr("point data array 'label' is of type ")) << type;
    EXPECT_EQ(surface_error(surface.text(), true), "(no error)") << type;
    ASSERT_EQ(surface_.point_data.size(), 1U);
    EXPECT_THAT(surface_.point_data[0].values, ElementsAre(1, 2, 3, 44)) << type;
    surface.point_data.clear();
    surface.field_data = single_number(type, "number");
    EXPECT_THAT(surface_error(surface.text()), HasSubstr("field data array 'number' is of type ")) << type;
    EXPECT_EQ(surface_error(surface.text(), true), "(no error)") << type;
    EXPECT_THAT(surface_.field_data.at(0).values, ElementsAre(3)) << type;
  }
}

TEST_F(Reading, RefusesIntegersThatADoubleCannotHold) {
  PlainSurface surface;
  surface.cell_data = array("Int64", "id", "9007199254740991 -9007199254740991");
  EXPECT_EQ(surface_error(surface.text(), true), "(no error)");
  EXPECT_THAT(surface_.cell_data[0].values, ElementsAre(9007199254740991.0, -9007199254740991.0));
  surface.cell_data = array("Int64", "id", "1 9007199254740993");
  EXPECT_THAT(surface_error(surface.text(), true),
              HasSubstr("cell data array 'id' holds the integer 9007199254740992 at tuple 1; from 2^53 on"));
}

TEST_F(Reading, LeavesOutTextOnlyWhenAsked) {
  PlainSurface surface;
  surface.field_data =
      "<Array type=\"String\" Name=\"remark\" NumberOfTuples=\"1\" format=\"ascii\">104 105 0</Array>" +
      single_number("Float64", "step");
  EXPECT_THAT(surface_error(surface.text()),
              HasSubstr("field data array 'remark' holds string, not numbers; remove"));
  EXPECT_EQ(surface_error(surface.text(), true), "(no error)");
  ASSERT_EQ(surface_.field_data.size(), 1U);
  EXPECT_EQ(surface_.field_data[0].name, "step");
}

TEST_F(Reading, RefusesUnknownTypes) {
  PlainSurface surface;
  surface.field_data = array("Float16", "half", "1 2 3 4");
  EXPECT_THAT(
      surface_error(surface.text(), true),
      HasSubstr("file.vtu: array 'half' is of the unknown type 'Float16'; known are Float64, Float32"));
}

TEST_F(Reading, FindsTheFirstNodeOfAnExtent) {
  EXPECT_EQ(grid_error(plain_grid("")), "(no error)");
  EXPECT_EQ(grid_.nodes, (std::array{2, 2, 1}));
  EXPECT_EQ(grid_.origin, (std::array<double, 3>{0.5 + 2 * 2, 0, 0}));
  EXPECT_THAT(grid_.point_data.at(0).values, ElementsAre(1, 2, 3, 4));
}

TEST_F(Reading, RefusesGridsThatAPacketCannotHold) {
  EXPECT_THAT(grid_error(plain_grid("Direction=\"0 1 0 1 0 0 0 0 1\"")),
              HasSubstr("file.vti: the grid's axes are turned"));
  EXPECT_THAT(grid_error(plain_grid("", array("Float64", "phase", "1"))),
              HasSubstr("has cell data ('phase')"));
}

TEST_F(Reading, RefusesNewerVersions) {
  auto text = PlainSurface().text();
  text.replace(text.find("0.1"), 3, "99.1");
  EXPECT_THAT(surface_error(text), AllOf(HasSubstr("file.vtu: cannot be read"), HasSubstr("99.1")));
}

}  // namespace
}  // namespace tanktread::exchange::testing
