// `--set key=value`: one assignment laid over a TOML document.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace tanktread::driver {

/// "key=value", taken apart.
struct Assignment {
  std::string text;   ///< as it was given
  std::string path;   ///< dotted, with an index for a list or array element: "capsule.0.radius", "flow.box.2"
  std::string value;  ///< TOML; for a key that holds text, a bare word too, since shells eat quotes
};

/// Splits at the first '='. @return an assignment with an empty path if there is none, or nothing before it
Assignment split_assignment(const std::string& text);

/// Sets the value in the document. Keys unknown to the schema are set as well: they are refused with those of
/// the file.
/// @return "" or, if there is nothing that could be set, what is wrong
std::string lay_over(toml::table& document, const Assignment& assignment);

}  // namespace tanktread::driver
