#include "membrane/interfacial_tension.hpp"

#include <cmath>

#include "membrane/law_check.hpp"

namespace tanktread::membrane {
namespace {

class InterfacialTension final : public ElasticLawOf<InterfacialTension> {
 public:
  explicit InterfacialTension(double tension) : tension_(tension) {}

  ElasticResponse evaluate(const Invariants& e) const override {
    const double area_ratio = std::sqrt(e.i2 + 1.0);
    return {tension_ * area_ratio, 0.0, 0.5 * tension_ / area_ratio};
  }
  double shear_modulus() const override { return 0.0; }
  double area_modulus() const override { return 0.0; }

 private:
  double tension_;
};

}  // namespace

std::unique_ptr<ElasticLaw> make_interfacial_tension(const ElasticParameters& parameters) {
  require_positive("interfacial-tension", "interfacial_tension", parameters.interfacial_tension);
  return std::make_unique<InterfacialTension>(parameters.interfacial_tension);
}

}  // namespace tanktread::membrane
