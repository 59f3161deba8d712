#include "engine/account/arm_sentences.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "engine/account/all_sample_errors.hpp"
#include "engine/account/name_list.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {
namespace {

// in the order in which people want to hear of them
constexpr std::array told{Verdict::named,      Verdict::one_of_class, Verdict::partly, Verdict::unexplained,
                          Verdict::data_fault, Verdict::insufficient, Verdict::none};

char const* clause_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
    case Verdict::one_of_class:
      return "named at";
    case Verdict::partly:
      return "partly explained at";
    case Verdict::unexplained:
      return "unexplained at";
    case Verdict::data_fault:
      return "a fault of the data at";
    case Verdict::insufficient:
      return "the recordings cannot tell at";
    case Verdict::none:
      break;
  }
  return "nothing missing at";
}

// "joint 2 (load dependent friction or spring)"
std::string with_names(JointDiagnosis const& joint) {
  std::vector<std::string> names;
  for (auto const& effect : joint.effects) {
    std::vector<std::string> alike{in_words(effect.name)};
    for (auto const& other : effect.equivalent) alike.push_back(in_words(other));
    names.push_back(name_list(alike, "or"));
  }
  return which_joint(joint) + (names.empty() ? "" : fmt::format(" ({})", fmt::join(names, "; ")));
}

// "joint 1 and joint 2 (spring)", "joints 1, 3 and 4"
std::string joints_clause(std::vector<JointDiagnosis> const& joints, Verdict verdict) {
  std::vector<std::string> who, numbers;
  for (auto const& joint : joints) {
    if (joint.verdict != verdict) continue;
    who.push_back(with_names(joint));
    if (joint.effects.empty() && joint.name.empty()) numbers.push_back(std::to_string(joint.joint));
  }
  if (who.empty()) return {};
  bool const are_numbers = who.size() > 1 && numbers.size() == who.size();
  return std::string(clause_of(verdict)) + " " +
         (are_numbers ? "joints " + name_list(numbers, "and") : name_list(who, "and"));
}

}  // namespace

namespace {

// "4 s to 9 s of monday.csv", "from 4 s of monday.csv on", "up to 9 s of monday.csv"; "" of all of it
std::string when_text(std::string const& recording, double from_s, double until_s) {
  bool const has_begin = std::isfinite(from_s), has_end = std::isfinite(until_s);
  if (has_begin && has_end) return fmt::format("{} of {}", between_text(from_s, until_s, "s"), recording);
  if (has_begin) return fmt::format("from {} of {} on", quantity_text(from_s, "s"), recording);
  if (has_end) return fmt::format("up to {} of {}", quantity_text(until_s, "s"), recording);
  return "";
}

}  // namespace

std::string whole_arm_sentence(NamedEffect const& effect, WholeArmFacts const& facts) {
  std::vector<std::string> values, alike{effect.title};
  for (auto const& one : effect.parameters) {
    double const half = 0.5 * (one.upper - one.lower);
    std::string const spread = std::isfinite(half) ? " +- " + quantity_text(half, one.unit) : "";
    if (one.unit != "s") values.push_back(fmt::format("{} {}{}", one.name, quantity_text(one.value, one.unit), spread));
  }
  for (auto const& other : effect.equivalent) alike.push_back(in_words(other));
  std::string when = when_text(facts.recording, facts.from_s, facts.until_s);
  when += when.empty() ? "all joints feel " : " all joints feel ";
  when.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(when.front())));
  std::string text = fmt::format("{}{} ({}): on held-out rows the error over all joints falls from {} to {}", when,
                                 name_list(alike, "or"), fmt::join(values, ", "), percent_text(facts.before),
                                 percent_text(facts.after));
  if (facts.validation_before > 0.0)
    text += fmt::format(", validation from {} to {}", percent_text(facts.validation_before),
                        percent_text(facts.validation_after));
  std::vector<std::string> there;
  for (auto const& one : facts.validation) {
    std::string const own = when_text(one.recording, one.from_s, one.until_s);
    there.push_back(own.empty() ? "in all of " + one.recording : own);
  }
  if (!there.empty()) text += fmt::format(" ({})", name_list(there, "and"));
  return text + ".";
}

std::string several_recordings_sentence(std::vector<std::string> const& recordings) {
  return fmt::format("Parameters are fitted to {} together.", name_list(recordings, "and"));
}

std::string refitted_clause(std::string const& effect) { return effect + " fitted to all of its rows"; }

std::string explained_by_arm_sentence(std::string const& effect, double share) {
  return fmt::format("The {} of the whole arm explains {} of this joint's mismatch; of what is left:", in_words(effect),
                     percent_text(share));
}

std::string own_masses_sentence(double own_relerr, double shared_relerr) {
  return fmt::format(
      "The masses that the rows of this joint tell are not those of the other joints: its error is {} with its own, "
      "and "
      "{} with those that all share.",
      percent_text(own_relerr), percent_text(shared_relerr));
}

std::string arm_reason_sentence(Diagnosis const& diagnosis) {
  std::string text;
  for (Verdict const verdict : told) {
    std::string const clause = joints_clause(diagnosis.joints, verdict);
    if (!clause.empty()) text += (text.empty() ? "" : "; ") + clause;
  }
  if (!text.empty())
    text = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front()))) + text.substr(1) + ".";
  if (diagnosis.arm)
    for (auto const& effect : diagnosis.arm->effects) text += (text.empty() ? "" : " ") + effect.sentence;
  ArmError const whole = validation_error_of_arm(diagnosis.joints);
  if (!whole.is_known()) return text;
  text += fmt::format(" Validation error over all joints and samples {}", percent_text(whole.before));
  if (names_physics(diagnosis.verdict)) text += fmt::format(" to {}", percent_text(whole.after));
  return text + ".";
}

}  // namespace torquescope
