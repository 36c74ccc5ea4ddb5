// What a case says by name, as the components themselves have it. A program without the component knows none
// of its names (driver/absent/): a case may then hold any.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tanktread::driver {

/// The elastic laws of the membrane component.
std::vector<std::string> elastic_law_names();
/// Those that take a parameter, "area_ratio" ...
std::vector<std::string> elastic_laws_with(const std::string& parameter);
/// The schemes of the Maxwell element.
std::vector<std::string> maxwell_scheme_names();

/// The kernels of the coupler component.
std::vector<std::string> kernel_names();
/// How far a kernel reaches along an axis, grid steps; nothing: not known.
std::optional<double> kernel_half_width(const std::string& kernel);
/// Whether a case that names the kernel, or none, has the tangential correction without a word of its own.
bool is_corrected_by_default(const std::string& kernel);

}  // namespace tanktread::driver
