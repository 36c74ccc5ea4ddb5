// What surface and grid files share: arrays to and from VTK, VTK's errors as exceptions, whole files only.
#pragma once

#include <vtkDataSetAttributes.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "exchange/vtk_files.hpp"

class vtkXMLReader;
class vtkXMLWriter;

namespace tanktread::exchange {

/// Puts the arrays into VTK's attributes without copying them: `arrays` must outlive the writing.
/// @param n_tuples how many tuples each must have; 0: any number (field data). @throws FileError
void lend_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, vtkFieldData* target,
                 const std::filesystem::path& file);

/// Copies every array of VTK's attributes. @throws FileError for a type other than double, unless `convert`
std::vector<Array> copy_arrays(vtkFieldData* source, bool convert, const std::filesystem::path& file);

/// Writes appended raw data under a temporary name, then renames. @throws FileError with VTK's words
void write_whole(vtkXMLWriter* writer, const std::filesystem::path& file);

/// Reads the file. @throws FileError with VTK's words if anything at all is wrong with it
void read_whole(vtkXMLReader* reader, const std::filesystem::path& file);

/// Calls `write(temporary name)`, flushes the file to disk and renames it into place; removes it if anything
/// fails.
void write_then_rename(const std::filesystem::path& file,
                       const std::function<void(const std::filesystem::path&)>& write);

}  // namespace tanktread::exchange
