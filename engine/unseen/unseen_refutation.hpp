#pragma once
// Whether validation recordings refute the accepted effects (METHOD.md, Validation recordings, Refutation).
//
// Equation   share = <e, r> / |e|^2; e: what the accepted effects change in the prediction, r: the baseline's residual
// Null       the same share in replicates that have the effects; refuted only below their mean less three deviations
// A part     where training says that the effects are not all, half of the promised improvement must be kept
// Asked      of all names together: laws that predict nothing elsewhere have moved the parameters beside them
// Energies   of residuals, summed over rows and recordings
// Threads    free functions
// Source     METHOD.md, Validation recordings

#include "engine/search/forward_selection.hpp"
#include "engine/statistics/prediction_energies.hpp"

namespace torquescope {

// of the torque that the accepted effects add, on one stretch of rows: its energy, and its product with the baseline's
// residual
struct AddedTorque {
  double energy = 0.0, found = 0.0;
};

struct UnseenEnergies {
  PredictionEnergies found{};
  // that replicates with the effects leave; 0 where they diverge, which a right law's do not; NaN: unknown
  double floor = 0.0;
  std::vector<AddedTorque> blocks{};  // of all recordings
  // of replicates that have the effects, predicted as the recordings are, over all of these; empty: not known
  std::vector<PredictionEnergies> twins{};
};

inline constexpr double enough_moved = 0.1;  // of the residual: less says nothing

// share in twins that have the law: three standard deviations below their mean; infinite where there are none
double least_by_chance(std::vector<PredictionEnergies> const& twins);

bool speak_against(UnseenEnergies const& energies);
// the same of effects that are a part only, by training and validation: they must also keep half of the promise
bool speak_against_a_part(UnseenEnergies const& energies);

// of the residuals without and with the accepted effects, in equal stretches
std::vector<AddedTorque> added_torque(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after);

// the sums, twin by twin; empty where those of one recording are
std::vector<PredictionEnergies> over_recordings(std::vector<std::vector<PredictionEnergies>> const& twins);

}  // namespace torquescope
