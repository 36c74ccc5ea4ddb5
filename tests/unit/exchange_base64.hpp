// Numbers as they stand within the XML of a VTK file, for files such as other programs write.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

namespace tanktread::exchange::testing {

inline std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;
    for (std::size_t j = k; j < k + 3; ++j)
      group = group << 8 | (j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0u);
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += k + digit > bytes.size() ? '=' : digits[group >> (18 - 6 * digit) & 63];
    }
  }
  return text;
}

template <class Number>
std::string encoded(const std::string& values) {
  std::istringstream stream(values);
  std::string bytes(4, ' ');
  for (long double value = 0; stream >> value;) {  // which holds every 64-bit integer
    const auto number = static_cast<Number>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  const auto length = static_cast<std::uint32_t>(bytes.size() - 4);
  std::memcpy(bytes.data(), &length, 4);
  return base64(bytes);
}

/// Numbers as VTK has them within the XML: a 32-bit length in bytes, then the numbers, in base64.
inline std::string binary(const std::string& type, const std::string& values) {
  if (type == "Float64") return encoded<double>(values);
  if (type == "Float32") return encoded<float>(values);
  if (type == "Int64") return encoded<std::int64_t>(values);
  if (type == "Int32") return encoded<std::int32_t>(values);
  if (type == "UInt64") return encoded<std::uint64_t>(values);
  if (type == "UInt32") return encoded<std::uint32_t>(values);
  if (type == "Int16") return encoded<std::int16_t>(values);
  if (type == "UInt16") return encoded<std::uint16_t>(values);
  if (type == "Int8") return encoded<std::int8_t>(values);
  if (type == "UInt8") return encoded<std::uint8_t>(values);
  return values;
}

}  // namespace tanktread::exchange::testing
