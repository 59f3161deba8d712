#include "engine/simulate/rollout/rollout_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/simulate/replicate_joint.hpp"

namespace torquescope {
namespace {

// of a linear parameter nobody knows the size of: what moves the torque by a tenth
double size_of(EffectParameter const& parameter, JointScales const& scales) {
  constexpr double tenth = 0.1;
  double size = 0.0;
  for (Bound const& bound : {parameter.lower, parameter.upper}) {
    double const value = std::abs(bound_value(bound, scales));
    if (std::isfinite(value)) size = std::max(size, value);
  }
  return size > 0.0 ? tenth * size : tenth;
}

// bounds of a linear parameter are plausible sizes, except 0 (effect.hpp): a search gets room around them
RolloutParameter linear_parameter(EffectParameter const& parameter, JointKind joint, JointScales const& scales,
                                  double start) {
  constexpr double room = 1e6;
  RolloutParameter made;
  made.name = parameter.name;
  made.unit = parameter.unit_for(joint);
  made.start = start;
  double const size = size_of(parameter, scales);
  made.scale = std::max(std::abs(start), size);
  made.upper = room * made.scale;
  made.lower = parameter.sign() == Sign::non_negative ? 0.0 : -made.upper;
  return made;
}

RolloutParameter shape_of(EffectParameter const& parameter, ParameterRange const& range, JointKind joint) {
  RolloutParameter made;
  made.name = parameter.name;
  made.unit = parameter.unit_for(joint);
  made.lower = range.lower;
  made.upper = range.upper;
  made.is_shape = true;
  made.is_logarithmic = range.spacing == Spacing::logarithmic && range.lower > 0.0;
  made.start = made.is_logarithmic ? std::sqrt(range.lower * range.upper) : 0.5 * (range.lower + range.upper);
  constexpr double tenth = 0.1;
  made.scale = made.is_logarithmic ? made.start : tenth * (range.upper - range.lower);
  return made;
}

// of a number of the loop: a tenth of what moves the joint, a sample, a step of the encoder
double natural_size(LoopMeasure measure, JointScales const& scales) {
  constexpr double tenth = 0.1;
  switch (measure) {
    case LoopMeasure::time:
      return 1.0 / scales.rate_hz;
    case LoopMeasure::torque:
      return tenth * scales.torque_rms;
    case LoopMeasure::torque_per_speed:
      return scales.torque_rms / scales.peak_speed;
    case LoopMeasure::speed:
      return tenth * scales.peak_speed;
    case LoopMeasure::position:
      return std::max(scales.encoder_step, 1e-3 * scales.position_range);
    case LoopMeasure::per_torque:
      return tenth / scales.torque_rms;
    case LoopMeasure::mass:
    case LoopMeasure::acceleration:
    case LoopMeasure::number:
      break;
  }
  return tenth;
}

void begin_at(RolloutParameter& parameter, double value) {
  parameter.start = value;
  parameter.is_given = true;
  // who begins beyond a plausible bound means to leave it
  if (value < parameter.lower) parameter.lower = parameter.is_shape ? value : -parameter.upper;
  if (value > parameter.upper) parameter.upper = value;
  parameter.scale = parameter.is_logarithmic ? std::abs(value) : std::max(parameter.scale, std::abs(value));
}

}  // namespace

RolloutModel::RolloutModel(Regressor const& regressor, Eigen::VectorXd const& start, JointScales const& scales,
                           std::vector<ModelEffect> const& effects, LoopSetting loop)
    : terms_(regressor.terms()), joint_(regressor.joint()), loop_(std::move(loop)) {
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(start.size()) == regressor.size());
  structure_.scales = scales;
  structure_.hold_ticks = loop_.hold_ticks;
  structure_.speed_samples = loop_.speed_samples;
  bool const fits_back_emf = std::find(loop_.free.begin(), loop_.free.end(), LoopKey::back_emf) != loop_.free.end();
  Eigen::Index at = 0;
  for (auto const* term : terms_) {
    ReplicateJoint ignored;
    std::vector<double> const zeros(term->n_linear(), 0.0);
    in_lanes_.push_back(place_in_lanes(ignored, term->name(), zeros.data()) ? 1 : 0);
    if (in_lanes_.back() == 0) structure_.effects.push_back(term);
    for (std::size_t k = 0; k < term->n_linear(); ++k, ++at) {
      parameters_.push_back(linear_parameter(term->parameters()[k], joint_, scales, start[at]));
      // the sign of a term's parameter is the recording's affair, but for what could not be a joint
      // beside a back-EMF, which the drive has while it is on, a joint that speeds itself up when it is off is none
      bool const has_end =
          term->name() == "inertia" || term->name() == "coulomb" || (term->name() == "viscous" && fits_back_emf);
      parameters_.back().lower = has_end ? 0.0 : -parameters_.back().upper;
    }
  }
  add_effect_parameters(effects, scales);
  add_loop_parameters(scales);
  std::set<std::string> names;
  for (auto const& one : parameters_)
    validate(names.insert(one.name).second, [&] {
      Problem problem{ExitCode::bad_job, fmt::format("two effects of the model have a parameter \"{}\"", one.name)};
      problem.help = "give each effect once; of waves, write the second as harmonics of the first where it has them";
      return problem;
    });
}

void RolloutModel::add_effect_parameters(std::vector<ModelEffect> const& effects, JointScales const& scales) {
  std::map<Effect const*, int> times;
  for (auto const& given : effects) {
    structure_.effects.push_back(given.effect);
    auto const ranges = given.effect->shape_bounds(scales);
    int const count = ++times[given.effect];
    for (std::size_t k = 0; k < given.effect->parameters().size(); ++k) {
      EffectParameter const& parameter = given.effect->parameters()[k];
      RolloutParameter made = k < given.effect->n_linear()
                                  ? linear_parameter(parameter, joint_, scales, 0.0)
                                  : shape_of(parameter, ranges[k - given.effect->n_linear()], joint_);
      if (auto const value = given.values.find(parameter.name); value != given.values.end())
        begin_at(made, value->second);
      // several waves of one kind are told apart by their number
      if (count > 1) made.name += fmt::format("_{}", count);
      parameters_.push_back(std::move(made));
    }
  }
}

void RolloutModel::add_loop_parameters(JointScales const& scales) {
  for (LoopKey const key : loop_.free) {
    auto const& facts = facts_of(key);
    RolloutParameter made;
    made.name = fmt::format("loop_{}", facts.name);
    made.unit = joint_ == JointKind::revolute ? facts.unit_revolute : facts.unit_prismatic;
    made.start = std::isfinite(loop_.values[key]) ? loop_.values[key] : facts.most;
    made.lower = facts.least;
    made.upper = facts.most;
    made.is_given = true;
    made.scale = std::max(std::abs(made.start), natural_size(facts.measure, scales));
    if (facts.measure == LoopMeasure::speed) made.scale = std::min(made.scale, scales.peak_speed);
    // friction that falls over more than all speeds of the joint is told from none that does not
    if (key == LoopKey::stribeck_speed) made.upper = scales.peak_speed;
    parameters_.push_back(std::move(made));
  }
}

Eigen::VectorXd RolloutModel::start() const {
  Eigen::VectorXd start(static_cast<Eigen::Index>(size()));
  for (std::size_t k = 0; k < size(); ++k) start[static_cast<Eigen::Index>(k)] = parameters_[k].start;
  return start;
}

RolloutModel RolloutModel::with_held(std::size_t parameter, double value) const {
  RolloutModel held = *this;
  RolloutParameter& one = held.parameters_[parameter];
  one.start = one.lower = one.upper = value;
  return held;
}

std::vector<std::string> RolloutModel::names() const {
  std::vector<std::string> names;
  for (auto const& one : parameters_) names.push_back(one.name);
  return names;
}

RolloutTrial RolloutModel::trial(Eigen::Ref<Eigen::VectorXd const> const& parameters) const {
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(parameters.size()) == size());
  RolloutTrial trial;
  double const* value = parameters.data();
  ReplicateJoint placed;
  placed.lanes.inertia = 0.0;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    std::size_t const count = terms_[t]->n_linear();
    if (in_lanes_[t] == 1)
      place_in_lanes(placed, terms_[t]->name(), value);
    else
      trial.effects.emplace_back(value, value + count);
    value += count;
  }
  for (std::size_t e = trial.effects.size(); e < structure_.effects.size(); ++e) {
    std::size_t const count = structure_.effects[e]->parameters().size();
    trial.effects.emplace_back(value, value + count);
    value += count;
  }
  trial.joint = placed.lanes;
  trial.forward = placed.coulomb_forward;
  trial.backward = placed.coulomb_backward;
  trial.offset = placed.offset;
  LoopValues values = loop_.values;
  for (LoopKey const key : loop_.free) values[key] = *value++;
  trial.loop = numbers_of(loop_.form, values);
  trial.gear = gear_of(values);
  trial.arm_mass = values[LoopKey::arm_mass];
  trial.motor_gain_per_kelvin = values[LoopKey::motor_gain_per_kelvin];
  trial.is_possible = parameters.allFinite() && trial.joint.inertia > 0.0 && trial.backward <= trial.forward;
  return trial;
}

RolloutStructure RolloutModel::structure_for(Eigen::VectorXd const& parameters, double tick_s) const {
  RolloutStructure structure = structure_;
  structure.step_s = loop_.steps_by_ticks ? tick_s : longest_step_s(trial(parameters), structure_, tick_s);
  return structure;
}

}  // namespace torquescope
