#include "engine/words/verdict_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/quantity_text.hpp"
#include "engine/words/name_list.hpp"
#include "engine/words/sentences.hpp"

namespace torquescope {
namespace {

// "0.11 N m [0.10, 0.12]", "3.8 ms [3.1, 4.4]"
std::string number_of(ParameterEstimate const& one) {
  constexpr double short_s = 0.1, thousand = 1e3;
  bool const is_short = one.unit == "s" && std::abs(one.value) < short_s;
  double const scale = is_short ? thousand : 1.0;
  std::string const unit = one.unit.empty() || one.unit == "1" ? "" : is_short ? " ms" : " " + one.unit;
  std::string text = two_digits(scale * one.value) + unit;
  if (std::isfinite(one.lower) && std::isfinite(one.upper))
    text += fmt::format(" [{}, {}]", two_digits(scale * one.lower), two_digits(scale * one.upper));
  return text;
}

// "Stribeck friction" of "Stribeck friction: falls with speed just above rest"; where the title is a sentence, the name
std::string title_of(NamedEffect const& effect) {
  constexpr std::ptrdiff_t most_spaces = 2;
  std::string const title = effect.title.substr(0, effect.title.find_first_of(":,"));
  bool const is_short = !title.empty() && std::count(title.begin(), title.end(), ' ') <= most_spaces;
  return is_short ? title : in_words(effect.name);
}

// its name and its first numbers, the first without a name of its own
std::string with_numbers(NamedEffect const& effect) {
  constexpr std::size_t most = 3;
  std::string text = title_of(effect);
  for (std::size_t k = 0; k < std::min(most, effect.parameters.size()); ++k)
    text += k == 0 ? " " + number_of(effect.parameters[k])
                   : fmt::format(", {} {}", effect.parameters[k].name, number_of(effect.parameters[k]));
  return text;
}

// strongest first, three at most
std::string class_of(NamedEffect const& effect) {
  constexpr std::size_t most = 2;  // beside the first
  std::string text = with_numbers(effect);
  for (std::size_t k = 0; k < std::min(most, effect.equivalent.size()); ++k)
    text += " | " + in_words(effect.equivalent[k]);
  if (effect.equivalent.size() > most) text += fmt::format(" | {} more", effect.equivalent.size() - most);
  return text;
}

std::string names_of(JointDiagnosis const& joint, bool with_classes) {
  std::string text;
  for (auto const& effect : joint.effects) {
    text += (text.empty() ? "" : "; ") + (with_classes ? class_of(effect) : with_numbers(effect));
    text += "   " + p_text(effect.p, effect.p_is_bound, least_p(joint.twins));
  }
  return text;
}

std::string without_full_stop(std::string text) {
  while (text.ends_with('.')) text.pop_back();
  return text;
}

std::string none_text(JointDiagnosis const& joint) {
  std::string text = joint.twins > 0 ? fmt::format("the residual is like that of {} simulated replicates ({})",
                                                   joint.twins, p_text(joint.omnibus_p, false, least_p(joint.twins)))
                                     : std::string("the model explains the recording");
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
  if (!joint.refutation.empty()) return text + without_full_stop(joint.refutation);
  return text + (tested > 0 ? fmt::format("and none of {} effects explains it", tested) : "and no effect explains it");
}

std::string what_of(Diagnosis const& diagnosis, JointDiagnosis const& joint, Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return none_text(joint);
    case Verdict::named:
    case Verdict::one_of_class:
      return names_of(joint, true);
    case Verdict::partly: {
      std::string const share = share_text(joint.explained_share, joint.explained_low, joint.explained_high);
      return (share.empty() ? "" : share + " of the mismatch by ") + names_of(joint, true);
    }
    case Verdict::unexplained:
      return unexplained_text(joint);
    case Verdict::insufficient:
    case Verdict::data_fault:
      break;
  }
  std::string const finding = without_full_stop(diagnosis.finding);
  if (finding.empty()) return without_full_stop(diagnosis.reason);
  return finding + (diagnosis.way_out.empty() ? "" : "; " + without_full_stop(diagnosis.way_out));
}

// "at joint 2 and joint 3", of an arm without a law of the whole
std::string where_missing(std::vector<JointDiagnosis> const& joints) {
  std::vector<std::string> names;
  for (auto const& joint : joints)
    if (joint.verdict != Verdict::none) names.push_back(which_joint(joint));
  return names.empty() ? "at any joint" : "at " + name_list(names, "and");
}

struct Errors {
  double before = unknown, after = unknown;

  bool is_known() const { return std::isfinite(before); }
  std::string text() const {
    bool const has_after = std::isfinite(after) && after != before;
    return has_after ? fmt::format("{} -> {}", percent_text(before), percent_text(after)) : percent_text(before);
  }
};

// over all samples, where rows were left out and their errors are known
Errors over_all(LeftOut const& left_out, double relerr, double augmented) {
  bool const leaves_out = left_out.time > 0.0;
  return leaves_out ? Errors{left_out.relerr, left_out.augmented_relerr} : Errors{relerr, augmented};
}

std::string both_text(Errors const& training, Errors const& validation) {
  std::string text;
  if (training.is_known()) text += "training " + training.text();
  if (validation.is_known()) text += (text.empty() ? "" : ", ") + ("validation " + validation.text());
  return text;
}

}  // namespace

VerdictLines verdict_lines(Diagnosis const& diagnosis, JointDiagnosis const& joint, Verdict verdict) {
  VerdictLines lines{what_of(diagnosis, joint, verdict), {}, {}};
  Errors const training{joint.train_relerr, joint.augmented_train_relerr};
  Errors const validation{joint.validation_relerr, joint.augmented_validation_relerr};
  std::string const all = both_text(over_all(joint.train_left_out, training.before, training.after),
                                    over_all(joint.validation_left_out, validation.before, validation.after));
  if (!all.empty()) lines.errors = "error, all samples: " + all;
  double const left_out = std::max(joint.train_left_out.time, joint.validation_left_out.time);
  if (left_out > 0.0) {
    lines.rows =
        fmt::format("on the {} that move one way: {}", percent_text(1.0 - left_out), both_text(training, validation));
    if (std::isfinite(joint.floor_relerr)) lines.rows += ", noise " + percent_text(joint.floor_relerr);
  } else if (!lines.errors.empty() && std::isfinite(joint.floor_relerr)) {
    lines.errors += ", noise " + percent_text(joint.floor_relerr);
  }
  return lines;
}

VerdictLines arm_lines(Diagnosis const& diagnosis) {
  VerdictLines lines;
  if (diagnosis.arm)
    for (auto const& effect : diagnosis.arm->effects) lines.what += (lines.what.empty() ? "" : "; ") + class_of(effect);
  if (lines.what.empty()) lines.what = where_missing(diagnosis.joints);
  double energy = 0.0, before = 0.0, after = 0.0;
  for (auto const& joint : diagnosis.joints) {
    Errors const errors =
        over_all(joint.validation_left_out, joint.validation_relerr, joint.augmented_validation_relerr);
    double const weight = joint.validation_torque_energy;
    if (!errors.is_known() || !std::isfinite(weight)) continue;
    double const now = std::isfinite(errors.after) ? errors.after : errors.before;
    energy += weight;
    before += weight * errors.before * errors.before;
    after += weight * now * now;
  }
  if (energy > 0.0) {
    Errors const whole{std::sqrt(before / energy), std::sqrt(after / energy)};
    lines.errors = "error, all joints and samples: validation " + whole.text();
  }
  return lines;
}

}  // namespace torquescope
