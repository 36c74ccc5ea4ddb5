// GoogleTest on every rank: each runs all tests, and the program fails if one of them does. Only the first
// rank says what passed.
#include <gtest/gtest.h>

#include "tests/ranks/world.hpp"

namespace {

/// Prints nothing but failures, with the rank.
class OnlyFailures final : public testing::EmptyTestEventListener {
 public:
  explicit OnlyFailures(int rank) : rank_(rank) {}
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, result.file_name() ? result.file_name() : "",
                 result.line_number(), result.summary());
  }

 private:
  int rank_;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  tanktread::ranks::World world(&argc, &argv);
  tanktread::ranks::test::all_ranks = &world;
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (!world.is_first()) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new OnlyFailures(world.rank()));
  } else {
    std::printf("%d ranks, %s\n", world.size(), tanktread::ranks::World::library());
  }
  const int failed = RUN_ALL_TESTS();
  return world.highest(failed) > 0 ? 1 : 0;
}
