#include "engine/account/sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/account/error_words.hpp"
#include "engine/account/name_list.hpp"
#include "engine/account/part_explained.hpp"
#include "engine/base/quantity_text.hpp"
#include "engine/effects/effect.hpp"

namespace torquescope {

namespace {

// a file is called as it is called: "train.csv: ..."
bool begins_with_a_file(std::string const& text) {
  std::string const first = text.substr(0, text.find(' '));
  std::size_t const at = first.find_first_of("./\\");
  return at != std::string::npos && at + 1 < first.size();
}

std::string capital(std::string text) {
  if (begins_with_a_file(text)) return text;
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

// one sentence of a clause: capital, full stop
std::string sentence(std::string const& clause) {
  std::string const text = capital(clause);
  return text.empty() || text.ends_with('.') ? text : text + ".";
}

std::string lower_case(std::string text) {
  for (char& letter : text)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return text;
}

// the linear parameters: those the effect's size is proportional to; all of them when the catalogue lacks the effect
std::vector<ParameterEstimate> linear_parameters(NamedEffect const& effect) {
  Effect const* known = find_effect(effect.name);
  std::size_t const count = known ? std::min(known->n_linear(), effect.parameters.size()) : effect.parameters.size();
  return {effect.parameters.begin(), effect.parameters.begin() + static_cast<std::ptrdiff_t>(count)};
}

// "0.35 N m" where one parameter is the torque and the rows have shown it; "up to 0.21 N m" otherwise
std::string amount(JointDiagnosis const& joint, NamedEffect const& effect) {
  auto const linear = linear_parameters(effect);
  bool const known_size = std::isfinite(effect.peak) && effect.peak > 0.0;
  if (linear.size() == 1 && linear[0].unit == joint.unit_torque) {
    double const size = std::abs(linear[0].value);
    // a size that no row came near is extrapolation, not a finding
    if (!known_size || size <= 1.25 * effect.peak) return quantity_text(size, joint.unit_torque);
  }
  return known_size ? "up to " + quantity_text(effect.peak, joint.unit_torque) : "torque";
}

// "Stribeck friction"; "friction that builds up over a distance after a reversal"
std::string short_title(NamedEffect const& effect) {
  std::string const title = effect.title.substr(0, effect.title.find_first_of(":,"));
  return title.empty() ? in_words(effect.name) : title;
}

// who loses or needs what; without place
std::string joint_clause(JointDiagnosis const& joint, NamedEffect const& effect) {
  Effect const* known = find_effect(effect.name);
  std::string const size = amount(joint, effect);
  bool const opposes_motion = known && known->parity() == Parity::odd;
  if (!opposes_motion) return fmt::format("{} deviates by {} from the model", which_joint(joint), size);
  auto const linear = linear_parameters(effect);
  bool const adds = std::all_of(linear.begin(), linear.end(), [](auto const& one) { return one.value >= 0.0; });
  bool const takes = std::all_of(linear.begin(), linear.end(), [](auto const& one) { return one.value <= 0.0; });
  if (adds) return fmt::format("{} loses {} extra", which_joint(joint), size);
  if (takes) return fmt::format("{} loses {} less", which_joint(joint), size);
  return fmt::format("the friction of {} differs by {}", which_joint(joint), size);
}

MapCell range_of(JointDiagnosis const& joint, SignatureAxis axis) {
  for (auto const& row : joint.map)
    if (row.axis == word(axis) && !row.cells.empty()) return {row.cells.front().from, row.cells.back().to};
  return {};
}

// what a creeping parameter comes to over the recording: a multiple of its value; 0 of one that does not creep
double creep_of(JointDiagnosis const& joint, EffectParameter const& parameter) {
  MapCell const time = range_of(joint, SignatureAxis::time), speed = range_of(joint, SignatureAxis::velocity);
  RelativeTo const to = parameter.lower.to;
  if (to == RelativeTo::torque_per_duration || to == RelativeTo::coulomb_per_duration) return time.to - time.from;
  if (to == RelativeTo::viscous_per_duration) return (time.to - time.from) * std::max(-speed.from, speed.to);
  return 0.0;
}

// "from 14.7 s on": of an effect that begins at an instant and stays. "" where it has another shape beside the instant
// (a push ends), or creeps by more than it steps
std::string onset_phrase(JointDiagnosis const& joint, NamedEffect const& effect) {
  Effect const* known = find_effect(effect.name);
  MapCell const time = range_of(joint, SignatureAxis::time);
  if (!known || known->parameters().size() != effect.parameters.size() || !(time.to > time.from)) return "";
  double onset = unknown, step = 0.0, creep = 0.0;
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    EffectParameter const& parameter = known->parameters()[i];
    double const value = effect.parameters[i].value, over_all = creep_of(joint, parameter);
    if (parameter.is_instant())
      onset = value;
    else if (parameter.is_shape)
      return "";
    else
      (over_all > 0.0 ? creep : step) += std::abs(value) * (over_all > 0.0 ? over_all : 1.0);
  }
  return std::isfinite(onset) && step > creep ? fmt::format("from {:.3g} s on", onset) : "";
}

// whole clause with its place
std::string finding_clause(JointDiagnosis const& joint, NamedEffect const& effect) {
  std::string const onset = onset_phrase(joint, effect);
  std::string const where = onset.empty() ? place_phrase(joint, effect.places) : onset;
  std::string const at = where.empty() ? "" : " " + where;
  std::string const fault = is_fault(effect) ? ", a fault of the recording" : "";
  auto const linear = linear_parameters(effect);
  if (effect.acts_on == word(ActsOn::recorded_torque)) {
    // a channel that is wrong by a time is wrong everywhere
    if (!linear.empty() && linear[0].unit == "s") {
      std::string const time = quantity_text(std::abs(linear[0].value), "s");
      if (linear[0].value >= 0.0)
        return fmt::format("the torque of {} comes {} after the motion{}", which_joint(joint), time, fault);
      // no cause comes after what it does: the motion is told late, or the torque too early
      return fmt::format(
          "the torque of {} comes {} before the motion, because the position channel is late or because a row "
          "holds a command that the drive follows late (actuator lag)",
          which_joint(joint), time);
    }
    return fmt::format("the torque{} of {} is off by {}{}{}", fault.empty() ? "" : " channel", which_joint(joint),
                       amount(joint, effect), at, fault);
  }
  if (effect.acts_on == word(ActsOn::recorded_position))
    return fmt::format("the position of {} is misread{}, as if {} were missing{}", which_joint(joint), at,
                       amount(joint, effect), fault);
  return joint_clause(joint, effect) + at;
}

// "Stribeck friction (p < 0.005; presliding cannot be excluded)"
std::string name_clause(JointDiagnosis const& joint, NamedEffect const& effect, bool one_of_class) {
  std::string const p = p_text(effect.p, least_p(joint.replicates));
  if (one_of_class && !effect.equivalent.empty()) {
    std::vector<std::string> names{effect.name};
    names.insert(names.end(), effect.equivalent.begin(), effect.equivalent.end());
    return fmt::format("{} ({}; this motion cannot tell which)", name_list(names, "or"), p);
  }
  std::string const title = short_title(effect);
  // a title without the name would leave nobody the wiser which effect of the catalogue is meant
  bool const says_name = lower_case(title).find(in_words(effect.name)) != std::string::npos;
  std::string brackets = (says_name ? "" : in_words(effect.name) + ", ") + p;
  if (!effect.equivalent.empty())
    brackets += fmt::format("; {} cannot be excluded", name_list(effect.equivalent, "or"));
  return fmt::format("{} ({})", title, brackets);
}

// of what acts between command and motor: its number, for no torque shows it
std::string command_clause(JointDiagnosis const& joint, NamedEffect const& effect, bool one_of_class) {
  std::string text = "between command and motor: " + name_clause(joint, effect, one_of_class);
  for (auto const& number : effect.parameters) text += ", " + quantity_text(number.value, number.unit);
  return text;
}

// what the simulation from the commands gains, where it decided; "" elsewhere
std::string simulated_sentence(JointDiagnosis const& joint) {
  if (!joint.decision || !joint.decision->loop.decides || joint.decision->loop.kept.empty()) return "";
  auto const& loop = joint.decision->loop;
  bool const predicts = std::isfinite(loop.base_validation.position);
  double const before = predicts ? loop.base_validation.position : loop.base_train.position;
  double const after = predicts ? loop.final_validation.position : loop.final_train.position;
  std::string const fitted =
      loop.fitted_share < 1.0
          ? fmt::format(" Its numbers are fitted to {} of the training samples.", percent_text(loop.fitted_share))
          : "";
  return fmt::format(
      "Simulated from its commands, the {} position is off by {} instead of {} of its motion, over all "
      "samples.{}",
      predicts ? "validation" : "training", percent_text(after), percent_text(before), fitted);
}

std::string effect_clauses(JointDiagnosis const& joint, NamedEffect const& effect, bool one_of_class) {
  if (effect.family == "command") return sentence(command_clause(joint, effect, one_of_class));
  return sentence(finding_clause(joint, effect) + ": " + name_clause(joint, effect, one_of_class));
}

constexpr std::size_t effects_told = 2;           // as sentences of their own
constexpr double unexplained_worth_a_word = 0.1;  // of the baseline residual's energy

void append(std::string& text, std::string const& more) {
  if (!more.empty()) text += (text.empty() ? "" : " ") + more;
}

// what is missing, and what naming it brings
std::string names_and_gain(JointDiagnosis const& joint, bool one_of_class) {
  std::string text;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < joint.effects.size(); ++i) {
    if (i < effects_told)
      append(text, effect_clauses(joint, joint.effects[i], one_of_class));
    else
      others.push_back(joint.effects[i].name);
  }
  if (!others.empty()) append(text, fmt::format("Also named: {}.", name_list(others, "and")));
  append(text, gain_sentence(joint));
  append(text, simulated_sentence(joint));
  return text;
}

std::string named_reason(JointDiagnosis const& joint, bool one_of_class) {
  std::string text = names_and_gain(joint, one_of_class);
  if (joint.budget.unexplained > unexplained_worth_a_word)
    append(text, fmt::format("{} of the mismatch's energy stays unexplained.", percent_text(joint.budget.unexplained)));
  return text;
}

std::string none_reason(JointDiagnosis const& joint) {
  std::string text = likeness_sentence(joint);
  append(text, joint.power_sentence);
  return text;
}

std::string unexplained_reason(JointDiagnosis const& joint) {
  auto const tested = n_tested(joint);
  std::string const nothing_fits =
      tested > 0 ? fmt::format("none of {} known effects fits it", tested) : std::string("no known effect fits it");
  std::string text = joint.other_joints;
  if (!text.empty()) return text;
  if (joint.unexplained.empty()) {
    text = unlikeness_sentence(joint, nothing_fits);
  } else {
    UnexplainedPart const& part = joint.unexplained.front();
    std::string const where = place_phrase(joint, part.where);
    text = fmt::format("{} of the residual of {} lies{}, more than simulated replicates have there, but {}.",
                       percent_text(part.energy_share), which_joint(joint), where.empty() ? "" : " " + where,
                       nothing_fits);
  }
  // what could be named all the same
  for (auto const& effect : joint.effects) append(text, effect_clauses(joint, effect, false));
  if (!joint.effects.empty()) append(text, gain_sentence(joint));
  return text;
}

std::string recording_reason(Diagnosis const& diagnosis) {
  std::string text = sentence(diagnosis.finding);
  for (auto const& joint : diagnosis.joints) {
    if (text.empty())
      for (auto const& effect : joint.effects)
        if (effect.acts_on != word(ActsOn::joint)) append(text, effect_clauses(joint, effect, false));
    if (diagnosis.verdict != Verdict::insufficient) continue;
    for (auto const& advice : joint.excitation)
      if (advice.would_separate.size() > 1)
        append(text, sentence(name_list(advice.would_separate, "and") + " cannot be told apart"));
  }
  for (auto const& joint : diagnosis.joints) {
    append(text, joint.timing_sentence);
    append(text, validation_is_other_sentence(joint));
  }
  append(text, sentence(diagnosis.way_out));
  return text;
}

std::string joint_reason(Verdict verdict, JointDiagnosis const& joint) {
  switch (verdict) {
    case Verdict::named:
      return named_reason(joint, false);
    case Verdict::one_of_class:
      return named_reason(joint, true);
    case Verdict::partly:
      return sentence(part_explained_clause(joint)) + " " + names_and_gain(joint, false);
    case Verdict::none:
      return none_reason(joint);
    case Verdict::unexplained:
      return unexplained_reason(joint);
    case Verdict::insufficient:
    case Verdict::data_fault:
      break;
  }
  return {};
}

}  // namespace

std::string effect_sentence(JointDiagnosis const& joint, NamedEffect const& effect) {
  return effect_clauses(joint, effect, false);
}

std::string reason_sentence(Diagnosis const& diagnosis) {
  if (diagnosis.verdict == Verdict::insufficient || diagnosis.verdict == Verdict::data_fault)
    return recording_reason(diagnosis);
  std::string text;
  for (auto const& joint : diagnosis.joints) {
    append(text, joint_reason(diagnosis.verdict, joint));
    append(text, joint.timing_sentence);
    append(text, validation_is_other_sentence(joint));
  }
  return text;
}

std::string whole_reason(Diagnosis const& diagnosis) {
  std::string text = reason_sentence(diagnosis);
  JointDiagnosis const& joint = diagnosis.joints.front();
  if (diagnosis.finding.empty())
    for (auto const& remark : joint.remarks) text += " " + remark;
  return text;
}

}  // namespace torquescope
