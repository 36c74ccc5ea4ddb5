#include "driver/stages/replay_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driver/case/case.hpp"
#include "driver/case/case_difference.hpp"
#include "driver/packets/packet_folder.hpp"
#include "driver/program/output_directory.hpp"
#include "exchange/shell_text.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

using exchange::Array;
using exchange::GridPacket;
using exchange::SurfacePacket;

/// Positions have no array of their own: as one, for the field of the difference.
Array points_array(const SurfacePacket& file) {
  return {"position", 3, file.points};
}

const Array& values_of(const SurfacePacket& file, const std::string& array, Array& points) {
  if (!array.empty()) return exchange::find_array(file.point_data, array, "a packet");
  points = points_array(file);
  return points;
}

const Array& values_of(const GridPacket& file, const std::string& array, Array&) {
  return exchange::find_array(file.point_data, array, "a packet");
}

void write(const std::filesystem::path& file, const SurfacePacket& content) {
  exchange::write_surface(file, content);
}
void write(const std::filesystem::path& file, const GridPacket& content) {
  exchange::write_grid(file, content);
}

/// The settings of the record are those that it was made with. @throws InputError
void require_recorded_case(const std::filesystem::path& record, const Case& made_it, const Case& the_case) {
  const auto lines = lines_of_fixed_keys(differences(made_it, the_case), "begin/echo.toml", "echo.toml");
  if (lines.empty()) return;
  throw InputError(fmt::format(
      "{}: echo.toml is not the case that was recorded\n{}\nset back each of these in it; what is "
      "meant to differ is said with --set",
      record.string(), lines));
}

/// Leaves of the recorded end only what the component gave.
void keep_common(std::vector<Array>& recorded, const std::vector<Array>& given) {
  std::erase_if(recorded, [&](const Array& array) {
    return exchange::find_optional_array(given, array.name) == nullptr;
  });
}

/// A packet as if all its nodes crossed the border.
GridPacket without_touched(const std::filesystem::path& file) {
  auto content = exchange::read_grid(file);
  std::erase_if(content.point_data, [](const Array& array) { return array.name == touched_array; });
  return content;
}

}  // namespace

ReplayRecord::ReplayRecord(const ReplayOptions& options) : directory_(options.record), out_(options.out) {
  for (const char* part : {"echo.toml", "begin"}) {
    if (!std::filesystem::exists(directory_ / part)) {
      throw InputError(
          fmt::format("{}: holds no {}: not a complete record; make one with tanktread run --record {}",
                      directory_.string(), part, exchange::shell_text(directory_)));
    }
  }
  if (!out_.empty()) require_new_directory("--out", out_);
  begin_ = read_state(directory_ / "begin");
  const auto the_case = read_case(directory_ / "echo.toml", {}, {false, false, false});
  if (begin_.the_case) require_recorded_case(directory_, *begin_.the_case, the_case);
  box_ = the_case.flow.box;
  const auto end = directory_ / "end" / membrane_state_file;
  has_end_ = std::filesystem::exists(end);
  last_step_ = has_end_ ? step_of(exchange::read_surface(end).field_data, end.string()) : begin_.step;
  // A run that broke down has no end: its last step is the last one with all packets.
  const auto last_packet = has_contrast(the_case) ? Packet::inside : Packet::grid_force;
  while (!has_end_ && std::filesystem::exists(packet_path(directory_, last_packet, last_step_ + 1)))
    ++last_step_;
  if (last_step_ <= begin_.step) throw InputError(directory_.string() + ": holds no whole step");
}

bool ReplayRecord::has_implicit() const {
  return std::filesystem::exists(packet_path(directory_, Packet::free_velocity, first_step()));
}

NodeVectors ReplayRecord::positions_before(std::int64_t step) const {
  return step == first_step() ? begin_.positions : nodes(Packet::positions, step - 1);
}

Surfaces ReplayRecord::surfaces_before(std::int64_t step) const {
  Surfaces surfaces{positions_before(step), {}};
  for (const auto& mesh : begin_.shapes.meshes) surfaces.triangles.push_back(mesh.triangles);
  return surfaces;
}

NodeVectors ReplayRecord::force_before(std::int64_t step) const {
  return step == first_step() ? begin_.node_force : nodes(Packet::node_force, step - 1);
}

NodeVectors ReplayRecord::nodes(Packet packet, std::int64_t step) const {
  return read_node_packet(packet_path(directory_, packet, step), packet, begin_.positions, step);
}

GridVectors ReplayRecord::grid(Packet packet, std::int64_t step, bool everywhere) const {
  const auto file = packet_path(directory_, packet, step);
  if (!everywhere) return read_grid_packet(file, packet, box_, step);
  return grid_vectors_of(without_touched(file), array_of(packet), box_, file.string());
}

template <class File>
void ReplayRecord::add(std::int64_t step, const std::string& packet, const std::filesystem::path& file,
                       const File& recorded, const File& given) {
  for (auto& difference : exchange::differences(recorded, given)) {
    differences_.push_back({step, packet, file, std::move(difference)});
  }
}

template <class File>
void ReplayRecord::write_field(Packet packet, std::int64_t step, File recorded, const File& given,
                               const std::string& array) {
  if (out_.empty()) return;
  Array recorded_points, given_points;
  const auto& before = values_of(recorded, array, recorded_points);
  const auto& now = values_of(given, array, given_points);
  Array replayed{"replayed_" + now.name, 3, now.values}, difference{"difference_" + now.name, 3, now.values};
  if (before.values.size() != now.values.size()) return;  // which the comparison has said
  for (std::size_t k = 0; k < now.values.size(); ++k) difference.values[k] -= before.values[k];
  recorded.point_data.push_back(std::move(replayed));
  recorded.point_data.push_back(std::move(difference));
  const auto file = packet_path(out_, packet, step);
  std::filesystem::create_directories(file.parent_path());
  write(file, recorded);
  const auto series = out_ / (name_of(packet) + ".pvd");
  if (!std::filesystem::exists(series)) exchange::write_series(series, {});
  exchange::append_to_series(series, {static_cast<double>(step), file.lexically_relative(out_).string()});
}

void ReplayRecord::compare(Packet packet, std::int64_t step, const NodeVectors& given) {
  const auto file = packet_path(directory_, packet, step);
  const auto recorded = exchange::read_surface(file);
  auto surfaces = surfaces_of(recorded, file.string());
  if (packet == Packet::positions) surfaces.positions = given;
  auto now = surface_file(surfaces, step);
  if (packet != Packet::positions) add_vectors(now, array_of(packet), given);
  add(step, name_of(packet), file, recorded, now);
  write_field(packet, step, recorded, now, array_of(packet));
}

void ReplayRecord::compare(Packet packet, std::int64_t step, const GridVectors& given) {
  const auto file = packet_path(directory_, packet, step);
  const auto recorded = exchange::read_grid(file);
  auto now = grid_file(given, array_of(packet), box_, step);
  if (packet == Packet::grid_velocity || packet == Packet::free_velocity)
    now.point_data.back() = exchange::find_array(recorded.point_data, touched_array, file.string());
  add(step, name_of(packet), file, recorded, now);
  write_field(packet, step, recorded, now, array_of(packet));
}

GridMarks ReplayRecord::marks(std::int64_t step, bool everywhere) const {
  const auto file = packet_path(directory_, Packet::inside, step);
  const auto n_capsules = begin_.positions.size();
  if (!everywhere) return read_marks_packet(file, n_capsules, box_, step);
  return grid_marks_of(without_touched(file), n_capsules, box_, file.string());
}

void ReplayRecord::compare(std::int64_t step, const GridMarks& news, std::span<const std::int32_t> all) {
  const auto file = packet_path(directory_, Packet::inside, step);
  add(step, name_of(Packet::inside), file, exchange::read_grid(file), marks_file(news, all, box_, step));
}

bool ReplayRecord::has_marks() const {
  return std::filesystem::exists(packet_path(directory_, Packet::inside, first_step()));
}

void ReplayRecord::compare_end(const SurfacePacket& given) {
  if (!has_end_) return;
  const auto file = directory_ / "end" / membrane_state_file;
  auto recorded = exchange::read_surface(file);
  keep_common(recorded.point_data, given.point_data);
  keep_common(recorded.cell_data, given.cell_data);
  keep_common(recorded.field_data, given.field_data);
  add(last_step_, "end", file, recorded, given);
}

void ReplayRecord::compare_end(const GridPacket& given) {
  if (!has_end_) return;
  const auto file = directory_ / "end" / fluid_state_file;
  add(last_step_, "end", file, exchange::read_grid(file), given);
}

}  // namespace tanktread::driver
