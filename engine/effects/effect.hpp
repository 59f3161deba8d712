#pragma once
// One physical effect of a joint: the torque it needs, as columns for identification and as a number for simulation.
//
// Equation   tau_effect = columns(motion, shape) * linear parameters
// Shapes     columns: n_samples x n_linear, column-major
// Units      SI of a revolute joint (N m, rad); unit_for() gives the prismatic ones (N, m)
// Threads    const objects, any number of threads
// Source     PHYSICS.md section 1 (names, equations); each file names its own

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"

namespace torquescope {

enum class JointKind { revolute, prismatic };

struct EffectParameter {
  std::string name;                 // "viscous"
  std::string unit_revolute;        // "N m s/rad"
  std::string unit_prismatic;       // "N s/m"
  bool is_shape = false;            // nonlinear: held fixed while the linear ones are solved
  double lower = 0.0, upper = 0.0;  // of shape parameters, in SI
  std::string const& unit_for(JointKind joint) const {
    return joint == JointKind::revolute ? unit_revolute : unit_prismatic;
  }
};

// one instant of a joint
struct JointState {
  double time_s = 0.0, q = 0.0, dq = 0.0, ddq = 0.0;
};

class Effect {
 public:
  virtual ~Effect() = default;
  virtual std::string const& name() const = 0;      // as in the job file
  virtual std::string const& title() const = 0;     // one line for people
  virtual std::string const& equation() const = 0;  // "J ddq"
  virtual std::string const& source() const = 0;
  virtual std::vector<EffectParameter> const& parameters() const = 0;  // linear ones first, then shapes
  // motion at the full rate, before the parallel filter
  virtual void columns(Motion const& motion, std::span<double const> shape, Eigen::Ref<Eigen::MatrixXd> out) const = 0;
  // torque at one instant; all parameters in the order of parameters(); sign(0) = 0
  virtual double torque(JointState const& state, std::span<double const> parameters) const = 0;
  // torque jumps with the sign of the velocity: a simulator must treat it as set-valued at rest
  virtual bool is_dry_friction() const { return false; }
};

std::vector<Effect const*> const& effect_choices();
Effect const* find_effect(std::string const& name);

}  // namespace torquescope
