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

// The arm's state: positions, and speeds half a step before them; of links, and then of the drive of an elastic joint
class MovingArm {
 public:
  MovingArm(Plant const& plant, Eigen::VectorXd const& q, Eigen::VectorXd const& v)
      : plant_(plant), arm_(plant.arm, plant.gravity), q_(q), half_(v) {
    if (elastic()) {
      // the drive where its controller wants it, and the link where its weight hangs
      int const j = plant.law->joint;
      arm_.update(q, Eigen::VectorXd::Zero(q.size()));
      q_ = with_drive(q, q[j]);
      q_[j] -= plant.law->size * arm_.bias()[j];
      half_ = with_drive(v, v[j]);
    }
    mean_ = half_;
    at_ = q_;
    a_ = Eigen::VectorXd::Zero(q_.size());
  }

  void step(Eigen::VectorXd const& torque, double h) {
    Eigen::VectorXd const now = half_ + 0.5 * h * a_;  // speed at the position's instant
    arm_.update(links(q_), links(now));
    Dynamics of = dynamics(now, torque);
    if (plant_.law) add_law(*plant_.law, now, of);
    // M (w' - w) / h + viscous (w + w') / 2 + needed + friction = torque
    Eigen::MatrixXd left = of.mass / h;
    Eigen::VectorXd const right = left * half_ - 0.5 * of.viscous.cwiseProduct(half_) + of.torque - of.needed;
    left.diagonal() += 0.5 * of.viscous;
    Eigen::VectorXd const after = speeds_against_dry_friction(left, right, of.level, half_);
    at_ = q_;
    mean_ = 0.5 * (half_ + after);
    a_ = (after - half_) / h;
    half_ = after;
    q_ += h * half_;
  }

  // at the drives, where not said otherwise
  Eigen::VectorXd q() const { return drives(q_); }
  // of the last step: where it began, and speed and acceleration there
  Eigen::VectorXd at() const { return drives(at_); }
  Eigen::VectorXd links_at() const { return links(at_); }
  Eigen::VectorXd links_v() const { return links(mean_); }
  Eigen::VectorXd v() const { return drives(mean_); }
  Eigen::VectorXd a() const { return drives(a_); }

 private:
  struct Dynamics {
    Eigen::MatrixXd mass;
    Eigen::VectorXd viscous, level, needed, torque;
  };

  bool elastic() const { return plant_.law && plant_.law->kind == LawKind::elastic_joint; }
  Eigen::VectorXd links(Eigen::VectorXd const& all) const { return all.head(plant_.arm.joints()); }
  Eigen::VectorXd drives(Eigen::VectorXd const& all) const {
    Eigen::VectorXd at = links(all);
    if (elastic()) at[plant_.law->joint] = all[plant_.arm.joints()];
    return at;
  }
  static Eigen::VectorXd with_drive(Eigen::VectorXd const& of_links, double drive) {
    Eigen::VectorXd all(of_links.size() + 1);
    all << of_links, drive;
    return all;
  }

  Dynamics dynamics(Eigen::VectorXd const& now, Eigen::VectorXd const& torque) const {
    int const n = plant_.arm.joints();
    Dynamics of{arm_.mass(), Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), torque};
    for (int j = 0; j < n; ++j) {
      Link const& link = plant_.arm.links[static_cast<std::size_t>(j)];
      of.viscous[j] = link.viscous;
      of.level[j] = link.coulomb;
      of.needed[j] = arm_.bias()[j] + link.offset_torque;
    }
    if (elastic()) part_drive(now, of);
    return of;
  }

  // an elastic joint: torque, drive and friction leave the link for the drive, and a spring joins both
  void part_drive(Eigen::VectorXd const& now, Dynamics& of) const {
    int const n = plant_.arm.joints(), j = plant_.law->joint;
    Link const& link = plant_.arm.links[static_cast<std::size_t>(j)];
    double const stiffness = 1.0 / plant_.law->size;
    double const damping = 2.0 * plant_.law->shape * std::sqrt(stiffness * plant_.law->second);
    double const spring = stiffness * (q_[n] - q_[j]) + damping * (now[n] - now[j]);
    of.mass.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 1, n + 1));
    of.mass(j, j) -= link.drive_inertia;
    of.mass(n, n) = link.drive_inertia;
    of.viscous = with_drive(of.viscous, of.viscous[j]);
    of.level = with_drive(of.level, of.level[j]);
    of.needed = with_drive(of.needed, link.offset_torque + spring);
    of.torque = with_drive(of.torque, of.torque[j]);
    of.needed[j] -= link.offset_torque + spring;
    of.viscous[j] = of.level[j] = of.torque[j] = 0.0;
  }

  void add_law(Law const& law, Eigen::VectorXd const& v, Dynamics& of) const {
    int const j = law.joint, beside = law.neighbour(plant_.arm.joints());
    // what passes the gear: the arm's torque without the drive's own inertia
    double const drive = plant_.arm.links[static_cast<std::size_t>(j)].drive_inertia;
    Instant const now{.q = q_[j],
                      .v = v[j],
                      .load = arm_.mass().row(j).dot(links(a_)) - drive * a_[j] + arm_.bias()[j],
                      .neighbour_speed = beside >= 0 ? v[beside] : 0.0};
    of.level[j] = std::max(0.0, of.level[j] + law.dry(now));
    of.needed[j] += law.smooth(now);
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
  for (auto* kept :
       {&run.reference, &run.q, &run.v, &run.a, &run.links_q, &run.links_v, &run.seen, &run.applied, &run.averaged})
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
      run.links_q.col(row) = arm.links_at();
      run.links_v.col(row) = arm.links_v();
      run.seen.col(row) = seen;
      run.applied.col(row) = torque;
      run.averaged.col(row) = tick == 0 ? torque : Eigen::VectorXd(0.5 * (before + torque));
    }
    before = torque;
  }
  return run;
}

}  // namespace concealed_arms
