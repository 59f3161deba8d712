#pragma once
// A joint in its loop, by itself and as textbooks write it: what rollouts are held against. No code of the engine.
//
// Motion     many steps a tick by the midpoint rule; dry friction is set-valued: where the velocity meets zero the step
//            is cut there, and what is left begins with the question whether friction holds
// Delays     by time stamps: what was asked at stamps up to now - delay. A held reference steps at its samples
// Controller answers every hold ticks: named forms; backward differences; integral by the backward rule, which stops
//            where it would push further into a limit
// Units      SI

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace torquescope::test {

struct PlainJoint {
  double inertia = 0.05, viscous = 0.15, gravity_sin = 0.0, gravity_cos = 0.0;
  double forward = 0.0, backward = 0.0, offset = 0.0;
  std::function<double(double time_s, double q)> smooth{};  // torque it needs beside
  std::function<double(double speed)> sliding{};            // friction beside, of a size of speed
};

struct PlainController {
  std::string form = "pd";
  double kp = 0.0, ki = 0.0, kd = 0.0, kv = 0.0;
  double feed_speed = 0.0, feed_acceleration = 0.0, added_gain = 1.0;
  double limit = std::numeric_limits<double>::infinity();
  double speed_lag_s = 0.0, back_emf = 0.0;
  double command_delay_s = 0.0, torque_delay_s = 0.0, torque_lag_s = 0.0, log_lag_s = 0.0;
  int hold = 1, span = 1;  // span 0: it sees the joint's own speed
};

// channels by sample; absent ones are empty
struct PlainInputs {
  double rate_hz = 500.0;
  int ticks_per_sample = 1;
  bool straight = false;
  std::vector<double> reference{}, added{}, outside{}, enabled{};
};

struct PlainStart {
  double position = 0.0, velocity = 0.0, torque = 0.0;
};

struct PlainMotion {
  std::vector<double> position, velocity, torque;
};

class PlainLoop {
 public:
  PlainLoop(PlainJoint joint, PlainController controller, PlainInputs inputs, PlainStart const& start,
            int steps_per_tick = 200, double encoder_step = 0.0)
      : joint_(std::move(joint)),
        c_(std::move(controller)),
        in_(std::move(inputs)),
        start_(start),
        steps_(steps_per_tick),
        encoder_step_(encoder_step) {
    tick_s_ = 1.0 / (in_.rate_hz * in_.ticks_per_sample);
    q_ = start.position;
    v_ = start.velocity;
    speed_ = start.velocity;
    lagged_ = logged_ = command_ = start.torque;
    last_goal_ = goal_at(0.0);
    bool const sums = c_.form == "pi" || c_.form == "pid" || c_.form == "p_pi";
    if (sums) integral_ = start.torque - stiffness() * (last_goal_ - q_) + damping() * v_;
  }

  PlainMotion run() {
    PlainMotion motion;
    auto const samples = static_cast<int>(in_.reference.size());
    for (int tick = 0; tick < samples * in_.ticks_per_sample; ++tick) {
      double const position = shown(q_), velocity = v_;
      answer(tick);
      if (tick % in_.ticks_per_sample == 0) {
        motion.position.push_back(position);
        motion.velocity.push_back(velocity);
        motion.torque.push_back(logged_);
      }
      move(tick);
    }
    return motion;
  }

 private:
  double shown(double q) const { return encoder_step_ > 0.0 ? encoder_step_ * std::round(q / encoder_step_) : q; }

  // gains on the error and the speed, whatever the form calls them
  double stiffness() const { return c_.form == "p_pi" ? c_.kv * c_.kp : c_.kp; }
  double damping() const { return c_.form == "pid" ? c_.kd : c_.form == "p_pi" ? c_.kv : 0.0; }

  static double channel(std::vector<double> const& values, int sample, double absent) {
    return values.empty() ? absent : values[static_cast<std::size_t>(sample)];
  }

  double goal_at(double time_s) const {
    double const seen_s = time_s - c_.command_delay_s;
    auto const last = static_cast<double>(in_.reference.size() - 1);
    double const sample = std::min(std::max(seen_s * in_.rate_hz, 0.0), last);
    auto const before = static_cast<std::size_t>(sample + 1e-9);
    double const from = in_.reference[before];
    if (!in_.straight || before + 1 >= in_.reference.size()) return from;
    return from + (sample - static_cast<double>(before)) * (in_.reference[before + 1] - from);
  }

  double seen_speed(double read, double period_s) {
    double speed = v_;
    if (c_.span > 0) {
      auto const answers = static_cast<int>(reads_.size());
      double const old = answers >= c_.span ? reads_[static_cast<std::size_t>(answers - c_.span)]
                                            : start_.position - start_.velocity * period_s * (c_.span - answers);
      speed = (read - old) / (c_.span * period_s);
      reads_.push_back(read);
    }
    if (c_.speed_lag_s <= 0.0) return speed_ = speed;
    return speed_ = speed + (speed_ - speed) * std::exp(-period_s / c_.speed_lag_s);
  }

  double limited(double u) const { return std::min(std::max(u, -c_.limit), c_.limit); }

  double with_integral(double rest, double growth) {
    double const u = rest + integral_ + growth;
    bool const pushes = (u > c_.limit && growth > 0.0) || (u < -c_.limit && growth < 0.0);
    if (!pushes) integral_ += growth;
    return limited(rest + integral_);
  }

  void answer(int tick) {
    int const sample = tick / in_.ticks_per_sample;
    if (tick % c_.hold == 0) {
      double const period_s = tick_s_ * c_.hold, goal = goal_at(tick * tick_s_), read = shown(q_), e = goal - read;
      double const v = seen_speed(read, period_s);
      double const goal_speed = (goal - last_goal_) / period_s;
      double const goal_acceleration = (goal_speed - last_goal_speed_) / period_s;
      last_goal_ = goal;
      last_goal_speed_ = goal_speed;
      double const wanted = c_.feed_speed * goal_speed;
      double const beside = c_.feed_acceleration * goal_acceleration + c_.added_gain * channel(in_.added, sample, 0.0);
      if (c_.form == "p") command_ = limited(c_.kp * e + beside);
      if (c_.form == "pd") command_ = limited(c_.kp * e + c_.kd * (wanted - v) + beside);
      double const on = channel(in_.enabled, sample, 1.0);
      if (c_.form == "pi") command_ = with_integral(c_.kp * e + beside, c_.ki * e * period_s * on);
      if (c_.form == "pid")
        command_ = with_integral(c_.kp * e + c_.kd * (wanted - v) + beside, c_.ki * e * period_s * on);
      double const slip = c_.kp * e + wanted - v;
      if (c_.form == "p_velocity") command_ = limited(c_.kv * slip + beside);
      if (c_.form == "p_pi") command_ = with_integral(c_.kv * slip + beside, c_.ki * slip * period_s * on);
    }
    double const sent = command_ * channel(in_.enabled, sample, 1.0);
    sent_.push_back(sent);
    logged_ = c_.log_lag_s > 0.0 ? sent + (logged_ - sent) * std::exp(-tick_s_ / c_.log_lag_s) : sent;
  }

  // of the motor at an instant, before its lag
  double sent_at(double time_s) const {
    double const tick = std::floor((time_s - c_.torque_delay_s) / tick_s_);
    return tick < 0.0 ? start_.torque : sent_[static_cast<std::size_t>(tick)];
  }

  double weight(double time_s, double q) const {
    double const own = joint_.gravity_sin * std::sin(q) + joint_.gravity_cos * std::cos(q) + joint_.offset;
    return own + (joint_.smooth ? joint_.smooth(time_s, q) : 0.0);
  }

  // of sliding forwards (1) or backwards (-1)
  double friction(double way, double speed) const {
    double const beside = joint_.sliding ? joint_.sliding(std::abs(speed)) : 0.0;
    return (way > 0.0 ? joint_.forward : joint_.backward) + way * beside;
  }

  void move(int tick) {
    int const sample = tick / in_.ticks_per_sample;
    double const h = tick_s_ / steps_, outside = channel(in_.outside, sample, 0.0);
    double const on = channel(in_.enabled, sample, 1.0), brake = on * c_.back_emf;
    for (int step = 0; step < steps_; ++step) {
      double const time_s = (tick + (step + 0.5) / steps_) * tick_s_;
      double acts = on * sent_at(time_s);
      lagged_ *= on;  // a motor that is off gives nothing, whatever was on its way
      if (c_.torque_lag_s > 0.0) {
        double const left = std::exp(-h / c_.torque_lag_s), before = lagged_;
        lagged_ = acts + (lagged_ - acts) * left;
        acts += (before - lagged_) * c_.torque_lag_s / h;  // mean of an exponential
      }
      slide(time_s, acts + outside, joint_.viscous + brake, h);
    }
  }

  void slide(double time_s, double acts, double viscous, double h) {
    for (int part = 0; part < 3 && h > 0.0; ++part) {
      double way = v_ > 0.0 ? 1.0 : v_ < 0.0 ? -1.0 : 0.0;
      if (way == 0.0) {
        double const free = acts - weight(time_s, q_);
        way = free > friction(1.0, 0.0) ? 1.0 : free < friction(-1.0, 0.0) ? -1.0 : 0.0;
        if (way == 0.0) return;
      }
      auto const acceleration = [&](double q, double v) {
        return (acts - weight(time_s, q) - friction(way, v) - viscous * v) / joint_.inertia;
      };
      double const a = acceleration(q_, v_);
      double const q_half = q_ + 0.5 * h * v_, v_half = v_ + 0.5 * h * a;
      double const next = v_ + h * acceleration(q_half, v_half);
      if (next * way >= 0.0) {
        q_ += 0.5 * h * (v_ + next);
        v_ = next;
        return;
      }
      double const slides = h * v_ / (v_ - next);
      q_ += 0.5 * slides * v_;
      v_ = 0.0;
      h -= slides;
    }
  }

  PlainJoint joint_;
  PlainController c_;
  PlainInputs in_;
  PlainStart start_;
  int steps_;
  double encoder_step_, tick_s_ = 0.0;
  double q_ = 0.0, v_ = 0.0, speed_ = 0.0, integral_ = 0.0, command_ = 0.0, lagged_ = 0.0, logged_ = 0.0;
  double last_goal_ = 0.0, last_goal_speed_ = 0.0;
  std::vector<double> reads_{}, sent_{};
};

}  // namespace torquescope::test
