#pragma once
// Physics that the plant has and the job's baseline model lacks.
//
// Equation   (inertia + added_inertia()) a = drive - offset - viscous v - gravity(q) - sum torque() - s max(0, coulomb
//            + sum dry()) so torque() and dry() are what the motor has to deliver in addition, dry() along the motion
// State      z, n_states() numbers integrated with the joint (bristles, temperatures, a second mass)
// Units      SI of the joint: N m, rad or N, m
// Threads    const objects, any number of threads

#include <cstddef>
#include <memory>
#include <vector>

namespace concealed {

// one instant of the motor side; direction is the branch of dry friction the joint slides on (-1, 1), 0 while it rests;
// motor is the torque the drive believes to deliver, and records
struct Instant {
  double t = 0.0, q = 0.0, v = 0.0, a = 0.0;
  int direction = 0;
  double motor = 0.0;
};

class HiddenEffect {
 public:
  virtual ~HiddenEffect() = default;
  virtual std::size_t n_states() const { return 0; }
  virtual void start(double /*q*/, double* /*z*/) const {}  // the state of a joint that has long been at rest at q
  virtual void rates(Instant const&, double const* /*z*/, double* /*dz*/) const {}
  virtual double torque(Instant const&, double const* /*z*/) const { return 0.0; }
  virtual double dry(Instant const&, double const* /*z*/) const { return 0.0; }
  // what moves with the joint beyond the baseline's inertia; its torque, times the acceleration, is not in torque()
  virtual double added_inertia(Instant const&) const { return 0.0; }
  // share of the baseline's inertia that is not the motor's but lives in z
  virtual double moved_inertia() const { return 0.0; }
  // dry() depends on the acceleration, which then follows from an equation that has to be solved
  virtual bool feels_load() const { return false; }
};

using HiddenEffects = std::vector<std::shared_ptr<HiddenEffect const>>;

}  // namespace concealed
