// Adding to a series (.pvd): as if it were written whole, at the same cost however long it is, and whole
// whatever happens.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "tests/unit/exchange_full_disk.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::string_view closing = "  </Collection>\n</VTKFile>\n";

SeriesEntry entry_of(int k) {
  return {k / 3.0, "membrane/membrane_" + std::to_string(k) + ".vtu"};
}

ino_t number_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(::stat(file.c_str(), &status), 0);
  return status.st_ino;
}

/// What write_series makes of the entries.
std::string written_whole(const std::vector<SeriesEntry>& entries) {
  const TemporaryFolder folder;
  write_series(folder / "series.pvd", entries);
  return read_text(folder / "series.pvd");
}

class Append : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "series.pvd";
};

TEST_F(Append, EqualsTheWholeSeriesByteForByte) {
  const std::vector<std::string> names = {"a & b.vtu", "<a>\"b\"'c'.vtu", "tab\tline\nreturn\r", "]]>--%20#?",
                                          std::string(3000, '&')};
  std::vector<SeriesEntry> entries;
  write_series(file_, entries);
  for (const auto& name : names) {
    entries.push_back({static_cast<double>(entries.size()) - 1, name});
    append_to_series(file_, entries.back());
    EXPECT_EQ(read_text(file_), written_whole(entries)) << name;
  }
}

TEST_F(Append, WritesTheNewEntryAndTheClosingTagsOnly) {
  constexpr int n_entries = 1000;
  std::vector<SeriesEntry> entries;
  write_series(file_, {});
  const auto number = number_of(file_);
  for (int k = 0; k < n_entries; ++k) {
    entries.push_back(entry_of(k));
    append_to_series(file_, entries.back());
    // A file that is written anew is another one.
    ASSERT_EQ(number_of(file_), number) << k;
  }
  EXPECT_EQ(read_text(file_), written_whole(entries));
  EXPECT_THAT(folder_.names(), ElementsAre("series.pvd"));
  // What is before the end is not even looked at: a byte there that no series has stays.
  auto text = read_text(file_);
  text[text.find("membrane_0")] = '<';
  put_text(file_, text);
  append_to_series(file_, entry_of(n_entries));
  EXPECT_THAT(read_text(file_), StartsWith(text.substr(0, text.size() - closing.size())));
  EXPECT_THAT(error_of([&] { read_series(file_); }), HasSubstr("cannot be read"));
}

TEST_F(Append, KeepsWhatAnotherProgramOrAPersonWrote) {
  put_text(
      file_,
      "<VTKFile type='Collection'><Collection><DataSet timestep='0.5' file='a.vtu'/></Collection></VTKFile>");
  append_to_series(file_, {1, "b.vtu"});
  EXPECT_EQ(read_text(file_), written_whole({{0.5, "a.vtu"}, {1, "b.vtu"}}));
  auto text = read_text(file_);
  text.insert(text.size() - closing.size(), "  <!-- mine -->\n");
  put_text(file_, text);
  append_to_series(file_, {2, "c.vtu"});
  EXPECT_EQ(read_text(file_), written_whole({{0.5, "a.vtu"}, {1, "b.vtu"}, {2, "c.vtu"}}));
}

TEST_F(Append, RefusesATimeThatIsNotLater) {
  const auto error = [&](double time) {
    return error_of([&] { append_to_series(file_, {time, "new.vtu"}); });
  };
  for (const char* quotes : {"\"", "'"}) {  // in place, and written anew
    put_text(file_, written_whole({{0.5, "a.vtu"}}));
    auto text = read_text(file_);
    if (*quotes == '\'') text = text.replace(text.find("\"0.5\""), 5, "'0.5'");
    put_text(file_, text);
    for (const double time : {0.5, 0.25})
      EXPECT_THAT(error(time),
                  HasSubstr("the entry 'new.vtu' has time " + std::string(time == 0.5 ? "0.5" : "0.25") +
                            ", and the one before it 0.5"));
    EXPECT_EQ(read_text(file_), text);
  }
}

TEST_F(Append, RefusesWhatXmlCannotHold) {
  write_series(file_, {{0, "a.vtu"}});
  const auto before = read_text(file_);
  const auto error = [&](const SeriesEntry& entry) {
    return error_of([&] { append_to_series(file_, entry); });
  };
  EXPECT_THAT(error({std::numeric_limits<double>::quiet_NaN(), "b.vtu"}), HasSubstr("not finite"));
  EXPECT_THAT(error({1, std::string("a\x01") + "b.vtu"}), HasSubstr("cannot be"));
  EXPECT_THAT(error({1, "a\xff.vtu"}), HasSubstr("cannot be"));
  EXPECT_EQ(read_text(file_), before);
}

TEST_F(Append, RefusesAFileThatIsCutOrNotThere) {
  EXPECT_THAT(error_of([&] {
                append_to_series(file_, {1, "b.vtu"});
              }),
              HasSubstr("series.pvd: cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(file_));
  const auto whole = written_whole({{0, "a.vtu"}});
  for (const auto length :
       {std::size_t{0}, std::size_t{10}, whole.size() - 5, whole.size() - closing.size()}) {
    put_text(file_, whole.substr(0, length));
    EXPECT_THAT(error_of([&] { append_to_series(file_, {1, "b.vtu"}); }), HasSubstr("cut off")) << length;
    EXPECT_EQ(read_text(file_), whole.substr(0, length));
  }
}

TEST_F(Append, OnAFullDiskKeepsTheOldFile) {
  const auto before = written_whole({{0, "a.vtu"}}), after = written_whole({{0, "a.vtu"}, {1, "b.vtu"}});
  // The limit lets a part of the line be written, from none of it to all but the last byte.
  for (std::size_t room = before.size(); room < after.size(); ++room) {
    put_text(file_, before);
    std::string message;
    {
      const FullDisk full(room);
      message = message_of([&] { append_to_series(file_, {1, "b.vtu"}); });
    }
    EXPECT_THAT(message, HasSubstr("series.pvd: cannot be written: ")) << room;
    EXPECT_EQ(read_text(file_), before) << room;
    EXPECT_THAT(folder_.names(), ElementsAre("series.pvd"));
  }
  const FullDisk full(after.size());
  append_to_series(file_, {1, "b.vtu"});
  EXPECT_EQ(read_text(file_), after);
}

TEST_F(Append, DoesNotChangeAFileUnderAReaderOfOurs) {
  write_series(file_, {{0, "a.vtu"}});
  const auto before = read_text(file_);
  const int reader = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(reader, LOCK_SH), 0);  // as read_series does while it reads
  append_to_series(file_, {1, "b.vtu"});
  std::string seen(before.size() + 1, '\0');
  seen.resize(static_cast<std::size_t>(::read(reader, seen.data(), seen.size())));
  ::close(reader);
  EXPECT_EQ(seen, before);
  EXPECT_EQ(read_series(file_).size(), 2U);
}

}  // namespace
}  // namespace tanktread::exchange::testing
