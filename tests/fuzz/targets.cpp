#include "tests/fuzz/targets.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "driver/case/case.hpp"
#include "driver/diff/table_difference.hpp"
#include "driver/observe/observables.hpp"
#include "driver/packets/packet_files.hpp"
#include "driver/packets/surface_mesh.hpp"
#include "driver/program/errors.hpp"
#include "driver/run/table_file.hpp"
#include "exchange/difference.hpp"
#include "exchange/grid_pieces.hpp"
#include "exchange/surface_pieces.hpp"
#include "exchange/vtk_files.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/seeds.hpp"
#include "tests/unit/case_samples.hpp"

namespace tanktread::fuzz {
namespace {

using exchange::FileError;
namespace fs = std::filesystem;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// The echo of a case must be read as the same case. Mesh files are sought in a folder that is not there.
void check_echo(const driver::Case& the_case) {
  const auto echo = driver::to_toml(the_case);
  try {
    require(driver::parse_case(echo, "case.toml", "/nowhere") == the_case, "the echo is another case");
  } catch (const driver::InputError& error) {
    throw std::logic_error(std::string("the echo is refused: ") + error.what());
  }
}

void read_case_text(const std::string& text, const std::vector<std::string>& assignments) {
  std::optional<driver::Case> the_case;
  try {
    the_case = driver::parse_case(text, "case.toml", "/nowhere", assignments);
  } catch (const driver::InputError&) {
    return;
  }
  check_echo(*the_case);
}

void read_case_file(std::string_view bytes) {
  read_case_text(std::string(bytes), {});
}

void read_assignment(std::string_view bytes) {
  read_case_text(testing::least_case, {std::string(bytes)});
}

template <class Packet>
struct Files;

template <>
struct Files<exchange::SurfacePacket> {
  static constexpr auto read = exchange::read_surface;
  static constexpr auto read_exact = exchange::read_exact_surface;
  static constexpr auto write = exchange::write_surface;
};

template <>
struct Files<exchange::GridPacket> {
  static constexpr auto read = exchange::read_grid;
  static constexpr auto read_exact = exchange::read_exact_grid;
  static constexpr auto write = exchange::write_grid;
};

/// What was read is written and comes back with every bit, unless writing refuses it (an array without a
/// name).
template <class Packet>
void check_copy(const Packet& packet) {
  static const WorkFolder folder;
  const auto copy = folder / "copy";
  try {
    Files<Packet>::write(copy, packet);
  } catch (const FileError&) {
    return;
  }
  const auto again = exchange::differences(packet, Files<Packet>::read(copy, false));
  require(std::ranges::all_of(again, [](const auto& array) { return array.identical(); }),
          "the copy differs");
}

/// What a component, or a case, makes of a surface.
void use(const exchange::SurfacePacket& packet) {
  try {
    const auto surfaces = driver::surfaces_of(packet, "input");
    driver::vectors_of(packet, "velocity", surfaces, "input");
  } catch (const FileError&) {
  }
  try {
    driver::require_no_defects(driver::inspected(driver::to_mesh(packet), "input"), "input");
  } catch (const driver::InputError&) {
  }
}

void use(const exchange::GridPacket& packet) {
  try {
    driver::grid_vectors_of(packet, "density", packet.nodes, "input");
  } catch (const FileError&) {
  }
}

template <class Read>
void read_packet(const Read& read) {
  try {
    const auto packet = read();
    use(packet);
    check_copy(packet);
  } catch (const FileError&) {
  }
}

template <class Packet>
void read_packets(std::string_view bytes) {
  const InputFile file(bytes);
  read_packet([&] { return Files<Packet>::read(file.path(), false); });
  read_packet([&] { return Files<Packet>::read(file.path(), true); });
  read_packet([&] { return Files<Packet>::read_exact(file.path()); });
}

template <class Packet>
struct Index;

template <>
struct Index<exchange::SurfacePacket> {
  static constexpr const char* suffix = ".pvtu";
  static constexpr auto read = exchange::read_surface_index;
  static constexpr auto write = exchange::write_surface_index;
};

template <>
struct Index<exchange::GridPacket> {
  static constexpr const char* suffix = ".pvti";
  static constexpr auto read = exchange::read_grid_index;
  static constexpr auto write = exchange::write_grid_index;
};

/// A folder with the pieces that the seeds name.
struct PiecesFolder {
  PiecesFolder() { write_pieces(folder / ""); }
  const WorkFolder folder;
};

/// An index, then all that its pieces are together; the index written again is the same.
template <class Packet>
void read_index(std::string_view bytes) {
  static const PiecesFolder pieces;
  const auto file = pieces.folder / (std::string("index") + Index<Packet>::suffix);
  const auto copy = pieces.folder / (std::string("copy") + Index<Packet>::suffix);
  put_bytes(file, bytes);
  try {
    const auto index = Index<Packet>::read(file);
    Index<Packet>::write(copy, index);
  } catch (const FileError&) {
    return;
  }
  const auto text = bytes_of(copy);
  Index<Packet>::write(copy, Index<Packet>::read(copy));
  require(bytes_of(copy) == text, "the copy of an index differs");
  read_packet([&] { return Files<Packet>::read(file, false); });
  read_packet([&] { return Files<Packet>::read(copy, true); });
}

void read_series(std::string_view bytes) {
  static const WorkFolder folder;
  const InputFile file(bytes);
  const auto copy = folder / "copy.pvd";
  try {
    const auto entries = exchange::read_series(file.path());
    exchange::write_series(copy, entries);
    const auto again = exchange::read_series(copy);
    require(
        std::ranges::equal(entries, again,
                           [](const auto& a, const auto& b) { return a.time == b.time && a.file == b.file; }),
        "the copy of a series differs");
  } catch (const FileError&) {
  }
}

/// Two tables, one after the other; between them a line of equals signs.
void read_tables(std::string_view bytes) {
  constexpr std::string_view between = "\n====\n";
  const auto at = bytes.find(between);
  const InputFile first(bytes.substr(0, at));
  const InputFile second(at == std::string_view::npos ? "" : bytes.substr(at + between.size()));
  for (const auto* other : {&first, &second}) {
    driver::DifferenceReport report({});
    report.begin_file("table.csv");
    driver::compare_tables(first.path(), other->path(), report);
    require(other != &first || !report.different(), "a table differs from itself");
  }
}

/// As a resumed run does.
void read_observables(std::string_view bytes) {
  static const WorkFolder folder;
  const auto file = folder / "observables.csv";
  put_bytes(file, bytes);
  std::vector<driver::TableRow> rows;
  try {
    rows = driver::read_table(file, driver::observables_header());
  } catch (const FileError&) {
    return;
  }
  driver::write_table(file, driver::observables_header(), rows);
  const auto kept = bytes_of(file);
  driver::write_table(file, driver::observables_header(),
                      driver::read_table(file, driver::observables_header()));
  require(bytes_of(file) == kept, "a table of whole rows was changed");
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"case_file", read_case_file},
      {"assignment", read_assignment},
      {"surface", read_packets<exchange::SurfacePacket>},
      {"grid", read_packets<exchange::GridPacket>},
      {"surface_index", read_index<exchange::SurfacePacket>},
      {"grid_index", read_index<exchange::GridPacket>},
      {"series", read_series},
      {"table", read_tables},
      {"observables", read_observables},
  };
  return all;
}

const Target& target(std::string_view name) {
  const auto found =
      std::ranges::find(targets(), name, [](const Target& t) { return std::string_view(t.name); });
  if (found == targets().end()) throw std::out_of_range("there is no fuzz target " + std::string(name));
  return *found;
}

}  // namespace tanktread::fuzz
