// The part of an echo on the energies of a capsule's membrane beside its law.
#pragma once

#include <cstddef>

#include "driver/plan/echo_subject.hpp"
#include "driver/plan/echo_table.hpp"

namespace tanktread::driver {

/// Their numbers, moduli and how stiff each may be; nothing without energies. @param mean_edge of the mesh
void put_energies(EchoTable& table, const Subject& subject, std::size_t number_of_capsule, double mean_edge);

}  // namespace tanktread::driver
