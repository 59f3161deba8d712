#include "concealed_arms/arm_loop.hpp"

#include <algorithm>
#include <cmath>

#include "concealed_arms/dry_friction.hpp"

namespace concealed_arms {
namespace {

// Joint controllers: they read encoders once a tick and hold their torque
class JointControllers {
 public:
  JointControllers(Plant const& plant, ArmMotion const& wanted)
      : plant_(plant), wanted_(wanted), believed_(plant.arm, upright) {
    int const n = plant.arm.joints();
    // stiffness for the inertia each joint has in the middle of its motion
    Eigen::VectorXd const middle = wanted.q.rowwise().mean(), rest = Eigen::VectorXd::Zero(n);
    believed_.update(middle, rest);
    double const w = full_turn * plant.controller.bandwidth_hz;
    stiffness_ = believed_.mass().diagonal() * (w * w);
    damping_ = believed_.mass().diagonal() * (2.0 * plant.controller.damping * w);
    integral_ = stiffness_ * (w * plant.controller.integral_share);
    keep_ = std::exp(-full_turn * plant.controller.speed_filter_hz * control_s);
    gathered_ = rest;
    speed_ = wanted.v.col(0);
  }

  // the encoders' positions; a zero error is in them
  Eigen::VectorXd seen(Eigen::VectorXd const& q) const {
    Eigen::VectorXd shown = q;
    if (plant_.law && plant_.law->kind == LawKind::joint_zero) shown[plant_.law->joint] += plant_.law->size;
    if (!plant_.controller.encoder) return shown;
    for (int j = 0; j < plant_.arm.joints(); ++j) {
      double const step = full_turn / plant_.arm.links[static_cast<std::size_t>(j)].counts;
      shown[j] = step * std::round(shown[j] / step);
    }
    return shown;
  }

  Eigen::VectorXd torque(int tick, Eigen::VectorXd const& shown) {
    if (tick > 0) speed_ = keep_ * speed_ + (1.0 - keep_) * (shown - before_) / control_s;
    before_ = shown;
    Eigen::VectorXd const error = wanted_.q.col(tick) - shown;
    gathered_ += control_s * error;
    believed_.update(wanted_.q.col(tick), Eigen::VectorXd::Zero(shown.size()));
    return plant_.controller.weight_share * believed_.bias() + stiffness_.cwiseProduct(error) +
           integral_.cwiseProduct(gathered_) + damping_.cwiseProduct(wanted_.v.col(tick) - speed_);
  }

 private:
  Plant const& plant_;
  ArmMotion const& wanted_;
  MujocoArm believed_;
  Eigen::VectorXd stiffness_, damping_, integral_, gathered_, speed_, before_;
  double keep_ = 0.0;
};

// The arm's state: positions, and speeds half a step before them
class MovingArm {
 public:
  MovingArm(Plant const& plant, Eigen::VectorXd const& q, Eigen::VectorXd const& v)
      : plant_(plant), arm_(plant.arm, plant.gravity), q_(q), half_(v), mean_(v), a_(Eigen::VectorXd::Zero(q.size())) {}

  void step(Eigen::VectorXd const& torque, double h) {
    Eigen::VectorXd const now = half_ + 0.5 * h * a_;  // speed at the position's instant
    arm_.update(q_, now);
    Eigen::VectorXd viscous(q_.size()), level(q_.size()), needed(q_.size());
    for (int j = 0; j < plant_.arm.joints(); ++j) {
      Link const& link = plant_.arm.links[static_cast<std::size_t>(j)];
      viscous[j] = link.viscous;
      level[j] = link.coulomb;
      needed[j] = arm_.bias()[j] + link.offset_torque;
    }
    if (plant_.law) add_law(*plant_.law, now, level, needed);
    // M (w' - w) / h + viscous (w + w') / 2 + needed + friction = torque
    Eigen::MatrixXd left = arm_.mass() / h;
    Eigen::VectorXd const right = left * half_ - 0.5 * viscous.cwiseProduct(half_) + torque - needed;
    left.diagonal() += 0.5 * viscous;
    Eigen::VectorXd const after = speeds_against_dry_friction(left, right, level, half_);
    at_ = q_;
    mean_ = 0.5 * (half_ + after);
    a_ = (after - half_) / h;
    half_ = after;
    q_ += h * half_;
  }

  Eigen::VectorXd const& q() const { return q_; }
  // of the last step: where it began, and speed and acceleration there
  Eigen::VectorXd const& at() const { return at_; }
  Eigen::VectorXd const& v() const { return mean_; }
  Eigen::VectorXd const& a() const { return a_; }

 private:
  void add_law(Law const& law, Eigen::VectorXd const& v, Eigen::VectorXd& level, Eigen::VectorXd& needed) const {
    int const j = law.joint, beside = law.neighbour(plant_.arm.joints());
    // what passes the gear: the arm's torque without the drive's own inertia
    double const drive = plant_.arm.links[static_cast<std::size_t>(j)].drive_inertia;
    Instant const now{.q = q_[j],
                      .v = v[j],
                      .load = arm_.mass().row(j).dot(a_) - drive * a_[j] + arm_.bias()[j],
                      .neighbour_speed = beside >= 0 ? v[beside] : 0.0};
    level[j] = std::max(0.0, level[j] + law.dry(now));
    needed[j] += law.smooth(now);
  }

  Plant const& plant_;
  MujocoArm arm_;
  Eigen::VectorXd q_, half_, at_, mean_, a_;
};

}  // namespace

ArmRun run_loop(Plant const& plant, ArmMotion const& wanted, int steps_a_tick) {
  auto const n = plant.arm.joints();
  auto const ticks = wanted.q.cols(), rows = ticks / log_every;
  ArmRun run;
  for (auto* kept : {&run.reference, &run.q, &run.v, &run.a, &run.seen, &run.applied, &run.averaged})
    kept->resize(n, rows);
  JointControllers controllers(plant, wanted);
  // an arm whose zero is off stands elsewhere than its controllers believe, from the beginning
  Eigen::VectorXd begin = wanted.q.col(0);
  if (plant.law && plant.law->kind == LawKind::joint_zero) begin[plant.law->joint] -= plant.law->size;
  MovingArm arm(plant, begin, wanted.v.col(0));
  Eigen::VectorXd before;
  for (int tick = 0; tick < ticks; ++tick) {
    Eigen::VectorXd const seen = controllers.seen(arm.q()), torque = controllers.torque(tick, seen);
    for (int k = 0; k < steps_a_tick; ++k) {
      arm.step(torque, control_s / steps_a_tick);
      if (k > 0 || tick % log_every != 0) continue;
      auto const row = tick / log_every;
      run.reference.col(row) = wanted.q.col(tick);
      run.q.col(row) = arm.at();
      run.v.col(row) = arm.v();
      run.a.col(row) = arm.a();
      run.seen.col(row) = seen;
      run.applied.col(row) = torque;
      run.averaged.col(row) = tick == 0 ? torque : Eigen::VectorXd(0.5 * (before + torque));
    }
    before = torque;
  }
  return run;
}

}  // namespace concealed_arms
