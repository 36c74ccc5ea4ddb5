// The interface of an elastic membrane law: an energy of the two strain invariants, and its derivatives.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tanktread::membrane {

/// Strain invariants of a membrane element (Eq. 2.5), Cg = F^T F the right Cauchy-Green tensor.
struct Invariants {
  double i1;  ///< tr Cg - 2 = lambda1^2 + lambda2^2 - 2
  double i2;  ///< det Cg - 1 = lambda1^2 lambda2^2 - 1; above -1
};

/// What a law answers: energy per undeformed area and its derivatives by I1 and I2. From these
/// S = 2 (W_1 I + W_2 adj Cg) (second Piola-Kirchhoff) and the nodal force -A0 F S grad N follow for every
/// law alike.
struct ElasticResponse {
  double energy;  ///< W, force per length
  double w1;      ///< dW/dI1
  double w2;      ///< dW/dI2
};

/// A law is const, keeps nothing between calls and knows no mesh. Its functions do not throw: parameters are
/// checked where it is made. Derive from ElasticLawOf, which answers evaluate_all().
class ElasticLaw {
 public:
  virtual ~ElasticLaw() = default;
  virtual ElasticResponse evaluate(const Invariants& invariants) const = 0;
  /// The same for many elements in one call; both spans have the same size.
  virtual void evaluate_all(std::span<const Invariants> invariants,
                            std::span<ElasticResponse> responses) const = 0;
  /// Small-strain shear modulus G_s and area modulus K_s at rest (0 and 0 for an interfacial tension and for
  /// none).
  virtual double shear_modulus() const = 0;
  virtual double area_modulus() const = 0;
};

/// Base of every law: `class MyLaw final : public ElasticLawOf<MyLaw>`. Here the law's type is known, so that
/// its evaluate() is inlined into the loop: one virtual call a block of elements, not one an element.
template <class Law>
class ElasticLawOf : public ElasticLaw {
 public:
  void evaluate_all(std::span<const Invariants> invariants,
                    std::span<ElasticResponse> responses) const final {
    const Law& law = static_cast<const Law&>(*this);
    for (std::size_t k = 0; k < invariants.size(); ++k) responses[k] = law.evaluate(invariants[k]);
  }
};

/// Parameters from which the law table builds a law; a law takes those it names in `elastic_law_table()`.
struct ElasticParameters {
  double shear_modulus = 0;        ///< G_s (small strain); Skalak's E_s = 2 G_s, the thesis's W = E_s/8 (...)
  double area_ratio = 1;           ///< C = E_a/E_s (Skalak), 0 or above
  double poisson_ratio = 0.5;      ///< nu_s (Hookean), -1 < nu_s < 1
  double interfacial_tension = 0;  ///< gamma (interfacial-tension)
};

/// One row of the table of laws (membrane/law_table.cpp): its name in the case file, what it is and how it is
/// made. `make` throws std::invalid_argument that names the law, the parameter, its value and what is
/// allowed.
struct ElasticLawEntry {
  std::string name;                     ///< "skalak", "neo-hookean", "hookean", "interfacial-tension", "none"
  std::string description;              ///< one line with the formula of W
  std::vector<std::string> parameters;  ///< names of the ElasticParameters members it uses
  std::unique_ptr<ElasticLaw> (*make)(const ElasticParameters&);
};
const std::vector<ElasticLawEntry>& elastic_law_table();

/// Makes a law by its name. @throws std::invalid_argument that lists the known names
std::unique_ptr<ElasticLaw> make_elastic_law(const std::string& name, const ElasticParameters& parameters);

}  // namespace tanktread::membrane
