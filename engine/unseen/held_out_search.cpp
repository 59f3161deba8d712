#include "engine/unseen/held_out_search.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/search/joint_search.hpp"
#include "engine/unseen/unseen_range.hpp"
#include "engine/unseen/unseen_selection.hpp"

namespace torquescope {
namespace {

constexpr int most_rounds = 3;

bool is_of_time(Effect const& effect) {
  auto const& families = effect.families();
  return effect.is_event() || std::find(families.begin(), families.end(), EffectFamily::time) != families.end();
}

class HeldOutSearch {
 public:
  HeldOutSearch(StageSetting const& setting, SelectionOptions const& options, std::span<Recording const> unseen,
                StageSink const& progress)
      : setting_(setting), options_(options), unseen_(unseen), progress_(progress) {}

  HeldOutSelection run(Selection selection) {
    HeldOutSelection first = judged(std::move(selection));
    if (is_final(first)) return of_time_last(std::move(first));
    if (is_beyond_training(first)) return first;
    auto const all = options_.candidates;
    if (has_law_of_time(first)) {
      leave_out_laws_of_time();
      if (auto found = searched(); found && is_answer(*found)) {
        reject_laws_of_time(first, *found);
        return std::move(*found);
      }
      options_.candidates = all;
    }
    if (auto found = without_spoilers(first)) return of_time_last(std::move(*found));
    return first;
  }

 private:
  HeldOutSelection judged(Selection selection) const {
    HeldOutSelection result;
    StageSetting setting = setting_;
    selection = doubt_noise(setting, options_, std::move(selection), progress_);
    result.remainder = judge_with_reversals(setting, options_, selection, progress_);
    drop_spoilers(setting, unseen_, selection, result.remainder);
    result.judgement = judge_held_out(setting, unseen_, selection, result.remainder);
    result.selection = std::move(selection);
    result.setting = std::make_unique<StageSetting const>(setting);
    return result;
  }

  // nothing to go on without: the names hold, there are none, or they are withdrawn for what they leave
  static bool is_final(HeldOutSelection const& one) {
    return one.judgement.holds() || one.remainder.is_unexplained || !one.selection.is_gate_open;
  }

  bool is_beyond_training(HeldOutSelection& one) const {
    if (unseen_.empty() || one.judgement.are_a_part || one.judgement.refusal == HeldOutRefusal::bound_to_instant)
      return false;
    one.kept_to = spoils_only_beyond(*one.setting, unseen_, one.selection);
    return one.kept_to.has_value();
  }

  static bool explains(HeldOutSelection const& one) {
    return !one.selection.accepted.empty() && !one.remainder.is_unexplained;
  }
  static bool is_answer(HeldOutSelection const& one) { return explains(one) && one.judgement.holds(); }

  // round by round without what spoiled the one before; nothing when no round ends with names that hold
  std::optional<HeldOutSelection> without_spoilers(HeldOutSelection const& first) {
    std::vector<RejectedEffect> spoiled;
    HeldOutSelection const* last = &first;
    HeldOutSelection next;
    for (int round = 0; round < most_rounds; ++round) {
      leave_out_spoilers(*last, spoiled);
      auto found = searched();
      if (!found || !explains(*found)) return std::nullopt;
      next = std::move(*found);
      last = &next;
      if (!next.judgement.holds()) continue;
      next.selection.rejected.insert(next.selection.rejected.end(), spoiled.begin(), spoiled.end());
      return next;
    }
    return std::nullopt;
  }

  void leave_out_spoilers(HeldOutSelection const& one, std::vector<RejectedEffect>& spoiled) {
    for (std::size_t const i : one.judgement.spoilers) {
      Effect const* effect = one.selection.accepted[i].effect;
      std::erase(options_.candidates, effect);
      spoiled.push_back({effect, one.judgement.refusal == HeldOutRefusal::bound_to_instant
                                     ? "is of one instant, in a model that is not adequate"
                                     : "does not lower the error on rows it was not fitted to"});
    }
  }

  // on the candidates that are left; nothing where there are none, or the recording cannot be searched again
  std::optional<HeldOutSelection> searched() const {
    if (options_.candidates.empty()) return std::nullopt;
    try {
      return judged(select_effects(setting_, options_, progress_));
    } catch (Error const&) {
      return std::nullopt;  // what was found before stands
    }
  }

  static bool has_law_of_time(HeldOutSelection const& one) {
    auto const& accepted = one.selection.accepted;
    return std::any_of(accepted.begin(), accepted.end(), [](auto const& law) { return is_of_time(*law.effect); });
  }

  void leave_out_laws_of_time() {
    std::erase_if(options_.candidates, [](Effect const* effect) { return is_of_time(*effect); });
  }

  static void reject_laws_of_time(HeldOutSelection const& with, HeldOutSelection& without) {
    for (auto const& one : with.selection.accepted)
      if (is_of_time(*one.effect))
        without.selection.rejected.push_back(
            {one.effect, "held-out rows do not need a law of the time beside the others"});
  }

  HeldOutSelection of_time_last(HeldOutSelection first) {
    if (!has_law_of_time(first) || first.remainder.is_unexplained || first.judgement.is_adequate) return first;
    leave_out_laws_of_time();
    auto other = searched();
    if (!other || other->selection.accepted.empty() || !is_final(*other) || other->remainder.is_unexplained)
      return first;
    // a law of the time stays only where held-out rows need it: nothing else imitates so many others
    if (gain_over(other->judgement, first.judgement).change == HeldOutChange::lower) return first;
    reject_laws_of_time(first, *other);
    return std::move(*other);
  }

  StageSetting setting_;
  SelectionOptions options_;
  std::span<Recording const> unseen_;
  StageSink const& progress_;
};

}  // namespace

HeldOutSelection search_while_names_spoil(StageSetting const& setting, SelectionOptions const& options,
                                          std::span<Recording const> unseen, Selection selection,
                                          StageSink const& progress) {
  return HeldOutSearch(setting, options, unseen, progress).run(std::move(selection));
}

}  // namespace torquescope
