#include "driver/outside/outside_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "driver/packets/packet_files.hpp"
#include "driver/program/errors.hpp"

namespace tanktread::driver {
namespace {

using exchange::FileError;

std::unique_ptr<ChildProcess> started(const std::vector<std::string>& command, double seconds,
                                      const std::string& component) {
  try {
    return std::make_unique<ChildProcess>(command, seconds);
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("the program of the {}, {}, cannot be started: {}", component,
                                 fmt::join(command, " "), error.code().message()));
  }
}

/// Writes a packet with what its `write` is. A disk in memory may be small.
template <class Write>
void written(Write write) {
  try {
    write();
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}; run.command_directory puts packets elsewhere", error.what()));
  }
}

/// Reads the packet that an answer names, with what its `read` is.
template <class Read>
auto answered(const std::string& answer, Read read) -> Reply<decltype(read(answer))> {
  try {
    return {read(answer), answer};
  } catch (const FileError& error) {
    throw FileError(fmt::format("its answer '{}' is not the name of a packet that can be read: {}", answer,
                                error.what()));
  }
}

}  // namespace

OutsideProgram::OutsideProgram(const std::vector<std::string>& command, const RunCase& run,
                               const std::string& place, std::string component)
    : component_(std::move(component)),
      command_(fmt::format("{}", fmt::join(command, " "))),
      directory_(run.command_directory, place),
      process_(started(command, run.command_time_limit, component_)) {}

Reply<exchange::SurfacePacket> OutsideProgram::ask(const exchange::SurfacePacket& input) {
  const auto file = directory_.next_file(".vtu");
  written([&] { exchange::write_surface(file, input); });
  return answered(process_->ask(file.string()), exchange::read_exact_surface);
}

Reply<exchange::GridPacket> OutsideProgram::ask(const exchange::GridPacket& input) {
  const auto file = directory_.next_file(".vti");
  written([&] { exchange::write_grid(file, input); });
  return answered(process_->ask(file.string()), exchange::read_exact_grid);
}

void OutsideProgram::report(std::int64_t step, const std::string& what) const {
  throw RunError(fmt::format("step {}: the program of the {}: {}", step, name(), what));
}

const exchange::Array& reply_array(const std::vector<exchange::Array>& arrays, const std::string& array,
                                   int components, std::size_t n_tuples, const std::string& where,
                                   const std::string& file) {
  const auto expected =
      fmt::format("expected {} '{}' of {} x {} numbers (Float64)", where, array, n_tuples, components);
  std::string present;
  for (const auto& found : arrays) {
    present += (present.empty() ? "" : ", ") + found.name;
    if (found.name != array) continue;
    if (found.components == components && found.values.size() == n_tuples * std::size_t(components))
      return found;
    throw FileError(fmt::format("{}: '{}' has {} components; {}", file, array, found.components, expected));
  }
  throw FileError(fmt::format("{}: the array '{}' is missing; {}; there are: {}", file, array, expected,
                              present.empty() ? "none" : present));
}

void check_reply_step(const std::vector<exchange::Array>& field_data, std::int64_t step,
                      const std::string& file) {
  if (exchange::find_optional_array(field_data, "step") == nullptr || step_of(field_data, file) == step)
    return;
  throw FileError(fmt::format("{}: of step {}; expected one of step {}, or without `step`", file,
                              step_of(field_data, file), step));
}

}  // namespace tanktread::driver
