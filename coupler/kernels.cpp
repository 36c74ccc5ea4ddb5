#include <cmath>
#include <numbers>

#include "coupler/coupler.hpp"

namespace tanktread::coupler {
namespace {

/// (1 + cos(pi r/2))/4 for |r| <= 2 (Eq. 2.2; Peskin 1977, doi 10.1016/0021-9991(77)90100-0).
double cosine4(double distance) {
  const double r = std::abs(distance);
  return r < 2.0 ? 0.25 * (1.0 + std::cos(0.5 * std::numbers::pi * r)) : 0.0;
}

/// The four points of cosine4 are a quarter turn apart, so that one sine and cosine serve all of them.
void cosine4_weights(double first_distance, double* weights) {
  const double angle = 0.5 * std::numbers::pi * first_distance;
  const double cosine = 0.25 * std::cos(angle), sine = 0.25 * std::sin(angle);
  weights[0] = 0.25 + cosine;
  weights[1] = 0.25 - sine;
  weights[2] = 0.25 - cosine;
  weights[3] = 0.25 + sine;
}

/// Three points (Roma, Peskin & Berger 1999, Eqs. 22-23; doi 10.1006/jcph.1999.6293).
double roma3(double distance) {
  const double r = std::abs(distance);
  if (r <= 0.5) return (1.0 + std::sqrt(1.0 - 3.0 * r * r)) / 3.0;
  if (r < 1.5) return (5.0 - 3.0 * r - std::sqrt(1.0 - 3.0 * (1.0 - r) * (1.0 - r))) / 6.0;
  return 0.0;
}

/// Four points with the even-odd condition (Peskin 2002, Eqs. 6.27-6.28; doi 10.1017/S0962492902000077).
double peskin4(double distance) {
  const double r = std::abs(distance);
  if (r <= 1.0) return (3.0 - 2.0 * r + std::sqrt(1.0 + 4.0 * r - 4.0 * r * r)) / 8.0;
  if (r < 2.0) return (5.0 - 2.0 * r - std::sqrt(-7.0 + 12.0 * r - 4.0 * r * r)) / 8.0;
  return 0.0;
}

/// The hat of linear interpolation.
double linear2(double distance) {
  const double r = std::abs(distance);
  return r < 1.0 ? 1.0 - r : 0.0;
}

}  // namespace

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> table = {
      {"cosine4", "(1 + cos(pi r/2))/4, 4 points (Peskin 1977): sum 1, no exact first moment", 2.0, false,
       cosine4, cosine4_weights},
      {"roma3", "3 points (Roma, Peskin & Berger 1999): sum 1, first moment 0", 1.5, true, roma3, nullptr},
      {"peskin4", "4 points (Peskin 2002): sum 1, first moment 0, even and odd sums 1/2", 2.0, true, peskin4,
       nullptr},
      {"linear2", "1 - r, 2 points: sum 1, first moment 0, not smooth", 1.0, true, linear2, nullptr},
  };
  return table;
}

const Kernel& kernel(const std::string& name) {
  std::string known;
  for (const auto& entry : kernels()) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + entry.name;
  }
  throw std::invalid_argument("unknown kernel '" + name + "'; known are " + known);
}

}  // namespace tanktread::coupler
