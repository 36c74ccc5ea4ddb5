// Series in time (.pvd): round trip of times and names, and files that are not a series.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing::series_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<SeriesEntry> round_trip(const std::vector<SeriesEntry>& entries) {
  const TemporaryFolder folder;
  write_series(folder / "series.pvd", entries);
  return read_series(folder / "series.pvd");
}

TEST(Series, KeepsTimesExactly) {
  // 17 significant digits name one double only.
  using limits = std::numeric_limits<double>;
  const std::vector<double> times = {
      0.0,  0.1,           1.0 / 3.0,     std::nextafter(1.0, 2.0), 2.0 / 3e7, 12345678.9,
      -1.5, limits::max(), limits::min(), limits::denorm_min()};
  std::vector<SeriesEntry> entries;
  for (const double time : times) entries.push_back({time, "membrane/membrane_0000000001.vtu"});
  const auto back = round_trip(entries);
  ASSERT_EQ(back.size(), times.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_EQ(back[k].time, times[k]);
}

TEST(Series, KeepsOddNames) {
  const std::vector<std::string> names = {
      "a & b.vtu", "<a>\"b\"'c'.vtu",     "&amp;.vtu",       "\xc3\xa4\xe2\x82\xac.vtu",
      "a  b .vtu", "tab\tline\nreturn\r", "back\\slash.vtu", "]]>--%20#?"};
  std::vector<SeriesEntry> entries;
  for (const auto& name : names) entries.push_back({static_cast<double>(entries.size()), name});
  const auto back = round_trip(entries);
  ASSERT_EQ(back.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(back[k].file, names[k]);
}

TEST(Series, KeepsTheOrderOfEntriesAndNone) {
  EXPECT_THAT(round_trip({}), IsEmpty());
  const auto back = round_trip({{2, "b"}, {1, "a"}, {3, "b"}});
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[0].file + back[1].file + back[2].file, "bab");
}

TEST(Series, ReadsWhatParaViewWrites) {
  const TemporaryFolder folder;
  put_text(
      folder / "series.pvd",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<Collection>\n<DataSet timestep=\"0.25\" part=\"0\" file=\"a/a_0.vtu\" "
      "name=\"first\"/>\n</Collection>\n</VTKFile>\n");
  const auto entries = read_series(folder / "series.pvd");
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].time, 0.25);
  EXPECT_EQ(entries[0].file, "a/a_0.vtu");
}

TEST(Series, RefusesToWriteWhatXmlCannotHold) {
  const TemporaryFolder folder;
  const auto error = [&](const SeriesEntry& entry) {
    return error_of([&] { write_series(folder / "series.pvd", {{0, "fine.vtu"}, entry}); });
  };
  EXPECT_THAT(
      error({std::numeric_limits<double>::quiet_NaN(), "a.vtu"}),
      AllOf(HasSubstr("series.pvd"), HasSubstr("the entry 'a.vtu' has time nan, which is not finite")));
  EXPECT_THAT(error({std::numeric_limits<double>::infinity(), "a.vtu"}), HasSubstr("has time inf"));
  EXPECT_THAT(error({1, std::string("a\x01") + "b.vtu"}), HasSubstr("cannot be"));
  EXPECT_THAT(error({1, "a\xff.vtu"}), HasSubstr("cannot be"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Series, HoldsNoTimeTwiceAndSpellsATimeInOneWay) {
  const TemporaryFolder folder;
  const auto file = folder / "series.pvd";
  EXPECT_THAT(error_of([&] {
                write_series(file, {{1, "a.vtu"}, {0.5, "b.vtu"}, {1.0, "c.vtu"}});
              }),
              AllOf(HasSubstr("the entry 'c.vtu' has time 1, as has 'a.vtu'"),
                    HasSubstr("ParaView shows the first")));
  // Equal numbers, two texts in most programs.
  EXPECT_THAT(error_of([&] {
                write_series(file, {{0.0, "a.vtu"}, {-0.0, "b.vtu"}});
              }),
              HasSubstr("as has 'a.vtu'"));
  EXPECT_THAT(folder.names(), IsEmpty());
  write_series(file, {{-0.0, "a.vtu"}});
  EXPECT_THAT(read_text(file), HasSubstr("timestep=\"0\""));
}

TEST(Series, RefusesToReadWhatIsNotASeries) {
  const TemporaryFolder folder;
  const auto file = folder / "series.pvd";
  const auto error = [&](const std::string& collection, const std::string& type = "Collection") {
    put_text(file, "<VTKFile type=\"" + type + "\">" + collection + "</VTKFile>");
    return error_of([&] { read_series(file); });
  };
  EXPECT_EQ(error("<Collection/>"), "(no error)");
  EXPECT_THAT(error("<Collection/>", "ImageData"),
              HasSubstr("it is a grid (.vti), not a series (.pvd); give a series"));
  EXPECT_THAT(error(""), HasSubstr("is not a .pvd series"));
  EXPECT_THAT(error("<Collection><DataSet file='a'/></Collection>"),
              HasSubstr("entry 0 lacks its attribute 'timestep'"));
  EXPECT_THAT(error("<Collection><DataSet timestep='1'/></Collection>"),
              HasSubstr("entry 0 lacks its attribute 'file'"));
  for (const char* time : {" ", "soon", "1.5x", "nan", "inf", "1e999"}) {
    EXPECT_THAT(
        error("<Collection><DataSet timestep='" + std::string(time) + "' file='a'/></Collection>"),
        HasSubstr("entry 0 has timestep \"" + std::string(time) + "\", which is not a finite number"));
  }
  EXPECT_THAT(error("<Collection><DataSet></Collection>"),
              AllOf(HasSubstr("cannot be read"), HasSubstr("line 1")));
  EXPECT_THAT(error_of([&] { read_series(folder / "none.pvd"); }), HasSubstr("none.pvd: no such file"));
}

TEST(Series, RefusesAFileCutAnywhere) {
  const TemporaryFolder folder;
  write_series(folder / "whole.pvd", {{0, "a.vtu"}, {1, "b.vtu"}});
  const auto whole = read_text(folder / "whole.pvd");
  for (std::size_t length = 0; length < whole.find_last_not_of('\n') + 1; ++length) {
    put_text(folder / "cut.pvd", whole.substr(0, length));
    EXPECT_THAT(error_of([&] { read_series(folder / "cut.pvd"); }), HasSubstr("cut off")) << length;
  }
}

}  // namespace
}  // namespace tanktread::exchange::testing::series_test
