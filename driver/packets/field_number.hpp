// A number that a file holds of itself.
#pragma once

#include <optional>
#include <string>

#include "exchange/packet.hpp"

namespace tanktread::driver {

/// Field data of one number, "step", "shear_time" ...; nothing if the surface has no such array, or one of
/// another length.
inline std::optional<double> field_number(const exchange::SurfacePacket& surface, const std::string& name) {
  const auto* array = exchange::find_optional_array(surface.field_data, name);
  if (array == nullptr || array->values.size() != 1) return std::nullopt;
  return array->values.front();
}

}  // namespace tanktread::driver
