#include "engine/account/verdict_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/account/all_sample_errors.hpp"
#include "engine/account/error_words.hpp"
#include "engine/account/name_list.hpp"
#include "engine/account/sentences.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {
namespace {

// cos(7 q) has seven waves in a turn of the joint
bool counts_waves(ParameterEstimate const& one) { return one.unit == "1/rad" && one.name.ends_with("order"); }

// "0.11 N m [0.10, 0.12]", "3.8 ms [3.1, 4.4]", "7 a turn"; no interval that the digits do not show
std::string number_of(ParameterEstimate const& one) {
  constexpr double short_s = 0.1, thousand = 1e3;
  bool const is_short = one.unit == "s" && std::abs(one.value) < short_s;
  double const scale = is_short ? thousand : 1.0;
  std::string unit = one.unit.empty() || one.unit == "1" ? "" : is_short ? " ms" : " " + one.unit;
  if (counts_waves(one)) unit = " a turn";
  std::string const value = two_digits(scale * one.value);
  if (!std::isfinite(one.lower) || !std::isfinite(one.upper)) return value + unit;
  std::string const lower = two_digits(scale * one.lower), upper = two_digits(scale * one.upper);
  return value + unit + (lower == value && upper == value ? "" : fmt::format(" [{}, {}]", lower, upper));
}

// of a number beside the first: "speed" of stribeck_speed; none says itself in "7 a turn"
std::string short_name(NamedEffect const& effect, ParameterEstimate const& one) {
  if (counts_waves(one)) return "";
  std::string const lead = effect.name + "_";
  return in_words(one.name.starts_with(lead) ? one.name.substr(lead.size()) : one.name) + " ";
}

// "Stribeck friction" of "Stribeck friction: falls with speed just above rest"; where the title is a sentence, the name
std::string title_of(NamedEffect const& effect) {
  constexpr std::ptrdiff_t most_spaces = 2;
  std::string const title = effect.title.substr(0, effect.title.find_first_of(":,"));
  bool const is_short = !title.empty() && std::count(title.begin(), title.end(), ' ') <= most_spaces;
  return is_short ? title : in_words(effect.name);
}

// of a cosine and its sine, the amplitude: which of them is large is a matter of where the zero lies
ParameterEstimate amplitude_of(ParameterEstimate const& one, ParameterEstimate const& other, std::string name) {
  auto const part = [](ParameterEstimate const& of) { return of.value * 0.5 * (of.upper - of.lower); };
  // no hypot: that of glibc 2.35 keeps the tarball from older systems
  auto const length = [](double a, double b) { return std::sqrt(a * a + b * b); };
  double const amplitude = length(one.value, other.value);
  double const width = amplitude > 0.0 ? length(part(one), part(other)) / amplitude : 0.0;
  return {std::move(name), one.unit, amplitude, width > amplitude ? 0.0 : amplitude - width, amplitude + width};
}

// "gravity" of gravity_sin beside gravity_cos; "" of others
std::string wave_name(ParameterEstimate const& one, ParameterEstimate const& other) {
  constexpr std::size_t ending = std::string_view("_sin").size();
  for (auto const& [first, second] : {std::pair{"_sin", "_cos"}, std::pair{"_cos", "_sin"}}) {
    std::string stem = one.name.substr(0, one.name.size() - std::min(one.name.size(), ending));
    if (one.name == stem + first && other.name == stem + second) return stem;
  }
  return "";
}

// its parameters, a cosine and its sine as one
std::vector<ParameterEstimate> told_parameters(NamedEffect const& effect) {
  std::vector<ParameterEstimate> parameters;
  for (ParameterEstimate const& one : effect.parameters) {
    std::string name = parameters.empty() ? "" : wave_name(parameters.back(), one);
    if (name.empty())
      parameters.push_back(one);
    else
      parameters.back() = amplitude_of(parameters.back(), one, std::move(name));
  }
  return parameters;
}

constexpr std::size_t three = 3;

// its name and its first numbers, the first without a name of its own
std::string with_numbers(NamedEffect const& effect, std::size_t most) {
  std::string text = title_of(effect);
  std::size_t told_numbers = 0;
  auto const parameters = told_parameters(effect);
  for (ParameterEstimate const& one : parameters) {
    bool const is_first = told_numbers == 0;
    // a second one of the same unit is another component of the same size
    if (told_numbers == most || (!is_first && one.unit == parameters.front().unit)) continue;
    text += is_first ? " " + number_of(one) : fmt::format(", {}{}", short_name(effect, one), number_of(one));
    ++told_numbers;
  }
  return text;
}

// strongest first, three at most
std::string class_of(NamedEffect const& effect, std::size_t most_numbers = three) {
  constexpr std::size_t most = 2;  // beside the first
  std::string text = with_numbers(effect, most_numbers);
  for (std::size_t k = 0; k < std::min(most, effect.equivalent.size()); ++k)
    text += " or " + in_words(effect.equivalent[k]);
  if (effect.equivalent.size() > most) text += fmt::format(" or {} more", effect.equivalent.size() - most);
  return text;
}

// with how many numbers each of some effects is told: one line holds a few
std::size_t numbers_each(std::size_t effects) { return effects < three ? three + 1 - effects : 1; }

// three effects at most. Equal p are printed once
std::string named_text(JointDiagnosis const& joint, std::size_t most_numbers) {
  auto const& effects = joint.effects;
  std::size_t const shown = std::min(three, effects.size());
  std::string text;
  for (std::size_t k = 0; k < shown; ++k) {
    auto const p_of = [&](NamedEffect const& one) { return p_text(one.p, least_p(joint.replicates)); };
    bool const is_last = k + 1 == shown;
    text += (text.empty() ? "" : "; ") + class_of(effects[k], most_numbers);
    if (is_last || p_of(effects[k]) != p_of(effects[k + 1])) text += ", " + p_of(effects[k]);
  }
  if (effects.size() > shown) text += fmt::format("; and {} more", effects.size() - shown);
  return text;
}

std::string without_full_stop(std::string text) {
  while (text.ends_with('.')) text.pop_back();
  return text;
}

std::string likeness_text(JointDiagnosis const& joint) {
  if (joint.replicates == 0) return "the model explains the recording";
  std::string const p = p_text(joint.omnibus_p, least_p(joint.replicates));
  if (!is_unlike_replicates(joint))
    return fmt::format("the residual is like that of {} simulated replicates ({})", joint.replicates, p);
  return fmt::format("the residual differs from that of {} simulated replicates ({}) by too little for a name",
                     joint.replicates, p);
}

std::string none_text(JointDiagnosis const& joint) {
  std::string text = likeness_text(joint);
  if (!joint.power_sentence.empty()) text += ". " + without_full_stop(joint.power_sentence);
  return text;
}

std::string unexplained_text(JointDiagnosis const& joint) {
  auto const tested = std::count_if(joint.candidates.begin(), joint.candidates.end(),
                                    [](Candidate const& one) { return one.decision != Decision::not_tested; });
  std::string text;
  if (!joint.unexplained.empty()) {
    UnexplainedPart const& part = joint.unexplained.front();
    text =
        fmt::format("{} of the residual lies {}, ", percent_text(part.energy_share), place_phrase(joint, part.where));
  }
  return text + (tested > 0 ? fmt::format("and none of {} effects explains it", tested) : "and no effect explains it");
}

std::string what_of(Diagnosis const& diagnosis, JointDiagnosis const& joint, Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return none_text(joint);
    case Verdict::named:
    case Verdict::one_of_class:
      return named_text(joint, numbers_each(joint.effects.size()));
    case Verdict::partly: {
      std::string const share = share_text(joint.explained_share);
      if (joint.effects.empty())
        return (share.empty() ? "" : share + " of the mismatch by an effect of the whole arm; of what is left, ") +
               unexplained_text(joint);
      return (share.empty() ? "" : share + " of the mismatch by ") + named_text(joint, 1);
    }
    case Verdict::unexplained:
      return unexplained_text(joint);
    case Verdict::insufficient:
    case Verdict::data_fault:
      break;
  }
  bool const is_of_arm = diagnosis.joints.size() > 1;
  if (is_of_arm && !joint.reason.empty()) return without_full_stop(joint.reason);
  std::string finding = without_full_stop(diagnosis.finding);
  if (!finding.empty()) return finding;
  // a channel that is at fault is named like physics
  return joint.effects.empty() ? without_full_stop(diagnosis.reason) : named_text(joint, three);
}

// "at joint 2 and joint 3", of an arm without an effect of the whole
std::string where_missing(std::vector<JointDiagnosis> const& joints) {
  std::vector<std::string> names;
  for (auto const& joint : joints)
    if (joint.verdict != Verdict::none) names.push_back(which_joint(joint));
  return names.empty() ? "at any joint" : "at " + name_list(names, "and");
}

// "load dependent friction", "unexplained"
std::string short_answer(JointDiagnosis const& joint) {
  std::vector<std::string> titles;
  for (auto const& effect : joint.effects) titles.push_back(title_of(effect));
  return titles.empty() ? in_words(word(joint.verdict)) : name_list(titles, "and");
}

// "joint 2: load dependent friction; joint 3: unexplained", three joints at most
std::string joints_with_answers(std::vector<JointDiagnosis> const& joints) {
  std::vector<JointDiagnosis const*> open;
  for (auto const& joint : joints)
    if (joint.verdict != Verdict::none) open.push_back(&joint);
  std::string text;
  for (std::size_t k = 0; k < std::min(three, open.size()); ++k)
    text += fmt::format("{}{}: {}", k == 0 ? "" : "; ", which_joint(*open[k]), short_answer(*open[k]));
  if (open.size() > three) text += fmt::format("; {} more joints", open.size() - three);
  return open.empty() ? "no joint lacks anything" : text;
}

std::string both_text(ErrorPair const& training, ErrorPair const& validation) {
  std::string text;
  if (training.is_known()) text += "training " + training.text();
  if (validation.is_known()) text += (text.empty() ? "" : ", ") + ("validation " + validation.text());
  return text;
}

}  // namespace

VerdictLines verdict_lines(Diagnosis const& diagnosis, JointDiagnosis const& joint, Verdict verdict) {
  VerdictLines lines{what_of(diagnosis, joint, verdict), {}, {}};
  std::string const all = both_text(training_error(joint), validation_error(joint));
  if (!all.empty()) lines.errors = "error, all samples: " + all;
  bool const is_of_arm = diagnosis.joints.size() > 1;
  if (!is_of_arm && !diagnosis.way_out.empty()) lines.remarks.push_back(diagnosis.way_out);
  std::string const of_validation =
      joint.nuisances.empty() ? "" : fmt::format("in validation: {}", fmt::join(joint.nuisances, "; "));
  for (auto const& sentence : {of_validation, joint.timing_sentence, validation_is_other_sentence(joint)})
    if (!sentence.empty()) lines.remarks.push_back(sentence);
  return lines;
}

VerdictLines arm_lines(Diagnosis const& diagnosis) {
  VerdictLines lines;
  if (diagnosis.arm)
    for (auto const& effect : diagnosis.arm->effects) lines.what += (lines.what.empty() ? "" : "; ") + class_of(effect);
  if (lines.what.empty()) lines.what = where_missing(diagnosis.joints);
  ArmError const whole = validation_error_of_arm(diagnosis.joints);
  if (whole.is_known())
    lines.errors = fmt::format("error, {}: validation {}",
                               whole.is_mean_of_joints ? "all samples, mean of the joints" : "all joints and samples",
                               whole.text());
  return lines;
}

std::string headline_of(Diagnosis const& diagnosis) {
  if (diagnosis.joints.empty()) return without_full_stop(diagnosis.reason);
  bool const has_effects = diagnosis.arm && !diagnosis.arm->effects.empty();
  if (diagnosis.joints.size() > 1)
    return has_effects ? arm_lines(diagnosis).what : joints_with_answers(diagnosis.joints);
  return what_of(diagnosis, diagnosis.joints.front(), diagnosis.verdict);
}

}  // namespace torquescope
