// The output directory of a run: observables.csv, measures.csv, energy.csv, membrane.pvd, fluid.pvd and their
// files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "driver/engine/engine.hpp"
#include "driver/run/output_series.hpp"
#include "driver/run/output_table.hpp"
#include "driver/run/row_counts.hpp"

namespace tanktread::driver {

/// When each kind of output is due.
struct OutputSchedules {
  Schedule observables, measures, energy, membrane, fluid;
};
OutputSchedules output_schedules(const Case& the_case, const FlowParameters& parameters);

/// The state that a run goes on from, as far as its output is concerned.
struct ResumePoint {
  std::int64_t step = 0;
  OutputSchedules schedules;        ///< of the run that wrote the state
  std::optional<RowCounts> counts;  ///< due up to there; none: not known, told by the schedules
  bool accept_gaps = false;         ///< rows may be missing
};

/// Writes what is due, when it is due. Files of a series are named by their step. Both series have an entry
/// at each time at which a file of either is written (OutputSeries).
class Output {
 public:
  Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory);

  /// Starts new tables and series.
  void begin();

  /// Whether the run can go on with its tables and series from the point. Writes nothing.
  /// @throws exchange::FileError if a table cannot be read or lacks rows, or a series names what is not of
  /// this run
  void check(const ResumePoint& point) const;

  /// Cuts tables and series back to what the run had written up to the point; an uninterrupted run with the
  /// same intervals has the same. A series that cannot be read is made anew from its files, which is said.
  /// @throws exchange::FileError
  void resume(const ResumePoint& point);

  /// The rows of the tables that were due so far.
  RowCounts row_counts() const { return {observables_.n_rows(), measures_.n_rows(), energy_.n_rows()}; }

  /// Whether anything is due at this step. @param last of the run
  bool due(std::int64_t step, bool last) const;

  /// Writes all that is due at this step; with `last`, the state at the end of the run too.
  /// @return the observations if they were due, else none
  std::vector<Observation> write(Engine& engine, bool last);

 private:
  Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory,
         const OutputSchedules& schedules);

  const Case& case_;
  double shear_rate_;
  OutputTable observables_, measures_, energy_;
  OutputSeries membrane_, fluid_;
};

}  // namespace tanktread::driver
