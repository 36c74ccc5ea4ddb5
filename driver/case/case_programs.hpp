// The programs of a case: flow.command, membrane.command.
#pragma once

#include <filesystem>

#include "driver/case/case.hpp"

namespace tanktread::driver {

class CaseReader;

/// A program takes the place of the fluid or of a membrane.
bool has_program(const Case& the_case);

/// Takes arguments that are relative paths of files beside the case file, and run.command_directory, from the
/// case file's folder, and keeps them absolute, so that an echo of the case can lie anywhere.
void find_program_files(Case& the_case, const std::filesystem::path& directory);

/// Each command that is used begins with a program that can be run: a path, or a name that PATH finds. A
/// fluid that is a program has one viscosity.
void check_programs(CaseReader& reader, const Case& the_case, const FilesUsed& used);

/// The command for a person, paths without their folders: "python3 my_membrane.py".
std::string short_text(const std::vector<std::string>& command);

}  // namespace tanktread::driver
