#pragma once
// The equation of motion of an arm whose joints have effects of their own, with dry friction as the set-valued law it
// is.
//
// Equation   M(q) ddq + bias(q, dq) + smooth(q, dq, ddq, t) + dry = u; at rest dry is whatever holds the joint, within
//            the branches of either direction (stick_slip.hpp)
// Effects    those that act on the joint (joint_effects.hpp); effects with memory step by step. Load torque, of effects
//            that follow the load: M ddq + bias of the joint's row at the beginning of the step
// Units      SI; u is the motors' torque at the joints (N m or N). No hard stops at the ends of the travel
// Threads    one object, one thread

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/robot/arm_equation.hpp"
#include "engine/simulate/joint_effects.hpp"
#include "engine/simulate/stick_slip.hpp"

namespace torquescope {

struct ArmState {
  double time_s = 0.0;
  Eigen::VectorXd q, dq;
};

// effects of one joint: those that follow from the instant, and those that remember
struct ArmJointTerms {
  std::vector<PlantTerm> instant, remembering;
};

class ArmPlant {
 public:
  // one entry a joint; dry branches must hold: the backward one is not above the forward one
  ArmPlant(SerialChain const& chain, JointVector const& parameters, std::vector<ArmJointTerms> const& joints);

  Eigen::Index size() const { return equation_.size(); }
  // just after this instant; 0 while held
  Eigen::VectorXd const& acceleration(ArmState const& state, JointVector const& u);
  // u that makes this motion, without effects that remember; sign(0) = 0
  Eigen::VectorXd inverse_dynamics(ArmState const& state, JointVector const& ddq);
  // of each joint alone at q: the diagonal of M, and what its effects add
  Eigen::VectorXd inertia(ArmState const& state);

  // One step under a constant u: midpoint rule; where a joint with dry friction comes to rest the step is cut, and the
  // rest of the step begins with the question which joints friction holds. Second order in step_s
  void advance(ArmState& state, JointVector const& u, double step_s);

 private:
  struct Slope {
    Eigen::VectorXd dq, ddq;
  };
  bool has_dry(std::size_t joint) const { return effects_[joint].has_dry() || !memories_[joint].empty(); }
  JointState joint_state(ArmState const& state, std::size_t joint) const;
  // M and push = u - bias - coasting at this state
  void set_equation(ArmState const& state, JointVector const& u);
  void set_contacts(ArmState const& state);
  // accelerations with the contacts as they stand, or as free joints find them
  Slope slope(ArmState const& state, JointVector const& u);
  ArmState slid(ArmState const& state, Slope const& begin, JointVector const& u, double step_s);
  void remember(ArmState const& state, JointVector const& u, double step_s);
  void fix_contacts();

  ArmEquation equation_;
  std::vector<JointEffects> effects_;
  std::vector<std::vector<std::unique_ptr<EffectRunner>>> memories_;
  bool needs_past_ = false;  // an effect remembers, or follows the load
  StickSlip stick_slip_;
  // of the instant
  Eigen::MatrixXd mass_;
  Eigen::VectorXd push_, load_, motor_;
  std::vector<DryBranches> dry_;
  std::vector<JointContact> contacts_;
  // of the step
  std::vector<int> stops_;
};

}  // namespace torquescope
