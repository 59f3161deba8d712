#include "engine/infer/decision/servo_decision.hpp"

#include <algorithm>
#include <cmath>

#include "engine/infer/decision/loop_moves.hpp"
#include "engine/infer/decision/servo_start.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// sizes of the joint that bounds and steps of a fit are measured by
JointScales scales_of(ServoStart const& start, DriveScales const& recorded, std::vector<RolloutTrack> const& tracks) {
  JointScales scales;
  double lowest = tracks.front().position[0], highest = lowest;
  for (auto const& track : tracks) {
    lowest = std::min(lowest, track.position.minCoeff());
    highest = std::max(highest, track.position.maxCoeff());
    scales.duration_s = std::max(scales.duration_s, static_cast<double>(track.position.size()) / track.rate_hz);
    scales.gravity_sin = std::max(scales.gravity_sin, track.known.gravity_moment);
    scales.inertia = std::max(scales.inertia, track.known.inertia);
  }
  scales.rate_hz = 1.0 / recorded.sample_s;
  scales.peak_speed = recorded.speed;
  scales.position_range = highest - lowest;
  scales.position_centre = 0.5 * (highest + lowest);
  scales.encoder_step = recorded.encoder_step;
  scales.torque_rms = start.motor_gain * recorded.command;
  scales.torque_peak = scales.torque_highest = scales.torque_lowest = 3.0 * scales.torque_rms;
  return scales;
}

bool fits_weight(Regressor const& regressor) {
  auto const& terms = regressor.terms();
  return std::any_of(terms.begin(), terms.end(), [](auto* one) { return one->name() == "gravity"; });
}

void free_key(LoopSetting& loop, LoopKey key, double value) {
  if (std::find(loop.free.begin(), loop.free.end(), key) != loop.free.end()) return;
  if (loop.values[key] != facts_of(key).none) return;  // the job gives it
  loop.free.push_back(key);
  loop.values[key] = value;
}

LoopSetting loop_of(ServoQuestion const& question, ServoStart const& start) {
  LoopSetting loop = question.loop;
  loop.steps_by_ticks = true;
  if (start.fixes_scale) free_key(loop, LoopKey::motor_gain, start.motor_gain);
  bool const brakes = question.command == DriveCommand::voltage;
  if (brakes) free_key(loop, LoopKey::back_emf, 0.5 * start.damping);
  return loop;
}

// What least squares says is bent: friction by delays, inertia by the encoder, and a motor's gain comes out too small
// because its command follows errors (Fuller 1987, Measurement Error Models, doi:10.1002/9780470316665)
std::vector<LoopPoint> starts_of(LoopQuestion const& question, Regressor const& regressor) {
  std::vector<LoopPoint> starts{base_point(question)};
  auto const& free = question.loop.free;
  bool const has_gain = std::find(free.begin(), free.end(), LoopKey::motor_gain) != free.end();
  std::vector<double> const gains = has_gain ? std::vector<double>{1.0, 3.0} : std::vector<double>{1.0};
  constexpr double sides[] = {0.2, 1.0, 5.0};
  for (std::size_t i = 0; i < 9 * gains.size(); ++i) {
    double const inertia = sides[i % 3], friction = sides[i / 3 % 3], gain = gains[i / 9];
    LoopPoint other = base_point(question);
    if (has_gain) other.loop.values[LoopKey::motor_gain] *= gain;
    Index at = 0;
    for (auto const* term : regressor.terms()) {
      if (term->name() == "inertia") other.terms[at] *= inertia;
      if (term->name() == "coulomb") other.terms[at] *= friction;
      at += static_cast<Index>(term->n_linear());
    }
    starts.push_back(std::move(other));
  }
  return starts;
}

LoopQuestion asked_of(ServoQuestion const& question, Eigen::VectorXd const& terms, LoopSetting const& loop,
                      JointScales const& scales) {
  LoopQuestion asked{question.regressor,
                     terms,
                     scales,
                     loop,
                     question.training,
                     question.training,
                     question.validation,
                     {true, false},
                     {},
                     question.most_effects};
  asked.numbers = question.numbers;
  asked.seed = question.seed;
  asked.threads = question.threads;
  asked.fits_starts = false;
  asked.progress = question.progress;
  return asked;
}

}  // namespace

RolloutModel ServoDecision::model(ServoQuestion const& question, LoopFit const& fit) const {
  return {question.regressor, fit.point.terms, scales, fit.point.effects, fit.point.loop};
}

ServoBase servo_base(ServoQuestion const& question) {
  ServoStart const start = servo_start(question.regressor, question.loop, question.training);
  ServoBase base{start.terms, loop_of(question, start), {}, {}, start.fixes_scale};
  base.recorded = drive_scales(question.training, numbers_of(base.loop.form, base.loop.values));
  base.scales = scales_of(start, base.recorded, question.training);
  return base;
}

ServoDecision decide_servo(ServoQuestion const& question) {
  ServoBase const base = servo_base(question);
  ServoDecision decision;
  decision.fixes_scale = base.fixes_scale;
  decision.recorded = base.recorded;
  decision.scales = base.scales;
  LoopQuestion asked = asked_of(question, base.terms, base.loop, decision.scales);
  asked.moves = drive_moves(base.loop, question.training, question.effects.of_drive, fits_weight(question.regressor));
  for (Effect const* effect : question.effects.of_joint)
    asked.moves.push_back(effect_move(*effect, {}, decision.scales));
  LoopClimb climb = climb_ladder(asked, starts_of(asked, question.regressor));
  decision.facts = std::move(climb.facts);
  decision.base = std::move(climb.base);
  decision.final = std::move(climb.final);
  return decision;
}

std::vector<LoopNumber> numbers_of_fit(ServoQuestion const& question, ServoDecision const& decision,
                                       LoopFit const& fit) {
  RolloutModel const model = decision.model(question, fit);
  std::vector<LoopNumber> numbers;
  for (std::size_t k = 0; k < model.size(); ++k) {
    auto const& one = model.parameters()[k];
    auto const at = static_cast<Index>(k);
    numbers.push_back({one.name, one.unit, fit.fit.parameters[at], fit.fit.lower[at], fit.fit.upper[at]});
  }
  return numbers;
}

LoopFit refitted(ServoQuestion const& question, ServoDecision const& decision, LoopFit const& structure) {
  ServoStart const start = servo_start(question.regressor, question.loop, question.training);
  LoopQuestion const asked = asked_of(question, start.terms, structure.point.loop, decision.scales);
  return fitted(asked, structure.point, LoopSearch::to_its_end, question.threads);
}

}  // namespace torquescope
