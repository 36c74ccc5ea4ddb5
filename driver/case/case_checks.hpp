// Checks of a case that look at more than one key. What a key may hold by itself is in the schema.
#pragma once

#include "driver/case/case_reader.hpp"

namespace tanktread::driver {

/// Keys that must not be absent, and those that have no place in such a case (Key::objection).
void check_presence(CaseReader& reader, const Case& the_case);

/// Flow, membranes, [si]: what goes together.
void check_consistency(CaseReader& reader, const Case& the_case);

/// The mesh files are there.
void check_mesh_files(CaseReader& reader, const Case& the_case);

/// Capsules in the box, clear of walls, of each other and of their periodic images; fluid_box in the box. The
/// numbers must be right by themselves.
void check_geometry(CaseReader& reader, const Case& the_case);

/// The path under which a key of a capsule's membrane was given: the capsule's own, else that of [membrane].
std::string membrane_path(const CaseReader& reader, const std::string& name, std::size_t capsule);

/// The modulus that the capillary number of a law is of, if the file does not say.
std::string preset_modulus(const std::string& elastic_law);

}  // namespace tanktread::driver
