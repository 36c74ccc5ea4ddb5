#include "membrane/neo_hookean.hpp"

#include "membrane/law_check.hpp"

namespace tanktread::membrane {
namespace {

class NeoHookean final : public ElasticLawOf<NeoHookean> {
 public:
  explicit NeoHookean(double shear_modulus) : shear_modulus_(shear_modulus) {}

  ElasticResponse evaluate(const Invariants& e) const override {
    const double thinning = 1.0 / (e.i2 + 1.0);  // thickness squared: the sheet keeps its volume
    const double half = 0.5 * shear_modulus_;
    return {half * (e.i1 - 1.0 + thinning), half, -half * thinning * thinning};
  }
  double shear_modulus() const override { return shear_modulus_; }
  double area_modulus() const override { return 3.0 * shear_modulus_; }

 private:
  double shear_modulus_;
};

}  // namespace

std::unique_ptr<ElasticLaw> make_neo_hookean(const ElasticParameters& parameters) {
  require_positive("neo-hookean", "shear_modulus", parameters.shear_modulus);
  return std::make_unique<NeoHookean>(parameters.shear_modulus);
}

}  // namespace tanktread::membrane
