#include "driver/run/resume.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "driver/case/case_difference.hpp"
#include "driver/units/flow_units.hpp"
#include "exchange/shell_text.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {
namespace {

namespace fs = std::filesystem;

/// A run goes on with the case that it began with, but for what its state does not depend on.
/// @throws InputError that names each key, with both values
void require_same_case(const fs::path& directory, const fs::path& folder, const Case& made_it,
                       const Case& the_case) {
  const auto lines = lines_of_fixed_keys(differences(made_it, the_case), "the checkpoint", "echo.toml");
  if (lines.empty()) return;
  throw InputError(
      fmt::format("--resume {0}: {1} is not the case that {2} was made with\n{3}\nset back each of these in "
                  "it, or start a "
                  "run of its own: tanktread run {4} --output NEW",
                  directory.string(), (directory / "echo.toml").string(), folder.string(), lines,
                  exchange::shell_text(directory / "echo.toml")));
}

/// Checks a checkpoint's case and the output against it.
ResumeStart start_at(const fs::path& directory, const fs::path& folder, Checkpoint checkpoint,
                     const Case& the_case, const Output& output, bool accept_gaps) {
  ResumeStart start{folder, std::move(checkpoint.state), {}};
  if (start.state.the_case) require_same_case(directory, folder, *start.state.the_case, the_case);
  // The case's own parameters serve for both: the keys that they follow from are the same.
  const auto& made_it = start.state.the_case ? *start.state.the_case : the_case;
  start.point = {start.state.step, output_schedules(made_it, flow_parameters(the_case)), checkpoint.counts,
                 accept_gaps};
  output.check(start.point);
  return start;
}

/// The step of the latest other checkpoint that the run could go on from. @param accept_gaps as asked for
/// then @param with_pieces as read_checkpoint(): without, only that pieces are there is known
std::optional<std::int64_t> other_start(const fs::path& directory, const fs::path& folder,
                                        const Case& the_case, const Output& output, bool accept_gaps,
                                        bool with_pieces) {
  for (const auto& other : other_checkpoints(directory, folder)) {
    try {
      return start_at(directory, other, read_checkpoint(other, with_pieces), the_case, output, accept_gaps)
          .point.step;
    } catch (const InputError&) {
    } catch (const exchange::FileError&) {
      // Is no help either.
    }
  }
  return std::nullopt;
}

std::string advice_for_damage(const fs::path& directory, const fs::path& folder, const Case& the_case,
                              const Output& output, bool with_pieces) {
  if (const auto other = other_start(directory, folder, the_case, output, false, with_pieces))
    return fmt::format("go on from the checkpoint of step {0} with --from-step {0}", *other);
  if (const auto other = other_start(directory, folder, the_case, output, true, with_pieces)) {
    return fmt::format(
        "go on from the checkpoint of step {0}, without rows of tables that are missing, "
        "with --from-step {0} --accept-gaps",
        *other);
  }
  return fmt::format("there is no other that can be used; start the case anew: tanktread run {} --output NEW",
                     exchange::shell_text(directory / "echo.toml"));
}

[[noreturn]] void refuse_damaged(const exchange::FileError& error, const fs::path& directory,
                                 const fs::path& folder, const Case& the_case, const Output& output,
                                 bool with_pieces) {
  throw InputError(fmt::format("{}\n{}: the checkpoint cannot be used; {}", error.what(), folder.string(),
                               advice_for_damage(directory, folder, the_case, output, with_pieces)));
}

std::string advice_for_gap(std::optional<std::int64_t> other) {
  const std::string without =
      "or go on without what is missing, with --accept-gaps (move away first what cannot be read)";
  if (!other) return without;
  return fmt::format(
      "or go on from the checkpoint of step {0}, for which all is there, with --from-step {0}\n{1}", *other,
      without);
}

}  // namespace

ResumeStart find_start(const fs::path& directory, const Case& the_case, const Output& output,
                       const ResumeFrom& from) {
  const auto folder = find_checkpoint(directory, from.step);
  Checkpoint checkpoint;
  try {
    checkpoint = read_checkpoint(folder, from.with_pieces);
  } catch (const exchange::FileError& error) {
    refuse_damaged(error, directory, folder, the_case, output, from.with_pieces);
  }
  try {
    return start_at(directory, folder, std::move(checkpoint), the_case, output, from.accept_gaps);
  } catch (const exchange::FileError& error) {
    throw InputError(fmt::format(
        "{}\n{}", error.what(),
        advice_for_gap(other_start(directory, folder, the_case, output, false, from.with_pieces))));
  }
}

void restore_start(Engine& engine, const ResumeStart& start, const fs::path& directory, const Case& the_case,
                   const Output& output) {
  try {
    engine.restore(start.state);
  } catch (const exchange::FileError& error) {
    const bool with_pieces = start.state.membrane_pieces.empty();
    refuse_damaged(error, directory, start.folder, the_case, output, with_pieces);
  }
}

}  // namespace tanktread::driver
