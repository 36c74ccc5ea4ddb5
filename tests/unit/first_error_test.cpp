// Which error of a step is said, of those that ranks have met.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "driver/system/first_error.hpp"

namespace tanktread::driver {
namespace {

TEST(FirstError, IsThatOfTheEarliestPhaseThenOfTheLowestPrecedence) {
  // In the order in which one rank would meet them.
  const std::vector<StepError> errors = {
      {StepPhase::correction, 9, false, ""}, {StepPhase::move, 8, false, ""},
      {StepPhase::forces, 6, false, ""},     {StepPhase::forces, 7, false, ""},
      {StepPhase::stencils, 0, false, ""},   {StepPhase::flow, 1, true, ""},
      {StepPhase::flow, 2, true, ""}};
  for (std::size_t a = 0; a < errors.size(); ++a)
    for (std::size_t b = 0; b < errors.size(); ++b)
      EXPECT_EQ(errors[a].is_before(errors[b]), a < b) << a << " and " << b;
}

TEST(FirstError, StaysAndNothingIsDoneAfterIt) {
  FirstError error;
  int n_done = 0;
  error.guard(StepPhase::move, [&] { ++n_done; });
  error.guard(StepPhase::forces, [] { throw CapsuleInverted("capsule 3: bad", 3); });
  error.guard(StepPhase::stencils, [&] { ++n_done; });
  FirstError later;
  later.guard(StepPhase::flow, [] { throw fluid::Breakdown("too fast", 5); });
  error.take(later);
  ASSERT_TRUE(error.error());
  EXPECT_EQ(error.error()->message, "capsule 3: bad");
  EXPECT_EQ(error.error()->precedence, 3);
  EXPECT_EQ(n_done, 1);
  ASSERT_TRUE(later.error());
  EXPECT_TRUE(later.error()->says_step);
  FirstError none;
  none.take(FirstError());
  EXPECT_FALSE(none.error());
  none.take(later);
  EXPECT_EQ(none.error()->precedence, 5);
}

TEST(FirstError, LetsThroughWhatNoStepMayEndWith) {
  FirstError error;
  EXPECT_THROW(error.guard(StepPhase::move, [] { throw std::logic_error("a fault of ours"); }),
               std::logic_error);
  EXPECT_FALSE(error.error());
}

TEST(FirstError, GoesFromRankToRank) {
  ranks::Packing packing;
  pack(packing, StepError{StepPhase::inside, 1, true, "where"});
  ranks::Unpacking unpacking(packing.take_bytes());
  const auto error = take_step_error(unpacking);
  EXPECT_EQ(error.phase, StepPhase::inside);
  EXPECT_EQ(error.precedence, 1);
  EXPECT_TRUE(error.says_step);
  EXPECT_EQ(error.message, "where");
}

}  // namespace
}  // namespace tanktread::driver
