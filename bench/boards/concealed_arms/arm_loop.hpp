#pragma once
// An arm in closed loop: joint controllers with weight fed forward, encoders, dry friction that is set-valued at rest.
//
// Equation   M(q) a + c(q, v) + viscous v + offset + smooth law = u - f,  f in level * Sgn(v), level >= 0
// Elastic    of an elastic joint q is its link's; drive, friction and encoder turn by another angle behind a spring and
//            a damper (Spong 1987, doi:10.1115/1.3143860)
// Steps      0.25 ms: staggered (leapfrog), v in the middle of two positions; second order but where a joint reverses.
//            Friction: complementarity solved exactly by sweeps over the joints (Moreau 1988; Stewart, Trinkle 1996)
// Control    1 kHz, held: PD or PID on the encoder's position, speed by a filtered difference, weight at the reference
// Shapes     matrices of joints x log rows (500 Hz); SI
// Threads    one run, one thread

#include <Eigen/Core>
#include <optional>

#include "concealed_arms/arm_motion.hpp"
#include "concealed_arms/law.hpp"
#include "concealed_arms/mujoco_arm.hpp"

namespace concealed_arms {

struct Controller {
  double bandwidth_hz = 6.0, damping = 0.9, integral_share = 0.0, speed_filter_hz = 80.0;
  double weight_share = 1.0;  // of the weight that is fed forward
  bool encoder = true;        // false: the exact position is read (for tests)
};

struct Plant {
  Arm arm{};
  Gravity gravity = upright;  // that acts; controllers believe in `upright`
  std::optional<Law> law{};
  Controller controller{};
};

struct ArmRun {
  Eigen::MatrixXd reference;         // at the rows
  Eigen::MatrixXd q, v, a;           // true, of an elastic joint at its drive
  Eigen::MatrixXd links_q, links_v;  // true, of the links
  Eigen::MatrixXd seen;              // by the encoders, zero errors included
  Eigen::MatrixXd applied;           // torque in force from the row on
  Eigen::MatrixXd averaged;          // mean of the torques in force before and from the row on
};

// steps_a_tick: 4 for cases; more shows what the step costs
ArmRun run_loop(Plant const& plant, ArmMotion const& wanted, int steps_a_tick = 4);

}  // namespace concealed_arms
