// Aligned text in sections: the layout of the echo, which knows nothing of what it says.
#pragma once

#include <string>

namespace tanktread::driver {

/// Columns name, value (lattice units), SI value (if there is that column), note; 100 wide.
class EchoTable {
 public:
  explicit EchoTable(bool has_si_column);

  void title(const std::string& title);
  void section(const std::string& name);
  /// @param is_shown false leaves the row out, which spares the caller an if
  void row(const std::string& name, const std::string& value, const std::string& in_si = "",
           const std::string& note = "", bool is_shown = true);
  /// Text broken between words into lines of at most 100 columns, the later ones indented.
  void paragraph(const std::string& text);

  const std::string& text() const { return text_; }

 private:
  bool has_si_column_;
  bool has_heading_ = false;
  std::string text_;
};

}  // namespace tanktread::driver
