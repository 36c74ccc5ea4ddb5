// What a file is that is not of the kind asked for, and how one of that kind is made of it.
#pragma once

#include <filesystem>
#include <string>

namespace tanktread::exchange {

/// Says of a file of another format that we know (STL, OBJ, PLY, OFF, Gmsh, old VTK ...), by its first bytes
/// or else by its suffix, what it is and what to do: "is an STL file; make a .vtu of it: ...". "" for others.
/// @param name as the user gave it
/// @param content where to open it
/// @param type VTK's type of what is asked for: UnstructuredGrid (a surface, .vtu), ImageData (a grid, .vti),
///   Collection (a series, .pvd), PUnstructuredGrid, PImageData (indexes of pieces, .pvtu, .pvti)
std::string foreign_format(const std::filesystem::path& name, const std::filesystem::path& content,
                           const std::string& type);

/// The same for a VTK XML file of type `found` where one of type `type` is asked for; never "".
std::string other_type(const std::filesystem::path& name, const std::string& found, const std::string& type);

/// "a surface (.vtu)": what a file of VTK's type is to us.
std::string type_text(const std::string& type);

/// The command that makes a .vtu of a surface. @param file to be read
std::string convert_command(const std::filesystem::path& file);

}  // namespace tanktread::exchange
