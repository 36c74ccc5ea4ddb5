// Text as it stands in XML.
#pragma once

#include <string>

namespace tanktread::exchange {

/// A text as the value of an XML attribute. Line breaks and tabs are spelled out: XML makes them spaces
/// otherwise.
std::string escaped(const std::string& text);

}  // namespace tanktread::exchange
