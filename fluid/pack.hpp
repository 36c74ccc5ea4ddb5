// Numbers that lie side by side and go through the same arithmetic. Internal to fluid/.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

namespace tanktread::fluid {

/// A pack is one register of the widest vectors that the processor has. Wider packs GCC takes apart and keeps
/// in memory between any two operations: with 64 bytes and AVX2 a step takes twice the time.
#if defined(__AVX512F__)
inline constexpr int pack_bytes = 64;
#elif defined(__AVX__)
inline constexpr int pack_bytes = 32;
#else
inline constexpr int pack_bytes = 16;
#endif

/// Rows of the lattice begin at a cache line.
inline constexpr int cache_line_bytes = 64;

/// Numbers in a pack: with AVX-512 8 doubles or 16 floats.
template <typename Real>
inline constexpr int pack_size = pack_bytes / static_cast<int>(sizeof(Real));

/// Every node of the lattice goes through a pack, those at the end of a row too, so that a node's result
/// depends neither on its place in a row nor on the compiler's choice of a loop.
template <typename Real>
struct PackType;
template <>
struct PackType<double> {
  using type = double __attribute__((vector_size(pack_bytes)));
};
template <>
struct PackType<float> {
  using type = float __attribute__((vector_size(pack_bytes)));
};
template <typename Real>
using Pack = typename PackType<Real>::type;

/// The lanes of a type of pack.
template <typename SomePack>
inline constexpr int lanes_of = static_cast<int>(sizeof(SomePack) / sizeof(std::declval<SomePack&>()[0]));

/// A pack at any address of numbers.
template <typename Real>
inline Pack<Real> load(const Real* address) {
  Pack<Real> pack;
  std::memcpy(&pack, address, sizeof pack);
  return pack;
}
template <typename Real>
inline void store(Real* address, Pack<Real> pack) {
  std::memcpy(address, &pack, sizeof pack);
}

/// The same number in every lane.
template <typename Real>
inline Pack<Real> pack_of(Real number) {
  return Pack<Real>{} + number;
}

/// Whether a lane is not zero.
template <typename SomePack>
inline bool any_lane(SomePack pack) {
  std::uint64_t bits[pack_bytes / sizeof(std::uint64_t)], any = 0;
  std::memcpy(bits, &pack, sizeof pack);
  for (const auto some : bits) any |= some;
  return any != 0;
}

/// `pack` moved by one lane towards the higher ones; `first` comes in.
template <typename Real>
inline Pack<Real> moved_up(Pack<Real> pack, Real first) {
  Pack<Real> moved = [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return __builtin_shufflevector(pack, pack, (lane == 0 ? 0 : lane - 1)...);
  }
  (std::make_integer_sequence<int, pack_size<Real>>{});
  moved[0] = first;
  return moved;
}

/// `pack` moved by one lane towards the lower ones; the last lane keeps its number.
template <typename SomePack>
inline SomePack moved_down(SomePack pack) {
  constexpr int last = lanes_of<SomePack> - 1;
  return [&]<int... lane>(std::integer_sequence<int, lane...>) {
    return __builtin_shufflevector(pack, pack, (lane == last ? last : lane + 1)...);
  }
  (std::make_integer_sequence<int, lanes_of<SomePack>>{});
}

/// Stores all lanes but the last, by two halves that overlap: no other address is touched.
template <typename Real>
inline void store_all_but_last(Real* address, Pack<Real> pack) {
  constexpr int half = pack_size<Real> / 2;
  const auto store_half = [&]<int... lane>(int begin, std::integer_sequence<int, lane...>) {
    const auto low = __builtin_shufflevector(pack, pack, lane...);
    const auto high = __builtin_shufflevector(pack, pack, (half - 1 + lane)...);
    std::memcpy(address, &low, sizeof low);
    std::memcpy(address + begin, &high, sizeof high);
  };
  store_half(half - 1, std::make_integer_sequence<int, half>{});
}

/// Stores some lanes, one after the other.
template <typename Real>
inline void store_lanes(Real* address, Pack<Real> pack, int begin, int end) {
  for (int lane = begin; lane < end; ++lane) address[lane] = pack[lane];
}

/// The first `n` lanes of a pack, zero in the others.
template <typename SomePack>
inline SomePack first_lanes(SomePack pack, int n) {
  SomePack lane{}, end{};
  for (int k = 0; k < lanes_of<SomePack>; ++k) {
    lane[k] = k;
    end[k] = n;
  }
  return lane < end ? pack : SomePack{};
}

}  // namespace tanktread::fluid
