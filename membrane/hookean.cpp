#include "membrane/hookean.hpp"

#include "membrane/law_check.hpp"

namespace tanktread::membrane {
namespace {

class Hookean final : public ElasticLawOf<Hookean> {
 public:
  Hookean(double shear_modulus, double poisson_ratio)
      : shear_modulus_(shear_modulus), trace_factor_(poisson_ratio / (1.0 - poisson_ratio)) {}

  ElasticResponse evaluate(const Invariants& e) const override {
    const double g = shear_modulus_ / 4.0;
    return {g * ((1.0 + trace_factor_) * e.i1 * e.i1 + 2.0 * e.i1 - 2.0 * e.i2),
            g * (2.0 * (1.0 + trace_factor_) * e.i1 + 2.0), -2.0 * g};
  }
  double shear_modulus() const override { return shear_modulus_; }
  double area_modulus() const override { return shear_modulus_ * (1.0 + 2.0 * trace_factor_); }

 private:
  double shear_modulus_, trace_factor_;
};

}  // namespace

std::unique_ptr<ElasticLaw> make_hookean(const ElasticParameters& parameters) {
  require_positive("hookean", "shear_modulus", parameters.shear_modulus);
  require_law_parameter(parameters.poisson_ratio > -1.0 && parameters.poisson_ratio < 1.0, "hookean",
                        "poisson_ratio", parameters.poisson_ratio, "above -1 and below 1");
  return std::make_unique<Hookean>(parameters.shear_modulus, parameters.poisson_ratio);
}

}  // namespace tanktread::membrane
