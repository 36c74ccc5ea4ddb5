#include "membrane/no_law.hpp"

namespace tanktread::membrane {
namespace {

class NoLaw final : public ElasticLawOf<NoLaw> {
 public:
  ElasticResponse evaluate(const Invariants&) const override { return {0.0, 0.0, 0.0}; }
  double shear_modulus() const override { return 0.0; }
  double area_modulus() const override { return 0.0; }
};

}  // namespace

std::unique_ptr<ElasticLaw> make_no_law(const ElasticParameters&) {
  return std::make_unique<NoLaw>();
}

}  // namespace tanktread::membrane
