#include "exchange/vtk_support.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkXMLReader.h>
#include <vtkXMLWriter.h>

#include <cerrno>
#include <cstring>

namespace tanktread::exchange {
namespace {

/// Collects what VTK complains about an object, in place of its printing it.
class Complaints {
 public:
  explicit Complaints(vtkObject* object) : object_(object) {
    callback_->SetClientData(&text_);
    callback_->SetCallback([](vtkObject*, unsigned long, void* client, void* message) {
      auto& text = *static_cast<std::string*>(client);
      text += (text.empty() ? "" : " ") + std::string(static_cast<const char*>(message));
    });
    error_tag_ = object->AddObserver(vtkCommand::ErrorEvent, callback_);
    warning_tag_ = object->AddObserver(vtkCommand::WarningEvent, callback_);
  }
  ~Complaints() {
    object_->RemoveObserver(error_tag_);
    object_->RemoveObserver(warning_tag_);
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  /// VTK's words on one line.
  std::string text() const {
    std::string line = text_;
    for (char& character : line) character = character == '\n' ? ' ' : character;
    return line;
  }

 private:
  vtkObject* object_;
  vtkNew<vtkCallbackCommand> callback_;
  unsigned long error_tag_ = 0, warning_tag_ = 0;
  std::string text_;
};

}  // namespace

void lend_arrays(const std::vector<Array>& arrays, std::int64_t n_tuples, vtkFieldData* target,
                 const std::filesystem::path& file) {
  for (const auto& array : arrays) {
    const auto size = static_cast<std::int64_t>(array.values.size());
    if (array.components < 1 || size % array.components != 0 ||
        (n_tuples > 0 && size != n_tuples * array.components)) {
      throw FileError(fmt::format("{}: array '{}' has {} values, which are not {} tuples of {}",
                                  file.string(), array.name, size, n_tuples, array.components));
    }
    vtkNew<vtkDoubleArray> lent;
    lent->SetName(array.name.c_str());
    lent->SetNumberOfComponents(array.components);
    constexpr int keep_ours = 1;  // VTK must not free it; the writer only reads
    lent->SetArray(const_cast<double*>(array.values.data()), size, keep_ours);
    target->AddArray(lent);
  }
}

std::vector<Array> copy_arrays(vtkFieldData* source, bool convert, const std::filesystem::path& file) {
  std::vector<Array> arrays;
  for (int k = 0; k < source->GetNumberOfArrays(); ++k) {
    auto* array = source->GetArray(k);
    if (array == nullptr) {
      if (convert) continue;  // text, which a file made elsewhere may carry
      throw FileError(fmt::format("{}: array {} is not numeric", file.string(), k));
    }
    const std::string name = array->GetName() != nullptr ? array->GetName() : "";
    if (array->GetDataType() != VTK_DOUBLE && !convert) {
      throw FileError(
          fmt::format("{}: array '{}' is {}, must be double (Float64); convert the file, or write doubles",
                      file.string(), name, array->GetDataTypeAsString()));
    }
    Array copy{name, array->GetNumberOfComponents(), {}};
    const vtkIdType size = array->GetNumberOfValues();
    copy.values.resize(size);
    if (auto* doubles = vtkDoubleArray::SafeDownCast(array)) {
      if (size > 0) std::memcpy(copy.values.data(), doubles->GetPointer(0), sizeof(double) * size);
    } else {
      for (vtkIdType i = 0; i < size; ++i)
        copy.values[i] = array->GetComponent(i / copy.components, static_cast<int>(i % copy.components));
    }
    arrays.push_back(std::move(copy));
  }
  return arrays;
}

void write_whole(vtkXMLWriter* writer, const std::filesystem::path& file) {
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  write_then_rename(file, [&](const std::filesystem::path& temporary) {
    const Complaints complaints(writer);
    writer->SetFileName(temporary.c_str());
    if (writer->Write() == 0 || !complaints.text().empty()) {
      throw FileError(fmt::format("{}: cannot be written: {}", file.string(), complaints.text()));
    }
  });
}

void read_whole(vtkXMLReader* reader, const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw FileError(fmt::format("{}: there is no such file", file.string()));
  const Complaints complaints(reader);
  reader->SetFileName(file.c_str());
  if (reader->CanReadFile(file.c_str()) == 0) {
    throw FileError(fmt::format("{}: not a {} file (or cut short)", file.string(), reader->GetClassName()));
  }
  reader->Update();
  if (reader->GetErrorCode() != 0 || !complaints.text().empty()) {
    throw FileError(fmt::format("{}: cannot be read: {}", file.string(), complaints.text()));
  }
}

void write_then_rename(const std::filesystem::path& file,
                       const std::function<void(const std::filesystem::path&)>& write) {
  auto temporary = file;
  temporary += fmt::format(".{}.tmp", getpid());
  try {
    write(temporary);
    const int descriptor = open(temporary.c_str(), O_RDONLY);
    if (descriptor < 0 || fsync(descriptor) != 0) {
      const std::string reason = std::strerror(errno);
      if (descriptor >= 0) close(descriptor);
      throw FileError(fmt::format("{}: cannot be written: {}", file.string(), reason));
    }
    close(descriptor);
    std::error_code error;
    std::filesystem::rename(temporary, file, error);
    if (error) throw FileError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace tanktread::exchange
