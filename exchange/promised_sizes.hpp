// Sizes that the head of a VTK file promises, held against the file's own size before anything is made so
// large.
#pragma once

#include <cstdint>
#include <filesystem>

class vtkXMLDataElement;

namespace tanktread::exchange {

/// How much larger compressed numbers may be than they are in the file: zlib packs equal ones a thousand to
/// one, LZMA some seven thousand to one.
inline constexpr double growth_of_compressed = 10000;

/// Whether a file of `n_bytes`, compressed or not as its `root` says, can hold so many numbers of
/// `n_bytes_each` in memory.
bool fits_in_file(vtkXMLDataElement& root, double n_numbers, double n_bytes_each, std::uint64_t n_bytes);

/// Checks that all counts in the head are whole numbers that such counts can be, and that a file of `n_bytes`
/// can hold the arrays that they promise: VTK makes room for an array before it looks for its numbers.
/// @throws FileError naming the count or the array
void check_promised_sizes(vtkXMLDataElement& root, std::uint64_t n_bytes, const std::filesystem::path& file);

}  // namespace tanktread::exchange
