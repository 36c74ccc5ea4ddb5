// A hash of all that a packet holds, kept in its file, so that changed numbers are noticed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "exchange/array_shape.hpp"
#include "exchange/packet.hpp"

namespace tanktread::exchange {

/// The name of the field data array that holds the hash in a file: two numbers, the upper and the lower 32
/// bits (text would be shorter, but meshio refuses it in field data). Reading checks it and leaves it out.
inline constexpr const char* content_hash_name = "content_hash";

/// XXH3 (64 bits, no seed) over the packet. Each part counts: the name of its kind, then
/// - "points": coordinates; "triangles": nodes, as 64-bit integers; "grid": nodes, position of the first of
/// them, spacing;
/// - "point data", "cell data", "field data": of each array in order its name, components and values.
/// A text or list enters as its length (64-bit integer) and its bytes as they lie in memory, where doubles
/// and integers are little-endian. Hence -0.0 is not 0.0, and the payload of a NaN counts; but
/// an origin of -0.0 is one of 0.0, as which VTK writes it.
std::uint64_t content_hash(const SurfacePacket& packet);
std::uint64_t content_hash(const GridPacket& packet);

/// The same of a grid whose numbers come in parts: array after array, each begun and then added to.
class GridHash {
 public:
  /// @param grid all but its point data @param n_arrays of point data
  GridHash(const GridPacket& grid, std::size_t n_arrays);
  ~GridHash();
  GridHash(const GridHash&) = delete;
  GridHash& operator=(const GridHash&) = delete;

  void begin_array(const ArrayShape& array, std::size_t n_values);
  void add(std::span<const double> values);
  /// After the last array.
  std::uint64_t with(const std::vector<Array>& field_data);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The hash as the array of a file.
Array to_array(std::uint64_t hash);

/// Takes the array content_hash out of `packet`, as read from `file`, and holds it against the rest. A packet
/// without one passes: its file was made by another program.
/// @throws FileError if they differ
void check_content(SurfacePacket& packet, const std::filesystem::path& file);
void check_content(GridPacket& packet, const std::filesystem::path& file);

/// Takes the array content_hash out of field data; none if there is none.
std::optional<Array> take_hash(std::vector<Array>& field_data);

/// @param stored the array content_hash of a file @param found of its contents @throws FileError if they
/// differ
void check_hash(const Array& stored, std::uint64_t found, const std::filesystem::path& file);

/// Takes the array content_hash out of field data unread.
void drop_hash(std::vector<Array>& field_data);

/// @throws FileError if field data that are to be written have a name that the file keeps for itself
void check_names(const std::vector<Array>& field_data, const std::filesystem::path& file);

}  // namespace tanktread::exchange
