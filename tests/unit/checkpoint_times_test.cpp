// When checkpoints are due: by steps, by minutes, at the end.
#include <gtest/gtest.h>

#include <vector>

#include "driver/run/checkpoint_times.hpp"

namespace tanktread::driver {
namespace {

/// The steps after which one was due, of steps and of checkpoints that take so many seconds each.
std::vector<std::int64_t> due_steps(CheckpointTimes times, std::int64_t last_step, double of_step,
                                    double of_checkpoint = 0) {
  std::vector<std::int64_t> steps;
  double now = 0;
  for (std::int64_t step = 1; step <= last_step; ++step) {
    now += of_step;
    if (!times.due(step, now)) continue;
    steps.push_back(step);
    now += of_checkpoint;
    times.wrote(now);
  }
  return steps;
}

TEST(CheckpointTimes, go_by_steps_alone_without_minutes) {
  EXPECT_EQ(due_steps({Schedule{4}, 10, 0}, 10, 1000.0), (std::vector<std::int64_t>{4, 8, 10}));
}

// Steps of 50 s, at most 2 minutes: after three steps since the last one, whatever was the reason for that.
TEST(CheckpointTimes, go_by_minutes_since_the_last) {
  EXPECT_EQ(due_steps({Schedule{100}, 10, 2}, 10, 50.0), (std::vector<std::int64_t>{3, 6, 9, 10}));
  EXPECT_EQ(due_steps({Schedule{4}, 10, 2}, 10, 50.0), (std::vector<std::int64_t>{3, 4, 7, 8, 10}));
}

// Writing takes longer than the minutes between two: there are steps between them all the same.
TEST(CheckpointTimes, count_minutes_from_the_end_of_writing) {
  EXPECT_EQ(due_steps({Schedule{100}, 10, 2}, 10, 50.0, 500.0), (std::vector<std::int64_t>{3, 6, 9, 10}));
}

}  // namespace
}  // namespace tanktread::driver
