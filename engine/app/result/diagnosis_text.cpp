#include "engine/app/result/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/app/result/candidate_text.hpp"
#include "engine/app/result/map_text.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/quantity_text.hpp"

namespace torquescope {

namespace {

struct VerdictWords {
  char const* mark;
  char const* word;
};

VerdictWords words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return {"○", "NOTHING MISSING"};
    case Verdict::named:
      return {"●", "NAMED"};
    case Verdict::one_of_class:
      return {"◍", "ONE OF A CLASS"};
    case Verdict::partly:
      return {"◐", "PARTLY EXPLAINED"};
    case Verdict::unexplained:
      return {"◌", "UNEXPLAINED"};
    case Verdict::insufficient:
      return {"▽", "INSUFFICIENT"};
    case Verdict::data_fault:
      return {"✕", "DATA FAULT"};
  }
  return {"", ""};
}

// a fault of a channel beside physics
bool has_fault(Diagnosis const& diagnosis) {
  if (!names_physics(diagnosis.verdict)) return false;
  return std::any_of(diagnosis.joints.begin(), diagnosis.joints.end(), [](JointDiagnosis const& joint) {
    return std::any_of(joint.effects.begin(), joint.effects.end(), is_fault);
  });
}

bool needs_care(Verdict verdict) {
  return verdict == Verdict::unexplained || verdict == Verdict::insufficient || verdict == Verdict::data_fault;
}

constexpr std::array<std::pair<char const*, char const*>, 3> kept_together{
    {{" %", "\u00A0%"}, {"p < ", "p\u00A0<\u00A0"}, {"p = ", "p\u00A0=\u00A0"}}};

std::string with_each(std::string text, std::string const& old_words, std::string const& new_words) {
  for (std::size_t at = 0; (at = text.find(old_words, at)) != std::string::npos; at += new_words.size())
    text.replace(at, old_words.size(), new_words);
  return text;
}

std::string joined(std::vector<std::string> const& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + printable(names[i]);
  return text;
}

std::string share_cell(double share) { return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : ""; }

std::string next_text(JointDiagnosis const& joint) {
  std::string text;
  for (auto const& advice : joint.excitation) {
    std::string line = printable(advice.lacks);
    if (advice.would_separate.size() > 1) line += ": would tell " + joined(advice.would_separate) + " apart";
    // of what may not be named yet
    if (advice.would_separate.size() == 1)
      line += ": would tell whether it is " + joined(advice.would_separate) + ", which came closest";
    text += hanging(lead(text.empty() ? "next" : ""), line);
  }
  return text;
}

// an interval that reaches much further to one side is said by its ends
std::string interval_text(ParameterEstimate const& one) {
  constexpr double lopsided = 0.1;
  std::string value = short_number(one.value);
  if (!std::isfinite(one.lower) || !std::isfinite(one.upper)) return value;
  double const half = 0.5 * (one.upper - one.lower), middle = 0.5 * (one.upper + one.lower);
  if (std::abs(one.value - middle) > lopsided * half)
    return fmt::format("{} ({} to {})", value, short_number(one.lower), short_number(one.upper));
  return value + " +- " + two_digits(half);
}

// errors over all rows, and what the others leave out
void add_left_out(TextTable& table, std::string const& where, LeftOut const& left_out) {
  if (!(left_out.time > 0.0)) return;
  table.row({"error, " + where + ", all rows", "", share_cell(left_out.relerr), share_cell(left_out.augmented_relerr)});
  table.row({"left out, " + where, "",
             fmt::format("{} of the time, {} of the residual's energy", share_cell(left_out.time),
                         share_cell(left_out.energy)),
             ""});
}

ParameterEstimate const* find_parameter(std::vector<ParameterEstimate> const& parameters, std::string const& name) {
  auto const found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](ParameterEstimate const& one) { return one.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

}  // namespace

std::string verdict_text(Diagnosis const& diagnosis, bool utf8, Ink const& ink) {
  VerdictWords const words = words_of(diagnosis.verdict);
  bool const of_few_rows = diagnosis.verdict == Verdict::none &&
                           std::any_of(diagnosis.joints.begin(), diagnosis.joints.end(), looks_at_less_than_half);
  std::string const lead =
      fmt::format("{} {}{}", utf8 ? words.mark : "*", words.word, of_few_rows ? " ON THE ROWS LOOKED AT" : "");
  std::string inked = needs_care(diagnosis.verdict) ? ink.warning(lead) : ink.bold(lead);
  if (has_fault(diagnosis)) inked += ink.warning(" + DATA FAULT");
  // a number stays with its percent sign, a p with its value: wrap() breaks at spaces only
  std::string reason = printable(diagnosis.reason);
  for (auto const& [loose, tight] : kept_together) reason = with_each(reason, loose, tight);
  return with_each(hanging(inked + "  ", reason), "\u00A0", " ");
}

// of a joint among others
std::string verdict_of_joint(JointDiagnosis const& joint, bool utf8, Ink const& ink) {
  VerdictWords const words = words_of(joint.verdict);
  std::string const lead = fmt::format("{} {}: {}", utf8 ? words.mark : "*", which_joint(joint), words.word);
  return (needs_care(joint.verdict) ? ink.warning(lead) : ink.bold(lead)) + "\n" +
         hanging("  ", printable(joint.reason));
}

std::string evidence_text(Diagnosis const& diagnosis, DiagnosisTextOptions const& options, Ink const& ink) {
  std::string text;
  if (diagnosis.arm && !diagnosis.arm->candidates.empty()) {
    JointDiagnosis whole;
    whole.candidates = diagnosis.arm->candidates;
    text += "\n" + ink.bold("whole arm") + "\n" + candidates_text(whole, options.all_candidates);
  }
  for (auto const& joint : diagnosis.joints) {
    bool const is_one_of_many = !joint.reason.empty();
    Verdict const verdict = is_one_of_many ? joint.verdict : diagnosis.verdict;
    std::string const part = where_text(joint, options.utf8) +
                             (verdict == Verdict::partly ? what_is_left_text(joint, options.utf8) : "") +
                             candidates_text(joint, options.all_candidates) + next_text(joint);
    if (part.empty() && !is_one_of_many) continue;
    text += "\n";
    if (is_one_of_many) text += verdict_of_joint(joint, options.utf8, ink);
    text += part;
  }
  return text;
}

std::string diagnosis_text(Diagnosis const& diagnosis, DiagnosisTextOptions const& options, Ink const& ink) {
  return verdict_text(diagnosis, options.utf8, ink) + evidence_text(diagnosis, options, ink);
}

std::string diagnosed_model_text(Diagnosis const& diagnosis, Ink const& ink) {
  using Align = TextTable::Align;
  std::string text;
  for (auto const& joint : diagnosis.joints) {
    if (joint.baseline.empty()) continue;
    TextTable table({Align::left, Align::left, Align::left, Align::left}, "  ");
    table.row({"parameter", "unit", "before", "after"});
    auto const& after = joint.augmented.empty() ? joint.baseline : joint.augmented;
    for (auto const& one : after) {
      ParameterEstimate const* before = find_parameter(joint.baseline, one.name);
      table.row({printable(one.name), printable(one.unit), before ? interval_text(*before) : "", interval_text(one)});
    }
    table.row({"error, train", "", share_cell(joint.train_relerr), share_cell(joint.augmented_train_relerr)});
    table.row(
        {"error, unseen", "", share_cell(joint.validation_relerr), share_cell(joint.augmented_validation_relerr)});
    add_left_out(table, "train", joint.train_left_out);
    add_left_out(table, "unseen", joint.validation_left_out);
    std::string const explained = share_text(joint.explained_share, joint.explained_low, joint.explained_high);
    if (!explained.empty()) table.row({"explained, held-out rows", "", "", explained});
    text += ink.bold(fmt::format("model of {} (+- 95 %)", which_joint(joint))) + "\n" + table.text(page_width);
  }
  return text;
}

}  // namespace torquescope
