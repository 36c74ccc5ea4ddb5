// Numbers on the command line: decimal, bounded, and by one helper for all commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "driver/command_line.hpp"
#include "driver/program/errors.hpp"
#include "driver/program/number_option.hpp"

namespace number_option_test {
namespace {

using namespace tanktread::driver;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Parses in the way of main(); the message of an InputError, else "".
std::string refusal(CLI::App& app, std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    app.parse(arguments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <class Target>
std::string refusal_of(Target& target, const NumberRange& range, std::vector<std::string> arguments) {
  CLI::App app;
  add_number(app, "--n", target, "", range);
  return refusal(app, std::move(arguments));
}

TEST(NumberOption, IntegersAreDecimal) {
  const std::vector<std::pair<std::string, std::int64_t>> all = {
      {"0000000100", 100},       {"010", 10}, {"08", 8}, {"0", 0}, {"+5", 5}, {"-7", -7},
      {"9999999999", 9999999999}};
  for (const auto& [text, value] : all) {
    std::int64_t number = -1;
    EXPECT_EQ(refusal_of(number, between(-10, 9999999999), {"--n", text}), "");
    EXPECT_EQ(number, value) << text;
  }
}

TEST(NumberOption, WhatIsNoIntegerIsRefusedWithOptionValueAndRange) {
  for (const std::string text : {"0x10", "1e5", "1.5", "8'", "1,5", "eight", "nan", "inf", " 5", "5 ", "+-5",
                                 "++5", "-1", "101", "99999999999999999999", "-99999999999999999999"}) {
    int number = 3;
    EXPECT_EQ(refusal_of(number, between(0, 100), {"--n=" + text}),
              "--n " + text + ": must be an integer in decimal digits >= 0 and <= 100");
    EXPECT_EQ(number, 3) << text;
  }
}

TEST(NumberOption, WhatIsNoNumberIsRefusedWithOptionValueAndFix) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"3,5", "is no number; write 3.5"},
      {"0x1p3", "is no number; must be a number > 0"},
      {"3.5m", "is no number; must be a number > 0"},
      {"1,000,000", "is no number; must be a number > 0"},
      {"nan", "is not finite; must be a number > 0"},
      {"-inf", "is not finite; must be a number > 0"},
      {"1e999", "is beyond what a number of double precision holds; must be a number > 0"},
      {"0", "must be a number > 0"},
      {"-2.5", "must be a number > 0"},
  };
  for (const auto& [text, message] : all) {
    double number = 3;
    EXPECT_EQ(refusal_of(number, positive(), {"--n=" + text}), "--n " + text + ": " + message);
    EXPECT_EQ(number, 3) << text;
  }
  double number = 0;
  EXPECT_EQ(refusal_of(number, positive(), {"--n", "+1.5e-3"}), "");
  EXPECT_EQ(number, 1.5e-3);
}

TEST(NumberOption, Lists) {
  std::vector<double> many;
  EXPECT_EQ(refusal_of(many, {}, {"--n", "1", "-2.5", "3e2"}), "");
  EXPECT_THAT(many, ElementsAre(1, -2.5, 300));
  EXPECT_EQ(refusal_of(many, {}, {"--n", "1,5"}), "--n 1,5: is no number; write 1.5, or 1 5 for two values");
  EXPECT_EQ(refusal_of(many, {}, {"--n", "1,5,7"}), "--n 1,5,7: is no number; separate values by spaces");
  std::array<double, 3> three = {0, 0, 0};
  EXPECT_EQ(refusal_of(three, {}, {"--n", "1", "-2", "3"}), "");
  EXPECT_THAT(three, ElementsAre(1, -2, 3));
  std::optional<std::int64_t> perhaps;
  EXPECT_EQ(refusal_of(perhaps, between(0, 9), {"--n", "007"}), "");
  EXPECT_EQ(perhaps, 7);
}

/// Calls `visit` with each option of each command, and the words that lead to the command.
void walk(const CLI::App& command, const std::vector<std::string>& words,
          const std::function<void(const CLI::Option&, const std::vector<std::string>&)>& visit) {
  for (const auto* option : command.get_options()) visit(*option, words);
  for (const auto* below : command.get_subcommands([](const CLI::App*) { return true; })) {
    auto longer = words;
    longer.push_back(below->get_name());
    walk(*below, longer, visit);
  }
}

/// The option's own text of what it wants; CLI11's names of numbers are INT, UINT and FLOAT.
bool is_a_number_of_the_library(const CLI::Option& option) {
  for (const char* type : {"INT", "UINT", "FLOAT"}) {
    const auto found = option.get_type_name().find(type);
    const auto after =
        found == std::string::npos ? ' ' : option.get_type_name()[found + std::string(type).size()];
    if (found != std::string::npos && std::isalpha(static_cast<unsigned char>(after)) == 0) return true;
  }
  return false;
}

TEST(CommandLineNumbers, AreAllOfTheHelper) {
  int exit_code = 0, n_numbers = 0;
  const auto app = command_line(exit_code);
  walk(*app, {}, [&](const CLI::Option& option, const std::vector<std::string>& words) {
    EXPECT_FALSE(is_a_number_of_the_library(option))
        << words.back() << " " << option.get_name() << ": declare it by add_number";
    const auto type = option.get_type_name();
    if (type == integer_type || type == number_type) ++n_numbers;
  });
  EXPECT_GE(n_numbers, 30);
  // And the test would see one: CLI11 names its own types so.
  int of_the_library = 0;
  CLI::App other;
  EXPECT_TRUE(is_a_number_of_the_library(*other.add_option("--n", of_the_library)));
}

TEST(CommandLineNumbers, AreEachRefusedWhenTheyAreNone) {
  const std::vector<std::string> no_integer = {"0x10", "1e5",         "1.5",  "nan",
                                               "-1",   "99999999999", "1e18", "99999999999999999999"};
  const std::vector<std::string> no_number = {"nan", "inf", "-inf", "0x1p3", "3,5", "1e999", "ten"};
  int exit_code = 0;
  const auto all = command_line(exit_code);
  walk(*all, {}, [&](const CLI::Option& option, const std::vector<std::string>& words) {
    const auto type = option.get_type_name();
    if (type != integer_type && type != number_type) return;
    for (const auto& value : type == integer_type ? no_integer : no_number) {
      auto arguments = words;
      // A list of fixed length must be whole before it is looked at.
      arguments.push_back(option.get_name());
      for (int k = 0; k < option.get_expected_min(); ++k) arguments.push_back(value);
      if (option.get_expected_min() > 1) arguments.push_back("file");  // else the last is taken for that
      if (value[0] == '-') {
        arguments = words;
        arguments.push_back(option.get_name() + "=" + value);
        if (option.get_expected_min() > 1) continue;
      }
      const auto fresh = command_line(exit_code);
      EXPECT_THAT(refusal(*fresh, arguments), HasSubstr(option.get_name() + " " + value + ": "))
          << words.back();
    }
  });
}

}  // namespace
}  // namespace number_option_test
