#pragma once
// Whether the names of a selection hold on rows they were not fitted to; which of them to go on without where not.
//
// Held out   the unseen recordings; without any, ten blocks of the training rows, each predicted by the fit outside it
// Rule       the error is clearly lower than the baseline's (held_out_gain.hpp), and unseen recordings do not speak
//            against the names (unseen_refutation.hpp). No law is exempt, and none exempts others
// Instants   a law that predicts nothing elsewhere is named only in an adequate model: training leaves nothing beyond
//            chance, no unseen recording is predicted worse than by all its twins. Where all names are such, the error
//            is that on the rows where they act, left out in short blocks, and the unseen one must not be higher
// Spoilers   such laws of a model that is not adequate, and the worst other one if held-out rows gain without it; else
//            the one name without which they lose least
// Threads    as check_unseen

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/search/abstention.hpp"
#include "engine/unseen/held_out_gain.hpp"
#include "engine/unseen/unseen_record.hpp"

namespace torquescope {

enum class HeldOutRefusal { none, bound_to_instant, spoils_unseen, not_lower };

// of one recording
struct HeldOutResiduals {
  std::vector<Eigen::Index> rows{};
  Eigen::VectorXd before{}, after{};
  Eigen::Index memory_rows = 1;
};

struct HeldOutJudgement {
  std::vector<UnseenResult> unseen{};  // one for each recording
  UnseenEnergies energies{};           // of all
  double torque_energy = 0.0;
  LeftOutRows left_out{};              // by the mask, of all
  std::vector<UnseenBeyond> beyond{};  // predicted worse than all twins
  bool twins_ran_away = false;
  std::vector<HeldOutResiduals> residuals{};
  HeldOutGain gain{};    // of all names
  HeldOutGain acting{};  // where all are bound to the recording: on the rows where they act
  HeldOutRefusal refusal = HeldOutRefusal::none;
  bool is_adequate = false;             // nothing beyond chance is left, in training or unseen
  bool are_a_part = false;              // training says that the names are not all, and so does an unseen recording
  std::vector<std::size_t> spoilers{};  // of the accepted effects; empty where the names hold

  bool holds() const { return refusal == HeldOutRefusal::none; }
};

// what decides, as numbers
struct HeldOutEvidence {
  HeldOutGain gain{}, acting{};
  bool has_bound = false, all_bound = false;  // laws that predict nothing elsewhere
  bool is_adequate = false;
  bool is_spoken_against = false;  // by unseen recordings
};
HeldOutRefusal refusal_of(HeldOutEvidence const& evidence);

// which of the accepted effects to go on without; worth: of each, the energy that held-out rows have more without it;
// bound: those that predict nothing elsewhere
std::vector<std::size_t> spoilers_of(HeldOutRefusal refusal, std::vector<double> const& worth,
                                     std::vector<std::size_t> bound);

// Errors     as check_unseen
HeldOutJudgement judge_held_out(StageSetting const& setting, std::span<Recording const> unseen,
                                Selection const& selection, Remainder const& remainder);

// of two selections' residuals on the rows that both have: whether `other` leaves less of them
HeldOutGain gain_over(HeldOutJudgement const& one, HeldOutJudgement const& other);

}  // namespace torquescope
