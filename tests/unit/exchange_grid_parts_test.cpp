// Grid files that are written and read in parts: the bytes of one that is written at once, and its numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "exchange/grid_pieces.hpp"
#include "exchange/grid_writer.hpp"
#include "tests/unit/exchange_full_disk.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing::grid_parts_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

/// A piece of a grid whose frame and numbers are awkward.
GridPacket sample_piece() {
  GridPacket packet;
  packet.nodes = {5, 4, 3};
  packet.begin = {2, -1, 7};
  packet.origin = {1.0 / 7, -0.0, 1e-300};
  packet.spacing = {0.1, 1e22, 1.0 / 3};
  packet.point_data = {{"populations", 19, awkward_numbers(19 * 60, 3)},
                       {"small", 1, awkward_numbers(60, 1)},
                       {"pairs", 2, awkward_numbers(120, 2)},
                       {"no number", 1, std::vector<double>(60, std::nan(""))},
                       {"largest", 1, std::vector<double>(60, std::numeric_limits<double>::max())}};
  for (double& number : packet.point_data[1].values)
    if (!std::isfinite(number)) number = -1.0 / 3;
  packet.field_data = {{"step", 1, {7}}, {"three", 3, {1, -0.0, 1.0 / 3}}, {"none", 1, {}}};
  return packet;
}

std::vector<ArrayShape> shapes_of(const GridPacket& packet) {
  std::vector<ArrayShape> shapes;
  for (const auto& array : packet.point_data) shapes.push_back({array.name, array.components});
  return shapes;
}

GridPacket without_point_data(GridPacket packet) {
  packet.point_data.clear();
  return packet;
}

/// @param nodes_a_time of each array
void write_in_parts(const fs::path& file, const GridPacket& packet, std::size_t nodes_a_time) {
  GridWriter writer(file, without_point_data(packet), shapes_of(packet));
  for (const auto& array : packet.point_data) {
    const auto at_a_time = nodes_a_time * static_cast<std::size_t>(array.components);
    for (std::size_t first = 0; first < array.values.size(); first += at_a_time) {
      const auto n = std::min(at_a_time, array.values.size() - first);
      writer.add(std::span(array.values).subspan(first, n));
    }
  }
  writer.finish();
}

TEST(GridParts, WrittenInAnyPartsHaveTheSameBytes) {
  const TemporaryFolder folder;
  const auto packet = sample_piece();
  write_grid(folder / "whole.vti", packet);
  const auto whole = read_text(folder / "whole.vti");
  for (const std::size_t nodes_a_time : {1, 7, 20, 60}) {
    write_in_parts(folder / "parts.vti", packet, nodes_a_time);
    EXPECT_EQ(read_text(folder / "parts.vti"), whole) << nodes_a_time;
  }
  EXPECT_THAT(folder.names(), ElementsAre("parts.vti", "whole.vti"));
}

/// Of the arrays with NaN here VTK notes other ranges.
GridPacket without_nan(GridPacket packet) {
  for (auto& array : packet.point_data) {
    for (double& number : array.values)
      if (std::isnan(number)) number = 1.0 / 7;
  }
  return packet;
}

TEST(GridParts, HaveTheBytesThatVtkWrites) {
  const TemporaryFolder folder;
  auto bare = without_nan(sample_piece());
  bare.field_data.clear();
  auto empty = sample_piece();
  empty.point_data.clear();
  for (const auto& packet : {without_nan(sample_piece()), without_nan(sample_grid()), bare, empty}) {
    write_grid(folder / "grid.vti", packet);
    const auto command =
        std::string(TANKTREAD_PYTHON " " TANKTREAD_BYTES_SCRIPT " ") + (folder / "grid.vti").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
  }
}

TEST(GridParts, AreHeldAgainstWhatWasPromised) {
  const TemporaryFolder folder;
  const auto packet = sample_piece();
  const std::vector<ArrayShape> shapes = {{"pairs", 2}, {"last", 1}};
  const std::vector<double> numbers(121);
  const auto part = [&](std::size_t n) { return std::span(numbers).first(n); };
  put_text(folder / "grid.vti", "old");
  {
    GridWriter writer(folder / "grid.vti", packet, shapes);
    EXPECT_THROW(writer.add(part(3)), std::logic_error);
    EXPECT_THROW(writer.add(part(122 - 1)), std::logic_error);
    writer.add(part(120));
    EXPECT_THROW(writer.finish(), std::logic_error);
    writer.add(part(59));
    EXPECT_THROW(writer.finish(), std::logic_error);
    writer.add(part(1));
    EXPECT_THROW(writer.add(part(1)), std::logic_error);
  }
  EXPECT_EQ(read_text(folder / "grid.vti"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("grid.vti"));
  const auto refusal = [&](const std::vector<ArrayShape>& others) {
    return error_of([&] { GridWriter(folder / "grid.vti", packet, others); });
  };
  EXPECT_THAT(refusal({{"", 1}}), HasSubstr("has no name"));
  EXPECT_THAT(refusal({{"a", 0}}), HasSubstr("has 0 components"));
  EXPECT_THAT(refusal({{"a", 1}, {"a", 2}}), HasSubstr("two point data arrays are named 'a'"));
}

TEST(GridParts, OnAFullDiskLeaveNothing) {
  const TemporaryFolder folder;
  const auto packet = sample_piece();
  const FullDisk disk(6000);
  EXPECT_THAT(error_of([&] { write_in_parts(folder / "grid.vti", packet, 20); }),
              AllOf(HasSubstr("grid.vti: cannot be written"), HasSubstr("File too large")));
  EXPECT_THAT(folder.names(), IsEmpty());
}

/// A grid of one piece, and a reader of some of its nodes.
class GridPartsRead : public ::testing::Test {
 protected:
  GridPartsRead() {
    packet_ = sample_piece();
    packet_.begin = {0, 0, 0};
    packet_.field_data.pop_back();
    fs::create_directories(folder_ / "grid");
    write_grid(piece(), packet_);
    index_ = {{{0, 0, 0}, packet_.nodes}, packet_.origin,     packet_.spacing,
              shapes_of(packet_),         packet_.field_data, {{"grid/0.vti", {{0, 0, 0}, packet_.nodes}}}};
    write_grid_index(folder_ / "grid.pvti", index_);
  }
  fs::path piece() const { return folder_ / "grid/0.vti"; }

  /// Numbers of the nodes of a block, on some of its layers.
  std::vector<double> expected(const Array& array, const GridBlock& block, int first, int end) const {
    std::vector<double> numbers;
    for (int z = block.begin[2] + first; z < block.begin[2] + end; ++z) {
      for (int y = block.begin[1]; y < block.begin[1] + block.nodes[1]; ++y) {
        const auto row = array.values.begin() +
                         array.components * ((z * packet_.nodes[1] + y) * packet_.nodes[0] + block.begin[0]);
        numbers.insert(numbers.end(), row, row + array.components * block.nodes[0]);
      }
    }
    return numbers;
  }

  /// What a reader gives of every array, on the layers of a block one by one and all.
  void expect_numbers(const GridBlockReader& reader, const GridBlock& block) const {
    for (const auto& array : packet_.point_data) {
      for (int first = 0; first < block.nodes[2]; ++first) {
        for (int end = first; end <= block.nodes[2]; ++end) {
          const auto numbers = expected(array, block, first, end);
          std::vector<double> read(numbers.size());
          reader.read(array.name, first, end, read);
          EXPECT_EQ(difference(read, numbers), "") << array.name;
        }
      }
    }
  }

  TemporaryFolder folder_;
  GridPacket packet_;
  GridIndex index_;
};

TEST_F(GridPartsRead, HaveTheNumbersOfTheGrid) {
  for (const GridBlock& block :
       {GridBlock{{0, 0, 0}, {5, 4, 3}}, {{1, 2, 1}, {3, 1, 2}}, {{4, 3, 2}, {1, 1, 1}}})
    expect_numbers(GridBlockReader(folder_ / "grid.pvti", index_, block), block);
  EXPECT_THROW(GridBlockReader(folder_ / "grid.pvti", index_, {{0, 0, 0}, {5, 4, 4}}), std::invalid_argument);
  const GridBlockReader reader(folder_ / "grid.pvti", index_, {{0, 0, 0}, {1, 1, 1}});
  std::vector<double> one(1);
  EXPECT_THROW(reader.read("heat", 0, 1, one), std::invalid_argument);
}

TEST_F(GridPartsRead, OfAFileInAnotherForm) {
  // Its numbers come first by another way to write the same, which is not ours.
  auto text = read_text(piece());
  text.insert(text.find("   _"), " ");
  text.replace(text.find(" Direction=\"1 0 0 0 1 0 0 0 1\""), 30, std::string(29, ' '));
  put_text(piece(), text);
  const GridBlock block{{1, 2, 1}, {3, 1, 2}};
  expect_numbers(GridBlockReader(folder_ / "grid.pvti", index_, block), block);
}

TEST_F(GridPartsRead, AreRefusedWhereTheyHaveChanged) {
  const auto text = read_text(piece());
  for (const std::size_t place : {text.size() - 40, text.find("   _") + 20, text.find("   _") + 5000}) {
    auto damaged = text;
    damaged[place] ^= 1;
    put_text(piece(), damaged);
    EXPECT_THAT(error_of([&] {
                  GridBlockReader(folder_ / "grid.pvti", index_, {{0, 0, 0}, {1, 1, 1}});
                }),
                HasSubstr("their hash is not the file's"));
  }
  put_text(piece(), text);
  const GridBlockReader reader(folder_ / "grid.pvti", index_, {{0, 0, 0}, {1, 1, 1}});
  std::vector<double> one(1);
  reader.read("small", 0, 1, one);
  write_grid(piece(), packet_);  // another file of that name
  EXPECT_THAT(error_of([&] { reader.read("small", 0, 1, one); }),
              AllOf(HasSubstr("grid/0.vti"), HasSubstr("has changed while it was read")));
  fs::remove(piece());
  EXPECT_THAT(error_of([&] { reader.read("small", 0, 1, one); }),
              AllOf(HasSubstr("grid/0.vti"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace tanktread::exchange::testing::grid_parts_test
