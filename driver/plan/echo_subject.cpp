#include "driver/plan/echo_subject.hpp"

#include <fmt/format.h>

namespace tanktread::driver {

std::string in_si(const Subject& subject, double value, double (*unit_size)(const SiScales&),
                  const char* unit) {
  return subject.si ? fmt::format("{:.5g} {}", value * unit_size(*subject.si), unit) : "";
}

double metre(const SiScales& si) {
  return si.length_m;
}
double second(const SiScales& si) {
  return si.time_s;
}
double per_second(const SiScales& si) {
  return 1.0 / si.time_s;
}
double metre_per_second(const SiScales& si) {
  return si.length_m / si.time_s;
}
double newton(const SiScales& si) {
  return si.force_N;
}
double newton_per_metre(const SiScales& si) {
  return si.force_N / si.length_m;
}
double pascal_second(const SiScales& si) {
  return si.force_N * si.time_s / (si.length_m * si.length_m);
}

double newton_second_per_metre(const SiScales& si) {
  return si.force_N * si.time_s / si.length_m;
}

double joule(const SiScales& si) {
  return si.force_N * si.length_m;
}
double per_metre(const SiScales& si) {
  return 1.0 / si.length_m;
}
double newton_per_square_metre(const SiScales& si) {
  return si.force_N / (si.length_m * si.length_m);
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

}  // namespace tanktread::driver
