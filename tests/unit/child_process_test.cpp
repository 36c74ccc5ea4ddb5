// A program asked line by line: what it may do, and what is said of what it may not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>

#include "driver/outside/child_process.hpp"
#include "tests/integration/program.hpp"

namespace {

using tanktread::driver::ChildProcess;
using tanktread::driver::NoAnswer;
using tanktread::testing::read_file;
using tanktread::testing::TemporaryDirectory;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

std::vector<std::string> shell(const std::string& script, const std::string& argument = "") {
  return {"sh", "-c", script, "sh", argument};
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What is said when the program is asked.
std::string complaint(ChildProcess& process) {
  try {
    return "answered " + process.ask("question");
  } catch (const NoAnswer& error) {
    return error.what();
  }
}

std::string complaint(const std::string& script, double seconds = 60) {
  ChildProcess process(shell(script), seconds);
  return complaint(process);
}

TEST(ChildProcess, AnswersLineByLine) {
  ChildProcess process(shell("while read -r line; do echo \"<$line>\"; done"), 60);
  EXPECT_EQ(process.ask("one"), "<one>");
  EXPECT_EQ(process.ask("a  b\\"), "<a  b\\>");
  EXPECT_EQ(process.ask(""), "<>");
}

TEST(ChildProcess, ALineMayComeInPiecesAndWithACarriageReturn) {
  EXPECT_EQ(complaint("read x; printf a; sleep 0.1; printf 'b\\r\\n'; read x"), "answered ab");
}

TEST(ChildProcess, AProgramThatDoesNotReadIsGivenUpInTime) {
  // A megabyte, far more than a pipe holds.
  ChildProcess process(shell("sleep 60"), 0.3);
  const auto start = Clock::now();
  EXPECT_THROW(process.ask(std::string(1 << 20, 'x')), NoAnswer);
  EXPECT_LT(seconds_since(start), 30);
}

TEST(ChildProcess, SaysHowAProgramEnded) {
  EXPECT_EQ(complaint("exit 0"), "it ended with exit code 0 and gave no answer");
  EXPECT_EQ(complaint("read x; exit 7"), "it ended with exit code 7 and gave no answer");
  EXPECT_EQ(complaint("read x; printf half; exit 7"), "it ended with exit code 7 and gave no answer");
  EXPECT_THAT(complaint("read x; kill -9 $$"), HasSubstr("it was ended by signal 9 (Killed)"));
}

TEST(ChildProcess, ABrokenPipeDoesNotEndUs) {
  // It no longer reads when it is asked again, and SIGPIPE would end this test.
  ChildProcess process(shell("read x; echo y; exec <&-; sleep 0.5; exit 7"), 60);
  EXPECT_EQ(process.ask("one"), "y");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(complaint(process), "it ended with exit code 7 and gave no answer");
}

TEST(ChildProcess, IsKilledWhenItDoesNotAnswerInTimeWithAllThatItStarted) {
  const TemporaryDirectory folder;
  const auto start = Clock::now();
  {
    ChildProcess process(shell("read x; (sleep 1; echo late > \"$1\") & wait", folder / "late"), 0.2);
    EXPECT_EQ(complaint(process), "it gave no answer within 0.2 s (run.command_time_limit) and was killed");
  }
  EXPECT_LT(seconds_since(start), 0.9) << "it was waited for";
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_FALSE(std::filesystem::exists(folder / "late")) << "what it had started went on";
}

TEST(ChildProcess, StandardOutputIsForAnswersOnly) {
  EXPECT_THAT(complaint("read x; printf 'one\\ntwo\\n'; read x"),
              HasSubstr("with more than one line, 'one...'"));
  const auto start = Clock::now();
  EXPECT_THAT(complaint("read x; while :; do printf xxxxxxxxxxxxxxxx; done"),
              HasSubstr("xxx...' and no end of a line"));
  EXPECT_LT(seconds_since(start), 30) << "what is of no use is not waited for";
  ChildProcess process(shell("echo hello; read x; echo y"), 60);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_THAT(complaint(process),
              HasSubstr("it wrote 'hello...' to its standard output before it was asked"));
}

TEST(ChildProcess, EndsByItselfWhenItsInputIsClosed) {
  const TemporaryDirectory folder;
  ::testing::internal::CaptureStderr();
  { ChildProcess process(shell("while read -r x; do :; done; echo done > \"$1\"", folder / "end"), 60); }
  EXPECT_EQ(read_file(folder / "end"), "done\n");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ChildProcess, IsKilledWhenItDoesNotEnd) {
  ::testing::internal::CaptureStderr();
  const auto start = Clock::now();
  { ChildProcess process(shell("sleep 30"), 0.2); }
  EXPECT_LT(seconds_since(start), 20);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("did not end within 0.2 s"));
}

// What mpirun tells a rank by is not for a program that the rank starts; all else is.
TEST(ChildProcess, HasOurEnvironmentWithoutThatOfMpirun) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "OMPI_MCA_btl"})
    ::setenv(name, "3", 1);
  ChildProcess process(
      shell("read line; echo \"${OMPI_COMM_WORLD_SIZE-none} ${PMIX_RANK-none} ${PMI_RANK-none} "
            "${OMPI_MCA_btl-none}\""),
      60);
  EXPECT_EQ(process.ask("question"), "none none none 3");
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "OMPI_MCA_btl"}) ::unsetenv(name);
}

TEST(ChildProcess, CannotBeStarted) {
  EXPECT_THROW(ChildProcess({"no-such-program"}, 1), std::system_error);
}

TEST(ChildProcess, IsOutOfTheReachOfTheKeyboard) {
  // Ctrl-C goes to the process group at the terminal, ours.
  ChildProcess process(shell("read x; cut -d' ' -f5 /proc/$$/stat; read x"), 60);
  EXPECT_NE(process.ask(""), std::to_string(getpgrp()));
}

}  // namespace
