#include "engine/diagnose/arm_laws.hpp"

#include <array>
#include <string>

#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {
namespace {

// an arm on its way; standard: parameters in the columns that stand
struct MovingArm {
  SerialChain const& chain;
  Eigen::VectorXd standard;
  std::vector<Motion> const& motion;

  Eigen::Index samples() const { return motion.front().q.size(); }
  Eigen::VectorXd at(Eigen::VectorXd Motion::*what, Eigen::Index sample) const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(motion.size()));
    for (std::size_t j = 0; j < motion.size(); ++j) all[static_cast<Eigen::Index>(j)] = (motion[j].*what)[sample];
    return all;
  }
};

// of every joint; a joint without columns: the law does not exist there
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
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd(arm.samples(), 2));
  if (arm.chain.gravity.isZero()) return ColumnsOfJoints(arm.motion.size());
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

ColumnsOfJoints joint_zero(MovingArm const& arm) {
  constexpr double step = 1e-5;  // rad or m: of a central difference, good to ten digits
  ColumnsOfJoints all(arm.motion.size(), Eigen::MatrixXd(arm.samples(), 1));
  for (Eigen::Index i = 0; i < arm.samples(); ++i) {
    Eigen::VectorXd const dq = arm.at(&Motion::dq, i), ddq = arm.at(&Motion::ddq, i);
    for (std::size_t j = 0; j < all.size(); ++j) {
      auto const own = static_cast<Eigen::Index>(j);
      Eigen::VectorXd ahead = arm.at(&Motion::q, i), behind = ahead;
      ahead[own] += step;
      behind[own] -= step;
      all[j](i, 0) = (inverse_dynamics(arm.chain, arm.standard, ahead, dq, ddq)[own] -
                      inverse_dynamics(arm.chain, arm.standard, behind, dq, ddq)[own]) /
                     (2.0 * step);
    }
  }
  return all;
}

struct ArmLaw {
  char const* name;
  ColumnsOfJoints (*columns)(MovingArm const&);
};

constexpr ArmLaw table[] = {
    {"friction_of_next_joint", friction_of_next}, {"friction_of_previous_joint", friction_of_previous},
    {"inertia_of_next_joint", inertia_of_next},   {"inertia_of_previous_joint", inertia_of_previous},
    {"gravity_direction", gravity_direction},     {"joint_zero", joint_zero}};

}  // namespace

std::vector<GivenSignals> arm_law_signals(ArmModel const& model, Eigen::VectorXd const& parameters,
                                          std::vector<Motion> const& motion) {
  MovingArm const arm{model.chain(), model.base().to_standard(parameters.head(model.base().size())), motion};
  std::vector<GivenSignals> signals(motion.size());
  for (ArmLaw const& law : table) {
    ColumnsOfJoints columns = law.columns(arm);
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (columns[j].size() > 0) signals[j].laws.push_back({law.name, std::move(columns[j])});
  }
  return signals;
}

}  // namespace torquescope
