#include "driver/engine/part_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "driver/engine/capsule_orders.hpp"
#include "driver/program/file_system_error.hpp"
#include "driver/system/capsule_shape.hpp"
#include "exchange/append_surface.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// A capsule as a surface of its own.
struct CapsuleSurface {
  std::size_t number = 0;
  exchange::SurfacePacket surface;
};

/// Brings the rank's capsules in these pieces to the ranks that write them: of piece k that one whose number
/// is k less the first. @return those of the piece that this rank is to write, ascending by number
std::vector<CapsuleSurface> brought_to_writers(const SystemPart& part, std::span<const CapsuleRange> pieces,
                                               bool is_state) {
  const auto capsules = part.capsules();
  std::vector<ranks::Message> messages;
  for (std::size_t writer = 0; writer < pieces.size(); ++writer) {
    ranks::Packing letter;
    for (std::size_t k = 0; k < capsules.membranes.size(); ++k) {
      const auto number = capsules.number(k);
      if (number < pieces[writer].first || number >= pieces[writer].end) continue;
      letter.put(true).put(number);
      pack(letter, surface_to_write(capsules.some(k, 1), part.arrays(), is_state));
    }
    if (letter.bytes().empty()) continue;
    letter.put(false);
    messages.push_back({static_cast<int>(writer), letter.take_bytes()});
  }
  std::vector<CapsuleSurface> found;
  for (auto& message : part.world().exchange(std::move(messages))) {
    ranks::Unpacking letter(std::move(message.bytes));
    while (letter.take<bool>()) {
      const auto number = letter.take<std::size_t>();
      found.push_back({number, take_surface(letter)});
    }
  }
  std::ranges::sort(found, {}, &CapsuleSurface::number);
  return found;
}

/// One surface of several, each of which may have field data of its own. @param surfaces at least one
exchange::SurfacePacket put_together(std::vector<CapsuleSurface> surfaces) {
  auto whole = std::move(surfaces.front().surface);
  for (std::size_t k = 1; k < surfaces.size(); ++k) {
    auto& next = surfaces[k].surface;
    exchange::append_surface(whole, next);
    for (auto& array : next.field_data) {
      if (exchange::find_optional_array(whole.field_data, array.name) == nullptr)
        whole.field_data.push_back(std::move(array));
    }
    next = {};
  }
  return whole;
}

/// "": all is well.
std::string error_of_writing(const std::filesystem::path& file, const exchange::SurfacePacket& content) {
  try {
    std::filesystem::create_directories(file.parent_path());
    exchange::write_surface(file, content);
  } catch (const std::filesystem::filesystem_error& error) {
    return message_of(error);
  } catch (const std::exception& error) {  // the others wait for the word of this rank
    return error.what();
  }
  return "";
}

/// Why these are not all capsules of a case in their order; "": they are.
/// @param found piece and number of each, those of a piece one after the other
std::string objection_to(const std::vector<double>& found, std::size_t n_capsules, const std::string& name) {
  std::vector<std::pair<double, double>> capsules;
  for (std::size_t k = 0; k + 1 < found.size(); k += 2) capsules.emplace_back(found[k], found[k + 1]);
  std::ranges::stable_sort(capsules, {}, [](const auto& capsule) { return capsule.first; });
  bool are_all = capsules.size() == n_capsules;
  for (std::size_t k = 0; are_all && k < n_capsules; ++k)
    are_all = capsules[k].second == static_cast<double>(k);
  if (are_all) return "";
  return fmt::format(
      "{}: its pieces have {} capsules, the case has {}, each of which must be there once, in their order",
      name, capsules.size(), n_capsules);
}

}  // namespace

SurfacesWritten write_surfaces(const SystemPart& part, const SurfacesToWrite& what) {
  const auto pieces = ranges_of_pieces(part.n_triangles(), what.most_triangles);
  const auto n_ranks = static_cast<std::size_t>(part.world().size());
  const auto rank = static_cast<std::size_t>(part.world().rank());
  SurfacesWritten written{"", pieces.size(), {}};
  for (std::size_t round = 0; round < pieces.size(); round += n_ranks) {
    const auto of_round = std::span(pieces).subspan(round, std::min(n_ranks, pieces.size() - round));
    auto surfaces = brought_to_writers(part, of_round, what.is_state);
    if (rank >= of_round.size()) continue;
    auto content = put_together(std::move(surfaces));
    const auto error = error_of_writing(file_of_piece(what.file, round + rank, pieces.size()), content);
    if (written.error.empty()) written.error = error;
    if (round + rank == 0 && pieces.size() > 1) written.first = std::move(content);
  }
  return written;
}

void pack(ranks::Packing& packing, const SurfacesToWrite& what) {
  packing.put_text(what.file.string()).put(what.is_state).put(what.most_triangles);
}

SurfacesToWrite take_surfaces_to_write(ranks::Unpacking& unpacking) {
  SurfacesToWrite what;
  what.file = unpacking.take_text();
  what.is_state = unpacking.take<bool>();
  what.most_triangles = unpacking.take<std::int64_t>();
  return what;
}

CapsulesMade make_capsules(const ranks::World& world, const Case& the_case) {
  CapsulesMade made;
  for (auto k = static_cast<std::size_t>(world.rank()); k < the_case.capsules.size();
       k += static_cast<std::size_t>(world.size())) {
    try {
      auto shape = capsule_shape(the_case, k);
      made.capsules.push_back({k, std::move(shape.mesh), std::move(shape.stress_free), std::nullopt});
    } catch (const std::runtime_error& error) {  // an InputError, or one of the file system
      made.error = StepError{StepPhase::restore, k, false, error.what()};
      break;
    }
  }
  return made;
}

CapsulesRead read_capsules(const ranks::World& world, const std::filesystem::path& index_file,
                           std::size_t n_capsules) {
  CapsulesRead read;
  std::vector<double> numbers;
  try {
    const auto index = exchange::read_surface_index(index_file);
    for (auto piece = static_cast<std::size_t>(world.rank()); piece < index.pieces.size();
         piece += static_cast<std::size_t>(world.size())) {
      for (auto& capsule : part_capsules(read_saved_capsules(index_file, index, piece))) {
        numbers.insert(numbers.end(), {static_cast<double>(piece), static_cast<double>(capsule.number)});
        read.capsules.push_back(std::move(capsule));
      }
    }
  } catch (const std::runtime_error& error) {  // a FileError, or one of the file system
    read.error = error.what();
  }
  read.all_well = world.highest(read.error.empty() ? 0 : 1) == 0;
  if (!read.all_well) return read;
  read.error = objection_to(world.all_numbers(numbers), n_capsules, index_file.string());
  read.all_well = read.error.empty();  // all see the same numbers
  return read;
}

std::vector<PartCapsule> part_capsules(SavedCapsules saved) {
  std::vector<PartCapsule> capsules;
  for (std::size_t k = 0; k < saved.positions.size(); ++k) {
    capsules.push_back(
        {saved.first + k, std::move(saved.shapes.meshes[k]), std::move(saved.shapes.stress_free[k]),
         PartCapsule::State{std::move(saved.positions[k]), std::move(saved.node_velocity[k]),
                            std::move(saved.node_force[k]), std::move(saved.membranes[k].history)}});
  }
  return capsules;
}

}  // namespace tanktread::driver
