// A case at work, as a run sees it: whoever makes its steps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "driver/observe/energy.hpp"
#include "driver/observe/observables.hpp"
#include "driver/packets/saved_state.hpp"
#include "driver/system/system.hpp"

namespace tanktread::driver {

/// It begins, or takes over a state, and then advances step by step. In between it is looked at and written:
/// the numbers and files are the same whether one process has the system (OneProcess) or many ranks do
/// (ManyRanks).
class Engine {
 public:
  virtual ~Engine() = default;

  /// From the start of the case. @param shapes of all its capsules; none: they are made by who needs them
  /// @throws InputError if a mesh lies too near a wall for the kernel, or a program cannot be started
  virtual void begin(const MembraneShapes& shapes) = 0;
  /// From a state. @throws InputError if it does not fit the case; exchange::FileError if a piece of it
  /// cannot be read
  virtual void restore(const SavedState& state) = 0;

  /// From t to t+1. @throws RunError; it is then of no use: go back to a checkpoint
  virtual void advance() = 0;
  /// For a good place between two steps, now and then: ranks give capsules that have moved on to each other.
  virtual void share_out() {}

  virtual std::int64_t step() const = 0;
  virtual double shear_time() const = 0;
  /// Of the steps so far, of the first rank.
  virtual const StepSeconds& seconds() const = 0;

  /// Of all capsules, in the order of the case.
  virtual std::vector<Observation> observe() = 0;
  /// Rows of measures.csv, likewise.
  virtual std::vector<std::string> measures_rows() = 0;
  /// @throws RunError if the tangential correction cannot be found
  virtual EnergyBudget energy_budget() = 0;

  // Files, in one or in pieces as the case says. @param file without an ending @throws exchange::FileError

  /// .vtu or .pvtu (write_surfaces).
  virtual void write_membranes(const std::filesystem::path& file) = 0;
  /// .vti or .pvti (write_flow).
  virtual void write_flow(const std::filesystem::path& file) = 0;
  /// A state folder (write_state).
  virtual void write_state(const std::filesystem::path& folder) = 0;
};

}  // namespace tanktread::driver
