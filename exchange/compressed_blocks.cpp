#include "exchange/compressed_blocks.hpp"

#include <fmt/format.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "exchange/promised_sizes.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;

std::string_view attribute_of(vtkXMLDataElement& element, const char* name) {
  const char* found = element.GetAttribute(name);
  return found != nullptr ? found : "";
}

/// As many bytes as can be read, of `n`.
std::string bytes_at(std::istream& stream, std::int64_t position, std::size_t n) {
  std::string bytes(n, '\0');
  stream.clear();
  stream.seekg(position);
  stream.read(bytes.data(), static_cast<std::streamsize>(n));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

/// Up to the first character that is not of base64. An equals sign counts as a digit of zero wherever it
/// stands, as it does in VTK.
std::string from_base64(const std::string& text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto digit = text[k] == '=' ? 0 : digits.find(text[k]);
    if (digit == std::string_view::npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if (k % 4 != 0) bytes += static_cast<char>(bits >> (6 - 2 * (k % 4)) & 0xff);
  }
  return bytes;
}

/// Where the text of an element begins, as VTK finds it: after its start tag and blanks.
std::int64_t position_of_text(std::istream& stream, vtkXMLDataElement& element) {
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(element.GetXMLByteIndex()));
  char c = 0;
  while (stream.get(c) && c != '>') continue;
  while (stream.get(c) && std::isspace(static_cast<unsigned char>(c)) != 0) continue;
  return stream ? static_cast<std::int64_t>(stream.tellg()) - 1 : 0;
}

/// Looks at the arrays of one file.
class BlockCheck {
 public:
  BlockCheck(vtkXMLDataParser& parser, std::istream& stream, std::uint64_t n_bytes, const fs::path& file)
      : stream_(stream), n_bytes_(n_bytes), file_(file), appended_(parser.GetAppendedDataPosition()) {
    auto& root = *parser.GetRootElement();
    if (attribute_of(root, "header_type") == "UInt64") word_ = sizeof(std::uint64_t);
    is_big_endian_ = attribute_of(root, "byte_order") == "BigEndian";
    if (auto* data = root.FindNestedElementWithName("AppendedData"))
      is_raw_ = attribute_of(*data, "encoding") == "raw";
  }

  void check(vtkXMLDataElement& element) {
    const std::string_view name = element.GetName();
    if (name == "DataArray" || name == "Array") check_array(element);
    for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) check(*element.GetNestedElement(k));
  }

 private:
  void check_array(vtkXMLDataElement& array) {
    const auto begin = words_of(array, 3);
    if (begin.size() < 3) return;  // VTK will say what is missing
    const auto n_bytes = static_cast<double>(n_bytes_);
    const auto n_blocks = static_cast<double>(begin[0]),
               longest = static_cast<double>(std::max(begin[1], begin[2]));
    if (n_blocks * static_cast<double>(word_) > n_bytes || longest > growth_of_compressed * n_bytes)
      refuse(array, fmt::format("{:.10g} compressed blocks of {:.10g} bytes", n_blocks, longest));
    const auto lengths = words_of(array, 3 + begin[0]);  // those of the compressed blocks follow
    for (std::size_t k = 3; k < lengths.size(); ++k) {
      if (lengths[k] > n_bytes_)
        refuse(array, fmt::format("a compressed block that takes {} bytes", lengths[k]));
    }
  }

  [[noreturn]] void refuse(vtkXMLDataElement& array, const std::string& what) const {
    throw FileError(fmt::format(
        "{}: array '{}' is said to be of {}, which a file of {} bytes cannot hold: it is damaged; "
        "write or copy it again",
        file_.string(), attribute_of(array, "Name"), what, n_bytes_));
  }

  /// The first `n` words of an array, or less.
  std::vector<std::uint64_t> words_of(vtkXMLDataElement& array, std::uint64_t n) {
    const auto bytes = beginning_of(array, static_cast<std::size_t>(n) * word_);
    std::vector<std::uint64_t> words;
    for (std::size_t first = 0; first + word_ <= bytes.size() && words.size() < n; first += word_) {
      std::uint64_t value = 0;
      for (std::size_t k = 0; k < word_; ++k) {
        const auto place = first + (is_big_endian_ ? k : word_ - 1 - k);
        value = value << 8 | static_cast<unsigned char>(bytes[place]);
      }
      words.push_back(value);
    }
    return words;
  }

  /// At least the first `n` bytes of an array, or all that the file has.
  std::string beginning_of(vtkXMLDataElement& array, std::size_t n) {
    const auto n_digits = 4 * ((n + 2) / 3);
    long long offset = 0;  // whoever has one is appended, for VTK, whatever its format is said to be
    if (array.GetScalarAttribute("offset", offset) != 1)
      return from_base64(bytes_at(stream_, position_of_text(stream_, array), n_digits));
    if (offset < 0 || offset > static_cast<long long>(n_bytes_)) return "";
    return is_raw_ ? bytes_at(stream_, appended_ + offset, n)
                   : from_base64(bytes_at(stream_, appended_ + offset, n_digits));
  }

  std::istream& stream_;
  std::uint64_t n_bytes_;
  const fs::path& file_;
  std::int64_t appended_;
  std::size_t word_ = sizeof(std::uint32_t);
  bool is_big_endian_ = false, is_raw_ = false;
};

}  // namespace

void check_compressed_blocks(vtkXMLDataParser& parser, std::istream& stream, std::uint64_t n_bytes,
                             const fs::path& file) {
  auto& root = *parser.GetRootElement();
  if (root.GetAttribute("compressor") != nullptr) BlockCheck(parser, stream, n_bytes, file).check(root);
}

}  // namespace tanktread::exchange
