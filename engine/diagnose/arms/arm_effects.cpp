#include "engine/diagnose/arms/arm_effects.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "engine/base/parallel.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/link_inertia.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {
namespace {

// an arm on its way; standard: parameters in the columns that stand
struct MovingArm {
  SerialChain const& chain;
  Eigen::VectorXd standard;
  std::vector<Motion> const& motion;
  std::vector<bool> has_drive{};  // [N] whether its drive's inertia is a parameter, apart from those of links

  Eigen::Index samples() const { return motion.front().q.size(); }
  Eigen::VectorXd at(Eigen::VectorXd Motion::*what, Eigen::Index sample) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(motion.size()));
    for (std::size_t j = 0; j < motion.size(); ++j) all[static_cast<Eigen::Index>(j)] = (motion[j].*what)[sample];
    return all;
  }
};

// of every joint; a joint without columns: the effect does not exist there
using ColumnsOfJoints = std::vector<Eigen::MatrixXd>;

ColumnsOfJoints friction_of(MovingArm const& arm, int neighbour) {
  ColumnsOfJoints all(arm.motion.size());
  for (std::size_t j = 0; j < all.size(); ++j) {
    std::size_t const other = j + static_cast<std::size_t>(neighbour);  // wraps below 0
    if (other >= all.size()) continue;
    Eigen::VectorXd const& dq = arm.motion[other].dq;
    all[j].resize(dq.size(), 2);
    all[j] << dq, dq.array().sign().matrix();
  }
  return all;
}

ColumnsOfJoints inertia_of(MovingArm const& arm, int neighbour) {
  ColumnsOfJoints all(arm.motion.size());
  for (std::size_t j = 0; j < all.size(); ++j) {
    std::size_t const other = j + static_cast<std::size_t>(neighbour);
    if (other < all.size()) all[j] = arm.motion[other].ddq;
  }
  return all;
}

ColumnsOfJoints friction_of_next(MovingArm const& arm) { return friction_of(arm, 1); }
ColumnsOfJoints friction_of_previous(MovingArm const& arm) { return friction_of(arm, -1); }
ColumnsOfJoints inertia_of_next(MovingArm const& arm) { return inertia_of(arm, 1); }
ColumnsOfJoints inertia_of_previous(MovingArm const& arm) { return inertia_of(arm, -1); }

// two directions at right angles to gravity, as long as it
std::array<Eigen::Vector3d, 2> beside_gravity(Eigen::Vector3d const& gravity) {
  Eigen::Index least = 0;
  gravity.cwiseAbs().minCoeff(&least);
  Eigen::Vector3d const first = cross(gravity, Eigen::Vector3d::Unit(least)).normalized();
  return {gravity.norm() * first, cross(gravity, first)};
}

ColumnsOfJoints gravity_direction(MovingArm const& arm) {
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd::Zero(arm.samples(), 2));
  if (arm.chain.gravity.isZero()) return all;
  auto const directions = beside_gravity(arm.chain.gravity);
  for (Eigen::Index k = 0; k < 2; ++k) {
    SerialChain tilted = arm.chain;
    tilted.gravity = directions[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < arm.samples(); ++i) {
      Eigen::VectorXd const torque = gravity_torque(tilted, arm.standard, arm.at(&Motion::q, i));
      for (std::size_t j = 0; j < all.size(); ++j) all[j](i, k) = torque[static_cast<Eigen::Index>(j)];
    }
  }
  return all;
}

// all joints feel the zero of one
ColumnsOfJoints joint_zero(MovingArm const& arm, std::size_t joint) {
  constexpr double step = 1e-5;  // rad or m: of a central difference, good to ten digits
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd(arm.samples(), 1));
  for (Eigen::Index i = 0; i < arm.samples(); ++i) {
    Eigen::VectorXd const dq = arm.at(&Motion::dq, i), ddq = arm.at(&Motion::ddq, i);
    Eigen::VectorXd ahead = arm.at(&Motion::q, i), behind = ahead;
    ahead[static_cast<Eigen::Index>(joint)] += step;
    behind[static_cast<Eigen::Index>(joint)] -= step;
    Eigen::VectorXd const slope = (inverse_dynamics(arm.chain, arm.standard, ahead, dq, ddq) -
                                   inverse_dynamics(arm.chain, arm.standard, behind, dq, ddq)) /
                                  (2.0 * step);
    for (std::size_t j = 0; j < all.size(); ++j) all[j](i, 0) = slope[static_cast<Eigen::Index>(j)];
  }
  return all;
}

// A joint's way: position, speed and acceleration [n] each, of a joint or of a part of it
struct Way {
  Eigen::VectorXd position, speed, acceleration;

  static Way of(Eigen::VectorXd const& position, double rate_hz) {
    Eigen::VectorXd const speed = central_derivative(position, rate_hz);
    return {position, speed, central_derivative(speed, rate_hz)};
  }
};

// [N] for an arm that moves along a joint's way, and not otherwise: change of torque per unit of it, at one sample
Eigen::VectorXd change_along(MovingArm const& arm, Eigen::VectorXd const& links, std::size_t joint, Way const& way,
                             Eigen::Index sample) {
  // of a central difference: a way of 1e-5 rad, good to ten digits; speeds enter by their squares, accelerations in
  // proportion, and both are as exact
  double const step = 1e-5 / std::max(way.position.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  auto const moved = [&](double by) {
    auto const i = static_cast<Eigen::Index>(joint);
    Eigen::VectorXd q = arm.at(&Motion::q, sample), dq = arm.at(&Motion::dq, sample),
                    ddq = arm.at(&Motion::ddq, sample);
    q[i] += by * way.position[sample];
    dq[i] += by * way.speed[sample];
    ddq[i] += by * way.acceleration[sample];
    return inverse_dynamics(arm.chain, links, q, dq, ddq);
  };
  return (moved(step) - moved(-step)) / (2.0 * step);
}

// A spring behind the encoder of one joint: its link lags by load / stiffness, and all joints feel where it is. The
// load is the links' torque. Where the model has the drive's inertia J in a link's, neither is known: columns of J, J^2
ColumnsOfJoints joint_compliance(MovingArm const& arm, std::size_t joint) {
  Eigen::VectorXd const links = arm.standard.head(numbers_per_link * static_cast<Eigen::Index>(arm.motion.size()));
  Eigen::VectorXd load(arm.samples());
  for (Eigen::Index i = 0; i < arm.samples(); ++i)
    load[i] = inverse_dynamics(arm.chain, links, arm.at(&Motion::q, i), arm.at(&Motion::dq, i),
                               arm.at(&Motion::ddq, i))[static_cast<Eigen::Index>(joint)];
  double const rate_hz = arm.motion.front().rate_hz;
  Way const lag = Way::of(-load, rate_hz), back = Way::of(arm.motion[joint].ddq, rate_hz);
  bool const has_drive = arm.has_drive[joint];
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd::Zero(arm.samples(), has_drive ? 1 : 3));
  for (Eigen::Index i = 0; i < arm.samples(); ++i) {
    Eigen::VectorXd const of_load = change_along(arm, links, joint, lag, i);
    Eigen::VectorXd const of_drive = has_drive ? of_load : change_along(arm, links, joint, back, i);
    for (std::size_t j = 0; j < all.size(); ++j) {
      all[j](i, 0) = of_load[static_cast<Eigen::Index>(j)];
      if (!has_drive) all[j](i, 1) = of_drive[static_cast<Eigen::Index>(j)];
    }
  }
  // the drive does not lag
  if (!has_drive) {
    all[joint].col(1) -= lag.acceleration;
    all[joint].col(2) -= back.acceleration;
  }
  return all;
}

// parameters of an arm that is a unit of one number of its last link, and nothing else
Eigen::VectorXd one_number_of_last_link(MovingArm const& arm, LinkNumber number) {
  auto const joints = static_cast<Eigen::Index>(arm.motion.size());
  Eigen::VectorXd standard = Eigen::VectorXd::Zero(numbers_per_link * joints);
  standard[numbers_per_link * (joints - 1) + static_cast<Eigen::Index>(number)] = 1.0;
  return standard;
}

ColumnsOfJoints payload_picked_up(MovingArm const& arm) {
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd(arm.samples(), numbers_per_link));
  for (Eigen::Index k = 0; k < numbers_per_link; ++k) {
    Eigen::VectorXd const payload = one_number_of_last_link(arm, static_cast<LinkNumber>(k));
    for (Eigen::Index i = 0; i < arm.samples(); ++i) {
      Eigen::VectorXd const torque =
          inverse_dynamics(arm.chain, payload, arm.at(&Motion::q, i), arm.at(&Motion::dq, i), arm.at(&Motion::ddq, i));
      for (std::size_t j = 0; j < all.size(); ++j) all[j](i, k) = torque[static_cast<Eigen::Index>(j)];
    }
  }
  return all;
}

// a force F on a point is the weight of a unit mass there where gravity is F
ColumnsOfJoints tip_contact(MovingArm const& arm) {
  Eigen::VectorXd unit_mass = one_number_of_last_link(arm, LinkNumber::m);
  unit_mass.segment<3>(unit_mass.size() - numbers_per_link + static_cast<Eigen::Index>(LinkNumber::mx)) =
      arm.chain.flange.position;
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd(arm.samples(), 3));
  SerialChain pushed = arm.chain;
  for (Eigen::Index k = 0; k < 3; ++k) {
    pushed.gravity = Eigen::Vector3d::Unit(k);
    for (Eigen::Index i = 0; i < arm.samples(); ++i) {
      Eigen::VectorXd const torque = gravity_torque(pushed, unit_mass, arm.at(&Motion::q, i));
      for (std::size_t j = 0; j < all.size(); ++j) all[j](i, k) = torque[static_cast<Eigen::Index>(j)];
    }
  }
  return all;
}

// felt by one joint each
struct JointEffect {
  char const* name;
  ColumnsOfJoints (*columns)(MovingArm const&);
};

constexpr JointEffect of_a_joint[] = {{"friction_of_next_joint", friction_of_next},
                                      {"friction_of_previous_joint", friction_of_previous},
                                      {"inertia_of_next_joint", inertia_of_next},
                                      {"inertia_of_previous_joint", inertia_of_previous}};

// one set of parameters for all joints; of_each: there is one effect for every joint's own number
struct ArmEffect {
  char const* name;
  ColumnsOfJoints (*columns)(MovingArm const&);
  ColumnsOfJoints (*of_each)(MovingArm const&, std::size_t joint);
};

constexpr ArmEffect of_the_arm[] = {{"gravity_direction", gravity_direction, nullptr},
                                    {"joint_compliance", nullptr, joint_compliance},
                                    {"joint_zero", nullptr, joint_zero},
                                    {"payload_picked_up", payload_picked_up, nullptr},
                                    {"tip_contact", tip_contact, nullptr}};

MovingArm moving(ArmModel const& model, Eigen::VectorXd const& parameters, std::vector<Motion> const& motion) {
  std::vector<bool> has_drive(model.joints(), false);
  auto const links = numbers_per_link * static_cast<Eigen::Index>(model.joints());
  for (Eigen::Index const column : model.base().columns())
    if (column >= links) has_drive[static_cast<std::size_t>(column - links)] = true;
  return {model.chain(), model.base().to_standard(parameters.head(model.base().size())), motion, has_drive};
}

}  // namespace

std::vector<GivenSignals> arm_effect_signals(ArmModel const& model, std::vector<Motion> const& motion) {
  MovingArm const arm{model.chain(), {}, motion, {}};
  std::vector<GivenSignals> signals(motion.size());
  for (JointEffect const& effect : of_a_joint) {
    ColumnsOfJoints columns = effect.columns(arm);
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (columns[j].size() > 0) signals[j].effects.push_back({effect.name, std::move(columns[j])});
  }
  return signals;
}

std::vector<WholeArmEffect> whole_arm_effects(ArmModel const& model, Eigen::VectorXd const& parameters,
                                              std::vector<Motion> const& motion, std::span<Effect const* const> wanted,
                                              int threads) {
  MovingArm const arm = moving(model, parameters, motion);
  std::vector<WholeArmEffect> effects;
  std::vector<ArmEffect> how;
  for (ArmEffect const& known : of_the_arm) {
    auto const effect =
        std::find_if(wanted.begin(), wanted.end(), [&](Effect const* one) { return one->name() == known.name; });
    if (effect == wanted.end()) continue;
    if (known.columns) effects.push_back({*effect, {}, {}});
    for (std::size_t j = 0; known.of_each && j < motion.size(); ++j) effects.push_back({*effect, j, {}});
    how.resize(effects.size(), known);
  }
  parallel_for(effects.size(), threads, [&](std::size_t i, int) {
    effects[i].columns = effects[i].joint ? how[i].of_each(arm, *effects[i].joint) : how[i].columns(arm);
  });
  return effects;
}

}  // namespace torquescope
