#include "sticking/recording.hpp"

#include <algorithm>
#include <cmath>

namespace sticking {
namespace {

constexpr double least_level = 0.05;  // of dry friction, share of the joint's

class Controller {
 public:
  Controller(Control design, double reference, double seen, double holding)
      : design_(design), reference_(reference), seen_(seen), sum_(design.cascade ? holding : 0.0) {}

  double tick(double reference, double seen) {
    double const tick_s = 1.0 / design_.rate_hz;
    double const keep = std::exp(-turn * design_.speed_filter_hz * tick_s);
    speed_ = keep * speed_ + (1.0 - keep) * (seen - seen_) * design_.rate_hz;
    double const wanted_speed = (reference - reference_) * design_.rate_hz;
    reference_ = reference, seen_ = seen;
    double const error = reference - seen;
    if (!design_.cascade) return design_.position_gain * error + design_.speed_gain * (wanted_speed - speed_);
    double const speed_error = design_.position_gain * error + wanted_speed - speed_;
    sum_ += design_.integral_gain * tick_s * speed_error;
    return design_.speed_gain * speed_error + sum_;
  }

 private:
  Control design_;
  double reference_, seen_, sum_;
  double speed_ = 0.0;
};

class Encoder {
 public:
  explicit Encoder(Reading const& by) : step_(by.encoder_step()), phase_(by.encoder_phase) {}
  double read(double q) const { return step_ * std::floor(q / step_ + phase_); }

 private:
  double step_, phase_;
};

// where the joint rests under its controller before the recording begins
double resting_place(Rig const& rig, double reference) {
  if (rig.control.cascade) return reference;
  double q = reference;
  for (int round = 0; round < 200; ++round) {
    double const wanted = reference - (rig.joint.weight(q) + rig.joint.offset) / rig.control.position_gain;
    q += 0.3 * (wanted - q);
  }
  return q;
}

class Plant {
 public:
  Plant(Rig const& rig, HiddenEffect const* effect, double q)
      : rig_(rig),
        effect_(effect),
        friction_(rig.sticking, {rig.joint.inertia, rig.joint.viscous}, rig.joint.dry(), step_s) {
    now_.q = q;
    given_ = rig.joint.weight(q) + rig.joint.offset;
    arriving_ = -std::expm1(-step_s / rig.reading.lag_s);
  }
  Moment const& now() const { return now_; }
  double given() const { return given_; }

  void step(double command, Mean& sum) {
    Joint const& joint = rig_.joint;
    given_ += arriving_ * (command - given_);
    now_.weight = joint.weight(now_.q);
    double const torque = effect_ && effect_->torque ? effect_->torque(now_) : 0.0;
    double const dry = effect_ && effect_->dry ? effect_->dry(now_) : 0.0;
    double const lost = effect_ && effect_->lost ? effect_->lost(now_, given_) : 0.0;
    double const amplitude = effect_ ? effect_->amplitude : 0.0;
    double const least = least_level * joint.dry();
    double const forward = std::max(least, joint.dry_forward + amplitude * dry);
    double const backward = std::max(least, joint.dry_backward + amplitude * dry);

    double const push = given_ - now_.weight - joint.offset - amplitude * (torque + lost);
    double const before = now_.v;
    now_.v = friction_.step(before, push, forward, backward);
    double const taken = friction_.torque();
    double const level = taken > 0.0 ? forward : backward;
    double const place = now_.q;
    now_.q += 0.5 * step_s * (before + now_.v);
    now_.t += step_s;

    double const speed = 0.5 * (before + now_.v);
    sum.acceleration += (now_.v - before) / step_s;
    sum.speed += speed;
    sum.sliding += taken / level;
    sum.sine += std::sin(place), sum.cosine += std::cos(place);
    sum.given += given_;
    sum.effect += torque + lost + dry * taken / level;
    sum.lag += command - given_;
    sum.sticking += taken - (speed > 0.0 ? forward : speed < 0.0 ? -backward : 0.0);
  }

 private:
  Rig const& rig_;
  HiddenEffect const* effect_;
  DryFriction friction_;
  Moment now_;
  double given_ = 0.0, arriving_ = 0.0;
};

Mean over(Mean const& sum, double n) {
  return {sum.acceleration / n, sum.speed / n,  sum.sliding / n, sum.sine / n,    sum.cosine / n,
          sum.given / n,        sum.effect / n, sum.lag / n,     sum.sticking / n};
}

double tracking_error(std::vector<Row> const& rows) {
  double mean = 0.0, spread = 0.0, error = 0.0;
  for (Row const& row : rows) mean += row.reference / static_cast<double>(rows.size());
  for (Row const& row : rows) {
    spread += (row.reference - mean) * (row.reference - mean);
    error += (row.reference - row.position) * (row.reference - row.position);
  }
  return std::sqrt(error / spread);
}

double chatter(std::vector<Row> const& rows) {
  double changes = 0.0, all = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    changes += (rows[i].torque - rows[i - 1].torque) * (rows[i].torque - rows[i - 1].torque);
    all += rows[i].torque * rows[i].torque;
  }
  return std::sqrt(changes / all);
}

}  // namespace

Recording record(Rig const& rig, std::vector<double> const& reference, HiddenEffect const* effect) {
  auto const steps_per = [](double rate_hz) { return static_cast<std::size_t>(std::lround(1.0 / (rate_hz * step_s))); };
  std::size_t const tick = steps_per(rig.control.rate_hz), period = steps_per(rig.reading.log_hz);
  std::size_t const steps = reference.size() * tick;
  auto const late = static_cast<std::size_t>(std::lround((effect ? effect->delay_s : 0.0) / step_s));

  Encoder const encoder{rig.reading};
  Plant plant{rig, effect, resting_place(rig, reference[0])};
  Controller controller{rig.control, reference[0], encoder.read(plant.now().q), plant.given()};
  Recording found;
  found.channel.reserve(steps);
  Mean sum;
  double command = plant.given();
  for (std::size_t i = 0; i < steps; ++i) {
    double const before = plant.given();
    double const seen = encoder.read(plant.now().q);
    if (i % tick == 0) command = controller.tick(reference[i / tick], seen);
    found.channel.push_back(rig.reading.commanded ? command : before);
    if (i % period == 0) {
      if (i > 0) found.means.push_back(over(sum, static_cast<double>(period)));
      sum = {};
      found.rows.push_back({reference[i / tick], seen, found.channel[i < late ? 0 : i - late]});
    }
    plant.step(command, sum);
  }
  found.means.push_back(over(sum, static_cast<double>(period)));
  found.tracking_error = tracking_error(found.rows);
  found.chatter = chatter(found.rows);
  return found;
}

}  // namespace sticking
