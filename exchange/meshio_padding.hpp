// A way round an error of meshio, so that it reads every surface that we write.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tanktread::exchange {

/// The name of the field data array that pads a surface file; reading leaves it out.
inline constexpr const char* padding_name = "padding_for_meshio";

/// meshio (seen in 5.0.0) turns appended raw data into base64 array by array, and finds an array by the
/// text of its raw offset, among arrays some of which have their new base64 offset already. If a new offset
/// happens to equal the raw one that is sought, meshio takes the wrong array. Whether that happens depends on
/// the arrays' lengths only, and one more array of the right length prevents it.
/// @param lengths in bytes, of the arrays in the order of the file
/// @return the number of doubles that a padding array before all others must hold; none if the file can do
/// without
std::optional<std::int64_t> padding_for_meshio(std::vector<std::int64_t> lengths);

}  // namespace tanktread::exchange
