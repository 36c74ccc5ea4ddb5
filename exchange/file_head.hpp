// What the XML at the head of a VTK file says, looked at before VTK's readers trust it.
#pragma once

#include <filesystem>
#include <istream>
#include <string>

class vtkXMLDataElement;
class vtkXMLDataParser;

namespace tanktread::exchange {

class WholeFile;

/// Parses XML up to its appended data, if it has any. @throws FileError with the parser's words
void parse_head(vtkXMLDataParser& parser, std::istream& stream, const std::filesystem::path& file);

/// The file's numbers are appended raw bytes of this machine, with lengths of 64 bits, as we write them.
/// @param root of its XML
bool has_raw_numbers(vtkXMLDataElement& root);

/// Checks what VTK's readers do not:
/// - the file is one of VTK's type `type` ("UnstructuredGrid", "ImageData");
/// - each array is of a known type of number or text (a reader of VTK 9.1 crashes otherwise);
/// - appended raw data, as write_surface and write_grid use, lie where the head says. There each array begins
/// at
///   an offset with its length in bytes, and ends where the next begins, the last where XML goes on. With
///   bytes missing in between VTK would take other numbers for the array's. Files in other forms are let
///   through.
/// - all counts are whole numbers, and the arrays (and compressed blocks) that they promise are no larger
/// than the
///   file can hold;
/// - a grid's frame is all numbers, and its pieces fill it;
/// - there are no polyhedra.
/// @param exact refuses arrays written as ASCII, which need not keep every bit
/// @return the number of arrays of field data, of which VTK drops all without a word if one cannot be read
/// @throws FileError
int check_head(const WholeFile& file, const std::string& type, bool exact);

}  // namespace tanktread::exchange
