// The output directory of a run: observables.csv, membrane.pvd, fluid.pvd and their files.
#pragma once

#include <filesystem>

#include "driver/run/observables.hpp"
#include "driver/run/output_series.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// Writes what is due, when it is due. Files of a series are named by their step. Both series have an entry
/// at each time at which a file of either is written (OutputSeries).
class Output {
 public:
  Output(const Case& the_case, const Parameters& parameters, std::filesystem::path directory);

  /// Starts new tables and series.
  void begin();

  /// Cuts tables and series back to what the run had written up to `step`; an uninterrupted run with the same
  /// intervals has the same. A series that cannot be read is made anew from its files, which is said.
  /// @throws exchange::FileError before anything is changed, if a series names what is not of this run
  void resume(std::int64_t step);

  /// Writes all that is due at this step; with `last`, the state at the end of the run too.
  /// @return the observations if they were due, else none
  std::vector<Observation> write(const System& system, bool last);

 private:
  void write_membrane(const System& system);
  void write_fluid(const System& system);

  const Case& case_;
  std::filesystem::path directory_;
  double shear_rate_;
  Schedule observables_;
  OutputSeries membrane_, fluid_;
};

}  // namespace tanktread::driver
