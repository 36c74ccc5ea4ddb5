// Between the arrays of a packet and VTK's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "exchange/packet.hpp"

class vtkDataArray;
class vtkFieldData;

namespace tanktread::exchange {

/// A number of tuples that is not prescribed: an array of field data has its own.
constexpr std::int64_t any_size = -1;

/// Which numbers besides doubles are taken.
enum class Convert {
  nothing,      ///< only doubles
  exactly,      ///< integers too, widened; text is left out
  with_losses,  ///< and single precision, which has fewer digits
};

/// Arrays as VTK can write them. `kind` ("point data") is for messages.
/// @throws FileError for a missing or repeated name, or a number of values that is not components times
/// `n_tuples`
void check_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, const std::string& kind,
                  const std::filesystem::path& file);

/// Adds the arrays to `data` without copying them: they must outlive it. @throws FileError as check_arrays
void add_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, vtkFieldData& data,
                const std::string& kind, const std::filesystem::path& file);

/// Takes all arrays out of `data`; each is freed there once it is copied, as together they may be large.
/// @throws FileError for numbers that are not double, and for text, unless `convert` allows them
std::vector<Array> take_arrays(vtkFieldData& data, Convert convert, const std::string& kind,
                               const std::filesystem::path& file);

/// What the points are called in messages; there a surface can be converted as a whole.
inline constexpr const char* points_text = "the array of points";

/// The values of one array, as in take_arrays.
std::vector<double> values_of(vtkDataArray& array, Convert convert, const std::string& what,
                              const std::filesystem::path& file);

}  // namespace tanktread::exchange
