// The fuzzers' entries by themselves, without a fuzzer: every seed is read, whole, cut off and with bytes
// changed.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/fuzz/seeds.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

using namespace tanktread::fuzz;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& one : targets()) all.emplace_back(one.name);
  return all;
}

class Seeds : public ::testing::TestWithParam<std::string> {
 protected:
  void read(const std::string& input) { EXPECT_NO_THROW(target(GetParam()).read(input)) << input; }
};

TEST_P(Seeds, AreReadOrRefused) {
  const auto all = seeds(GetParam());
  ASSERT_FALSE(all.empty());
  for (const auto& seed : all) read(seed);
}

TEST_P(Seeds, AreReadOrRefusedWhenCutOff) {
  for (const auto& seed : seeds(GetParam())) {
    for (std::size_t part = 0; part < 8; ++part) read(seed.substr(0, part * seed.size() / 8));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Seeds, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

}  // namespace
