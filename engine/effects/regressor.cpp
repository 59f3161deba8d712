#include "engine/effects/regressor.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"
#include "engine/base/huge_pages.hpp"
#include "engine/effects/redundancy.hpp"

namespace torquescope {
namespace {

// terms of a joint, or what stands beside a rigid arm
Problem problem_at_terms(Section const& model, std::string what) {
  char const* key = model.find("terms") == nullptr && model.find("friction") != nullptr ? "friction" : "terms";
  return problem_at(model, key, std::move(what), "");
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (auto const* effect : effect_choices()) names.push_back(effect->name());
  return names;
}

std::string joined(std::vector<std::string> const& words) {
  std::string text;
  for (auto const& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Problem unknown_term(Section const& model, std::string const& term) {
  auto problem = problem_at_terms(model, "there is no effect \"" + term + "\"");
  auto const close = closest_name(term, effect_names());
  if (!close.empty()) problem.caret_note = "did you mean \"" + close + "\"?";
  problem.notes = {"the effects are: " + joined(effect_names())};
  problem.help = "torquescope list effects";
  return problem;
}

// why least squares on the motion alone cannot fit this effect
std::string reason_not_plain(Effect const& effect) {
  if (effect.n_shape() > 0) {
    std::string shapes;
    for (auto const& parameter : effect.parameters())
      if (parameter.is_shape) shapes += (shapes.empty() ? "" : ", ") + parameter.name;
    return "its torque is not linear in " + shapes;
  }
  if (effect.acts_on() != ActsOn::joint) return "it acts on a recorded channel, not in the joint";
  if (effect.has_memory()) return "its torque depends on what happened before";
  return "it is built on the torque of a fitted model";
}

Problem not_a_term(Section const& model, Effect const& effect) {
  auto problem =
      problem_at_terms(model, "\"" + effect.name() + "\" cannot be a term of the model: " + reason_not_plain(effect));
  problem.help = "remove it and let `torquescope diagnose` look for it: effects = [\"" + effect.name() + "\"]";
  return problem;
}

Problem needs_an_angle(Section const& model, Effect const& effect) {
  auto problem = problem_at_terms(
      model, "term \"" + effect.name() + "\" needs an angle, but model.joint = \"prismatic\" moves along a line");
  problem.help = "remove it; the weight on a slide is constant: write \"offset\" instead";
  return problem;
}

// which of q, dq, ddq a column depends on: asked of the effect itself, so that no second table can disagree
void find_needs(RegressorColumn& column, Effect const& effect, std::size_t index) {
  std::vector<double> unit(effect.n_linear(), 0.0);
  unit[index] = 1.0;
  auto const torque = [&](JointState const& state) { return effect.torque(state, unit, {}); };
  JointState const base{0.0, 0.4, -0.7, 0.9};
  auto moved = base;
  moved.q = 1.1;
  column.needs_position = torque(moved) != torque(base);
  moved = base;
  moved.dq = 1.3;
  column.needs_velocity = torque(moved) != torque(base);
  moved = base;
  moved.ddq = -1.7;
  column.needs_acceleration = torque(moved) != torque(base);
  moved = base;
  moved.time_s = 0.6;
  column.needs_time = torque(moved) != torque(base);
}

}  // namespace

Regressor::Regressor(std::vector<std::string> const& terms, JointKind joint, double velocity_deadband,
                     Section const& model)
    : joint_(joint), velocity_deadband_(velocity_deadband) {
  TORQUESCOPE_EXPECT(velocity_deadband >= 0.0);
  std::vector<Problem> problems;
  if (terms.empty()) {
    problems.push_back(problem_at_terms(model, "the model has no terms"));
    problems.back().help = "write terms = [\"inertia\", \"viscous\", \"coulomb_positive\", \"coulomb_negative\"]";
  }

  // names -> effects
  for (auto const& term : terms) {
    auto const* effect = find_effect(term);
    if (effect == nullptr) {
      problems.push_back(unknown_term(model, term));
    } else if (std::find(terms_.begin(), terms_.end(), effect) != terms_.end()) {
      problems.push_back(problem_at_terms(model, "term \"" + term + "\" is listed twice"));
      problems.back().help = "remove one";
    } else if (!effect->exists_on(joint)) {
      problems.push_back(needs_an_angle(model, *effect));
    } else if (!effect->is_plain_term()) {
      problems.push_back(not_a_term(model, *effect));
    } else {
      terms_.push_back(effect);
    }
  }
  if (!problems.empty()) throw Error(std::move(problems));

  // effects -> columns
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    auto const& parameters = terms_[term]->parameters();
    for (std::size_t k = 0; k < terms_[term]->n_linear(); ++k) {
      RegressorColumn column{parameters[k].name, parameters[k].unit_for(joint), term};
      find_needs(column, *terms_[term], k);
      columns_.push_back(std::move(column));
    }
  }

  // columns that say the same on every motion
  for (auto const& redundancy : find_redundancies(terms_)) {
    problems.push_back(problem_at_terms(model, redundancy.what));
    problems.back().help = redundancy.help;
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

Regressor Regressor::beside(Effect const& given) const {
  TORQUESCOPE_EXPECT(given.is_given());
  Regressor both = *this;
  both.terms_.push_back(&given);
  // a rigid body's torque passes the gear, as that of a joint's own mass and weight
  bool const loads = given.is_rigid_body();
  for (auto const& parameter : given.parameters())
    both.columns_.push_back({parameter.name, parameter.unit_for(joint_), terms_.size(), loads, false, loads, false});
  return both;
}

std::vector<std::string> Regressor::names() const {
  std::vector<std::string> names;
  for (auto const& column : columns_) names.push_back(column.name);
  return names;
}

std::vector<std::string> Regressor::units() const {
  std::vector<std::string> units;
  for (auto const& column : columns_) units.push_back(column.unit);
  return units;
}

std::string Regressor::equation() const {
  std::string text = joint_ == JointKind::revolute ? "tau =" : "F =";
  for (auto const* effect : terms_)
    text += (effect == terms_.front() ? " " : " + ") +
            (effect->has_plain_form() ? effect->plain_equation() : effect->equation());
  return text;
}

double Regressor::seen_velocity(Effect const& effect, double velocity) const {
  bool const at_rest = effect.is_dry_friction() && std::abs(velocity) <= velocity_deadband_;
  return at_rest ? 0.0 : velocity;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is a view, and what it looks at is changed
void Regressor::columns_of_term(Motion const& motion, std::size_t term, Eigen::Ref<Eigen::MatrixXd> out,
                                GivenSignals const* given) const {
  TORQUESCOPE_EXPECT(motion.q.size() == motion.dq.size() && motion.q.size() == motion.ddq.size() &&
                     motion.q.size() == motion.time_s.size());
  auto const& effect = *terms_[term];
  if (!effect.is_dry_friction() || velocity_deadband_ == 0.0) {
    EffectInput input{motion};
    input.given = given;
    return effect.columns(input, {}, out);
  }
  Motion deadened = motion;
  for (double& velocity : deadened.dq) velocity = seen_velocity(effect, velocity);
  effect.columns({deadened}, {}, out);
}

Eigen::MatrixXd Regressor::columns(Motion const& motion, GivenSignals const* given) const {
  Eigen::MatrixXd phi(motion.q.size(), static_cast<Eigen::Index>(size()));
  in_huge_pages(phi);
  Eigen::Index first = 0;
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    auto const count = static_cast<Eigen::Index>(terms_[term]->n_linear());
    columns_of_term(motion, term, phi.middleCols(first, count), given);
    first += count;
  }
  return phi;
}

double Regressor::torque(JointState const& state, std::span<double const> parameters) const {
  TORQUESCOPE_EXPECT(parameters.size() == size());
  double torque = 0.0;
  std::size_t first = 0;
  for (auto const* effect : terms_) {
    auto const count = effect->n_linear();
    auto seen = state;
    seen.dq = seen_velocity(*effect, state.dq);
    torque += effect->torque(seen, parameters.subspan(first, count), {});
    first += count;
  }
  return torque;
}

}  // namespace torquescope
