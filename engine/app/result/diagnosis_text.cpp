#include "engine/app/result/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/account/job_lines.hpp"
#include "engine/account/verdict_lines.hpp"
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
bool has_fault(JointDiagnosis const& joint, Verdict verdict) {
  return names_physics(verdict) && std::any_of(joint.effects.begin(), joint.effects.end(), is_fault);
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

ParameterEstimate const* find_parameter(std::vector<ParameterEstimate> const& parameters, std::string const& name) {
  auto const found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](ParameterEstimate const& one) { return one.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

}  // namespace

namespace {

std::string mark_of(Verdict verdict, bool utf8, Ink const& ink, std::string const& whose) {
  VerdictWords const words = words_of(verdict);
  std::string const lead =
      fmt::format("{} {}{}", utf8 ? words.mark : "*", whose.empty() ? "" : whose + "  ", words.word);
  return needs_care(verdict) ? ink.warning(lead) : ink.bold(lead);
}

std::string mark_of(JointDiagnosis const& joint, Verdict verdict, bool utf8, Ink const& ink, std::string const& whose) {
  return mark_of(verdict, utf8, ink, whose) + (has_fault(joint, verdict) ? ink.warning(" + DATA FAULT") : "");
}

// a number stays with its percent sign, a p with its value: wrap() breaks at spaces only
std::string line_text(std::string const& lead, std::string text) {
  text = printable(text);
  for (auto const& [loose, tight] : kept_together) text = with_each(text, loose, tight);
  return with_each(hanging(lead, text), "\u00A0", " ");
}

std::string lines_text(std::string const& lead, VerdictLines const& lines) {
  std::string const indent = "    ";
  std::string text = line_text(lead + "  ", lines.what);
  if (!lines.errors.empty()) text += line_text(indent, lines.errors);
  for (auto const& remark : lines.remarks) text += line_text(indent, remark);
  return text;
}

// joints at which something is missing come first, the others in their order
std::vector<JointDiagnosis const*> by_weight(std::vector<JointDiagnosis> const& joints) {
  std::vector<JointDiagnosis const*> sorted;
  for (auto const& joint : joints) sorted.push_back(&joint);
  std::stable_partition(sorted.begin(), sorted.end(), [](auto* joint) { return joint->verdict != Verdict::none; });
  return sorted;
}

bool is_arm(Diagnosis const& diagnosis) { return diagnosis.joints.size() > 1; }

std::string arm_text(Diagnosis const& diagnosis, bool utf8, Ink const& ink) {
  VerdictLines lines = arm_lines(diagnosis);
  if (lines.what.empty()) lines.what = printable(diagnosis.finding);
  std::string text = lines_text(mark_of(diagnosis.verdict, utf8, ink, "whole arm"), lines);
  for (JointDiagnosis const* joint : by_weight(diagnosis.joints)) {
    text += lines_text(mark_of(*joint, joint->verdict, utf8, ink, which_joint(*joint)),
                       verdict_lines(diagnosis, *joint, joint->verdict));
    for (auto const& effect : job_lines(*joint))
      text += line_text("    ", fmt::format("hold it in run: {}", fmt::join(effect, "   ")));
  }
  return text;
}

}  // namespace

std::string verdict_text(Diagnosis const& diagnosis, bool utf8, Ink const& ink) {
  if (is_arm(diagnosis)) return arm_text(diagnosis, utf8, ink);
  if (diagnosis.joints.empty()) return line_text(mark_of(diagnosis.verdict, utf8, ink, "") + "  ", diagnosis.reason);
  JointDiagnosis const& joint = diagnosis.joints.front();
  return lines_text(mark_of(joint, diagnosis.verdict, utf8, ink, ""),
                    verdict_lines(diagnosis, joint, diagnosis.verdict));
}

std::string advice_text(Diagnosis const& diagnosis) {
  std::string text;
  for (auto const& joint : diagnosis.joints) text += next_text(joint);
  return text;
}

std::string evidence_text(Diagnosis const& diagnosis, DiagnosisTextOptions const& options, Ink const& ink) {
  if (!options.all_candidates) return advice_text(diagnosis);
  std::string text = "\n" + line_text("", diagnosis.reason);
  if (diagnosis.arm && !diagnosis.arm->candidates.empty()) {
    JointDiagnosis whole;
    whole.candidates = diagnosis.arm->candidates;
    text += "\n" + ink.bold("whole arm") + "\n" + candidates_text(whole);
  }
  for (auto const& joint : diagnosis.joints) {
    Verdict const verdict = is_arm(diagnosis) ? joint.verdict : diagnosis.verdict;
    std::string const part = where_text(joint, options.utf8) +
                             (verdict == Verdict::partly ? what_is_left_text(joint, options.utf8) : "") +
                             candidates_text(joint) + next_text(joint);
    if (part.empty() && joint.reason.empty()) continue;
    text += "\n";
    if (is_arm(diagnosis)) text += ink.bold(which_joint(joint)) + "\n" + line_text("  ", joint.reason);
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
        {"error, validation", "", share_cell(joint.validation_relerr), share_cell(joint.augmented_validation_relerr)});
    std::string const explained = share_text(joint.explained_share);
    if (!explained.empty()) table.row({"explained, held-out rows", "", "", explained});
    text += ink.bold(fmt::format("model of {} (+- 95 %)", which_joint(joint))) + "\n" + table.text(page_width());
  }
  return text;
}

}  // namespace torquescope
