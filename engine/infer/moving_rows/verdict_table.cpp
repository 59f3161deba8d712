#include "engine/infer/moving_rows/verdict_table.hpp"

namespace torquescope {
namespace {

VerdictOf without_laws(VerdictFacts const& facts) {
  if (facts.is_baseline_adequate && facts.is_motion_poor) return {Verdict::insufficient, VerdictReason::motion_poor};
  if (facts.is_baseline_adequate) return {Verdict::none, VerdictReason::nothing_left};
  if (!facts.has_relation) return {Verdict::data_fault, VerdictReason::no_relation};
  return {Verdict::unexplained, VerdictReason::nothing_fits};
}

Verdict names(VerdictFacts const& facts) {
  if (facts.all_on_channel) return Verdict::data_fault;
  return facts.has_class ? Verdict::one_of_class : Verdict::named;
}

}  // namespace

std::string word(VerdictReason reason) {
  switch (reason) {
    case VerdictReason::nothing_left:
      return "nothing_left";
    case VerdictReason::motion_poor:
      return "motion_poor";
    case VerdictReason::nothing_fits:
      return "nothing_fits";
    case VerdictReason::no_relation:
      return "no_relation";
    case VerdictReason::other_joints:
      return "other_joints";
    case VerdictReason::not_held_out:
      return "not_held_out";
    case VerdictReason::too_small:
      return "too_small";
    case VerdictReason::most_is_left:
      return "most_is_left";
    case VerdictReason::explained:
      return "explained";
    case VerdictReason::partly_explained:
      return "partly_explained";
  }
  return {};
}

VerdictOf verdict_of(VerdictFacts const& facts) {
  if (facts.others_predict_better && !facts.is_baseline_adequate)
    return {Verdict::unexplained, VerdictReason::other_joints};
  if (facts.laws == 0) return without_laws(facts);
  // nothing is left beyond chance, and what was found in it is of no use for other rows
  if (!facts.is_held_out_lower && facts.is_baseline_adequate) return without_laws(facts);
  if (!facts.is_held_out_lower) return {Verdict::unexplained, VerdictReason::not_held_out};
  if (facts.is_adequate && !facts.is_worth_naming) return {Verdict::none, VerdictReason::too_small};
  if (facts.is_adequate) return {names(facts), VerdictReason::explained, true};
  if (facts.explains_most) return {Verdict::partly, VerdictReason::partly_explained, true};
  return {Verdict::unexplained, VerdictReason::most_is_left};
}

}  // namespace torquescope
