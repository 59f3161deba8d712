#pragma once
// Whether a model is enough: where what it leaves lies among what its replicates leave, in training and unseen.
//
// Statistic  D over training folds; D over unseen rows. A law may be off in form by `tolerance` of its torque: the
//            recording is allowed tolerance^2 times the energy of each law's torque more, and so are corrections of
//            its form (law_forms.hpp)
// Itself     training rows are asked in the torque itself as well, whose slow changes weights hide
// Adequate   p above a third of alpha, since three parts are asked (Bonferroni), or the excess beyond the replicates'
//            mean is below delta of the torque's rms
// Unseen     a recording without replicates of its own is compared with those of training, row for row; true, with p
//            unknown, without unseen recordings
// Threads    pure functions
// Source     engine/infer/moving_rows/THEORY.md, Adequacy

#include "engine/infer/moving_rows/decision_levels.hpp"
#include "engine/infer/moving_rows/evidence.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct AdequacyPart {
  bool holds = true;
  double p = unknown;
  double excess_share = unknown;  // rms beyond replicates, over the torque's
};

struct Adequacy {
  AdequacyPart train{}, unseen{};
  bool holds() const { return train.holds && unseen.holds; }
};

Adequacy adequacy_of(Evidence const& evidence, DecisionLevels const& levels);

// whether what is left beside the model and that law lies among what replicates leave, the same taken from them: p as
// above, whatever the size
bool leaves_chance(Evidence const& evidence, LawGain const& law, FoldKind kind, DecisionLevels const& levels);

// left: of recording, then replicates; allowed: energy more that the recording may leave; torque: its energy
AdequacyPart adequacy_part(Eigen::VectorXd const& left, double allowed, double torque, DecisionLevels const& levels);

}  // namespace torquescope
