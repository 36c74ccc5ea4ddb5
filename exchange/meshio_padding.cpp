#include "exchange/meshio_padding.hpp"

#include <set>

namespace tanktread::exchange {
namespace {

/// Whether the raw offset of some array is the base64 offset of one before it.
bool confuses_meshio(const std::vector<std::int64_t>& lengths) {
  std::set<std::int64_t> base64_offsets;
  std::int64_t raw = 0, base64 = 0;
  for (const auto length : lengths) {
    if (base64_offsets.contains(raw)) return true;
    base64_offsets.insert(base64);
    const std::int64_t block = 8 + length;  // each array follows its length
    raw += block;
    base64 += 4 * ((block + 2) / 3);
  }
  return false;
}

}  // namespace

std::optional<std::int64_t> padding_for_meshio(std::vector<std::int64_t> lengths) {
  if (!confuses_meshio(lengths)) return std::nullopt;
  lengths.insert(lengths.begin(), 0);
  // Ends soon: each double of padding adds 8 to all raw offsets and 10 or 11 to all base64 offsets, so that a
  // pair of equal ones parts and does not meet again.
  std::int64_t n_doubles = 0;
  while (confuses_meshio(lengths)) lengths.front() = 8 * ++n_doubles;
  return n_doubles;
}

}  // namespace tanktread::exchange
