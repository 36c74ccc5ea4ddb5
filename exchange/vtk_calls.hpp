// Calls into VTK's readers and writers that end in success or in a FileError.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

class vtkDataObject;
class vtkObject;
class vtkXMLReader;
class vtkXMLWriter;

namespace tanktread::exchange {

/// Gathers what VTK has to say while it lives; nothing goes to the terminal, not even from VTK's inner
/// objects. One at a time: others wait, since whether VTK speaks at all is one switch for the whole process.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// Errors and warnings of this object come here from now on.
  void listen_to(vtkObject* object);
  void listen_to_parser_of(vtkXMLReader& reader);

  /// All messages in one line, without VTK's source lines and addresses; empty if there were none.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes `data` as appended raw numbers to `file`, by AtomicFile. @throws FileError with VTK's own words
void write_with(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file);

/// The text of such a file, for what is small. @param file for messages @throws FileError with VTK's own
/// words
std::string text_with(vtkXMLWriter& writer, vtkDataObject& data, const std::filesystem::path& file);

/// What the system said last, if it is a reason for which a file cannot be written, and what can be done;
/// else
/// "". @param system_error errno
std::string reason_of_writing(int system_error);

/// Reads `file` after a look at it: it must be there, whole, and of VTK's type `type` ("UnstructuredGrid",
/// ...), and with `exact` hold no number as ASCII. The result is the reader's output. @throws FileError with
/// VTK's own words
void read_with(vtkXMLReader& reader, const std::filesystem::path& file, const std::string& type, bool exact);

}  // namespace tanktread::exchange
