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
    std::vector<RejectedEffect> spoiled;
    HeldOutSelection const* last = &first;
    HeldOutSelection next;
    for (int round = 0; round < most_rounds; ++round) {
      leave_out_spoilers(*last, spoiled);
      auto found = searched();
      if (!found || found->selection.accepted.empty() || found->remainder.is_unexplained) break;
      next = std::move(*found);
      last = &next;
      if (!next.judgement.holds()) continue;
      next.selection.rejected.insert(next.selection.rejected.end(), spoiled.begin(), spoiled.end());
      return next;
    }
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

  HeldOutSelection of_time_last(HeldOutSelection first) {
    auto const& accepted = first.selection.accepted;
    bool const has_any =
        std::any_of(accepted.begin(), accepted.end(), [](auto const& one) { return is_of_time(*one.effect); });
    if (!has_any || first.remainder.is_unexplained || first.judgement.is_adequate) return first;
    std::erase_if(options_.candidates, [](Effect const* effect) { return is_of_time(*effect); });
    auto other = searched();
    if (!other || other->selection.accepted.empty() || !is_final(*other) || other->remainder.is_unexplained)
      return first;
    // a law of the time stays only where held-out rows need it: nothing else imitates so many others
    if (gain_over(other->judgement, first.judgement).change == HeldOutChange::lower) return first;
    for (auto const& one : accepted)
      if (is_of_time(*one.effect))
        other->selection.rejected.push_back(
            {one.effect, "held-out rows do not need a law of the time beside the others"});
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
