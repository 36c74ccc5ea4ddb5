// Surfaces in pieces (.pvtu): every bit comes back, whole or piece by piece; what does not belong together is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "exchange/surface_pieces.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing::surface_pieces_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

/// Tetrahedra with awkward numbers, `capsule` their numbers from `first` on.
SurfacePacket tetrahedra(std::int64_t first, std::int64_t n) {
  SurfacePacket packet;
  const auto n_capsules = static_cast<std::size_t>(n), begin = static_cast<std::size_t>(first);
  packet.points = awkward_numbers(12 * n_capsules, begin);
  packet.point_data = {{"velocity", 3, awkward_numbers(12 * n_capsules, begin + 5)},
                       {"place", 1, awkward_numbers(4 * n_capsules, begin + 2)}};
  packet.cell_data = {{"stress", 9, awkward_numbers(36 * n_capsules, begin + 1)}, {"capsule", 1, {}}};
  packet.field_data = {{"step", 1, {7}}, {"shear_time", 1, {0.1}}, {"three", 3, {1, -0.0, 1.0 / 3}}};
  for (std::int64_t capsule = 0; capsule < n; ++capsule) {
    for (const std::int64_t corner : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3})
      packet.triangles.push_back(4 * capsule + corner);
    for (int k = 0; k < 4; ++k) packet.cell_data[1].values.push_back(static_cast<double>(first + capsule));
  }
  return packet;
}

Array history(std::int64_t capsule) {
  return {"history_" + std::to_string(capsule), 2, awkward_numbers(8, static_cast<std::size_t>(capsule))};
}

SurfaceIndex index_of(const SurfacePacket& packet, std::size_t n_pieces) {
  SurfaceIndex index{{}, {}, packet.field_data, {}};
  for (const auto& array : packet.point_data) index.point_data.push_back({array.name, array.components});
  for (const auto& array : packet.cell_data) index.cell_data.push_back({array.name, array.components});
  for (std::size_t k = 0; k < n_pieces; ++k) index.pieces.push_back("cells/" + std::to_string(k) + ".vtu");
  return index;
}

/// A folder with cells.pvtu and its pieces: those given, of the numbers of the whole as tetrahedra() has
/// them.
class SurfacePieces : public ::testing::Test {
 protected:
  void write(const std::vector<SurfacePacket>& pieces) {
    index_ = index_of(tetrahedra(0, 1), pieces.size());
    fs::create_directories(folder_ / "cells");
    for (std::size_t k = 0; k < pieces.size(); ++k) write_surface(folder_ / index_.pieces[k], pieces[k]);
    write_surface_index(file(), index_);
  }
  fs::path file() const { return folder_ / "cells.pvtu"; }
  std::string reading_error() {
    return error_of([&] { read_surface(file()); });
  }

  const std::vector<SurfacePacket> two_ = {tetrahedra(0, 2), tetrahedra(2, 1)};
  TemporaryFolder folder_;
  SurfaceIndex index_;
};

/// The numbers of two pieces in one, node numbers of the second after those of the first.
SurfacePacket joined(SurfacePacket a, const SurfacePacket& b) {
  const auto n_nodes = static_cast<std::int64_t>(a.points.size() / 3);
  const auto add = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(a.points, b.points);
  for (const auto node : b.triangles) a.triangles.push_back(n_nodes + node);
  for (std::size_t k = 0; k < a.point_data.size(); ++k) add(a.point_data[k].values, b.point_data[k].values);
  for (std::size_t k = 0; k < a.cell_data.size(); ++k) add(a.cell_data[k].values, b.cell_data[k].values);
  return a;
}

TEST_F(SurfacePieces, OfOneTwoAndThreeKeepEveryBit) {
  write({two_[0]});
  EXPECT_EQ(difference(read_surface(file()), two_[0]), "");
  write(two_);
  const auto both = joined(two_[0], two_[1]);
  EXPECT_EQ(both.triangles.back(), 11);
  EXPECT_EQ(difference(read_surface(file()), both), "");
  write({two_[0], tetrahedra(2, 0), two_[1]});
  EXPECT_EQ(difference(read_surface(file()), both), "") << "one piece of no triangles";
}

TEST_F(SurfacePieces, AreReadWithoutLossesToo) {
  write(two_);
  EXPECT_EQ(difference(read_exact_surface(file()), joined(two_[0], two_[1])), "");
  EXPECT_EQ(difference(read_surface(file(), true), joined(two_[0], two_[1])), "");
}

TEST_F(SurfacePieces, OneIsReadByItself) {
  write(two_);
  const auto index = read_surface_index(file());
  EXPECT_EQ(difference(read_surface_piece(file(), index, 1), two_[1]), "");
  put_text(folder_ / "cells/0.vtu", "damaged");
  EXPECT_EQ(difference(read_surface_piece(file(), index, 1), two_[1]), "") << "the other is not looked at";
  EXPECT_THROW(read_surface_piece(file(), index, 2), std::out_of_range);
}

TEST_F(SurfacePieces, NumbersOfTheirOwnComeAfterThoseOfTheWhole) {
  auto pieces = two_;
  pieces[0].field_data.insert(pieces[0].field_data.begin(), history(0));
  pieces[1].field_data.push_back(history(2));
  write(pieces);
  auto expected = joined(two_[0], two_[1]);
  expected.field_data.push_back(history(0));
  expected.field_data.push_back(history(2));
  EXPECT_EQ(difference(read_surface(file()), expected), "");
  EXPECT_EQ(difference(read_surface_piece(file(), index_, 1), pieces[1]), "");
  pieces[1].field_data.back() = history(0);
  write(pieces);
  EXPECT_THAT(reading_error(),
              AllOf(HasSubstr("cells/1.vtu: has the field data 'history_0', as has "),
                    HasSubstr("cells/0.vtu, and "), HasSubstr("only one piece can have them")));
}

TEST_F(SurfacePieces, AnIndexIsReadAsItWasWritten) {
  write(two_);
  const auto index = read_surface_index(file());
  EXPECT_EQ(index.point_data, index_.point_data);
  EXPECT_EQ(index.cell_data, index_.cell_data);
  EXPECT_EQ(difference(index.field_data, index_.field_data), "");
  EXPECT_EQ(index.pieces, (std::vector<std::string>{"cells/0.vtu", "cells/1.vtu"}));
}

TEST_F(SurfacePieces, VtkReadsTheSameNumbers) {
  write({two_[0], two_[1], tetrahedra(3, 2)});
  write_surface(folder_ / "whole.vtu", joined(joined(two_[0], two_[1]), tetrahedra(3, 2)));
  const auto command = std::string(TANKTREAD_PYTHON " " TANKTREAD_PIECES_SCRIPT " ") + file().string() + " " +
                       (folder_ / "whole.vtu").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(SurfacePieces, AMissingPieceIsNamed) {
  write(two_);
  fs::remove(folder_ / "cells/1.vtu");
  EXPECT_THAT(error_of([&] { read_surface_index(file()); }),
              AllOf(HasSubstr("cells/1.vtu: no such file, a piece of "), HasSubstr("cells.pvtu")));
}

TEST_F(SurfacePieces, ADamagedPieceIsNamed) {
  write(two_);
  auto text = read_text(folder_ / "cells/1.vtu");
  text[text.size() - 120] ^= 1;
  put_text(folder_ / "cells/1.vtu", text);
  EXPECT_THAT(reading_error(), HasSubstr("cells/1.vtu: "));
  write_surface_index(folder_ / "cells/1.vtu", index_);
  EXPECT_THAT(reading_error(), AllOf(HasSubstr("cells/1.vtu: is the index of a surface in pieces"),
                                     HasSubstr("its name must end with .pvtu")));
}

TEST_F(SurfacePieces, APieceOfAnotherSurfaceIsRefused) {
  const auto error = [&](const SurfacePacket& piece) {
    write(two_);
    write_surface(folder_ / "cells/1.vtu", piece);
    return reading_error();
  };
  auto other = two_[1];
  other.field_data[0].values[0] = 8;
  EXPECT_THAT(error(other), AllOf(HasSubstr("cells/1.vtu: has another 'step', other than "),
                                  HasSubstr("cells.pvtu says"), HasSubstr("write or copy both again")));
  other = two_[1];
  other.field_data.erase(other.field_data.begin());
  EXPECT_THAT(error(other), HasSubstr("has another 'step'"));
  other = two_[1];
  other.point_data.erase(other.point_data.begin());
  EXPECT_THAT(error(other), HasSubstr("has no array 'velocity' of 3 components"));
  other = two_[1];
  other.cell_data[0] = {"stress", 3, awkward_numbers(12, 0)};
  EXPECT_THAT(error(other), HasSubstr("has no array 'stress' of 9 components"));
  other = two_[1];
  other.cell_data.push_back({"area_ratio", 1, awkward_numbers(4, 0)});
  EXPECT_THAT(error(other), HasSubstr("has an array 'area_ratio', other than "));
  EXPECT_EQ(error(two_[1]), "(no error)");
}

TEST_F(SurfacePieces, EachIsNamedOnce) {
  const auto error = [&](const std::vector<std::string>& pieces) {
    auto index = index_of(two_[0], 0);
    index.pieces = pieces;
    return error_of([&] { write_surface_index(file(), index); });
  };
  EXPECT_THAT(error({}), HasSubstr("cells.pvtu: cannot be written: it names no piece"));
  EXPECT_THAT(error({"a.vtu", "b.vtu", "a.vtu"}),
              HasSubstr("cannot be written: it names the piece 'a.vtu' twice"));
  EXPECT_THAT(folder_.names(), IsEmpty());
  write(two_);
  auto text = read_text(file());
  text.replace(text.find("cells/1.vtu"), 11, "cells/0.vtu");
  put_text(file(), text);
  EXPECT_THAT(reading_error(), HasSubstr("cells.pvtu: is damaged: it names the piece 'cells/0.vtu' twice"));
}

TEST_F(SurfacePieces, ADamagedIndexIsRefused) {
  write(two_);
  const auto text = read_text(file());
  const auto error = [&](const std::string& old, const std::string& changed) {
    auto spoilt = text;
    spoilt.replace(spoilt.find(old), old.size(), changed);
    put_text(file(), spoilt);
    return reading_error();
  };
  EXPECT_THAT(error("GhostLevel=\"0\"", "GhostLevel=\"1\""), HasSubstr("pieces that share no triangles"));
  EXPECT_THAT(error("Source", "Sauce"), HasSubstr("its element Piece lacks the attribute 'Source'"));
  EXPECT_THAT(error("NumberOfComponents=\"9\"", "NumberOfComponents=\"-1\""),
              HasSubstr("NumberOfComponents"));
  EXPECT_THAT(error("type=\"PUnstructuredGrid\"", "type=\"UnstructuredGrid\""),
              HasSubstr("is a surface (.vtu), not the index of a surface in pieces (.pvtu)"));
  EXPECT_THAT(error("<PUnstructuredGrid", "<PUnstructuredGrit"), HasSubstr("cells.pvtu"));
  EXPECT_THAT(error("</VTKFile>", ""), HasSubstr("it is cut off"));
  EXPECT_THAT(error("NumberOfTuples=\"1\" format=\"ascii\">7<", "NumberOfTuples=\"1\" format=\"ascii\">x<"),
              HasSubstr("its array 'step' has 0 numbers, 1 are needed"));
  put_text(file(), "solid cell\nendsolid cell\n");
  EXPECT_THAT(reading_error(), HasSubstr("is an STL file, not the index of a surface in pieces (.pvtu)"));
  EXPECT_THAT(error_of([&] { read_surface(folder_ / "none.pvtu"); }), HasSubstr("no such file"));
}

TEST_F(SurfacePieces, RefusesToWriteWhatXmlCannotHold) {
  auto index = index_of(two_[0], 1);
  index.pieces[0] = std::string("a\x01") + ".vtu";
  EXPECT_THAT(error_of([&] { write_surface_index(file(), index); }), HasSubstr("does not survive in XML"));
  index = index_of(two_[0], 1);
  index.field_data[0].values[0] = std::nan("");
  EXPECT_THAT(error_of([&] { write_surface_index(file(), index); }), HasSubstr("does not survive in XML"));
  EXPECT_THAT(folder_.names(), IsEmpty());
}

}  // namespace
}  // namespace tanktread::exchange::testing::surface_pieces_test
