#pragma once
// The delay of the torque that leaves the least of a recording: every model has its own.
//
// Search     a grid of an eighth of the cut-off's period, then a parabola
// Sign       positive: the torque column is late; negative: early, as a command that the drive follows
// Bounds     the longest delay, either way; at a bound it is none
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Rows

#include "engine/infer/decision/decision_numbers.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/infer/decision/treated_fit.hpp"

namespace torquescope {

enum class DelaySearch { everywhere, near_zero, given };

struct DelayChoice {
  DelaySearch search = DelaySearch::everywhere;
  double longest_s = 0.0;
  double given_s = 0.0;  // where none is searched
};

inline DelayChoice free_delay(DecisionNumbers const& numbers) {
  return {DelaySearch::everywhere, numbers.longest_delay_s};
}

struct ChosenTreatment {
  double late_s = 0.0;
  TreatedFit fit{};
  bool is_delay_at_bound = false;
};

ChosenTreatment chosen_treatment(ModelOnStrips const& on, DelayChoice const& delay);

// derivative of the model's torque by the delay: a nuisance of every question about it; one per row
Eigen::VectorXd delay_tangent(ModelOnStrips const& on, TreatedFit const& fit);

// The sizes of sticking that the recordings bear: those which leave, alone, at most `odds` times what the best mixture
// leaves. What replicates draw
StickingBounds plausible_sticking(ModelOnStrips const& on, ChosenTreatment const& chosen, double odds);

}  // namespace torquescope
