#include "engine/infer/pipeline/motion_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

bool remembers_reversals(Effect const& effect) {
  auto const& axes = effect.signature();
  return std::any_of(axes.begin(), axes.end(), [](SignatureAxis axis) {
    return axis == SignatureAxis::since_velocity_reversal || axis == SignatureAxis::since_torque_reversal;
  });
}

}  // namespace

MotionLimits limits_of(Excitation const& facts, double relerr) {
  MotionLimits limits;
  limits.has_one_direction = std::max(facts.forward_share, 1.0 - facts.forward_share) > levels::one_direction;
  limits.has_one_speed = facts.speed_spread < levels::one_speed_ratio();
  limits.is_saturated = facts.torque_limit_share > levels::rows_at_limit;
  limits.has_no_relation = relerr > levels::no_relation;
  return limits;
}

std::optional<Hopeless> place_is_time(MotionLimits const& limits, Excitation const& facts, JointKind joint) {
  constexpr double turn = 2.0 * std::numbers::pi;
  bool const comes_again = joint == JointKind::revolute && facts.position_most - facts.position_least > turn;
  if (!limits.has_one_direction || !limits.has_one_speed || comes_again) return std::nullopt;
  return Hopeless{Verdict::insufficient,
                  "the joint goes one way at one speed and comes to no place twice: what depends on the place, on time "
                  "or on the start of the motion cannot be told apart",
                  "record both directions over the same positions, at several speeds"};
}

bool moves_both_ways(Eigen::Ref<Eigen::VectorXd const> const& velocity) {
  constexpr double fifth = 0.2;
  Eigen::Index const n = velocity.size(), forward = (velocity.array() > 0.0).count();
  return static_cast<double>(std::min(forward, n - forward)) >= fifth * static_cast<double>(n);
}

bool closes(MotionLimits const& limits, Effect const& effect) {
  auto const& families = effect.families();
  bool const is_of_velocity = std::find(families.begin(), families.end(), EffectFamily::velocity_law) != families.end();
  bool const needs_reversals =
      effect.family() == EffectFamily::reversal && remembers_reversals(effect) && !is_of_velocity;
  if (limits.has_one_direction && needs_reversals) return true;
  return limits.has_one_speed && is_of_velocity;
}

std::string closed_sentences(MotionLimits const& limits, Excitation const& facts) {
  std::string text;
  auto const add = [&](std::string const& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (limits.has_one_direction)
    add("Only one direction of motion was recorded: Coulomb friction and offset are one number, and nothing is known "
        "of "
        "effects that need reversals.");
  if (limits.has_one_speed) add("Only one speed was recorded: nothing is known of effects of the velocity.");
  if (limits.is_saturated)
    add(fmt::format("The torque sits at its limit {:.0f} % of the time; those rows are left out.",
                    100.0 * facts.torque_limit_share));
  return text;
}

std::optional<Hopeless> blamed_for_silence(MotionLimits const& limits, Excitation const& facts, double relerr) {
  if (limits.has_no_relation)
    return Hopeless{
        Verdict::data_fault,
        fmt::format("the model explains almost nothing of the torque (relative error {:.0f} %), and no known effect "
                    "explains what is left",
                    100.0 * relerr),
        "check recording.columns and torque_per_unit: the column may hold another signal or another joint"};
  if (limits.has_one_direction)
    return Hopeless{Verdict::insufficient,
                    "only one direction of motion was recorded: viscous, Coulomb friction and offset cannot be "
                    "separated, and effects that need reversals cannot be seen",
                    "record both directions over the same positions"};
  if (limits.has_one_speed)
    return Hopeless{Verdict::insufficient, "only one speed was recorded: effects of the velocity cannot be told apart",
                    "record at least four speeds in both directions"};
  if (limits.is_saturated)
    return Hopeless{
        Verdict::insufficient,
        fmt::format("the torque sits at its limit {:.0f} % of the time: nothing is missing on the other rows",
                    100.0 * facts.torque_limit_share),
        "widen the range of the torque channel, or record a gentler motion"};
  return check_silence(facts);
}

std::vector<bool> saturated_samples(Recording const& recording, double cutoff_hz) {
  Eigen::VectorXd const& torque = recording.torque;
  Eigen::Index const n = torque.size();
  std::vector<bool> left_out(static_cast<std::size_t>(n), false);
  double const share = recording.rows.torque_limit_share > 0.0
                           ? recording.rows.torque_limit_share
                           : limit_share({torque.data(), static_cast<std::size_t>(n)});
  if (!(share > levels::rows_at_limit)) return left_out;
  double const most = torque.maxCoeff(), least = torque.minCoeff();
  auto const reach =
      cutoff_hz > 0.0 ? static_cast<Eigen::Index>(std::ceil(levels::independent_after_s(cutoff_hz) * recording.rate_hz))
                      : 0;
  Eigen::Index beyond = 0;  // of the last sample that is marked
  for (Eigen::Index k = 0; k < n; ++k) {
    if (torque[k] != most && torque[k] != least) continue;
    Eigen::Index const end = std::min(n, k + reach + 1);
    for (Eigen::Index i = std::max({Eigen::Index{0}, k - reach, beyond}); i < end; ++i)
      left_out[static_cast<std::size_t>(i)] = true;
    beyond = end;
  }
  return left_out;
}

Hopeless noise_hides(double share) {
  return {Verdict::insufficient,
          fmt::format("noise hides whatever is missing below {:.0f} % of the torque", 100.0 * share),
          "record a longer motion with fewer reversals, or set filter.parallel_cutoff_hz and filter.cutoff_hz lower"};
}

}  // namespace torquescope
