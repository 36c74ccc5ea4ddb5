// The entry of one fuzzer; TANKTREAD_FUZZ_TARGET is the name of its target. An exception that comes out ends
// it: that is a finding.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const auto& chosen = tanktread::fuzz::target(TANKTREAD_FUZZ_TARGET);
  chosen.read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
