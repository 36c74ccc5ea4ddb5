#include "membrane/skalak.hpp"

#include "membrane/law_check.hpp"

namespace tanktread::membrane {
namespace {

class Skalak final : public ElasticLawOf<Skalak> {
 public:
  Skalak(double skalak_modulus, double area_ratio)
      : shear_(skalak_modulus / 8.0), area_(area_ratio * skalak_modulus / 8.0) {}

  ElasticResponse evaluate(const Invariants& e) const override {
    return {shear_ * (e.i1 * e.i1 + 2.0 * e.i1 - 2.0 * e.i2) + area_ * e.i2 * e.i2,
            shear_ * (2.0 * e.i1 + 2.0), -2.0 * shear_ + 2.0 * area_ * e.i2};
  }
  double shear_modulus() const override { return 4.0 * shear_; }
  double area_modulus() const override { return 4.0 * shear_ + 8.0 * area_; }

 private:
  double shear_, area_;  // E_s/8, E_a/8
};

}  // namespace

std::unique_ptr<ElasticLaw> make_skalak(const ElasticParameters& parameters) {
  require_positive("skalak", "shear_modulus", parameters.shear_modulus);
  require_not_negative("skalak", "area_ratio", parameters.area_ratio);
  return std::make_unique<Skalak>(2.0 * parameters.shear_modulus, parameters.area_ratio);
}

}  // namespace tanktread::membrane
