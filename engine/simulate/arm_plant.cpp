#include "engine/simulate/arm_plant.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

// a joint that has come to rest as often within one step is held for the rest of it
constexpr int most_stops = 2;

// its torque jumps with the sign of the velocity where it replaces a part of the dry friction: all of it is branches
void add_memory(EffectRunner const& memory, JointState const& state, double& inertia, DryBranches& dry) {
  constexpr double creeping = std::numeric_limits<double>::min();
  JointState forward = state, backward = state, accelerating = state;
  forward.dq = std::max(state.dq, creeping);
  backward.dq = std::min(state.dq, -creeping);
  accelerating.ddq = 1.0;
  inertia += memory.torque(accelerating) - memory.torque(state);
  dry.forward += memory.torque(forward);
  dry.backward += memory.torque(backward);
}

double sign_of(Contact contact) {
  return contact == Contact::forward ? 1.0 : contact == Contact::backward ? -1.0 : 0.0;
}

}  // namespace

ArmPlant::ArmPlant(SerialChain const& chain, JointVector const& parameters, std::vector<ArmJointTerms> const& joints)
    : equation_(chain, parameters),
      memories_(joints.size()),
      stick_slip_(chain.size()),
      mass_(chain.size(), chain.size()),
      push_(chain.size()),
      load_(Eigen::VectorXd::Zero(chain.size())),
      motor_(Eigen::VectorXd::Zero(chain.size())),
      dry_(joints.size()),
      contacts_(joints.size()),
      stops_(joints.size(), 0) {
  TORQUESCOPE_EXPECT(joints.size() == chain.joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    effects_.emplace_back(joints[j].instant);
    for (auto const& term : joints[j].remembering)
      memories_[j].push_back(term.effect->runner(term.parameters, effects_[j].scales()));
    needs_past_ = needs_past_ || !memories_[j].empty();
    for (auto const& term : joints[j].instant) needs_past_ = needs_past_ || term.effect->needs_baseline();
  }
}

JointState ArmPlant::joint_state(ArmState const& state, std::size_t joint) const {
  auto const j = static_cast<Index>(joint);
  return {state.time_s, state.q[j], state.dq[j], 0.0, load_[j], motor_[j]};
}

void ArmPlant::set_equation(ArmState const& state, JointVector const& u) {
  equation_.set(state.q, state.dq);
  mass_ = equation_.mass();
  push_ = u - equation_.bias();
  for (std::size_t j = 0; j < effects_.size(); ++j) {
    auto const at = static_cast<Index>(j);
    JointState const joint = joint_state(state, j);
    auto const smooth = effects_[j].smooth(joint);
    mass_(at, at) += smooth.inertia;
    push_[at] -= smooth.coasting;
    dry_[j] = {effects_[j].dry(joint, -1.0), effects_[j].dry(joint, 1.0)};
    for (auto const& memory : memories_[j]) add_memory(*memory, joint, mass_(at, at), dry_[j]);
    // no friction drives: an effect that weakens dry friction by more than there is leaves none
    if (joint.dq == 0.0 && dry_[j].backward > dry_[j].forward)
      dry_[j].backward = dry_[j].forward = 0.5 * (dry_[j].backward + dry_[j].forward);
  }
}

void ArmPlant::set_contacts(ArmState const& state) {
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    double const speed = state.dq[static_cast<Index>(j)];
    if (!has_dry(j))
      contacts_[j] = {Contact::forward, false};  // its branches are 0
    else if (speed != 0.0)
      contacts_[j] = {speed > 0.0 ? Contact::forward : Contact::backward, false};
    else
      contacts_[j] = {Contact::held, stops_[j] < most_stops};
  }
}

ArmPlant::Slope ArmPlant::slope(ArmState const& state, JointVector const& u) {
  set_equation(state, u);
  stick_slip_.solve(mass_, push_, dry_, contacts_);
  return {state.dq, stick_slip_.acceleration()};
}

void ArmPlant::fix_contacts() {
  for (auto& joint : contacts_) joint.is_free = false;
}

Eigen::VectorXd const& ArmPlant::acceleration(ArmState const& state, JointVector const& u) {
  std::fill(stops_.begin(), stops_.end(), 0);
  set_contacts(state);
  set_equation(state, u);
  stick_slip_.solve(mass_, push_, dry_, contacts_);
  return stick_slip_.acceleration();
}

Eigen::VectorXd ArmPlant::inverse_dynamics(ArmState const& state, JointVector const& ddq) {
  equation_.set(state.q, state.dq);
  load_ = equation_.mass() * ddq + equation_.bias();
  Eigen::VectorXd u = load_;
  for (std::size_t j = 0; j < effects_.size(); ++j) {
    JointState joint = joint_state(state, j);
    joint.ddq = ddq[static_cast<Index>(j)];
    u[static_cast<Index>(j)] += effects_[j].torque(joint);
  }
  return u;
}

Eigen::VectorXd ArmPlant::inertia(ArmState const& state) {
  set_equation(state, Eigen::VectorXd::Zero(size()));
  return mass_.diagonal();
}

void ArmPlant::remember(ArmState const& state, JointVector const& u, double step_s) {
  set_contacts(state);
  set_equation(state, u);
  stick_slip_.solve(mass_, push_, dry_, contacts_);
  load_ = equation_.mass() * stick_slip_.acceleration() + equation_.bias();
  motor_ = u;
  for (std::size_t j = 0; j < memories_.size(); ++j) {
    JointState joint = joint_state(state, j);
    joint.ddq = stick_slip_.acceleration()[static_cast<Index>(j)];
    for (auto const& memory : memories_[j]) memory->advance(joint, step_s);
  }
}

ArmState ArmPlant::slid(ArmState const& state, Slope const& begin, JointVector const& u, double step_s) {
  double const half_s = 0.5 * step_s;
  ArmState const middle{state.time_s + half_s, state.q + half_s * begin.dq, state.dq + half_s * begin.ddq};
  Slope const there = slope(middle, u);
  return {state.time_s + step_s, state.q + step_s * there.dq, state.dq + step_s * there.ddq};
}

void ArmPlant::advance(ArmState& state, JointVector const& u, double step_s) {
  TORQUESCOPE_EXPECT(step_s > 0.0);
  double const end_s = state.time_s + step_s;
  std::fill(stops_.begin(), stops_.end(), 0);
  if (needs_past_) remember(state, u, step_s);
  double left_s = step_s;
  while (left_s > 0.0) {
    set_contacts(state);
    Slope const begin = slope(state, u);
    fix_contacts();
    ArmState const next = slid(state, begin, u, left_s);

    // joints that would turn round: held where they were just pushed off, else the first of them cuts the step
    double share = 1.0;
    bool is_held = false;
    for (std::size_t j = 0; j < contacts_.size(); ++j) {
      auto const at = static_cast<Index>(j);
      if (!has_dry(j) || next.dq[at] * sign_of(contacts_[j].contact) >= 0.0) continue;
      if (state.dq[at] == 0.0) {
        stops_[j] = most_stops;
        is_held = true;
      } else {
        share = std::min(share, state.dq[at] / (state.dq[at] - next.dq[at]));
      }
    }
    if (is_held) continue;
    if (share == 1.0) {
      state = next;
      break;
    }
    ArmState cut = slid(state, begin, u, share * left_s);
    for (std::size_t j = 0; j < contacts_.size(); ++j) {
      auto const at = static_cast<Index>(j);
      bool const turns = has_dry(j) && next.dq[at] * sign_of(contacts_[j].contact) < 0.0;
      if (!turns || state.dq[at] / (state.dq[at] - next.dq[at]) > share) continue;
      cut.dq[at] = 0.0;
      ++stops_[j];
    }
    state = cut;
    left_s -= share * left_s;
  }
  state.time_s = end_s;
}

}  // namespace torquescope
