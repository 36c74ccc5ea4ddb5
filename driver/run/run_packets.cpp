#include "driver/run/run_packets.hpp"

#include <fmt/format.h>

#include "driver/case/case_programs.hpp"
#include "driver/engine/many_ranks.hpp"
#include "driver/program/output_directory.hpp"
#include "driver/stages/file_passage.hpp"
#include "driver/system/run_ranks.hpp"
#include "driver/units/laws.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

/// The steps to record, checked against those of the run. @throws InputError
RecordedSteps recorded_steps(const PacketOptions& packets, std::int64_t first_step, std::int64_t last_step) {
  const RecordedSteps steps{packets.from.value_or(first_step), packets.to.value_or(last_step)};
  if (steps.from >= first_step && steps.from < steps.to && steps.to <= last_step) return steps;
  throw InputError(
      fmt::format("--from {} --to {}: the run goes from step {} to step {}; give steps within that, the "
                  "first below the last",
                  steps.from, steps.to, first_step, last_step));
}

}  // namespace

void check_packets(const PacketOptions& packets, const std::filesystem::path& output, std::int64_t first_step,
                   std::int64_t last_step) {
  if (packets.record.empty()) return;
  recorded_steps(packets, first_step, last_step);
  require_new_directory("--record", packets.record);
  if (!is_place_of_run(output, packets.record)) return;
  throw InputError(
      fmt::format("--record {}: is a place of the run's own output in {}; give another directory",
                  packets.record.string(), output.string()));
}

void make_record_directory(const PacketOptions& packets) {
  if (packets.record.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(packets.record, error);
  if (error) {
    throw InputError(fmt::format("--record {}: cannot be made ({}); give another directory",
                                 packets.record.string(), error.message()));
  }
}

bool passes_one_process(const PacketOptions& packets, const Case& the_case) {
  return other_ranks() == nullptr || packets.through_files || !packets.record.empty() ||
         has_program(the_case);
}

RunEngine make_engine(const PacketOptions& packets, const Case& the_case, const Parameters& parameters) {
  if (!passes_one_process(packets, the_case))
    return {std::make_unique<ManyRanks>(the_case, parameters), nullptr};
  auto one_process = std::make_unique<OneProcess>(the_case, parameters);
  auto* pointer = one_process.get();
  return {std::move(one_process), pointer};
}

std::unique_ptr<Passage> make_passage(const PacketOptions& packets, const Plan& plan, std::int64_t first_step,
                                      const std::filesystem::path& directory) {
  if (packets.through_files) return std::make_unique<FilePassage>(directory / "packets");
  if (packets.record.empty()) return std::make_unique<Passage>();
  const auto last_step = last_step_of(plan.the_case, plan.parameters);
  write_echo(plan.the_case, packets.record);
  return std::make_unique<Recorder>(packets.record, recorded_steps(packets, first_step, last_step),
                                    plan.the_case, any_implicit(plan.the_case, plan.parameters));
}

void write_echo(const Case& the_case, const std::filesystem::path& directory) {
  exchange::write_text(directory / "echo.toml", to_toml(the_case));
}

}  // namespace tanktread::driver
