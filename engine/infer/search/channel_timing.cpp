#include "engine/infer/search/channel_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/infer/pipeline/drive_torque.hpp"
#include "engine/infer/search/late_torque.hpp"

namespace torquescope {

namespace {

constexpr double certain_q = 0.05;
constexpr double clear_z = 4.0;  // one direction, not searched for: far beyond chance

CandidateColumns columns_of(ModelStage const& stage) {
  return {*stage.pipeline, stage.comparison, stage.reference(), stage.parameters()};
}

// Of the recording as it came: by what was named first, or by what would have been if it explained more of it. Of that
// recording alone, as a delay's is: what a scan gains counts others, too
double first_gain(Selection const& selection) {
  double most = 0.0;
  for (std::size_t i = 0; i < selection.first_scan.size(); ++i) {
    EffectScan const& one = selection.first_scan[i];
    if (!one.is_testable) continue;
    if (!selection.accepted.empty() && one.effect == selection.accepted.front().effect)
      return selection.first_cv_gain[i];
    if (selection.first_q[i] <= certain_q) most = std::max(most, selection.first_cv_gain[i]);
  }
  return most;
}

// what an effect explained of the recording alone when it was accepted, in the unit of that step
double own_gain(AcceptedEffect const& one) { return one.gain > 0.0 ? one.scan.gain * one.cv_gain / one.gain : 0.0; }

}  // namespace

bool is_timing(LateTorque const& found, double already_s, double rate_hz) {
  constexpr double one_sided = 1.64, surely_not_half = 0.1;
  double const doubt = one_sided * std::abs(found.late_s) / std::max(one_sided, found.z) * rate_hz;
  double const rows = (already_s + found.late_s) * rate_hz;
  double const from_half = std::abs(rows - 0.5 * std::round(2.0 * rows));
  if (rows < 0.0 && from_half > std::max(surely_not_half, doubt)) return false;
  return std::abs(rows) - doubt <= longest_timing;
}

std::optional<double> delay_within_a_sample(Selection const& selection, bool is_unexplained, double already_s,
                                            double rate_hz) {
  static Effect const* const delay = find_effect("delay");
  if (!selection.is_gate_open) return std::nullopt;
  auto const& effects = selection.final->model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].effect != delay) continue;
    LateTorque const found{selection.final->model().effect_parameters(i, selection.final->parameters()).front(),
                           selection.accepted[i].scan.z};
    if (is_timing(found, already_s, rate_hz)) return found.late_s;
  }
  // asked before the physics that was named beside others
  for (auto const& one : selection.accepted)
    if (one.instead && one.instead->z >= clear_z && one.instead->gain >= nearly_as_good * own_gain(one) &&
        is_timing(*one.instead, already_s, rate_hz))
      return one.instead->late_s;
  ModelStage const& plain = *selection.baseline;
  auto const instead = late_torque(plain, columns_of(plain), rate_hz);
  if (!instead || instead->z < clear_z) return std::nullopt;
  if (!is_unexplained && instead->gain < nearly_as_good * first_gain(selection)) return std::nullopt;
  return is_timing(*instead, already_s, rate_hz) ? std::optional(instead->late_s) : std::nullopt;
}

namespace {

constexpr Eigen::Index half_width = 8;  // samples

// weights of the samples floor - half_width + 1 ... floor + half_width for the place `share` behind floor
Eigen::VectorXd sinc_weights(double share) {
  auto const sinc = [](double x) { return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
  Eigen::VectorXd weights(2 * half_width);
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    double const x = static_cast<double>(j - half_width + 1) - share;
    double const window = std::cos(0.5 * std::numbers::pi * x / static_cast<double>(half_width));
    weights[j] = std::abs(x) < half_width ? sinc(x) * window * window : 0.0;
  }
  return weights / weights.sum();
}

}  // namespace

Recording with_torque_earlier(Recording recording, double late_s) {
  double const samples = late_s * recording.rate_hz;
  // what was taken out of the channel was read with it
  Eigen::VectorXd const taken_out = torque_taken_out(recording);
  Eigen::VectorXd const read = recording.torque + taken_out, weights = sinc_weights(samples - std::floor(samples));
  Eigen::Index const last = read.size() - 1;
  auto const first = static_cast<Eigen::Index>(std::floor(samples)) - half_width + 1;
  for (Eigen::Index k = 0; k <= last; ++k) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < weights.size(); ++j)
      sum += weights[j] * read[std::clamp<Eigen::Index>(k + first + j, 0, last)];
    recording.torque[k] = sum - taken_out[k];
  }
  return recording;
}

bool loses_the_law(RecordedLoop const& as_read, Recording const& in_time) {
  constexpr double twice = 2.0;
  if (!as_read.controller || in_time.reference.size() != in_time.position.size()) return false;
  RecordedLoop const own = recorded_loop(in_time, {}, {});
  return std::pow(own.controller->noise.std, 2) > twice * std::pow(as_read.controller->noise.std, 2);
}

std::string timing_remark(double late_s, double rate_hz) {
  if (late_s == 0.0) return "";
  return fmt::format(
      "torque taken {:.2g} ms {} than its rows say, {:.2g} of a sample: it was read there, as drives do that are "
      "faster than their log",
      1e3 * std::abs(late_s), late_s > 0.0 ? "earlier" : "later", std::abs(late_s) * rate_hz);
}

std::string timing_sentence(double late_s, double rate_hz) {
  if (late_s == 0.0) return "";
  bool const is_late = late_s > 0.0;
  return fmt::format(
      "The torque comes {:.2g} ms {} its rows, {:.2g} of a sample, as it does where drive and log are not in step. "
      "It was shifted back; {} recording.delay_s by as much to keep that. Only where drive and log are read together "
      "is "
      "it a lag.",
      1e3 * std::abs(late_s), is_late ? "after" : "before", std::abs(late_s) * rate_hz, is_late ? "lower" : "raise");
}

}  // namespace torquescope
