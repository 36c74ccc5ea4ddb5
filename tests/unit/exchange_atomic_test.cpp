// Writing that fails leaves the old file, no temporary one, and an error that says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "exchange/atomic_file.hpp"
#include "tests/unit/exchange_full_disk.hpp"
#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Kind {
  std::string name;
  std::function<void(const std::filesystem::path&)> write;
};

/// Each writer, with enough to write that no buffer holds it all; the grid of several of VTK's blocks.
std::vector<Kind> kinds() {
  auto grid = sample_grid();
  grid.nodes = {40, 30, 2};
  grid.point_data = {{"populations", 19, awkward_numbers(19 * 2400, 0)}};
  return {{"surface.vtu", [](const auto& file) { write_surface(file, sample_surface()); }},
          {"grid.vti", [grid](const auto& file) { write_grid(file, grid); }},
          {"series.pvd",
           [](const auto& file) {
             std::vector<SeriesEntry> entries;
             for (int k = 0; k < 100; ++k) entries.push_back({1.0 * k, "a.vtu"});
             write_series(file, entries);
           }},
          {"text.toml", [](const auto& file) { write_text(file, std::string(20000, 'x')); }}};
}

TEST(Writing, LeavesOneFileAndNothingElse) {
  const TemporaryFolder folder;
  for (const auto& kind : kinds()) kind.write(folder / kind.name);
  EXPECT_THAT(folder.names(), ElementsAre("grid.vti", "series.pvd", "surface.vtu", "text.toml"));
  EXPECT_EQ(read_text(folder / "text.toml"), std::string(20000, 'x'));
}

TEST(Writing, ReplacesAFileThatIsThere) {
  const TemporaryFolder folder;
  for (const auto& kind : kinds()) {
    kind.write(folder / kind.name);
    const auto expected = read_text(folder / kind.name);
    put_text(folder / kind.name, "old");
    kind.write(folder / kind.name);
    EXPECT_TRUE(read_text(folder / kind.name) == expected) << kind.name;
  }
}

TEST(Writing, OnAFullDiskKeepsTheOldFile) {
  for (const auto& kind : kinds()) {
    std::uintmax_t size = 0;
    {
      const TemporaryFolder folder;
      kind.write(folder / kind.name);
      size = std::filesystem::file_size(folder / kind.name);
    }
    // Full at once, on the way, and just before the last byte, which is still in a buffer when the file is
    // closed.
    for (const std::size_t room : {std::size_t{0}, size / 3, size / 2, size - 1}) {
      const TemporaryFolder folder;
      put_text(folder / kind.name, "old");
      std::string message;
      {
        const FullDisk full(room);
        message = message_of([&] { kind.write(folder / kind.name); });
      }
      // Why, in the system's words: of this limit EFBIG, of a full disk ENOSPC.
      EXPECT_THAT(message, HasSubstr(kind.name + ": cannot be written: File too large"))
          << room << " of " << size;
      EXPECT_EQ(read_text(folder / kind.name), "old") << kind.name << ", " << room << " of " << size;
      EXPECT_THAT(folder.names(), ElementsAre(kind.name)) << room << " of " << size;
    }
    const TemporaryFolder folder;
    const FullDisk full(size);
    EXPECT_EQ(message_of([&] { kind.write(folder / kind.name); }), "(no error)") << kind.name;
  }
}

TEST(Writing, WhereNothingCanBeWritten) {
  for (const auto& kind : kinds()) {
    // Not even root may make files there.
    EXPECT_THAT(error_of([&] { kind.write("/proc/self/" + kind.name); }),
                HasSubstr("/proc/self/" + kind.name + ": cannot be written: "))
        << kind.name;
  }
}

TEST(Writing, WhereThereIsNoFolder) {
  const TemporaryFolder folder;
  for (const auto& kind : kinds()) {
    const auto message = error_of([&] { kind.write((folder / "none") / kind.name); });
    EXPECT_THAT(message, AllOf(HasSubstr(kind.name + ": cannot be written: there is no folder '"),
                               HasSubstr("make it")));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Writing, WhereAFolderHasTheName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken");
  for (const auto& kind : kinds()) {
    EXPECT_THAT(error_of([&] { kind.write(folder / "taken"); }),
                HasSubstr("taken: cannot be written: it is a folder"));
  }
  EXPECT_THAT(folder.names(), ElementsAre("taken"));
}

TEST(Writing, WhereADeviceOrAPipeHasTheName) {
  const TemporaryFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& kind : kinds()) {
    EXPECT_THAT(error_of([&] { kind.write(pipe); }),
                HasSubstr("pipe: cannot be written: it is a device or a pipe; give the name of a file"));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::filesystem::create_symlink("pipe", folder / "link");
  EXPECT_THAT(error_of([&] { write_text(folder / "link", ""); }),
              HasSubstr("link: cannot be written: it is a device"));
  EXPECT_THAT(folder.names(), ElementsAre("link", "pipe"));
}

TEST(Writing, ThroughALinkGoesToTheFileBehindIt) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  const auto link = folder / "link", file = folder / "elsewhere" / "file";
  std::filesystem::create_symlink("elsewhere/file", link);
  for (const auto& kind : kinds()) {
    std::filesystem::remove(file);
    EXPECT_THAT(
        error_of([&] { kind.write(link); }),
        HasSubstr("link: cannot be written: it is a link to a file that is not there; give another name"));
    put_text(file, "old");
    kind.write(link);
    EXPECT_NE(read_text(file), "old") << kind.name;
    EXPECT_TRUE(std::filesystem::is_symlink(link)) << kind.name;
  }
  EXPECT_THAT(folder.names(), ElementsAre("elsewhere", "link"));
}

TEST(Writing, IntoTheFolderOneIsIn) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  for (const auto& kind : kinds()) EXPECT_EQ(message_of([&] { kind.write(kind.name); }), "(no error)");
  std::filesystem::current_path(before);
  EXPECT_EQ(folder.names().size(), kinds().size());
}

TEST(Writing, GivesTheRightsThatTheUserAsksFor) {
  const TemporaryFolder folder;
  const auto old = ::umask(027);
  for (const auto& kind : kinds()) kind.write(folder / kind.name);
  ::umask(old);
  for (const auto& kind : kinds()) {
    EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(folder / kind.name).permissions()), 0640U)
        << kind.name;
  }
}

TEST(AddedText, IsThereWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const auto file = folder / "table.csv";
  EXPECT_THAT(error_of([&] { append_text(file, "row\n"); }), HasSubstr("No such file"));
  write_text(file, "header\n");
  append_text(file, "0,1\n1,2\n");
  EXPECT_EQ(read_text(file), "header\n0,1\n1,2\n");
  {
    const FullDisk disk(18);  // room for half of the next row
    EXPECT_THAT(error_of([&] { append_text(file, "2,3\n"); }), HasSubstr("table.csv: cannot be written"));
  }
  EXPECT_EQ(read_text(file), "header\n0,1\n1,2\n");
  append_text(file, "2,3\n");
  EXPECT_EQ(read_text(file), "header\n0,1\n1,2\n2,3\n");
}

}  // namespace
}  // namespace tanktread::exchange::testing
