// The series of a run, membrane.pvd and fluid.pvd: what each shows at which time, and after the run went on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "exchange/vtk_files.hpp"
#include "tests/integration/run_fixture.hpp"

namespace {

using namespace tanktread;
using namespace tanktread::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Membrane files are due at the steps 0, 60, 120 ..., fluid files at 0, 150, 300 ...
const std::vector<std::string> often_membrane = {"--set", "output.membrane_every=0.1", "--set",
                                                 "output.fluid_every=0.25"};
const std::vector<std::string> often_fluid = {"--set", "output.membrane_every=0.25", "--set",
                                              "output.fluid_every=0.1"};

class RunSeries : public Run {
 protected:
  std::vector<std::string> to(const char* shear_time, std::vector<std::string> more) const {
    more.insert(more.end(), {"--shear-time", shear_time});
    return more;
  }

  void run(const std::string& name, const std::vector<std::string>& more) const {
    const auto ended = run_program(run_to(name, more));
    ASSERT_EQ(ended.exit_code, 0) << ended.output;
  }

  Ended resume(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", "--resume", (directory_ / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  std::filesystem::path series(const std::string& name, const std::string& of) const {
    return directory_ / name / (of + ".pvd");
  }

  std::vector<double> times(const std::string& name, const std::string& of) const {
    std::vector<double> times;
    for (const auto& entry : exchange::read_series(series(name, of))) times.push_back(entry.time);
    return times;
  }

  /// What the file of an entry says of its own time.
  double own_time(const std::string& name, const exchange::SeriesEntry& entry) const {
    const auto file = directory_ / name / entry.file;
    const auto fields = file.extension() == ".vtu" ? exchange::read_surface(file).field_data
                                                   : exchange::read_grid(file).field_data;
    return exchange::find_array(fields, "shear_time", file.string()).values.at(0);
  }

  /// At every time at which either has a file both have an entry, which names the last file of that time.
  void expect_nothing_to_come(const std::string& name) const {
    std::vector<double> all;
    for (const char* of : {"membrane", "fluid"}) {
      for (const auto& entry : exchange::read_series(series(name, of))) all.push_back(own_time(name, entry));
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const char* of : {"membrane", "fluid"}) {
      EXPECT_EQ(times(name, of), all) << of;
      std::vector<double> own;
      for (const auto& entry : exchange::read_series(series(name, of))) own.push_back(own_time(name, entry));
      for (std::size_t k = 0; k < own.size(); ++k) {
        const auto later = std::ranges::upper_bound(own, all[k]);
        ASSERT_NE(later, own.begin());
        EXPECT_EQ(own[k], *(later - 1)) << of << " at " << all[k];
      }
    }
  }
};

TEST_F(RunSeries, NameTheirLastFileAgainWhereTheOtherHasOne) {
  run("a", to("0.55", often_membrane));
  expect_nothing_to_come("a");
  std::vector<std::string> files;
  for (const auto& entry : exchange::read_series(series("a", "fluid"))) files.push_back(entry.file.substr(6));
  EXPECT_THAT(files, ElementsAre("fluid_0000000000.vti", "fluid_0000000000.vti", "fluid_0000000000.vti",
                                 "fluid_0000000150.vti", "fluid_0000000150.vti", "fluid_0000000150.vti",
                                 "fluid_0000000300.vti", "fluid_0000000330.vti"));
  run("b", to("0.55", often_fluid));
  expect_nothing_to_come("b");
  run("c", {"--shear-time", "0.2", "--set", "output.fluid_every=0", "--set", "output.membrane_every=0.1"});
  EXPECT_EQ(times("c", "membrane").size(), 3U);
  EXPECT_EQ(times("c", "fluid").size(), 0U) << "a series without files names none";
}

TEST_F(RunSeries, KilledAndResumedEqualsUninterruptedWithMoreFluidFiles) {
  expect_killed_run_goes_on(often_fluid);
}

TEST_F(RunSeries, KilledAndResumedEqualsUninterruptedWithMoreMembraneFiles) {
  expect_killed_run_goes_on(often_membrane);
}

TEST_F(RunSeries, AnExtendedRunEqualsALongOne) {
  for (const auto& intervals : {often_membrane, often_fluid}) {
    // To an end off both schedules, on the one, on the other.
    run("long", to("0.6", intervals));
    for (const char* end : {"0.12", "0.2", "0.25"}) {
      run("short", to(end, intervals));
      const auto ended = resume("short", {"--shear-time", "0.6"});
      ASSERT_EQ(ended.exit_code, 0) << ended.output;
      EXPECT_THAT(ended.output, Not(HasSubstr("note:")));
      expect_same_results("long", "short");
      std::filesystem::remove_all(directory_ / "short");
    }
    std::filesystem::remove_all(directory_ / "long");
  }
}

TEST_F(RunSeries, WithOtherIntervalsKeepsWhatThereIsAndNamesNoTimeTwice) {
  run("a", to("0.3", often_membrane));
  const auto before = exchange::read_series(series("a", "membrane"));
  auto echo = read_file(directory_ / "a/echo.toml");
  const auto replace = [&](const std::string& key, const std::string& value) {
    const auto begin = echo.find(key);
    ASSERT_NE(begin, std::string::npos);
    echo.replace(begin, echo.find('\n', begin) - begin, key + " = " + value);
  };
  replace("membrane_every", "0.15");
  replace("fluid_every", "0.05");
  std::ofstream(directory_ / "a/echo.toml") << echo;
  const auto ended = resume("a", {"--shear-time", "0.5"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  expect_nothing_to_come("a");
  const auto after = exchange::read_series(series("a", "membrane"));
  ASSERT_GT(after.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(after[k].time, before[k].time);
    EXPECT_EQ(after[k].file, before[k].file);
  }
}

TEST_F(RunSeries, IsMadeAnewFromItsFilesIfItCannotBeRead) {
  run("whole", to("0.4", often_membrane));
  run("cut", to("0.3", often_membrane));
  // As a process that was killed inside its write leaves it, and as a person does.
  const auto text = read_file(series("cut", "fluid"));
  std::ofstream(series("cut", "fluid"), std::ios::binary) << text.substr(0, text.size() - 40);
  std::filesystem::remove(series("cut", "membrane"));
  const auto ended = resume("cut", {"--shear-time", "0.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("note: " + series("cut", "fluid").string() + ": does not end with"),
                    HasSubstr("note: " + series("cut", "membrane").string() + ": no such file"),
                    HasSubstr("the series is made anew from the files that are there")));
  expect_same_results("whole", "cut");
}

TEST_F(RunSeries, LeavesOutFilesThatAreGoneAndLeavesFilesOfOthers) {
  run("a", to("0.3", often_membrane));
  std::filesystem::remove(directory_ / "a/membrane/membrane_0000000060.vtu");
  std::ofstream(directory_ / "a/membrane/membrane_0000000060_smooth.vtu") << "mine";
  std::ofstream(directory_ / "a/membrane/.membrane_0000000060.vtu.1-2.tmp") << "half";
  const auto ended = resume("a", {"--shear-time", "0.4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("membrane.pvd: an entry names a file that is not there"));
  expect_nothing_to_come("a");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "a/membrane/membrane_0000000060_smooth.vtu"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "a/membrane/.membrane_0000000060.vtu.1-2.tmp"));
}

TEST_F(RunSeries, RefusesASeriesThatNamesWhatIsNotOfTheRun) {
  run("a", to("0.2", often_membrane));
  exchange::append_to_series(series("a", "fluid"), {9, "mine.vti"});
  const auto before = result_files(directory_ / "a");
  const auto ended = resume("a", {"--shear-time", "0.4"});
  EXPECT_NE(ended.exit_code, 0);
  EXPECT_THAT(ended.output, HasSubstr("fluid.pvd: entry mine.vti is not of this run; remove it"));
  for (const auto& after : result_files(directory_ / "a")) {
    const auto same = std::ranges::any_of(before, [&](const auto& file) {
      return file.first == after.first && (file.second == after.second || !after.first.ends_with(".pvd"));
    });
    EXPECT_TRUE(same) << after.first;
  }
}

}  // namespace
