#pragma once
// The laws that cannot be told from an accepted one on these recordings.
//
// Rival      any other law in its place, its shape refined, the other accepted laws beside it. Of a law of several
//            waves the rivals have as many, the further ones over their grid
// Asked      laws beyond chance, and those that gain no less than the accepted one: the p of a law that is searched
//            over many shapes is no ground to exclude it
// Excluded   when the accepted law gains clearly more over folds and blocks of unseen rows (paired, one-sided, level
//            5 %), and more than a law's form may be off; a rival that is itself no clear gain, or stands at a bound,
//            is none
// Threads    spreads grid points over `threads`; same bits for any number
// Source     engine/infer/moving_rows/THEORY.md, Confidence set; Cox 1962, doi:10.1111/j.2517-6161.1962.tb00468.x

#include <span>
#include <vector>

#include "engine/infer/moving_rows/decision_levels.hpp"
#include "engine/infer/moving_rows/refined_candidates.hpp"

namespace torquescope {

struct RivalLaw {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
  double gain_ratio = 0.0;  // its gain over the accepted law's
};

bool may_be_a_rival(EffectScan const& law, double own_gain, double alpha);

// of effect i of the evidence's model, strongest first
std::vector<RivalLaw> confidence_set(Evidence const& evidence, std::size_t i, std::span<Effect const* const> catalogue,
                                     DecisionLevels const& levels, RefinementSetting const& setting);

}  // namespace torquescope
