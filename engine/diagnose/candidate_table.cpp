#include "engine/diagnose/candidate_table.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace torquescope {
namespace {

Candidate listed(Selection const& selection, std::size_t i) {
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
  if (selection.is_gate_open) candidate.cv_gain = selection.first_cv_gain[i] / excess;
  if (selection.has_accepted(scan.effect)) {
    candidate.decision = scan.effect->acts_on() == ActsOn::joint ? Decision::named : Decision::measurement;
    return candidate;
  }
  for (auto const& rejected : selection.rejected)
    if (rejected.effect == scan.effect) candidate.reason = rejected.reason;
  return candidate;
}

}  // namespace

std::vector<Candidate> candidate_table(Selection const& selection) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < selection.first_scan.size(); ++i) candidates.push_back(listed(selection, i));
  std::stable_sort(candidates.begin(), candidates.end(), [&](auto const& a, auto const& b) {
    return selection.is_gate_open ? a.gain > b.gain : a.z - a.chance_z > b.z - b.chance_z;
  });
  return candidates;
}

void mark_equivalent(std::vector<Candidate>& candidates, std::vector<NamedEffect> const& effects) {
  for (auto& candidate : candidates)
    for (auto const& effect : effects)
      if (std::find(effect.equivalent.begin(), effect.equivalent.end(), candidate.name) != effect.equivalent.end())
        candidate.decision = Decision::equivalent;
}

void withdraw_names(std::vector<Candidate>& candidates, std::string const& reason) {
  for (auto& candidate : candidates)
    if (candidate.decision == Decision::named || candidate.decision == Decision::measurement) {
      candidate.decision = Decision::rejected;
      candidate.reason = reason;
    }
}

}  // namespace torquescope
