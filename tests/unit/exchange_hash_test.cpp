// The hash in every file: changed contents are refused, contents as written and files without a hash are
// read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "exchange/content_hash.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing::hash_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* refusal = "the contents are not those that were written";

class Hash : public ::testing::Test {
 protected:
  void SetUp() override {
    write_surface(folder_ / "whole.vtu", sample_surface());
    write_grid(folder_ / "whole.vti", sample_grid());
  }
  /// What reading `text` under that name says.
  std::string error(const std::string& name, const std::string& text, bool convert = false) {
    put_text(folder_ / name, text);
    return message_of([&] {
      if (name.ends_with("vtu")) read_surface(folder_ / name, convert);
      if (name.ends_with("vti")) read_grid(folder_ / name, convert);
    });
  }
  std::string whole(const std::string& kind) const { return read_text(folder_ / ("whole." + kind)); }
  /// The same with one text in the file's head replaced by another.
  std::string error_with(const std::string& kind, const std::string& before, const std::string& after) {
    auto text = whole(kind);
    EXPECT_NE(text.find(before), std::string::npos) << before;
    return error("changed." + kind, text.replace(text.find(before), before.size(), after));
  }
  const TemporaryFolder folder_;
};

TEST_F(Hash, NoticesASingleBitOfAnyNumber) {
  for (const std::string kind : {"vtu", "vti"}) {
    const auto text = whole(kind);
    ASSERT_THAT(text, Not(ContainsRegex("padding_for_meshio\" NumberOfTuples=\"[1-9]")))
        << "zeros that are of no importance";
    const auto first = text.find('_', text.find("<AppendedData")) + 1,
               last = text.rfind("\n  </AppendedData>");
    std::size_t n_by_hash = 0;
    for (auto k = first; k < last; ++k) {
      auto changed = text;
      changed[k] = static_cast<char>(changed[k] ^ (1 << (k % 8)));
      const auto message = error("changed." + kind, changed);
      EXPECT_THAT(message, HasSubstr("changed." + kind + ": ")) << kind << ", byte " << k - first;
      n_by_hash += message.find(refusal) != std::string::npos ? 1 : 0;
    }
    // The rest, in lengths, node numbers, offsets and cell types, is refused before there is a packet.
    EXPECT_GT(n_by_hash, (last - first) / 2) << kind;
  }
}

TEST_F(Hash, NoticesChangedNamesComponentsAndGeometry) {
  EXPECT_THAT(error_with("vtu", "\"velocity\"", "\"velocitz\""), HasSubstr(refusal));
  EXPECT_THAT(error_with("vtu", "\"stress\"", "\"Stress\""), HasSubstr(refusal));
  EXPECT_THAT(error_with("vtu", "\"step\"", "\"stap\""), HasSubstr(refusal));
  EXPECT_THAT(error_with("vtu", "\"history\" NumberOfTuples=\"40\"",
                         "\"history\" NumberOfComponents=\"2\" NumberOfTuples=\"20\""),
              HasSubstr(refusal));
  EXPECT_THAT(error_with("vti", "\"density\"", "\"dansity\""), HasSubstr(refusal));
  EXPECT_THAT(error_with("vti", "Origin=\"0.5 ", "Origin=\"0.25 "), HasSubstr(refusal));
  EXPECT_THAT(error_with("vti", "Spacing=\"1 ", "Spacing=\"2 "), HasSubstr(refusal));
}

TEST_F(Hash, IsNotLostWithAllFieldDataThatVtkCannotRead) {
  EXPECT_THAT(error_with("vtu", "\"history\" NumberOfTuples=\"40\"", "\"history\" NumberOfTuples=\"41\""),
              HasSubstr("its head tells of"));
  EXPECT_THAT(error_with("vti", "\"step\" NumberOfTuples=\"1\"", "\"step\" NumberOfTuples=\"2\""),
              HasSubstr("its head tells of"));
}

TEST_F(Hash, SaysWhatToDo) {
  EXPECT_THAT(error_with("vtu", "\"velocity\"", "\"velocitz\""),
              AllOf(HasSubstr("write or copy it again"),
                    HasSubstr("remove the array content_hash from its field data")));
}

/// A grid as another program may write it, in plain text, with such field data.
std::string plain_grid(const std::string& field_data) {
  return "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 1 0 0 0 0\" "
         "Origin=\"0.5 0 0\" Spacing=\"1 1 1\"><FieldData>" +
         field_data +
         "</FieldData><Piece Extent=\"0 1 0 0 0 0\"><PointData><DataArray type=\"Float64\" Name=\"density\" "
         "format=\"ascii\">1 2</DataArray></PointData></Piece></ImageData></VTKFile>\n";
}

std::string in_plain_text(const Array& array) {
  std::string text = "<DataArray type=\"Float64\" Name=\"" + array.name + "\" NumberOfTuples=\"" +
                     std::to_string(array.values.size()) + "\" format=\"ascii\">";
  for (const double value : array.values) text += std::to_string(value) + " ";
  return text + "</DataArray>";
}

TEST_F(Hash, IsOfTheNumbersHoweverTheyLieInTheFile) {
  GridPacket packet;
  packet.nodes = {2, 1, 1};
  packet.origin = {0.5, 0, 0};
  packet.point_data = {{"density", 1, {1, 2}}};
  EXPECT_EQ(error("plain.vti", plain_grid(""), true), "(no error)") << "a file without a hash";
  auto hash = to_array(content_hash(packet));
  EXPECT_EQ(error("plain.vti", plain_grid(in_plain_text(hash)), true), "(no error)");
  EXPECT_EQ(difference(read_grid(folder_ / "plain.vti", true), packet), "");
  hash.values[1] += 1;
  EXPECT_THAT(error("plain.vti", plain_grid(in_plain_text(hash)), true), HasSubstr(refusal));
  hash.values.clear();
  EXPECT_THAT(error("plain.vti", plain_grid(in_plain_text(hash)), true), HasSubstr(refusal));
}

TEST_F(Hash, StaysTheSameFromVersionToVersion) {
  // Else older files could not be read. The number is that of xxHash's XXH3_64bits over the bytes that
  // content_hash.hpp describes, put together by Python's struct.pack.
  GridPacket packet;
  packet.nodes = {2, 1, 1};
  packet.origin = {0.5, 0, 0};
  packet.point_data = {{"density", 1, {1, 2}}};
  packet.field_data = {{"step", 1, {7}}};
  EXPECT_EQ(content_hash(packet), 0x5fc98f2c6ccd6a54U);
  const SurfacePacket surface{
      {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, {{"speed", 1, {1, 2, -0.0}}}, {}, {{"none", 2, {}}}};
  EXPECT_EQ(content_hash(surface), 0x4deb6204644a5e7bU);
}

TEST_F(Hash, CountsWhatComparisonOfNumbersDoesNot) {
  const auto hash_with = [](const std::vector<Array>& point_data, const std::vector<Array>& field_data) {
    SurfacePacket packet;
    packet.point_data = point_data;
    packet.field_data = field_data;
    return content_hash(packet);
  };
  const auto nan = [](std::uint64_t payload) {
    return std::bit_cast<double>(std::uint64_t{0x7ff8000000000000} | payload);
  };
  EXPECT_NE(hash_with({{"a", 1, {0.0}}}, {}), hash_with({{"a", 1, {-0.0}}}, {}));
  EXPECT_NE(hash_with({{"a", 1, {nan(0)}}}, {}), hash_with({{"a", 1, {nan(1)}}}, {}));
  EXPECT_EQ(hash_with({{"a", 1, {nan(1)}}}, {}), hash_with({{"a", 1, {nan(1)}}}, {}));
  EXPECT_NE(hash_with({{"a", 1, {1}}}, {}), hash_with({}, {{"a", 1, {1}}}));
  EXPECT_NE(hash_with({{"a", 1, {}}, {"b", 1, {}}}, {}), hash_with({{"b", 1, {}}, {"a", 1, {}}}, {}));
  EXPECT_NE(hash_with({{"a", 1, {}}}, {}), hash_with({{"a", 2, {}}}, {}));
}

TEST_F(Hash, IsKeptForAGridAtNegativeZero) {
  auto packet = sample_grid();
  packet.origin = {-0.0, 0.0, -0.0};
  write_grid(folder_ / "zero.vti", packet);
  GridPacket back;
  EXPECT_EQ(error_of([&] { back = read_grid(folder_ / "zero.vti"); }), "(no error)");
  EXPECT_EQ(back.origin, packet.origin);
}

TEST_F(Hash, KeepsItsNameForItself) {
  for (const char* name : {"content_hash", "padding_for_meshio"}) {
    auto surface = sample_surface();
    surface.field_data.push_back({name, 1, {1}});
    EXPECT_THAT(error_of([&] { write_surface(folder_ / "out.vtu", surface); }),
                HasSubstr(std::string("out.vtu: cannot be written: the name '") + name));
    auto grid = sample_grid();
    grid.field_data.push_back({name, 1, {1}});
    EXPECT_THAT(error_of([&] { write_grid(folder_ / "out.vti", grid); }), HasSubstr("give the field data"));
  }
}

}  // namespace
}  // namespace tanktread::exchange::testing::hash_test
