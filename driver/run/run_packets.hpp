// The way of a run's packets, and what makes its steps for them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "driver/engine/one_process.hpp"
#include "driver/plan/plan.hpp"

namespace tanktread::driver {

/// How the packets of a run's steps go from phase to phase.
struct PacketOptions {
  std::filesystem::path record;      ///< a directory to record them in; "": they are not
  std::optional<std::int64_t> from;  ///< the first time step to record
  std::optional<std::int64_t> to;    ///< the end of the record; none: of the run
  bool through_files = false;        ///< every packet by way of a file in OUTPUT/packets
};

/// Whether packets are written, or go to programs and back: they all pass through one process then.
bool passes_one_process(const PacketOptions& packets, const Case& the_case);

/// Refuses what cannot be recorded, before anything is written. @throws InputError
void check_packets(const PacketOptions& packets, const std::filesystem::path& output, std::int64_t first_step,
                   std::int64_t last_step);
/// Before an earlier run is removed: the record may not be possible. @throws InputError
void make_record_directory(const PacketOptions& packets);

/// What makes the steps of a run.
struct RunEngine {
  std::unique_ptr<Engine> engine;
  OneProcess* one_process = nullptr;  ///< the same, if it is one
};

/// @param the_case borrowed by the engine @throws InputError if ranks cannot share it
RunEngine make_engine(const PacketOptions& packets, const Case& the_case, const Parameters& parameters);

/// The way that the packets of a run in one process go. @param plan must outlive it
/// @param directory of the run's output
std::unique_ptr<Passage> make_passage(const PacketOptions& packets, const Plan& plan, std::int64_t first_step,
                                      const std::filesystem::path& directory);

/// Writes echo.toml. @throws exchange::FileError
void write_echo(const Case& the_case, const std::filesystem::path& directory);

}  // namespace tanktread::driver
