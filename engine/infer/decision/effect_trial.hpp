#pragma once
// The few effects that gain most beside one model, refined and fitted, and what but chance speaks against each of them.
//
// Size       a torque of at least delta of the torque's rms, and an error on judged rows that falls by least_fall
// Bounds     no parameter beyond what it can be, no shape at an end of its range which is no effect of its own
// Judged     rows that no fit has seen: other recordings, else ten folds. Effects of an instant or a clock are another
//            in each recording (own_clock.hpp), so they are judged on folds of training
// Threads    spreads effects over the threads of the question; same bits for any number
// Source     engine/infer/decision/THEORY.md, The rules

#include <vector>

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

// a model that effects are tried beside
struct TrialModel {
  JointStrips const& rows;
  FittedModel const& fitted;
  std::vector<ShapedEffect> const& effects;  // that it has
  Score const& score;                        // of its residual
  JointScales const& scales;
  double judged = 0.0;  // its error on judged rows
};

struct TriedEffect {
  std::size_t question = 0;
  EffectFacts facts{};
  FittedModel with{};  // the model beside the effect; empty where the effect gains nothing
};

// largest first; of all values, or of so many
std::vector<std::size_t> places_of_largest(Eigen::VectorXd const& values, Eigen::Index most);
inline std::vector<std::size_t> places_of_largest(Eigen::VectorXd const& values) {
  return places_of_largest(values, values.size());
}
Eigen::VectorXd gains_of(std::vector<EffectFinding> const& findings);

// in the order of `which`
std::vector<TriedEffect> tried_effects(DecisionQuestion const& question, TrialModel const& beside,
                                       std::vector<EffectQuestion> const& effects,
                                       std::vector<EffectFinding> const& findings,
                                       std::vector<std::size_t> const& which, FoldKind kind);

}  // namespace torquescope
