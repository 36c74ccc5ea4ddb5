#include "driver/observe/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace tanktread::driver {
namespace {

constexpr int limb_bits = 32, mantissa_bits = 52, lowest_exponent = -1074;
constexpr std::uint64_t limb_mask = 0xffffffff;

/// A double as mantissa 2^(place - 1074), without its sign.
struct Parts {
  std::uint64_t mantissa;
  int place;
};

Parts parts_of(double number) {
  const auto bits = std::bit_cast<std::uint64_t>(number);
  const auto fraction = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
  const int exponent = static_cast<int>(bits >> mantissa_bits & 0x7ff);
  if (exponent == 0) return {fraction, 0};
  return {fraction | std::uint64_t{1} << mantissa_bits, exponent - 1};
}

}  // namespace

void ExactSum::add(double term) {
  if (!std::isfinite(term)) {
    not_finite_ += term;
    return;
  }
  if (term == 0) return;  // of which there are many
  constexpr std::int64_t most_uncarried = std::int64_t{1} << 29;
  if (++n_uncarried_ >= most_uncarried) carry();
  const auto [mantissa, place] = parts_of(term);
  const auto limb = static_cast<std::size_t>(place / limb_bits);
  const int shift = place % limb_bits;
  const std::uint64_t low = (mantissa & limb_mask) << shift, high = (mantissa >> limb_bits) << shift;
  const std::int64_t sign = std::signbit(term) ? -1 : 1;
  limbs_[limb] += sign * static_cast<std::int64_t>(low & limb_mask);
  limbs_[limb + 1] += sign * static_cast<std::int64_t>((low >> limb_bits) + (high & limb_mask));
  limbs_[limb + 2] += sign * static_cast<std::int64_t>(high >> limb_bits);
}

void ExactSum::add(const ExactSum& other) {
  ExactSum carried = other;
  carried.carry();
  carry();
  for (std::size_t k = 0; k < limbs_.size(); ++k) limbs_[k] += carried.limbs_[k];
  n_uncarried_ = 1;
  not_finite_ += other.not_finite_;
}

void ExactSum::carry() {
  for (std::size_t k = 0; k + 1 < limbs_.size(); ++k) {
    const std::int64_t above = limbs_[k] >> limb_bits;  // towards minus infinity: what stays is not negative
    limbs_[k] -= above * (std::int64_t{1} << limb_bits);
    limbs_[k + 1] += above;
  }
  n_uncarried_ = 0;
}

double ExactSum::value() const {
  if (not_finite_ != 0) return not_finite_;  // NaN too
  ExactSum sum = *this;
  sum.carry();
  const bool is_negative = sum.limbs_.back() < 0;
  if (is_negative) {
    for (auto& limb : sum.limbs_) limb = -limb;
    sum.carry();
  }
  const auto bit = [&](int place) {
    return sum.limbs_[static_cast<std::size_t>(place / limb_bits)] >> place % limb_bits & 1;
  };
  int top = limb_bits * n_limbs - 1;
  while (top > 0 && bit(top) == 0) --top;
  const int lowest = std::max(top - mantissa_bits, 0);
  std::uint64_t mantissa = 0;
  for (int place = top; place >= lowest; --place)
    mantissa = 2 * mantissa + static_cast<std::uint64_t>(bit(place));
  if (lowest > 0 && bit(lowest - 1) != 0) {
    bool is_above_half = false;
    for (int place = lowest - 2; place >= 0 && !is_above_half; --place) is_above_half = bit(place) != 0;
    if (is_above_half || mantissa % 2 != 0) ++mantissa;
  }
  const double size = std::ldexp(static_cast<double>(mantissa), lowest + lowest_exponent);
  return is_negative ? -size : size;
}

}  // namespace tanktread::driver
