#include "engine/workflows/servo_words.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "engine/base/quantity_text.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {

std::string word(ServoNote note) {
  switch (note) {
    case ServoNote::one_load:
      return "one_load";
    case ServoNote::no_scale:
      return "no_scale";
    case ServoNote::no_validation:
      return "no_validation";
    case ServoNote::no_gain:
      return "no_gain";
    case ServoNote::always_on:
      return "always_on";
    case ServoNote::other_gain:
      return "other_gain";
    case ServoNote::few_recordings:
      break;
  }
  return "few_recordings";
}

std::string sentence_of(ServoRemark const& remark) {
  switch (remark.note) {
    case ServoNote::one_load:
      return "All recordings have one load: friction that grows with the load shows over the angle alone, if at all. "
             "Record the same motions with another mass.";
    case ServoNote::no_scale:
      return "No load is known: every torque is in units of the command, and only ratios are told. A known mass "
             "([known] gravity_moment) fixes the scale.";
    case ServoNote::no_validation:
      return "No recording has role = \"validate\": effects are judged on the recordings that they were fitted to.";
    case ServoNote::no_gain:
      return "No [known] command_gain: the command is the error of the position itself, and no limit of the drive is "
             "known.";
    case ServoNote::always_on:
      return "The drive is never off: viscous friction and back-EMF are one number, and only their sum is told.";
    case ServoNote::other_gain:
      return fmt::format(
          "The recorded command (columns.torque) is {:.3g} times what [known] command_gain makes of the error: one of "
          "the two is in another unit, or the gain is not what the drive has.",
          remark.number);
    case ServoNote::few_recordings:
      break;
  }
  return "One recording of training: effects of load, gain and motion cannot be told apart in it.";
}

std::string name_of_number(LoopNumber const& number) {
  return number.name.starts_with("loop_") ? number.name.substr(5) : number.name;
}

namespace {

std::string named(KeptMove const& move) {
  std::string title =
      move.subject.is_of_command() ? drive_effect_of(move.subject.key).title : move.subject.effect->title();
  // within a sentence; Stribeck was a man
  if (!title.starts_with("Stribeck")) title.front() = static_cast<char>(std::tolower(title.front()));
  if (move.numbers.empty()) return title;
  LoopNumber const& number = move.numbers.front();
  std::string const unit = number.unit == "1" ? "" : " " + number.unit;
  return fmt::format("{} {:.4g}{}", title, number.value, unit);
}

}  // namespace

std::string headline(ServoReport const& report) {
  std::string names;
  for (auto const& move : report.decision.facts.kept) names += (names.empty() ? "" : "; ") + named(move);
  switch (report.verdict) {
    case Verdict::none:
      return "nothing is missing: the recordings differ from their simulation no more than replicates of it do";
    case Verdict::named:
    case Verdict::one_of_class:
      return "explained by " + names;
    case Verdict::partly:
      return "partly explained by " + names;
    case Verdict::unexplained:
      return "unexplained: the simulation misses the recordings, and no effect of drive or gear mends it";
    default:
      break;
  }
  return report.decision.facts.reason == LoopReason::diverges
             ? "insufficient: the job's model runs away; check the gains, units and signs of [known] and [recording]"
             : "insufficient: the simulation says no more of the motion than its mean; check [known], units and signs";
}

}  // namespace torquescope
