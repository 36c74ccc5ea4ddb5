#include "exchange/vtk_calls.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCommand.h>
#include <vtkDataCompressor.h>
#include <vtkDataSet.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLReader.h>
#include <vtkXMLWriter.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <new>
#include <regex>
#include <vector>

#include "exchange/atomic_file.hpp"
#include "exchange/file_head.hpp"
#include "exchange/vtk_files.hpp"
#include "exchange/whole_file.hpp"

namespace tanktread::exchange {
namespace {

namespace fs = std::filesystem;

/// VTK's "ERROR: In file.cxx, line 12\nvtkClass (0x1234): words\n\n" as "words": which of its objects spoke
/// means nothing to a user.
std::string tidy(const std::string& message) {
  static const std::regex source_line("^[^\n]*: In [^\n]*, line [0-9]+\n");
  static const std::regex object("vtk\\w+ ?\\((0x[0-9a-f]+|nullptr)\\)(: )?"), prefix("\\bvtk(?=[A-Z])");
  static const std::regex line_break("\\s*\n\\s*");
  auto text = std::regex_replace(message, source_line, "");
  text = std::regex_replace(text, object, "");
  text = std::regex_replace(text, prefix, "");
  text.erase(text.find_last_not_of(" \n") + 1);
  return std::regex_replace(text, line_break, " ");
}

class Collector : public vtkCommand {
 public:
  static Collector* New() { return new Collector; }
  void Execute(vtkObject* caller, unsigned long, void* text) override {
    // The pipeline only repeats, at length, that a reader or writer failed.
    if (vtkExecutive::SafeDownCast(caller) != nullptr && !messages.empty()) return;
    messages.push_back(tidy(static_cast<const char*>(text)));
  }
  std::vector<std::string> messages;
};

std::mutex one_at_a_time;

/// Throws what VTK said or, if it failed without a word, its error code.
void check_outcome(const VtkMessages& messages, unsigned long error_code, const fs::path& file,
                   const char* what) {
  auto text = messages.text();
  if (text.empty() && error_code == 0) return;
  if (text.empty() && error_code < vtkErrorCode::FirstVTKErrorCode) {
    text = std::strerror(static_cast<int>(error_code));
  } else if (text.empty()) {
    text = fmt::format("it is not as VTK files are (VTK's error {})", error_code);
  }
  throw FileError(fmt::format("{}: {}: {}", file.string(), what, text));
}

/// Keeps VTK's logger off the terminal while it lives.
class SilentLogger {
 public:
  SilentLogger() {
    const auto before = vtkLogger::GetCurrentVerbosityCutoff();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const auto others = vtkLogger::GetCurrentVerbosityCutoff();
    // The cutoff is the most talkative of terminal and log files: if files drown the terminal, take VTK's
    // default.
    terminal_ = before > others ? before : std::min(before, vtkLogger::VERBOSITY_INFO);
  }
  ~SilentLogger() { vtkLogger::SetStderrVerbosity(terminal_); }
  SilentLogger(const SilentLogger&) = delete;
  SilentLogger& operator=(const SilentLogger&) = delete;

 private:
  vtkLogger::Verbosity terminal_;
};

void set_form(vtkXMLWriter& writer) {
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToNone();
  writer.SetHeaderTypeToUInt64();  // arrays beyond 4 GiB
}

/// To where the writer is told to. @param file for messages
void write_appended(vtkXMLWriter& writer, vtkDataObject& data, const fs::path& file) {
  VtkMessages messages;
  messages.listen_to(&writer);
  messages.listen_to(writer.GetExecutive());
  writer.SetInputData(&data);
  set_form(writer);
  errno = 0;
  const bool written = writer.Write() == 1;
  const auto reason = reason_of_writing(errno);
  const bool failed = !written || writer.GetErrorCode() != 0 || !messages.text().empty();
  if (failed && !reason.empty())
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), reason));
  check_outcome(messages, writer.GetErrorCode(), file, "cannot be written");
  if (!written) {  // VTK may also fail without a word
    throw FileError(fmt::format("{}: cannot be written: VTK's writer failed", file.string()));
  }
}

}  // namespace

struct VtkMessages::State {
  std::lock_guard<std::mutex> lock{one_at_a_time};
  SilentLogger silence;
  int display = vtkObject::GetGlobalWarningDisplay();
  vtkNew<Collector> collector;
};

VtkMessages::VtkMessages() : state_(std::make_unique<State>()) {
  vtkObject::SetGlobalWarningDisplay(1);  // observers hear nothing while it is off
}

VtkMessages::~VtkMessages() {
  vtkObject::SetGlobalWarningDisplay(state_->display);
}

void VtkMessages::listen_to(vtkObject* object) {
  object->AddObserver(vtkCommand::ErrorEvent, state_->collector);
  object->AddObserver(vtkCommand::WarningEvent, state_->collector);
}

void VtkMessages::listen_to_parser_of(vtkXMLReader& reader) {
  reader.SetParserErrorObserver(state_->collector);
}

std::string VtkMessages::text() const {
  return fmt::format("{}", fmt::join(state_->collector->messages, "; "));
}

// VTK passes on that a write failed, not why.
std::string reason_of_writing(int system_error) {
  constexpr std::array reasons = {ENOSPC, EDQUOT, EFBIG,  EIO,    EROFS, EACCES,
                                  EPERM,  EMFILE, ENFILE, ENOMEM, ENOENT};
  if (std::ranges::find(reasons, system_error) == reasons.end()) return "";
  std::string text = std::strerror(system_error);
  if (system_error == ENOSPC || system_error == EDQUOT) text += "; make room there, or write elsewhere";
  return text;
}

void write_with(vtkXMLWriter& writer, vtkDataObject& data, const fs::path& file) {
  AtomicFile atomic(file);
  writer.SetFileName(atomic.temporary().c_str());
  write_appended(writer, data, file);
  atomic.commit();
}

std::string text_with(vtkXMLWriter& writer, vtkDataObject& data, const fs::path& file) {
  writer.SetWriteToOutputString(1);
  write_appended(writer, data, file);
  return writer.GetOutputString();
}

void read_with(vtkXMLReader& reader, const fs::path& file, const std::string& type, bool exact) {
  const WholeFile whole(file, type);
  const int n_field_arrays = check_head(whole, type, exact);
  VtkMessages messages;
  messages.listen_to(&reader);
  messages.listen_to(reader.GetExecutive());
  messages.listen_to_parser_of(reader);
  reader.SetFileName(whole.content().c_str());
  try {
    reader.UpdateInformation();
    if (reader.GetXMLParser() && reader.GetXMLParser()->GetCompressor()) {
      messages.listen_to(reader.GetXMLParser()->GetCompressor());
    }
    check_outcome(messages, reader.GetErrorCode(), file, "cannot be read");
    reader.Update();
  } catch (const std::bad_alloc&) {
    throw FileError(fmt::format("{}: cannot be read: an array is too large for the memory", file.string()));
  }
  check_outcome(messages, reader.GetErrorCode(), file, "cannot be read");
  const int n_read = reader.GetOutputAsDataSet()->GetFieldData()->GetNumberOfArrays();
  if (n_read != n_field_arrays) {
    throw FileError(
        fmt::format("{}: cannot be read: its head tells of {} arrays of field data, of which {} are there "
                    "as it says; write or copy it again",
                    file.string(), n_field_arrays, n_read));
  }
}

}  // namespace tanktread::exchange
