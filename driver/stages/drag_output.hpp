// What is written of membranes that move against a drag.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "driver/stages/drag_motion.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// A directory with drag.csv, membrane.pvd and membrane/membrane_STEP.vtu; steps are those of the case.
class DragOutput {
 public:
  /// Writes nothing. All is borrowed. @param starts the meshes that the capsules start as
  DragOutput(std::filesystem::path directory, const Case& the_case, const Parameters& parameters,
             const std::vector<membrane::TriangleMesh>& starts);

  void begin() const;
  /// A row a capsule. @throws exchange::FileError
  void add_row(const DragMotion& motion, std::int64_t step) const;
  void add_file(const DragMotion& motion, std::int64_t step);

  /// The state is a good one: the one to keep if the next steps go wrong.
  void remember(const DragMotion& motion, std::int64_t step);
  /// Writes the state of the last remember(), if it has no file yet.
  /// @return its file; empty if nothing was remembered
  std::filesystem::path keep_remembered();

  /// Of the fastest node of all capsules, in radii of its capsule per shear time.
  double speed(const DragMotion& motion) const;

 private:
  struct State {
    exchange::SurfacePacket surface;
    std::int64_t step = 0;
  };

  State state_of(const DragMotion& motion, std::int64_t step) const;
  void write(const State& state);
  double speed_of(const DragMotion& motion, std::size_t capsule) const;
  double shear_time(std::int64_t step) const { return static_cast<double>(step) * parameters_.shear_rate; }

  std::filesystem::path directory_;
  const Case& case_;
  const Parameters& parameters_;
  const std::vector<membrane::TriangleMesh>& starts_;
  std::optional<State> remembered_;
  std::int64_t last_written_ = -1;  ///< the step of the last membrane file
};

}  // namespace tanktread::driver
