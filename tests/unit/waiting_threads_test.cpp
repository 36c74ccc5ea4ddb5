// When a program takes its cores for shared with others.
#include "driver/program/waiting_threads.hpp"

#include <gtest/gtest.h>

namespace {

using tanktread::driver::SharedCores;

/// Two threads observed ten times a second.
class Observed : public ::testing::Test {
 protected:
  /// Goes on by a tenth of a second in which both threads ran or waited for a core.
  bool goes_on(double share_waited) {
    run_ += 0.2 * (1 - share_waited);
    waited_ += 0.2 * share_waited;
    return cores_.observe(run_, waited_);
  }

  void shares() {
    for (int k = 1; k < 5; ++k) ASSERT_FALSE(goes_on(0.5)) << k;
    ASSERT_TRUE(goes_on(0.5));
  }

  SharedCores cores_;
  double run_ = 0, waited_ = 0;
};

TEST_F(Observed, ThreadsThatRunHaveTheirCores) {
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(goes_on(0.09)) << k;
}

TEST_F(Observed, ThreadsThatWaitFiveTimesInARowShareThem) {
  for (int k = 1; k < 5; ++k) EXPECT_FALSE(goes_on(0.11)) << k;
  EXPECT_FALSE(goes_on(0));
  for (int k = 1; k < 5; ++k) EXPECT_FALSE(goes_on(0.11)) << k;
  EXPECT_TRUE(goes_on(0.11));
}

TEST_F(Observed, TheyAreFreeAfterFiveQuietTimesInARow) {
  shares();
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(goes_on(0)) << k;
  EXPECT_TRUE(goes_on(0.5));
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(goes_on(0)) << k;
  EXPECT_FALSE(goes_on(0));
}

TEST_F(Observed, AreTakenForFreeOnTrialMoreAndMoreSeldom) {
  shares();
  for (const int n_until_trial : {10, 20, 40, 40}) {
    for (int k = 1; k < n_until_trial; ++k) ASSERT_TRUE(goes_on(0.5)) << k << " of " << n_until_trial;
    EXPECT_FALSE(goes_on(0.5)) << n_until_trial;  // on trial
    EXPECT_FALSE(goes_on(0.5));
    EXPECT_TRUE(goes_on(0.5));
  }
  // Once they have been free for a second all begins anew.
  for (int k = 0; k < 20; ++k) goes_on(0);
  shares();
  for (int k = 1; k < 10; ++k) ASSERT_TRUE(goes_on(0.5)) << k;
  EXPECT_FALSE(goes_on(0.5));
}

TEST_F(Observed, TimesWithoutWorkSayNothing) {
  shares();
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(cores_.observe(run_, waited_));  // it waits for a file
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(goes_on(0)) << k;
  EXPECT_FALSE(goes_on(0));
  for (int k = 1; k < 5; ++k) {  // a thread that wakes for a moment
    run_ += 0.001;
    waited_ += 0.01;
    EXPECT_FALSE(cores_.observe(run_, waited_));
  }
}

TEST_F(Observed, ThreadsThatEndTakeTheirTimesWithThem) {
  EXPECT_FALSE(goes_on(0));
  EXPECT_FALSE(cores_.observe(0.5 * run_, 0));
  EXPECT_FALSE(cores_.observe(run_, 0));
}

}  // namespace
