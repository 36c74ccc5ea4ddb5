#include "driver/plan/echo_energies.hpp"

#include <fmt/format.h>

#include "driver/units/energy_limits.hpp"

namespace tanktread::driver {
namespace {

void put_bending(EchoTable& table, const Subject& subject, const CapsuleCase& the_case,
                 const CapsuleParameters& capsule) {
  const double bending = capsule.energy.bending_modulus, curvature = capsule.energy.spontaneous_curvature;
  if (bending == 0) return;
  table.row("kappa_b", number(bending), in_si(subject, bending, joule, "J"),
            capsule.capillary_by_kappa_b > 0 ? "mu_o g a^3/Ca" : "bending modulus");
  if (capsule.capillary_by_kappa_b == 0) {
    table.row("kappa_b/(G a^2)", number(the_case.membrane.energy.bending_modulus), "",
              fmt::format("Foeppl-von Karman number {:.4g}", 1 / the_case.membrane.energy.bending_modulus));
  }
  table.row("c_0", number(curvature), in_si(subject, curvature, per_metre, "1/m"),
            fmt::format("c_0 a = {:.6g}; a sphere has 2", the_case.membrane.energy.spontaneous_curvature),
            curvature != 0);
}

}  // namespace

void put_energies(EchoTable& table, const Subject& subject, std::size_t number_of_capsule, double mean_edge) {
  const auto& the_case = subject.the_case.capsules[number_of_capsule];
  const auto& capsule = subject.parameters.capsules[number_of_capsule];
  if (!the_case.membrane.command.empty()) return;
  const auto& [energy, given] = std::pair(capsule.energy, the_case.membrane.energy);
  put_bending(table, subject, the_case, capsule);
  const auto modulus = [&](const char* name, double value, double in_moduli, const char* unit) {
    table.row(name, number(value), in_si(subject, value, newton_per_metre, "N/m"),
              fmt::format("{:.6g} {}", in_moduli, unit), value > 0);
  };
  modulus("k_A", energy.global_area_modulus, given.global_area_modulus, "G; whole area");
  modulus("k_d", energy.local_area_modulus, given.local_area_modulus, "G; area of each triangle");
  table.row("k_V", number(energy.volume_modulus),
            in_si(subject, energy.volume_modulus, newton_per_square_metre, "N/m^2"),
            fmt::format("{:.6g} G/a; volume", given.volume_modulus), energy.volume_modulus > 0);
  table.row("area at rest", number(given.reference_area), "", "over that of the mesh",
            given.reference_area != 1);
  table.row("volume at rest", number(given.reference_volume), "", "over that of the mesh",
            given.reference_volume != 1);
  for (const auto& limit :
       energy_limits(subject.the_case, subject.parameters, number_of_capsule, mean_edge)) {
    table.row(fmt::format("{}/limit", limit.name), fmt::format("{:.3g}", limit.value / limit.most), "",
              fmt::format("stable up to {} = {:.3g}", limit.name, limit.most));
  }
}

}  // namespace tanktread::driver
