#include "exchange/content_hash.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <string_view>

#define XXH_INLINE_ALL  // no library to link: whoever uses the installed component needs none either
#include <xxhash.h>

#include "exchange/meshio_padding.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::exchange {
namespace {

static_assert(std::endian::native == std::endian::little, "the hash is of little-endian numbers");

class Hasher {
 public:
  Hasher() { XXH3_64bits_reset(&state_); }

  void add(std::int64_t number) { add_bytes(&number, sizeof number); }

  void add(std::string_view text) {
    add(static_cast<std::int64_t>(text.size()));
    add_bytes(text.data(), text.size());
  }

  template <class List>
  void add_list(const List& numbers) {
    const auto n_bytes = numbers.size() * sizeof numbers[0];
    add(static_cast<std::int64_t>(n_bytes));
    add_bytes(numbers.data(), n_bytes);
  }

  void begin_arrays(std::string_view kind, std::size_t n_arrays) {
    add(kind);
    add(static_cast<std::int64_t>(n_arrays));
  }

  /// Its values follow, in any parts.
  void begin_array(std::string_view name, int components, std::size_t n_values) {
    add(name);
    add(std::int64_t{components});
    add(static_cast<std::int64_t>(n_values * sizeof(double)));
  }
  void add_values(std::span<const double> values) { add_bytes(values.data(), values.size_bytes()); }

  void add_arrays(std::string_view kind, const std::vector<Array>& arrays) {
    begin_arrays(kind, arrays.size());
    for (const auto& array : arrays) {
      begin_array(array.name, array.components, array.values.size());
      add_values(array.values);
    }
  }

  std::uint64_t result() const { return XXH3_64bits_digest(&state_); }

 private:
  void add_bytes(const void* first, std::size_t n_bytes) {
    if (n_bytes > 0) XXH3_64bits_update(&state_, first, n_bytes);  // an empty list may lie nowhere
  }

  XXH3_state_t state_;
};

template <class Packet>
void check(Packet& packet, const std::filesystem::path& file) {
  if (const auto stored = take_hash(packet.field_data)) check_hash(*stored, content_hash(packet), file);
}

}  // namespace

std::uint64_t content_hash(const SurfacePacket& packet) {
  Hasher hasher;
  hasher.add("points");
  hasher.add_list(packet.points);
  hasher.add("triangles");
  hasher.add_list(packet.triangles);
  hasher.add_arrays("point data", packet.point_data);
  hasher.add_arrays("cell data", packet.cell_data);
  hasher.add_arrays("field data", packet.field_data);
  return hasher.result();
}

struct GridHash::State {
  Hasher hasher;
};

GridHash::GridHash(const GridPacket& grid, std::size_t n_arrays) : state_(std::make_unique<State>()) {
  auto& hasher = state_->hasher;
  hasher.add("grid");
  for (const int n : grid.nodes) hasher.add(std::int64_t{n});
  auto origin = first_node(grid);
  for (double& x : origin) x += 0.0;  // -0.0 becomes 0.0
  hasher.add_list(origin);
  hasher.add_list(grid.spacing);
  hasher.begin_arrays("point data", n_arrays);
}

GridHash::~GridHash() = default;

void GridHash::begin_array(const ArrayShape& array, std::size_t n_values) {
  state_->hasher.begin_array(array.name, array.components, n_values);
}

void GridHash::add(std::span<const double> values) {
  state_->hasher.add_values(values);
}

std::uint64_t GridHash::with(const std::vector<Array>& field_data) {
  state_->hasher.add_arrays("field data", field_data);
  return state_->hasher.result();
}

std::uint64_t content_hash(const GridPacket& packet) {
  GridHash hash(packet, packet.point_data.size());
  for (const auto& array : packet.point_data) {
    hash.begin_array({array.name, array.components}, array.values.size());
    hash.add(array.values);
  }
  return hash.with(packet.field_data);
}

Array to_array(std::uint64_t hash) {
  return {content_hash_name, 1, {static_cast<double>(hash >> 32), static_cast<double>(hash & 0xffffffffU)}};
}

void check_content(SurfacePacket& packet, const std::filesystem::path& file) {
  check(packet, file);
}

void check_content(GridPacket& packet, const std::filesystem::path& file) {
  check(packet, file);
}

std::optional<Array> take_hash(std::vector<Array>& field_data) {
  const auto found = std::find_if(field_data.begin(), field_data.end(),
                                  [](const Array& array) { return array.name == content_hash_name; });
  if (found == field_data.end()) return std::nullopt;
  auto array = std::move(*found);
  field_data.erase(found);
  return array;
}

void check_hash(const Array& stored, std::uint64_t found, const std::filesystem::path& file) {
  if (stored.values == to_array(found).values) return;
  throw FileError(
      fmt::format("{}: the contents are not those that were written: their hash is not the file's {}. The "
                  "file is damaged: write or copy it again. If it was changed on purpose, remove the array "
                  "{} from its field data",
                  file.string(), content_hash_name, content_hash_name));
}

void drop_hash(std::vector<Array>& field_data) {
  take_hash(field_data);
}

void check_names(const std::vector<Array>& field_data, const std::filesystem::path& file) {
  for (const auto& array : field_data) {
    if (array.name == content_hash_name || array.name == padding_name) {
      throw FileError(
          fmt::format("{}: cannot be written: the name '{}' is kept for an array that writing adds; give the "
                      "field data array another name",
                      file.string(), array.name));
    }
  }
}

}  // namespace tanktread::exchange
