// A reader that looks at a file all the time, while a writer in another process rewrites it, never sees half
// of it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "tests/unit/exchange_samples.hpp"

namespace tanktread::exchange::testing {
namespace {

/// Runs `write(k)` for k = 0 ... n-1 in a process of its own; alive() until it ends.
class Writer {
 public:
  Writer(int n, const std::function<void(int)>& write) : process_(::fork()) {
    if (process_ != 0) return;
    try {
      for (int k = 0; k < n; ++k) write(k);
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  ~Writer() {
    if (process_ > 0 && !ended_) ::waitpid(process_, &status_, 0);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  bool alive() {
    if (!ended_) ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
    return !ended_;
  }
  bool succeeded() const { return ended_ && WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  pid_t process_;
  int status_ = 0;
  bool ended_ = false;
};

/// A surface of its own size and numbers for each k, so that a mixture of two is seen; 1 MB so that writing
/// takes time.
SurfacePacket surface(int k) {
  SurfacePacket packet;
  const std::int64_t n_nodes = 20000 + 1000 * (k % 3);
  packet.points.assign(3 * n_nodes, k);
  packet.triangles = {0, 1, 2, n_nodes - 1, n_nodes - 2, n_nodes - 3};
  packet.point_data = {{"velocity", 3, std::vector<double>(3 * n_nodes, k)}};
  packet.field_data = {{"step", 1, {static_cast<double>(k)}}};
  return packet;
}

TEST(Polling, NeverSeesHalfASurface) {
  const TemporaryFolder folder;
  const auto file = folder / "surface.vtu";
  write_surface(file, surface(0));
  Writer writer(60, [&](int k) { write_surface(file, surface(k)); });
  int n_reads = 0, n_changes = 0, last = 0;
  while (writer.alive()) {
    const auto packet = read_surface(file);
    const auto step = static_cast<int>(find_array(packet.field_data, "step", file.string()).values.at(0));
    ASSERT_EQ(difference(packet, surface(step)), "");
    ++n_reads;
    n_changes += step != last ? 1 : 0;
    last = step;
  }
  EXPECT_TRUE(writer.succeeded());
  EXPECT_GT(n_reads, 3);
  EXPECT_GT(n_changes, 1) << "the reader never ran beside the writer";
  EXPECT_EQ(folder.names(), std::vector<std::string>{"surface.vtu"});
}

/// Reads a series that `write` makes, with the time 0.25 k in entry k, until its writer ends.
void expect_whole_series(int n, const std::function<void(const std::filesystem::path&, int)>& write) {
  const TemporaryFolder folder;
  const auto file = folder / "series.pvd";
  write_series(file, {});
  Writer writer(n, [&](int k) { write(file, k); });
  std::size_t last = 0;
  int n_changes = 0;
  while (writer.alive()) {
    const auto entries = read_series(file);
    ASSERT_GE(entries.size(), last);
    for (std::size_t k = 0; k < entries.size(); ++k)
      ASSERT_EQ(entries[k].time, 0.25 * static_cast<double>(k));
    n_changes += entries.size() != last ? 1 : 0;
    last = entries.size();
  }
  EXPECT_TRUE(writer.succeeded());
  EXPECT_EQ(read_series(file).size(), static_cast<std::size_t>(n));
  EXPECT_GT(n_changes, 1) << "the reader never ran beside the writer";
}

TEST(Polling, NeverSeesHalfASeries) {
  expect_whole_series(150, [](const auto& file, int k) {
    std::vector<SeriesEntry> entries;
    for (int i = 0; i <= k; ++i) entries.push_back({0.25 * i, "membrane/membrane.vtu"});
    write_series(file, entries);
  });
}

TEST(Polling, NeverSeesHalfAnEntryThatIsAdded) {
  // Entries of many lengths, so that they end at all places of a page and lie across two.
  expect_whole_series(500, [](const auto& file, int k) {
    if (k % 10 == 0) ::usleep(1000);  // in a folder in memory all else is done before the reader looks
    append_to_series(file, {0.25 * k, "membrane/" + std::string(1 + k % 89, 'm') + ".vtu"});
  });
}

}  // namespace
}  // namespace tanktread::exchange::testing
