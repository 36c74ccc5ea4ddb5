// What all sections of the echo look at, and how they write a number.
#pragma once

#include <optional>
#include <string>

#include "driver/units/si.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// A case with what follows from it.
struct Subject {
  const Case& the_case;
  const Parameters& parameters;
  std::optional<SiScales> si;
};

/// A lattice value as text.
std::string number(double value);

/// The value in SI, the lattice value times the unit's size; "" without [si].
std::string in_si(const Subject& subject, double value, double (*unit_size)(const SiScales&),
                  const char* unit);

// Sizes of units.
double metre(const SiScales& si);
double second(const SiScales& si);
double per_second(const SiScales& si);
double metre_per_second(const SiScales& si);
double newton(const SiScales& si);
double newton_per_metre(const SiScales& si);
double pascal_second(const SiScales& si);
double newton_second_per_metre(const SiScales& si);
double joule(const SiScales& si);
double per_metre(const SiScales& si);
double newton_per_square_metre(const SiScales& si);

}  // namespace tanktread::driver
