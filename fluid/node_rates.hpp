// The relaxation rates of every node: those of the settings, or from a viscosity of its own. Internal to
// fluid/.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "fluid/collision.hpp"
#include "fluid/lattice_boltzmann.hpp"

namespace tanktread::fluid {

/// A viscosity contrast has few viscosities, and most packs lie wholly in one of them. So each pack has a
/// class, one byte: the number of a pair of rates in a small table that stays in the cache, or `mixed`, and
/// only then does a step load rates from an array as large as the lattice. The rates of a node are the same
/// numbers either way. Which viscosities are in the table depends on the order in which they came; no result
/// does.
///
/// Packs are numbered as those of KeptVelocity: row by row (z ny + y), each row from x = 0.
template <typename Real>
class NodeRates {
 public:
  /// @param shape nodes of the solver, which may hold a part of the box of the settings
  NodeRates(const LatticeBoltzmannSettings& settings, const GridShape& shape);

  /// Viscosities of the nodes listed, one after the other: of a node that is listed twice the last one
  /// counts.
  /// @throws std::bad_alloc at the first call; all is then as before
  void set(std::span<const std::int64_t> nodes, std::span<const double> viscosity);

  /// The viscosity of every node; none: that of the settings, as if never set.
  /// @throws std::bad_alloc as the other
  void set_all(std::span<const double> viscosity);

  /// set_all() in parts: first room for what comes (@throws std::bad_alloc; all is then as before), then of
  /// each row. @param viscosity whole rows, from `first_row` on
  void begin_set_all();
  void set_rows(std::int64_t first_row, std::span<const double> viscosity);

  /// Whether viscosities were set, be it to that of the settings.
  bool is_set() const { return !class_of_.empty(); }

  /// Of as many nodes, from `first_node` on; overwritten.
  void viscosity(std::int64_t first_node, std::span<double> viscosity) const;

  /// Packs whose rates a step loads from the array.
  std::int64_t n_mixed() const;

  /// Of the pack that begins with node x of a row; lanes beyond the row have those of its last node (any that
  /// are finite would do).
  __attribute__((always_inline)) Rates<Real> pack(std::int64_t row, int x) const {
    if (!is_set()) return known_[0];
    const std::int64_t pack = row * packs_a_row_ + x / pack_size<Real>;
    const Class its_class = class_of_[pack];
    return its_class == mixed ? of_mixed_[pack] : known_[its_class];
  }

 private:
  using Class = std::uint8_t;
  static constexpr Class mixed = 255;
  static constexpr int n_known = 16;
  struct Release {
    void operator()(double* memory) const { std::free(memory); }
  };

  void prepare();
  void classify(std::int64_t pack);
  Class class_for(double viscosity);
  void fill_mixed(std::int64_t pack, std::span<const double> viscosity);
  Rates<Real> rates_of(double viscosity) const;

  /// As kept: zero for the viscosity of the settings.
  double kept(double viscosity) const { return viscosity == base_viscosity_ ? 0.0 : viscosity; }

  LatticeBoltzmannSettings settings_;
  GridShape shape_;
  double base_viscosity_;  ///< that of the settings
  std::int64_t packs_a_row_, n_packs_;

  /// Number 0 is the viscosity of the settings, for good; the others come and go.
  std::array<Rates<Real>, n_known> known_;
  std::array<double, n_known> known_viscosity_{};       ///< as kept
  std::array<std::int64_t, n_known> packs_of_known_{};  ///< how many are of the class; 0: free (but number 0)

  // Empty unless set. Of the two large arrays the system gives memory only where it is written to.
  std::vector<Class> class_of_;
  std::unique_ptr<double[], Release> viscosity_;  ///< of each node, as kept
  std::unique_ptr<Rates<Real>[]> of_mixed_;       ///< of each pack; without meaning unless it is mixed
};

}  // namespace tanktread::fluid
