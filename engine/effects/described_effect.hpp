#pragma once
// An effect whose words (name, title, equation, source, parameters) are a table; files in effects/ add the formulas.

#include <string>
#include <utility>
#include <vector>

#include "engine/effects/effect.hpp"

namespace torquescope {

struct EffectDescription {
  std::string name;
  std::string title;
  std::string equation;
  std::string source;
  std::vector<EffectParameter> parameters;  // an empty unit_prismatic: the effect needs an angle, no slide has it
};

class DescribedEffect : public Effect {
 public:
  explicit DescribedEffect(EffectDescription description) : description_(std::move(description)) {}
  std::string const& name() const override { return description_.name; }
  std::string const& title() const override { return description_.title; }
  std::string const& equation() const override { return description_.equation; }
  std::string const& source() const override { return description_.source; }
  std::vector<EffectParameter> const& parameters() const override { return description_.parameters; }

 private:
  EffectDescription description_;
};

// the part of an effect that is one linear parameter times a function of the instant
class SingleColumnEffect : public DescribedEffect {
 public:
  using DescribedEffect::DescribedEffect;
  void columns(Motion const& motion, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const final;
  double torque(JointState const& state, std::span<double const> parameters) const final;

 protected:
  virtual double column(JointState const& state) const = 0;  // torque per unit of the parameter
};

// -1, 0, 1; sign(0) = 0
inline double sign(double velocity) { return static_cast<double>((velocity > 0.0) - (velocity < 0.0)); }

}  // namespace torquescope
