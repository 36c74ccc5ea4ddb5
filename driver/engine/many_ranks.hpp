// The engine of a run that several ranks share, as the first rank leads it.
#pragma once

#include <memory>
#include <optional>

#include "driver/engine/engine.hpp"
#include "driver/engine/system_part.hpp"
#include "driver/system/fluid_on_ranks.hpp"
#include "driver/system/fluid_pieces.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Each rank has a SystemPart; the first one tells the others what to do (followers.hpp). It has no more of
/// the system than they have: rows of tables are made by the owners of the capsules, sums over nodes by the
/// ranks that have these, and files that are not in pieces are gathered where they are written.
class ManyRanks final : public Engine {
 public:
  /// For cases without programs, on the first rank of several (other_ranks()).
  /// @param the_case borrowed @throws InputError if the ranks cannot share the box
  ManyRanks(const Case& the_case, const Parameters& parameters);
  /// The others let go of their parts.
  ~ManyRanks() override;
  ManyRanks(const ManyRanks&) = delete;
  ManyRanks& operator=(const ManyRanks&) = delete;

  void begin(const MembraneShapes& shapes) override;
  void restore(const SavedState& state) override;
  void advance() override;
  void share_out() override;
  std::int64_t step() const override { return step_; }
  double shear_time() const override { return static_cast<double>(step_) * shear_rate_; }
  const StepSeconds& seconds() const override { return own_->seconds(); }
  std::vector<Observation> observe() override;
  std::vector<std::string> measures_rows() override;
  EnergyBudget energy_budget() override;
  void write_membranes(const std::filesystem::path& file) override;
  void write_flow(const std::filesystem::path& file) override;
  void write_state(const std::filesystem::path& folder) override;

 private:
  std::optional<StepError> begin_at(std::int64_t step, std::vector<PartCapsule> capsules);
  std::optional<StepError> begin_from_case();
  std::optional<StepError> begin_from_pieces(const SavedState& state);
  std::optional<StepError> first_error(const PartStep& own) const;
  void write_surfaces(const std::filesystem::path& file, bool is_state);
  void write_pieces(const PiecesOrder& what);
  std::vector<std::int32_t> gathered_marks() const;

  const Case& case_;
  double shear_rate_;
  bool has_iterations_;  ///< of implicit viscous forces
  std::unique_ptr<FluidOnRanks> fluid_;
  const ranks::World& world_;
  std::optional<SystemPart> own_;
  std::int64_t step_ = 0;
  double highest_speed_ = 0;
  int viscous_iterations_ = 0;
};

}  // namespace tanktread::driver
