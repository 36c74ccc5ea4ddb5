// What the head of a .vti says of its grid, looked at before VTK's reader takes it on trust.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

class vtkXMLDataElement;

namespace tanktread::exchange {

/// @throws FileError: the attribute of the file's head has the value `found`, which is not `expected` ("a
/// whole number ...")
[[noreturn]] void refuse_attribute(const std::string& attribute, const std::string& found,
                                   const std::string& expected, const std::filesystem::path& file);

/// First and last node along x, y, z: "x0 x1 y0 y1 z0 z1".
using Extent = std::array<std::int64_t, 6>;

/// @throws FileError unless the attribute is there, and is six whole numbers of 32 bits
Extent extent_of(vtkXMLDataElement& element, const char* attribute, const std::filesystem::path& file);

/// The numbers of an attribute; none if it is not there. @throws FileError unless they are `n` finite ones
std::vector<double> numbers_of(vtkXMLDataElement& element, const char* attribute, std::size_t n,
                               const std::filesystem::path& file);

/// Cells of an extent, of which pieces of a grid share none, as a real number; a grid of one node along an
/// axis has one cell there.
double cells_of(const Extent& extent);

/// The points of an extent "x0 x1 y0 y1 z0 z1" (first and last node along x, y, z), as a real number, which
/// may be beyond every integer; 0 if the extent is empty or is not there.
/// @throws FileError unless it is six whole numbers of 32 bits
double points_of_extent(vtkXMLDataElement& element, const char* attribute, const std::filesystem::path& file);

/// Checks what VTK 9.1 passes over: a part of Origin, Spacing or Direction that is no number, in whose place
/// it takes a default; and a grid that its pieces do not fill, whose other nodes it leaves as they happen to
/// be.
/// @param grid the element ImageData
/// @throws FileError
void check_grid_head(vtkXMLDataElement& grid, const std::filesystem::path& file);

}  // namespace tanktread::exchange
