// The XML of an index of pieces (.pvti, .pvtu): what those of grids and of surfaces have in common. Internal
// to exchange/.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

class vtkXMLDataElement;
class vtkXMLDataParser;

namespace tanktread::exchange {

/// Numbers with 17 digits, a blank between them.
std::string numbers_text(std::span<const double> numbers);

/// The element of the numbers of the whole; "" if there are none.
std::string field_data_text(const std::vector<Array>& arrays);

/// An element of the arrays that every piece has. @param element "PPointData" ...
std::string shapes_text(const std::string& element, const std::vector<ArrayShape>& shapes);

/// The whole file. @param type VTK's ("PImageData", "PUnstructuredGrid"), which is its main element too
/// @param attributes of that element @param content lines of what is in it
std::string index_text(const std::string& type, const std::string& attributes, const std::string& content);

/// What is made of the main element of an index; the parser reads numbers that stand in the text.
using UseOfIndex = std::function<void(vtkXMLDataParser& parser, vtkXMLDataElement& main)>;

/// Parses the text of an index of VTK's `type`, and passes its main element to `use`.
/// @throws FileError if it is no XML or of another type, and what `use` throws
void parse_index(const std::string& text, const std::string& type, const std::filesystem::path& file,
                 const UseOfIndex& use);

/// @throws FileError if the element lacks the attribute
std::string text_of(vtkXMLDataElement& element, const char* attribute, const std::filesystem::path& file);

/// The arrays of an element that shapes_text made; those of text, which other programs write, are left out.
std::vector<ArrayShape> shapes_of(vtkXMLDataElement& element, const std::filesystem::path& file);

/// The numbers of the whole; those in another form than field_data_text's are left to VTK.
std::vector<Array> field_data_of(vtkXMLDataParser& parser, vtkXMLDataElement& element,
                                 const std::filesystem::path& file);

/// Of names and all numbers, bit for bit.
bool same_arrays(const std::vector<Array>& a, const std::vector<Array>& b);

/// Some texts and numbers cannot be put in XML, which is found by reading what would be written.
/// @param is_same whether that gives the same index again; a FileError of it counts as no
/// @throws FileError
void require_survival(const std::filesystem::path& file, const std::function<bool()>& is_same);

/// How many bytes the pieces of an index have together. @param piece relative to the index
/// @throws FileError naming one that is not there
double bytes_of_pieces(const std::vector<std::string>& pieces, const std::filesystem::path& index);

}  // namespace tanktread::exchange
