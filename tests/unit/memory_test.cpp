// What memory there is, from files like those of a system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "driver/program/errors.hpp"
#include "driver/program/memory.hpp"
#include "tests/integration/program.hpp"

namespace {

using namespace tanktread::driver;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Memory : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) const {
    const auto file = root_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  double available() const { return available_memory_bytes(root_.path()); }

  TemporaryDirectory root_;
  static constexpr const char* meminfo = "MemTotal:  4000 kB\nMemFree:  100 kB\nMemAvailable:  2000 kB\n";
};

TEST_F(Memory, IsWhatTheSystemCallsAvailable) {
  EXPECT_EQ(available(), std::numeric_limits<double>::infinity());  // which says nothing
  put("proc/meminfo", meminfo);
  EXPECT_EQ(available(), 2000 * 1024);
  // And here there is some.
  EXPECT_GT(available_memory_bytes(), 1e6);
}

TEST_F(Memory, EndsAtTheLimitOfAControlGroupOfVersion2) {
  put("proc/meminfo", meminfo);
  put("proc/self/cgroup", "0::/job/step\n");
  put("sys/fs/cgroup/job/step/memory.max", "max\n");
  put("sys/fs/cgroup/job/step/memory.current", "1000\n");
  EXPECT_EQ(available(), 2000 * 1024);
  // A group that it lies in has a limit; its cache can be dropped.
  put("sys/fs/cgroup/job/memory.max", "50000\n");
  put("sys/fs/cgroup/job/memory.current", "30000\n");
  put("sys/fs/cgroup/job/memory.stat", "anon 20000\ninactive_file 10000\n");
  EXPECT_EQ(available(), 30000);
  // Of a container the mount itself.
  put("sys/fs/cgroup/memory.max", "500\n");
  put("sys/fs/cgroup/memory.current", "700\n");
  EXPECT_EQ(available(), 0);
}

TEST_F(Memory, EndsAtTheLimitOfAControlGroupOfVersion1) {
  put("proc/meminfo", meminfo);
  put("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/job\n0::/\n");
  put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "90000\n");
  put("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "40000\n");
  put("sys/fs/cgroup/memory/job/memory.stat", "inactive_file 1\ntotal_inactive_file 3000\n");
  EXPECT_EQ(available(), 53000);
}

TEST_F(Memory, WhatItCannotHoldIsRefused) {
  EXPECT_NO_THROW(require_memory(1e9, "case.toml: flow.box", 1e9));
  try {
    require_memory(2.5e9, "case.toml: flow.box", 1e9);
    ADD_FAILURE() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("case.toml: flow.box: needs about 2.50 GB of memory"),
                                    HasSubstr("1.00 GB are available"), HasSubstr("make it smaller")));
  }
}

}  // namespace
