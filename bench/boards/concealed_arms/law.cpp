#include "concealed_arms/law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace concealed_arms {
namespace {

constexpr double lowest_resonance_hz = 8.0;  // of the links with the motor held: softer gears no arm has

}  // namespace

double Law::dry(Instant const& now) const {
  double const speed = std::abs(now.v);
  switch (kind) {
    case LawKind::load_friction:
      return size * std::abs(now.load);
    case LawKind::stribeck:
      return size * std::exp(-std::pow(speed / shape, second));
    case LawKind::power_viscous:
      return size * std::pow(speed, shape);
    case LawKind::position_friction:
      return size * std::sin(shape * now.q + second);
    default:
      return 0.0;
  }
}

double Law::smooth(Instant const& now) const {
  switch (kind) {
    case LawKind::asymmetric_viscous:
      return size * std::abs(now.v);
    case LawKind::spring:
      return size * (now.q + shape * std::pow(now.q - second, 3));
    case LawKind::cogging:
      return size * std::cos(shape * now.q + second);
    case LawKind::friction_of_previous:
    case LawKind::friction_of_next:
      return size * (now.neighbour_speed + shape * std::tanh(now.neighbour_speed / 0.01));
    default:
      return 0.0;
  }
}

bool Law::is_of_several_joints() const {
  return kind == LawKind::tilted_base || kind == LawKind::joint_zero || kind == LawKind::elastic_joint;
}

int Law::neighbour(int joints) const {
  if (kind == LawKind::friction_of_previous) return joint - 1;
  if (kind == LawKind::friction_of_next && joint + 1 < joints) return joint + 1;
  return -1;
}

std::vector<LawWords> const& law_words() {
  static std::vector<LawWords> const words = {
      {LawKind::load_friction, "load_dependent_friction", {"load"}},
      {LawKind::stribeck, "stribeck", {"reversal", "velocity_law"}},
      {LawKind::spring, "spring", {"static_position"}},
      {LawKind::asymmetric_viscous, "asymmetric_viscous", {"velocity_law"}},
      {LawKind::cogging, "cogging", {"order_locked", "static_position"}},
      {LawKind::power_viscous, "power_law_viscous", {"velocity_law", "reversal"}},
      {LawKind::position_friction, "position_dependent_friction", {"static_position", "load"}},
      {LawKind::friction_of_previous, "friction_of_previous_joint", {"outside"}},
      {LawKind::tilted_base, "gravity_direction", {"static_position"}},
      {LawKind::friction_of_next, "friction_of_next_joint", {"outside"}},
      {LawKind::joint_zero, "joint_zero", {"static_position"}},
      {LawKind::elastic_joint, "joint_compliance", {"acceleration"}}};
  return words;
}

LawWords const& words_of(LawKind kind) {
  return *std::find_if(law_words().begin(), law_words().end(), [&](LawWords const& w) { return w.kind == kind; });
}

LawWords const& words_of(std::string const& name) {
  for (LawWords const& words : law_words())
    if (name == words.name) return words;
  throw std::invalid_argument("no law is called " + name);
}

std::vector<int> possible_joints(LawKind kind, Arm const& arm) {
  int first = 0, last = arm.joints() - 1;
  if (kind == LawKind::tilted_base) last = 0;  // the arm's, not a joint's
  // turned about the vertical nothing changes, and a last link that is turned is another last link
  if (kind == LawKind::joint_zero) first = 1, --last;
  if (kind == LawKind::friction_of_previous) first = 1;
  if (kind == LawKind::friction_of_next) --last;
  std::vector<int> joints;
  for (int joint = first; joint <= last; ++joint) joints.push_back(joint);
  return joints;
}

Law drawn_law(LawKind kind, Arm const& arm, int joint, JointMoves const& moves, concealed::Random& random) {
  auto const joints = possible_joints(kind, arm);
  if (std::find(joints.begin(), joints.end(), joint) == joints.end())
    throw std::invalid_argument(std::string("joint ") + std::to_string(joint + 1) + " of " + arm.name + " has no " +
                                words_of(kind).name);
  Link const& link = arm.links[static_cast<std::size_t>(joint)];
  double const phase = random.between(0.0, full_turn);
  Law law{.kind = kind, .joint = joint};
  switch (kind) {
    case LawKind::load_friction:
      law.largest = 0.3;
      break;
    case LawKind::stribeck:
      law.largest = 2.0 * link.coulomb;
      law.shape = moves.fastest * random.between(0.04, 0.15);
      law.second = random.between(1.0, 2.0);
      break;
    case LawKind::power_viscous:
      law.largest = 3.0 * link.coulomb;
      law.shape = random.uniform() < 0.5 ? random.between(0.3, 0.6) : random.between(1.6, 2.0);
      break;
    case LawKind::asymmetric_viscous:
      law.largest = 0.8 * link.viscous;
      break;
    case LawKind::spring:
      law.largest = 20.0 * link.coulomb;
      law.shape = random.uniform() < 0.5 ? 0.0 : random.between(0.0, 1.0) / (moves.travel * moves.travel);
      law.second = random.between(-0.2, 0.2) * moves.travel;
      break;
    case LawKind::position_friction:
      law.largest = 0.6 * link.coulomb;  // beyond its level, friction would push
      law.shape = full_turn * random.between(0.7, 3.0) / moves.travel;
      law.second = phase;
      break;
    case LawKind::cogging:
      law.largest = link.coulomb;
      law.shape = full_turn * random.between(3.0, 10.0) / moves.travel;
      law.second = phase;
      break;
    case LawKind::friction_of_previous:
    case LawKind::friction_of_next:
      law.largest = link.viscous;
      law.shape = moves.fastest * random.between(0.2, 1.0);  // dry part, as speed
      break;
    case LawKind::tilted_base:
      law.largest = 0.3;
      law.shape = phase;  // towards where
      break;
    case LawKind::joint_zero:
      law.largest = 0.3;
      break;
    case LawKind::elastic_joint:
      law.second = moves.inertia;
      law.largest = 1.0 / (law.second * std::pow(full_turn * lowest_resonance_hz, 2));
      law.smallest = law.largest / 25.0;      // at five times that resonance there is nothing to see
      law.shape = random.between(0.02, 0.1);  // damping ratio of the links with the motor held
      break;
  }
  return law;
}

}  // namespace concealed_arms
