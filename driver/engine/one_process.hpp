// The engine of a run in one process, or of a run whose packets are looked at on their way.
#pragma once

#include <memory>

#include "driver/engine/engine.hpp"
#include "driver/system/passage.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {

/// Has the system. Of several ranks the first one has membranes and coupler then, and all have the fluid.
class OneProcess final : public Engine {
 public:
  /// @param the_case borrowed
  OneProcess(const Case& the_case, const Parameters& parameters);

  /// Packets go by this way from now on; before, in memory.
  void set_passage(std::unique_ptr<Passage> passage) { passage_ = std::move(passage); }
  /// The run ends here, before its time.
  void stop() { passage_->stopped(system_); }

  void begin(const MembraneShapes& shapes) override;
  void restore(const SavedState& state) override;
  void advance() override;
  std::int64_t step() const override { return system_.step; }
  double shear_time() const override { return system_.shear_time(); }
  const StepSeconds& seconds() const override { return system_.seconds; }
  std::vector<Observation> observe() override;
  std::vector<std::string> measures_rows() override;
  EnergyBudget energy_budget() override;
  void write_membranes(const std::filesystem::path& file) override;
  void write_flow(const std::filesystem::path& file) override;
  void write_state(const std::filesystem::path& folder) override;

 private:
  const Case& case_;
  Parameters parameters_;
  std::unique_ptr<Passage> passage_ = std::make_unique<Passage>();
  System system_;
};

}  // namespace tanktread::driver
