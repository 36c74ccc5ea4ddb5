// The steps of a system that several ranks make together, as the first rank leads them.
#pragma once

#include <cstdint>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/fluid_pieces.hpp"
#include "driver/system/part_places.hpp"
#include "driver/system/system.hpp"
#include "driver/system/system_part.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Each rank has a SystemPart. The first one tells the others when to make a step, and has a System of the
/// whole case, which collect() brings up to date where somebody wants to look at it.
class SystemOnRanks {
 public:
  /// @param fluid borrowed, the one of the system
  SystemOnRanks(FluidOnRanks& fluid, const Case& the_case, const Parameters& parameters);
  /// The others let go of their parts.
  ~SystemOnRanks();
  SystemOnRanks(const SystemOnRanks&) = delete;
  SystemOnRanks& operator=(const SystemOnRanks&) = delete;

  /// Gives every capsule to the rank that has the middle of its nodes, unless all are there already.
  void share_out(const System& system);

  /// One step of all. Of the system this changes step, highest_speed, viscous_iterations and seconds.
  /// @throws RunError that one rank would have thrown
  void advance(System& system);

  /// Brings the capsules of the system up to date, and what follows from them: stencils, nodes inside.
  void collect(System& system) const;

  /// Each rank writes its piece of the fluid, then the first one the index. @throws exchange::FileError
  void write_pieces(const PiecesOrder& what) const;

 private:
  int owner_of(const Eigen::Matrix3Xd& positions) const;

  FluidOnRanks& fluid_;
  const ranks::World& world_;
  PartPlaces places_;
  SystemPart own_;
  std::vector<int> owners_;  ///< of each capsule; none: they are not shared out yet
};

/// Has the steps of a system made by all ranks from now on, where there are several and no program stands in
/// the place of a component. What goes from phase to phase can then not be looked at.
void share_out(System& system, const Case& the_case, const Parameters& parameters);

/// Brings a system up to date whose steps are made by all ranks; else nothing.
void collect(System& system);

}  // namespace tanktread::driver
