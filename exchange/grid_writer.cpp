#include "exchange/grid_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "exchange/atomic_file.hpp"
#include "exchange/content_hash.hpp"
#include "exchange/descriptor.hpp"
#include "exchange/grid_text.hpp"
#include "exchange/vtk_arrays.hpp"
#include "exchange/vtk_calls.hpp"

namespace tanktread::exchange {
namespace {

using std::filesystem::path;

void check_grid(const GridPacket& packet, const path& file) {
  for (int axis = 0; axis < 3; ++axis) {
    if (packet.nodes[axis] < 1) {
      throw FileError(fmt::format("{}: cannot be written: {} nodes along {}, at least 1 is needed",
                                  file.string(), packet.nodes[axis], "xyz"[axis]));
    }
    if (!std::isfinite(packet.origin[axis]) || !(packet.spacing[axis] > 0) ||
        !std::isfinite(packet.spacing[axis])) {
      throw FileError(
          fmt::format("{}: cannot be written: origin {} and spacing {} along {}; they must be finite, "
                      "the spacing above 0",
                      file.string(), packet.origin[axis], packet.spacing[axis], "xyz"[axis]));
    }
  }
}

void check_point_data(const std::vector<ArrayShape>& shapes, const path& file) {
  std::vector<Array> arrays;
  for (const auto& shape : shapes) arrays.push_back({shape.name, shape.components, {}});
  check_arrays(arrays, any_size, "point data", file);
}

/// @return the same
const GridPacket& checked(const GridPacket& grid, const std::vector<ArrayShape>& point_data,
                          const path& file) {
  check_grid(grid, file);
  check_names(grid.field_data, file);
  check_point_data(point_data, file);
  return grid;
}

/// A new file that is written from its beginning to its end, and then once more at its beginning.
class NewFile {
 public:
  /// @param target for messages
  NewFile(const path& name, path target)
      : target_(std::move(target)), open_(name, O_WRONLY | O_CREAT | O_EXCL) {
    if (!open_.is_open()) fail(errno);
  }

  void add(std::string_view bytes) {
    write(bytes, size_);
    size_ += bytes.size();
  }
  void begin_with(std::string_view bytes) { write(bytes, 0); }

 private:
  void write(std::string_view bytes, std::uint64_t place) {
    while (!bytes.empty()) {
      const auto n = ::pwrite(open_.number(), bytes.data(), bytes.size(), static_cast<off_t>(place));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail(n < 0 ? errno : ENOSPC);
      bytes.remove_prefix(static_cast<std::size_t>(n));
      place += static_cast<std::uint64_t>(n);
    }
  }

  [[noreturn]] void fail(int error) const {
    const auto reason = reason_of_writing(error);
    throw FileError(fmt::format("{}: cannot be written: {}", target_.string(),
                                reason.empty() ? std::strerror(error) : reason));
  }

  path target_;
  Descriptor open_;
  std::uint64_t size_ = 0;
};

template <class Number>
std::string_view bytes_of(const Number* first, std::size_t n) {
  return {reinterpret_cast<const char*>(first), n * sizeof(Number)};
}

}  // namespace

class GridWriter::Work {
 public:
  Work(const path& file, const GridPacket& grid, const std::vector<ArrayShape>& point_data)
      : text_(checked(grid, point_data, file), point_data, file),
        hash_(grid, point_data.size()),
        field_data_(grid.field_data),
        point_data_(point_data),
        ranges_(point_data.size(), no_norms),
        atomic_(file),
        file_(atomic_.temporary(), file) {
    for (const int n : grid.nodes) n_nodes_ *= static_cast<std::size_t>(n);
    file_.add(text_.before({0, 0}, ranges_));
  }

  void add(std::span<const double> values) {
    if (values.empty()) return;
    if (n_left_ == 0) begin_next();
    const auto& shape = point_data_[at_];
    if (values.size() > n_left_ || values.size() % static_cast<std::size_t>(shape.components) != 0)
      throw std::logic_error("a grid file gets other numbers than it is to have");
    hash_.add(values);
    widen(ranges_[at_], shape, values);
    file_.add(bytes_of(values.data(), values.size()));
    n_left_ -= values.size();
  }

  void finish() {
    if (n_left_ > 0 || n_begun_ < point_data_.size())
      throw std::logic_error("a grid file lacks numbers that it is to have");
    file_.add(text_.after());
    const auto hash = to_array(hash_.with(field_data_)).values;
    file_.begin_with(text_.before({hash[0], hash[1]}, ranges_));
    atomic_.commit();
  }

 private:
  void begin_next() {
    if (n_begun_ == point_data_.size())
      throw std::logic_error("a grid file gets more numbers than it is to have");
    at_ = n_begun_++;
    n_left_ = n_nodes_ * static_cast<std::size_t>(point_data_[at_].components);
    hash_.begin_array(point_data_[at_], n_left_);
    const std::uint64_t n_bytes = n_left_ * sizeof(double);
    file_.add(bytes_of(&n_bytes, 1));
  }

  GridText text_;
  GridHash hash_;
  std::vector<Array> field_data_;
  std::vector<ArrayShape> point_data_;
  std::vector<NormRange> ranges_;
  AtomicFile atomic_;
  NewFile file_;  ///< closed before the temporary file is removed
  std::size_t n_nodes_ = 1;
  std::size_t n_begun_ = 0, at_ = 0, n_left_ = 0;  ///< arrays; the present one; its numbers to come
};

GridWriter::GridWriter(const path& file, const GridPacket& grid, const std::vector<ArrayShape>& point_data)
    : work_(std::make_unique<Work>(file, grid, point_data)) {}

GridWriter::~GridWriter() = default;

void GridWriter::add(std::span<const double> values) {
  work_->add(values);
}

void GridWriter::finish() {
  work_->finish();
}

}  // namespace tanktread::exchange
