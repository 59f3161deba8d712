#pragma once
// One physical effect of a joint: the torque it needs, as columns for identification and step by step for simulation.
//
// Equation   tau_effect = columns(input, shape) * linear parameters
// Parameters linear ones first (solved for), then shapes (searched within shape_bounds(scales)). Bounds of linear ones
//            are plausible sizes, except 0, which is physics (sign())
// Shapes     columns: n_samples x n_linear(), column-major; n_linear() <= 8, of a whole arm 10, given any; full
//            rate, before the parallel filter
// Units      SI of a revolute joint (N m, rad); unit_for() gives the prismatic ones (N, m)
// Threads    const objects, any number of threads; a runner belongs to one
// Source     each file in effects/ names its own; table of all: effects/README.md. How to add one: engine/README.md

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/given_signals.hpp"
#include "engine/data/motion.hpp"
#include "engine/effects/effect_traits.hpp"
#include "engine/effects/joint_scales.hpp"
#include "engine/effects/joint_states.hpp"

namespace torquescope {

enum class Sign { any, non_negative };

struct EffectParameter {
  std::string name;            // "viscous"
  std::string unit_revolute;   // "N m s/rad"
  std::string unit_prismatic;  // "N s/m"; empty: the parameter needs an angle, no slide has it
  Bound lower{-std::numeric_limits<double>::infinity()};
  Bound upper{std::numeric_limits<double>::infinity()};
  bool is_shape = false;  // nonlinear: held fixed while the linear ones are solved
  Spacing spacing = Spacing::linear;
  bool none_at_lower = false;  // its lower bound stands for an effect without it
  bool is_resonance = false;   // that rings: most of what it explains is gone a few percent beside it
  // a bound that is an effect of its own (an exponent of 2, a share of all), or a limit of what rows can tell: an
  // estimate there is a finding, and at any other bound the end of what is plausible
  bool effect_at_lower = false, effect_at_upper = false;

  std::string const& unit_for(JointKind joint) const {
    return joint == JointKind::revolute ? unit_revolute : unit_prismatic;
  }
  Sign sign() const { return lower.factor == 0.0 ? Sign::non_negative : Sign::any; }
  // what the parameter is, by what its bounds are relative to
  bool is_instant() const { return is_shape && lower.to == RelativeTo::instant; }              // of this recording
  bool is_order() const { return is_shape && lower.to == RelativeTo::lowest_order; }           // waves per turn or m
  bool is_frequency() const { return is_shape && lower.to == RelativeTo::slowest_frequency; }  // waves per second
};

inline EffectParameter shape_parameter(std::string name, std::string unit_revolute, std::string unit_prismatic,
                                       Bound lower, Bound upper, Spacing spacing) {
  return {std::move(name), std::move(unit_revolute), std::move(unit_prismatic), lower, upper, true, spacing};
}

inline EffectParameter none_at_lower(EffectParameter parameter) {
  parameter.none_at_lower = true;
  return parameter;
}

inline EffectParameter resonance(EffectParameter parameter) {
  parameter.is_resonance = true;
  return parameter;
}

inline EffectParameter effect_at_lower(EffectParameter parameter) {
  parameter.effect_at_lower = true;
  return parameter;
}

inline EffectParameter effect_at_upper(EffectParameter parameter) {
  parameter.effect_at_upper = true;
  return parameter;
}

inline EffectParameter effect_at_both(EffectParameter parameter) {
  return effect_at_lower(effect_at_upper(std::move(parameter)));
}

// a parameter's bounds on one recording
struct ParameterRange {
  double lower = 0.0, upper = 0.0;
  Spacing spacing = Spacing::linear;
};

// columns(input, shape, out): effects with memory run their state over the samples in order, so the motion must be
// whole; mask and crop the columns, never the motion. Made by FittedBaseline (fitted_baseline.hpp)
struct EffectInput {
  Motion const& motion;
  JointScales scales{};
  std::span<double const> load_torque{};   // n_samples; may be empty unless needs_baseline()
  std::span<double const> model_torque{};  // n_samples: the baseline on this motion, without the torque channel's noise
  GivenSignals const* given = nullptr;     // of the recording; none

  Eigen::Index size() const { return motion.q.size(); }
  JointState state(Eigen::Index sample) const;
};

// For simulation: advance() once per step, then torque() as often as needed, also for trial states (other ddq, other
// sign of dq). The first advance() only tells where the memory starts. state.load_torque and state.motor_torque must be
// set when needs_baseline(). acts_on() says where the result goes: equation of motion, torque channel, or (a position)
// the position channel. Columns use the fitted baseline for the motor torque: equal to first order of the effect
class EffectRunner {
 public:
  virtual ~EffectRunner() = default;
  // the joint has come to `state`, step_s after the last one (0: it starts there)
  virtual void advance(JointState const& state, double step_s) = 0;
  // with the memory as it stands; affine in ddq unless the effect follows the load
  virtual double torque(JointState const& state) const = 0;
  double torque(JointState const& state, double step_s) {
    advance(state, step_s);
    return torque(state);
  }
};

struct EffectDescription {
  std::string name{};
  std::string title{};
  std::string equation{};
  std::string source{};
  std::string separated_by{};  // the motion that separates it from those it is confused with; empty for baseline terms
  std::vector<EffectParameter> parameters{};
  std::vector<EffectFamily> families{EffectFamily::baseline};  // own one first, then those it is also confused with
  std::vector<SignatureAxis> signature{};                      // principal axis first
  Parity parity = Parity::neither;
  ActsOn acts_on = ActsOn::joint;
  bool needs_baseline = false;   // input beyond the motion: load or motor torque, or baseline parameters in the scales
  bool has_inertia = false;      // a mass of its own moves behind the joint: it rings or knocks
  bool is_of_extremes = false;   // it acts where a limit is reached, which a recording may do once
  bool is_dry_friction = false;  // torque jumps with the sign of the velocity: set-valued at rest for a simulator
  bool is_partly_dry = false;    // a part of it does so, beside one that asks for an acceleration
  bool is_level_free =
      false;  // an effect of the position whose level is the baseline's: encoders read 0 where somebody put it
  bool is_given = false;          // columns come with the recording (given_effect.hpp)
  bool is_of_whole_arm = false;   // acts on several joints at once, and is judged on the rows of all
  bool is_torque_timing = false;  // the torque at another time: a nuisance of every decision
  bool is_rigid_body = false;     // mass or weight of the moved body, which the model of a whole arm has already
  std::string plain_equation{};   // of the effect without shapes, for which an empty shape stands; empty: there is none
  // the torque as an expression in C (instant_code.hpp); empty where one instant of the motion does not tell it
  std::string code{}, plain_code{};
};

class Effect {
 public:
  explicit Effect(EffectDescription description);
  virtual ~Effect() = default;

  std::string const& name() const { return description_.name; }          // as in the job file
  std::string const& title() const { return description_.title; }        // one line for people
  std::string const& equation() const { return description_.equation; }  // "J ddq"
  std::string const& source() const { return description_.source; }
  std::string const& separated_by() const { return description_.separated_by; }
  std::vector<EffectParameter> const& parameters() const { return description_.parameters; }
  EffectFamily family() const { return description_.families.front(); }
  std::vector<EffectFamily> const& families() const { return description_.families; }
  std::vector<SignatureAxis> const& signature() const { return description_.signature; }
  Parity parity() const { return description_.parity; }
  ActsOn acts_on() const { return description_.acts_on; }
  bool needs_baseline() const { return description_.needs_baseline; }
  bool has_inertia() const { return description_.has_inertia; }
  bool is_of_extremes() const { return description_.is_of_extremes; }
  bool is_dry_friction() const { return description_.is_dry_friction; }
  bool is_partly_dry() const { return description_.is_partly_dry; }
  bool is_level_free() const { return description_.is_level_free; }
  bool is_torque_timing() const { return description_.is_torque_timing; }
  bool is_rigid_body() const { return description_.is_rigid_body; }
  // of the moved body, over the position: what every link has unless its axis is upright
  bool is_weight() const { return is_rigid_body() && family() == EffectFamily::static_position; }
  bool is_given() const { return description_.is_given; }
  bool is_of_whole_arm() const { return description_.is_of_whole_arm; }
  std::string const& plain_equation() const { return description_.plain_equation; }
  std::string const& code() const { return description_.code; }
  std::string const& plain_code() const { return description_.plain_code; }
  bool has_plain_form() const { return !description_.plain_equation.empty(); }
  virtual bool has_memory() const = 0;
  // false: the effect can be computed there, but would be something else than its name says; n_shape()
  virtual bool is_plausible(std::span<double const> shape, JointScales const& scales) const;

  std::size_t n_linear() const { return n_linear_; }
  std::size_t n_shape() const { return parameters().size() - n_linear_; }
  bool exists_on(JointKind joint) const;  // false: it needs an angle
  bool is_event() const;                  // it begins at an instant: it belongs to one recording
  bool is_wave() const;                   // of an order or a frequency
  bool may_come_again() const;            // several waves or events may be there at once, each stands for itself
  std::vector<ParameterRange> shape_bounds(JointScales const&) const;   // n_shape()
  std::vector<ParameterRange> linear_bounds(JointScales const&) const;  // n_linear()
  // n_shape() numbers, or none where that is the plain form
  bool takes_shape(std::size_t numbers) const { return numbers == n_shape() || (has_plain_form() && numbers == 0); }
  // least squares can fit it and a plant can hold it as it is: no shape or a plain form, no memory, nothing but the
  // motion
  bool is_plain_term() const;

  virtual void columns(EffectInput const& input, std::span<double const> shape,
                       Eigen::Ref<Eigen::MatrixXd> out) const = 0;
  // of several shapes, one beside the other: the same to the last digit
  virtual void columns_of_shapes(EffectInput const& input, std::vector<std::vector<double>> const& shapes,
                                 Eigen::Ref<Eigen::MatrixXd> out) const;
  // all parameters, linear ones first; without shapes: the plain form
  virtual std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const& scales) const = 0;
  // torque at one instant; of an effect with memory, as if it began here; sign(0) = 0
  virtual double torque(JointState const& state, std::span<double const> parameters, JointScales const& scales) const;

 private:
  EffectDescription description_;
  std::size_t n_linear_ = 0;
};

std::vector<Effect const*> const& effect_choices();
// of these and of arm_effect_choices()
Effect const* find_effect(std::string const& name);

}  // namespace torquescope
