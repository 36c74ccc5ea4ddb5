// Options that are numbers, for all commands. CLI11's own would read 010 as 8, as C does.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "driver/program/number_range.hpp"

namespace tanktread::driver {

/// The names of the types in --help; a test sees to it that no option has one of CLI11's types of numbers.
inline constexpr const char* integer_type = "INTEGER";
inline constexpr const char* number_type = "NUMBER";

/// Adds an option that is a number, or a list of numbers of any length (std::vector) or of a fixed one
/// (std::array). Integers are decimal, whatever zeros they begin with; numbers have a decimal point and may
/// have an exponent. The value is stored when the command line is parsed, which throws InputError with
/// option, value and range for all that is not such a number, or not finite, or outside of `range`.
/// @tparam Target int, std::int64_t, std::optional of it, std::vector<int>, double, std::vector<double>,
///   std::array<double, 3>; what it holds before is the default
/// @param range for integers, both bounds and within int64
template <class Target>
CLI::Option* add_number(CLI::App& command, const std::string& name, Target& target,
                        const std::string& meaning, const NumberRange& range);

}  // namespace tanktread::driver
