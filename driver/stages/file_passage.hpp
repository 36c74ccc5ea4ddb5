// Packets through files: as they pass, or written beside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/system/passage.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// Every packet goes by way of a file: what a phase gets is what was read back from there. The files of the
/// last step stay, DIR/grid_velocity.vti ...
class FilePassage : public Passage {
 public:
  explicit FilePassage(std::filesystem::path directory);
  void pass(const System& system, Packet packet, GridVectors& vectors) override;
  void pass(const System& system, Packet packet, NodeVectors& vectors) override;
  void pass(const System& system, Packet packet, GridMarks& marks) override;

 private:
  std::filesystem::path directory_;
};

/// The steps that are recorded: those that lead from time `from` to time `to`.
struct RecordedSteps {
  std::int64_t from = 0, to = 0;
};

/// Writes the packets of some steps beside the run: DIR/begin and DIR/end (write_state), and a series a
/// packet, DIR/node_force.pvd with DIR/node_force/node_force_STEP.vtu.
class Recorder : public Passage {
 public:
  /// @param the_case of the run; it must outlive the recorder
  /// @param has_implicit the packets of implicit viscosities will pass too
  Recorder(std::filesystem::path directory, RecordedSteps steps, const Case& the_case, bool has_implicit);
  void pass(const System& system, Packet packet, GridVectors& vectors) override;
  void pass(const System& system, Packet packet, NodeVectors& vectors) override;
  void pass(const System& system, Packet packet, GridMarks& marks) override;
  void step_done(const System& system) override;
  /// What was recorded so far is a whole record.
  void stopped(const System& system) override;

 private:
  template <class Vectors>
  void record(const System& system, Packet packet, const Vectors& vectors);

  std::filesystem::path directory_;
  RecordedSteps steps_;
  const Case& case_;
};

}  // namespace tanktread::driver
