#include "exchange/packet.hpp"

#include <stdexcept>

namespace tanktread::exchange {

const Array& find_array(const std::vector<Array>& arrays, const std::string& name, const std::string& where) {
  std::string present;
  for (const auto& array : arrays) {
    if (array.name == name) return array;
    present += (present.empty() ? "" : ", ") + array.name;
  }
  throw FileError(where + ": array '" + name +
                  "' is missing; there are: " + (present.empty() ? "none" : present));
}

}  // namespace tanktread::exchange
