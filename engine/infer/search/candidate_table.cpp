#include "engine/infer/search/candidate_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace torquescope {
namespace {

std::string fault_of(ActsOn channel) {
  return channel == ActsOn::recorded_torque ? "a fault of the recorded torque" : "a fault of the recorded position";
}

// by what is known of the step at which nothing was named
std::string first_reason(Selection const& selection, std::size_t i, double q) {
  auto const& scan = selection.first_scan[i];
  if (selection.first_q[i] > q) return fmt::format("within chance (p above {:g})", q);
  if (!selection.is_gate_open)
    return fmt::format("too little to look for: below {:g} % of the torque", 100.0 * smallest_mismatch_share);
  if (scan.gain <= 0.0) return "explains no more than noise, with the signs that physics allows";
  return std::isfinite(selection.first_cv_gain[i]) ? "explains less than what was named"
                                                   : "explains less than the five best";
}

Candidate listed(Selection const& selection, std::size_t i, double q, double blocked_excess) {
  auto const& scan = selection.first_scan[i];
  double const excess = std::max(selection.first_excess, std::numeric_limits<double>::min());
  Candidate candidate;
  candidate.name = scan.effect->name();
  candidate.family = word(scan.effect->family());
  candidate.decision = scan.is_testable ? Decision::rejected : Decision::not_tested;
  if (!scan.is_testable) candidate.reason = "the model's own columns explain it on this motion";
  candidate.z = scan.z;
  candidate.p = scan.p;
  candidate.q = selection.first_q[i];
  candidate.chance_z = scan.chance_z;
  // without a mismatch there is nothing to have a share of
  candidate.gain = selection.is_gate_open ? std::max(0.0, scan.gain / excess) : 0.0;
  if (selection.is_gate_open) candidate.cv_gain = selection.first_cv_gain[i] / blocked_excess;
  if (selection.has_accepted(scan.effect)) {
    bool const is_physics = scan.effect->acts_on() == ActsOn::joint;
    candidate.decision = is_physics ? Decision::named : Decision::measurement;
    if (!is_physics) candidate.reason = fault_of(scan.effect->acts_on());
    return candidate;
  }
  if (scan.is_testable) candidate.reason = first_reason(selection, i, q);
  for (auto const& rejected : selection.rejected)
    if (rejected.effect == scan.effect) candidate.reason = rejected.reason;
  return candidate;
}

}  // namespace

std::vector<Candidate> candidate_table(Selection const& selection, double q, double blocked_excess) {
  std::vector<Candidate> candidates;
  // as the first excess: what one candidate takes was there
  double blocked_whole = std::max(blocked_excess, std::numeric_limits<double>::min());
  for (double gain : selection.first_cv_gain) blocked_whole = std::max(blocked_whole, std::isfinite(gain) ? gain : 0.0);
  for (std::size_t i = 0; i < selection.first_scan.size(); ++i)
    candidates.push_back(listed(selection, i, q, blocked_whole));
  std::stable_sort(candidates.begin(), candidates.end(), [&](auto const& a, auto const& b) {
    return selection.is_gate_open ? a.gain > b.gain : a.z - a.chance_z > b.z - b.chance_z;
  });
  return candidates;
}

void mark_equivalent(std::vector<Candidate>& candidates, std::vector<NamedEffect> const& effects) {
  for (auto& candidate : candidates)
    for (auto const& effect : effects) {
      // one of a class that holds physics too is no fault of the recording yet
      if (candidate.name == effect.name && candidate.decision == Decision::measurement && !is_fault(effect))
        candidate.decision = Decision::named;
      if (std::find(effect.equivalent.begin(), effect.equivalent.end(), candidate.name) != effect.equivalent.end()) {
        candidate.decision = Decision::equivalent;
        candidate.reason = "this motion cannot tell it from " + effect.name;
      }
    }
}

void withdraw_names(std::vector<Candidate>& candidates, std::string const& reason) {
  auto const has_name = [](Candidate const& one) {
    return one.decision == Decision::named || one.decision == Decision::measurement;
  };
  auto const others = std::stable_partition(candidates.begin(), candidates.end(), has_name);
  for (auto candidate = candidates.begin(); candidate != others; ++candidate) {
    candidate->decision = Decision::rejected;
    candidate->reason = reason;
  }
}

}  // namespace torquescope
