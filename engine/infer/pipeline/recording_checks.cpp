#include "engine/infer/pipeline/recording_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/data/levels.hpp"

namespace torquescope {

std::optional<Hopeless> check_recording(Excitation const& facts) {
  auto const insufficient = [](std::string finding, std::string way_out) {
    return Hopeless{Verdict::insufficient, std::move(finding), std::move(way_out)};
  };
  auto const fault = [](std::string finding, std::string way_out) {
    return Hopeless{Verdict::data_fault, std::move(finding), std::move(way_out)};
  };
  double const range = facts.position_most - facts.position_least;
  if (!(facts.moving_share > 0.0)) return insufficient("the joint never moves", "record a motion");
  if (facts.encoder_step > 0.0 && range < levels::fewest_encoder_steps * facts.encoder_step)
    return insufficient(fmt::format("the whole motion spans {:.0f} encoder steps: its speed is mostly rounding",
                                    range / facts.encoder_step),
                        "record a larger motion");
  if (facts.torque_updates > 0.0 && facts.torque_updates < levels::fewest_updates_in_period)
    return fault(
        fmt::format("the torque changes on one row in {} only, {:.2g} times in a period of the filter's cut-off",
                    facts.torque_held_rows, facts.torque_updates),
        fmt::format("log the torque as often as the position, or set filter.parallel_cutoff_hz to {:.2g} times what it "
                    "is, or less",
                    facts.torque_updates / levels::fewest_updates_in_period));
  return std::nullopt;
}

std::optional<Hopeless> check_silence(Excitation const& facts) {
  if (facts.one_speed_share < levels::mostly_one_speed) return std::nullopt;
  return Hopeless{
      Verdict::insufficient,
      fmt::format("{:.0f} % of the moving time have one and the same speed: nothing else is missing, but effects of "
                  "the velocity cannot be told from viscous and Coulomb friction",
                  100.0 * facts.one_speed_share),
      "record at least four speeds in both directions"};
}

std::optional<Hopeless> check_sign(ProcessedRecord const& record) {
  double const work = record.motion.torque.dot(record.motion.dq);
  if (record.held.empty() || work >= 0.0) return std::nullopt;
  return Hopeless{Verdict::data_fault,
                  "the torque takes work out of the joint, and the fitted " + record.held + " is negative",
                  "the torque column may have the wrong sign: check recording.columns and torque_per_unit"};
}

}  // namespace torquescope
