#include "exchange/vtk_arrays.hpp"

#include "exchange/file_kind.hpp"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

/// VTK puts names into its XML as they are, which a reader cannot read if they hold XML's own characters.
bool is_safe_in_names(char c) {
  return c >= ' ' && c <= '~' && std::string_view("<>&\"").find(c) == std::string_view::npos;
}

void check_array(const Array& array, std::int64_t n_tuples, const std::string& kind,
                 const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw FileError(
        fmt::format("{}: cannot be written: {} array '{}' {}", file.string(), kind, array.name, what));
  };
  if (array.name.empty()) fail("has no name");
  if (!std::all_of(array.name.begin(), array.name.end(), is_safe_in_names)) {
    fail("has a character in its name that VTK would write wrongly; use printable ASCII without < > & \"");
  }
  if (array.components < 1) fail(fmt::format("has {} components, at least 1 is needed", array.components));
  const auto n_values = static_cast<std::int64_t>(array.values.size());
  if (n_tuples == any_size && n_values % array.components != 0) {
    fail(fmt::format("has {} values, not a multiple of its {} components", n_values, array.components));
  }
  if (n_tuples != any_size && n_values != n_tuples * array.components) {
    fail(fmt::format("has {} values, expected {} tuples of {} components", n_values, n_tuples,
                     array.components));
  }
}

/// 2^53: from here on a double does not hold every integer.
constexpr double first_inexact_integer = 9007199254740992.0;

bool is_wide_integer(const vtkDataArray& array) {
  return array.GetDataTypeSize() == 8 && array.GetDataType() != VTK_DOUBLE;
}

}  // namespace

void check_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, const std::string& kind,
                  const std::filesystem::path& file) {
  for (auto array = arrays.begin(); array != arrays.end(); ++array) {
    check_array(*array, n_tuples, kind, file);
    const auto same = [&](const Array& before) { return before.name == array->name; };
    if (std::any_of(arrays.begin(), array, same)) {
      throw FileError(fmt::format("{}: cannot be written: two {} arrays are named '{}'", file.string(), kind,
                                  array->name));
    }
  }
}

void add_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, vtkFieldData& data,
                const std::string& kind, const std::filesystem::path& file) {
  check_arrays(arrays, n_tuples, kind, file);
  for (const auto& array : arrays) {
    vtkNew<vtkDoubleArray> wrapped;
    wrapped->SetName(array.name.c_str());
    wrapped->SetNumberOfComponents(array.components);
    // VTK only reads what it writes to a file; the 1 leaves the memory ours.
    wrapped->SetArray(const_cast<double*>(array.values.data()), static_cast<vtkIdType>(array.values.size()),
                      1);
    data.AddArray(wrapped);
  }
}

std::vector<Array> take_arrays(vtkFieldData& data, Convert convert, const std::string& kind,
                               const std::filesystem::path& file) {
  std::vector<Array> arrays;
  while (data.GetNumberOfArrays() > 0) {
    auto* found = data.GetAbstractArray(0);
    const std::string name = found->GetName() ? found->GetName() : "";
    const auto what = fmt::format("{} array '{}'", kind, name);
    auto* numbers = vtkDataArray::FastDownCast(found);
    // A file made elsewhere may carry text, of which a packet has no use.
    if (numbers == nullptr && convert != Convert::nothing) {
      data.RemoveArray(0);
      continue;
    }
    if (numbers == nullptr) {
      throw FileError(fmt::format("{}: {} holds {}, not numbers; remove it from the file", file.string(),
                                  what, found->GetDataTypeAsString()));
    }
    arrays.push_back({name, numbers->GetNumberOfComponents(), values_of(*numbers, convert, what, file)});
    data.RemoveArray(0);
  }
  return arrays;
}

std::vector<double> values_of(vtkDataArray& array, Convert convert, const std::string& what,
                              const std::filesystem::path& file) {
  if (const auto* doubles = vtkDoubleArray::FastDownCast(&array)) {
    const double* first = const_cast<vtkDoubleArray*>(doubles)->GetPointer(0);
    return std::vector<double>(first, first + doubles->GetNumberOfValues());
  }
  if (convert == Convert::nothing) {
    throw FileError(
        fmt::format("{}: {} is of type {}, not double; a packet keeps every bit: write it as Float64, in "
                    "numpy float64{}",
                    file.string(), what, array.GetDataTypeAsString(),
                    what == points_text ? ", or convert the surface: " + convert_command(file) : ""));
  }
  if (convert == Convert::exactly && array.GetDataType() == VTK_FLOAT) {
    throw FileError(
        fmt::format("{}: {} is of single precision (Float32), which has lost half of its digits; write it "
                    "as Float64, in numpy float64",
                    file.string(), what));
  }
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (vtkIdType tuple = 0; tuple < array.GetNumberOfTuples(); ++tuple) {
    for (int component = 0; component < array.GetNumberOfComponents(); ++component) {
      const double value = array.GetComponent(tuple, component);
      if (is_wide_integer(array) && std::abs(value) >= first_inexact_integer) {
        throw FileError(
            fmt::format("{}: {} holds the integer {:.0f} at tuple {}; from 2^53 on a double is not exact",
                        file.string(), what, value, tuple));
      }
      values.push_back(value);
    }
  }
  return values;
}

}  // namespace tanktread::exchange
