// Grids in pieces (.pvti): every bit comes back, whole or by blocks; what does not belong together is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "exchange/grid_pieces.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing::pieces_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;
using Triple = std::array<int, 3>;

constexpr Triple nodes = {7, 5, 4};

/// A grid whose numbers are awkward and, in `place`, those of its nodes.
GridPacket whole_grid(const Triple& n = nodes) {
  GridPacket packet;
  packet.nodes = n;
  packet.origin = {0.5, -3, 1.0 / 7};
  packet.spacing = {1, 0.1, 1.0 / 3};
  const auto size = static_cast<std::size_t>(n[0] * n[1] * n[2]);
  packet.point_data = {{"populations", 19, awkward_numbers(19 * size, 0)}, {"place", 1, {}}};
  for (std::size_t k = 0; k < size; ++k) packet.point_data[1].values.push_back(static_cast<double>(k));
  packet.field_data = {{"step", 1, {7}}, {"shear_time", 1, {0.1}}, {"three", 3, {1, -0.0, 1.0 / 3}}};
  return packet;
}

GridPacket cut(const GridPacket& whole, const GridBlock& block) {
  GridPacket packet = whole;
  packet.begin = block.begin;
  packet.nodes = block.nodes;
  for (auto& array : packet.point_data) array.values.clear();
  for (int z = 0; z < block.nodes[2]; ++z) {
    for (int y = 0; y < block.nodes[1]; ++y) {
      for (int x = 0; x < block.nodes[0]; ++x) {
        const int node = ((z + block.begin[2]) * whole.nodes[1] + y + block.begin[1]) * whole.nodes[0] + x +
                         block.begin[0];
        for (std::size_t k = 0; k < packet.point_data.size(); ++k) {
          const auto& from = whole.point_data[k];
          const auto first = from.values.begin() + from.components * node;
          auto& values = packet.point_data[k].values;
          values.insert(values.end(), first, first + from.components);
        }
      }
    }
  }
  return packet;
}

/// Blocks that share a layer, between the planes of nodes given for each axis.
std::vector<GridBlock> blocks_between(const std::array<std::vector<int>, 3>& planes) {
  std::vector<GridBlock> blocks;
  const auto [xs, ys, zs] = planes;
  for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        blocks.push_back(
            {{xs[i], ys[j], zs[k]}, {xs[i + 1] - xs[i] + 1, ys[j + 1] - ys[j] + 1, zs[k + 1] - zs[k] + 1}});
      }
    }
  }
  return blocks;
}

GridIndex index_of(const GridPacket& whole, const std::vector<GridBlock>& blocks) {
  GridIndex index{{{0, 0, 0}, whole.nodes}, whole.origin, whole.spacing, {}, whole.field_data, {}};
  for (const auto& array : whole.point_data) index.point_data.push_back({array.name, array.components});
  for (std::size_t k = 0; k < blocks.size(); ++k)
    index.pieces.push_back({"grid/" + std::to_string(k) + ".vti", blocks[k]});
  return index;
}

/// A folder with grid.pvti and its pieces.
class Pieces : public ::testing::Test {
 protected:
  void write(const GridPacket& whole, const std::vector<GridBlock>& blocks) {
    index_ = index_of(whole, blocks);
    fs::create_directories(folder_ / "grid");
    for (const auto& piece : index_.pieces) write_grid(folder_ / piece.file, cut(whole, piece.block));
    write_grid_index(file(), index_);
  }
  fs::path file() const { return folder_ / "grid.pvti"; }
  std::string reading_error() {
    return error_of([&] { read_grid(file()); });
  }

  const std::vector<GridBlock> two_ = blocks_between({{{0, 3, 6}, {0, 4}, {0, 3}}});
  TemporaryFolder folder_;
  GridIndex index_;
};

TEST_F(Pieces, CutAcrossEachAxisAndAllKeepEveryBit) {
  const auto whole = whole_grid();
  for (const std::array<std::vector<int>, 3>& planes :
       {std::array<std::vector<int>, 3>{{{0, 6}, {0, 4}, {0, 3}}},
        {{{0, 1, 2, 6}, {0, 4}, {0, 3}}},
        {{{0, 6}, {0, 3, 4}, {0, 3}}},
        {{{0, 6}, {0, 4}, {0, 1, 3}}},
        {{{0, 2, 6}, {0, 1, 4}, {0, 2, 3}}}}) {
    write(whole, blocks_between(planes));
    EXPECT_EQ(difference(read_grid(file()), whole), "");
    const auto index = read_grid_index(file());
    for (const GridBlock& block : {GridBlock{{0, 0, 0}, {1, 1, 1}},
                                   {{2, 1, 1}, {3, 2, 2}},
                                   {{6, 4, 3}, {1, 1, 1}},
                                   {{2, 0, 0}, {1, 5, 4}}}) {
      const auto read = read_grid_block(file(), index, block);
      EXPECT_EQ(read.begin, block.begin);
      EXPECT_EQ(difference(read, cut(whole, block)), "");
    }
  }
}

TEST_F(Pieces, OfAGridOfOneLayer) {
  const auto whole = whole_grid({7, 1, 4});
  write(whole, blocks_between({{{0, 3, 6}, {0, 0}, {0, 3}}}));
  EXPECT_EQ(difference(read_grid(file()), whole), "");
}

TEST_F(Pieces, AnIndexIsReadAsItWasWritten) {
  write(whole_grid(), two_);
  const auto index = read_grid_index(file());
  EXPECT_EQ(index.whole, index_.whole);
  EXPECT_EQ(index.origin, index_.origin);
  EXPECT_EQ(index.spacing, index_.spacing);
  EXPECT_EQ(index.point_data, index_.point_data);
  EXPECT_EQ(difference(index.field_data, index_.field_data), "");
  ASSERT_EQ(index.pieces.size(), 2U);
  EXPECT_EQ(index.pieces[1].file, "grid/1.vti");
  EXPECT_EQ(index.pieces[1].block, two_[1]);
}

TEST_F(Pieces, APieceIsAGridByItself) {
  const auto whole = whole_grid();
  write(whole, two_);
  auto expected = cut(whole, two_[1]);
  expected.origin = first_node(expected);
  expected.begin = {0, 0, 0};
  EXPECT_EQ(expected.origin[0], 3.5);
  EXPECT_EQ(difference(read_grid(folder_ / "grid/1.vti"), expected), "");
  EXPECT_EQ(read_grid(folder_ / "grid/1.vti").begin, (Triple{0, 0, 0}));
}

TEST_F(Pieces, OnlyThoseWithNodesInABlockAreRead) {
  const auto whole = whole_grid();
  write(whole, two_);
  put_text(folder_ / "grid/1.vti", "damaged");
  const GridBlock first{{0, 0, 0}, {3, 5, 4}};
  EXPECT_EQ(difference(read_grid_block(file(), index_, first), cut(whole, first)), "");
  EXPECT_THAT(reading_error(), HasSubstr("grid/1.vti"));
  EXPECT_THROW(read_grid_block(file(), index_, {{5, 0, 0}, {3, 1, 1}}), std::invalid_argument);
}

TEST_F(Pieces, VtkReadsTheSameNumbers) {
  const auto whole = whole_grid();
  for (const auto& planes :
       {std::array<std::vector<int>, 3>{{{0, 1, 6}, {0, 4}, {0, 3}}}, {{{0, 2, 6}, {0, 1, 4}, {0, 2, 3}}}}) {
    write(whole, blocks_between(planes));
    write_grid(folder_ / "whole.vti", whole);
    const auto command = std::string(TANKTREAD_PYTHON " " TANKTREAD_PIECES_SCRIPT " ") + file().string() +
                         " " + (folder_ / "whole.vti").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
}

TEST_F(Pieces, AMissingPieceIsNamed) {
  write(whole_grid(), two_);
  fs::remove(folder_ / "grid/1.vti");
  EXPECT_THAT(error_of([&] { read_grid_index(file()); }),
              AllOf(HasSubstr("grid/1.vti: no such file, a piece of "), HasSubstr("grid.pvti")));
}

TEST_F(Pieces, ADamagedPieceIsNamed) {
  write(whole_grid(), two_);
  auto text = read_text(folder_ / "grid/1.vti");
  text[text.size() - 40] ^= 1;
  put_text(folder_ / "grid/1.vti", text);
  EXPECT_THAT(reading_error(), AllOf(HasSubstr("grid/1.vti"), HasSubstr("their hash is not the file's")));
}

TEST_F(Pieces, APieceOfAnotherGridIsRefused) {
  const auto whole = whole_grid();
  const auto error = [&](const GridPacket& piece) {
    write(whole, two_);
    write_grid(folder_ / "grid/1.vti", piece);
    return reading_error();
  };
  const auto piece = cut(whole, two_[1]);
  EXPECT_THAT(
      error(cut(whole, two_[0])),
      AllOf(HasSubstr("grid/1.vti: has 4 x 5 x 4 nodes from node (0, 0, 0) of the whole, other than "),
            HasSubstr("grid.pvti says")));
  auto other = piece;
  other.origin[2] = 0;
  EXPECT_THAT(error(other), HasSubstr("has another origin or spacing"));
  other = piece;
  other.field_data[0].values[0] = 8;
  EXPECT_THAT(error(other), HasSubstr("has another 'step'"));
  other = piece;
  other.point_data.erase(other.point_data.begin());
  EXPECT_THAT(error(other), HasSubstr("has no array 'populations' of 19 components"));
  EXPECT_EQ(error(piece), "(no error)");
}

TEST_F(Pieces, EveryCellIsInOnePiece) {
  const auto whole = whole_grid();
  const auto error = [&](const std::vector<GridBlock>& blocks) {
    return error_of([&] { write_grid_index(file(), index_of(whole, blocks)); });
  };
  EXPECT_THAT(error({two_[0]}), AllOf(HasSubstr("grid.pvti: cannot be written: the grid has 72 cells"),
                                      HasSubstr("its pieces have 36")));
  EXPECT_THAT(error({two_[0], two_[0]}), HasSubstr("have cells in common"));
  EXPECT_THAT(error({two_[0], {{4, 0, 0}, {3, 5, 4}}}), HasSubstr("share one layer of nodes"));
  EXPECT_THAT(error({two_[0], {{3, 0, 0}, {5, 5, 4}}}), HasSubstr("is no part of the grid"));
  EXPECT_THAT(error({two_[0], two_[1], {{6, 0, 0}, {1, 5, 4}}}), HasSubstr("is no part of the grid"));
  EXPECT_THAT(folder_.names(), IsEmpty());
  write(whole, two_);
  auto text = read_text(file());
  text.replace(text.find("Extent=\"3 6 0"), 13, "Extent=\"4 6 0");
  put_text(file(), text);
  EXPECT_THAT(reading_error(), HasSubstr("grid.pvti: is damaged: the grid has 72 cells"));
}

TEST_F(Pieces, ADamagedIndexIsRefused) {
  write(whole_grid(), two_);
  const auto text = read_text(file());
  const auto error = [&](const std::string& old, const std::string& changed) {
    auto spoilt = text;
    spoilt.replace(spoilt.find(old), old.size(), changed);
    put_text(file(), spoilt);
    return reading_error();
  };
  EXPECT_THAT(error("\"0 6 0 4 0 3\"", "\"0 6 0 4 0\""), HasSubstr("WholeExtent"));
  EXPECT_THAT(error("Components=\"1\" NumberOfTuples=\"1\"", "Components=\"9999\" NumberOfTuples=\"9999\""),
              HasSubstr("NumberOfTuples=\"9999\", which is not one of 1000000 numbers at most"));
  EXPECT_THAT(error("Source", "Sauce"), HasSubstr("its element Piece lacks the attribute 'Source'"));
  EXPECT_THAT(error("NumberOfComponents=\"19\"", "NumberOfComponents=\"-1\""),
              HasSubstr("NumberOfComponents"));
  EXPECT_THAT(error("type=\"PImageData\"", "type=\"ImageData\""),
              HasSubstr("is a grid (.vti), not the index"));
  EXPECT_THAT(error("</VTKFile>", ""), HasSubstr("it is cut off"));
  EXPECT_THAT(error("NumberOfTuples=\"1\" format=\"ascii\">7<", "NumberOfTuples=\"1\" format=\"ascii\">x<"),
              HasSubstr("its array 'step' has 0 numbers, 1 are needed"));
  EXPECT_THAT(error_of([&] { read_grid_index(folder_ / "none.pvti"); }), HasSubstr("no such file"));
}

TEST_F(Pieces, RefusesToWriteWhatXmlCannotHold) {
  auto index = index_of(whole_grid(), two_);
  index.pieces[0].file = std::string("a\x01") + ".vti";
  EXPECT_THAT(error_of([&] { write_grid_index(file(), index); }), HasSubstr("cannot be"));
  EXPECT_THAT(folder_.names(), IsEmpty());
}

}  // namespace
}  // namespace tanktread::exchange::testing::pieces_test
