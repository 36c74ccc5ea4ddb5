// A line of a TOML file that this program writes.
#pragma once

#include <fmt/format.h>

#include <string>

#include "driver/case/case_value.hpp"

namespace tanktread::driver {

/// "name = value    # comment", the comments below each other.
inline std::string toml_line(const std::string& name, const Value& value, const std::string& comment) {
  return fmt::format("{:<44} # {}\n", fmt::format("{} = {}", name, toml_text(value)), comment);
}

}  // namespace tanktread::driver
