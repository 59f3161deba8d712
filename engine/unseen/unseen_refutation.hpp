#pragma once
// Names that unseen recordings speak against: a law that explains one recording and spoils the prediction of another is
// not the joint's, however certain it was.
//
// Refuted    when less of the torque that the names add is found there than in twins that have the names, by three
//            standard deviations of these: an attenuated column moves the other terms, and where parts knock against
//            each other an encoder's noise turns the next knock, so that even of a right law little or nothing may be
//            found. And when the model with its names keeps less than a quarter of what its own twins of these
//            recordings promise, though they promise that a quarter of the residual's energy goes, and though the names
//            change the prediction by as much as a quarter of it. The second condition spares knocking parts, whose
//            phases no model repeats; the third spares a right law on a recording that has something else wrong with
//            it. Or when less than a quarter of the torque that the names add is found there, if they add a tenth of
//            the residual's energy, or if twenty blocks of each recording agree on it to two standard errors. Where
//            nobody knows
//            what twins promise (a loop that cannot be simulated), names are refuted that make the prediction worse and
//            move it as much
// A part     where the training recording says that the names are not all (abstention.hpp), and an unseen one is
//            predicted worse than by any fit of its twins (unseen_transfer.hpp), they must keep half of that promise,
//            and neither that the torque they add is there nor that it is little saves them: a part of what they stand
//            for is no law of it, and the recordings agree that most is something else
// Not asked  of what need not carry over: events, and what runs with the time of the training recording
// Why        as every rule that looks at unseen recordings (unseen_selection.hpp, unseen_range.hpp) it takes names away
//            and never gives one, so that the errors that are printed with names are those of a model nothing was
//            fitted to
// Energies   of residuals, summed over rows and recordings
// Threads    free functions
// Source     PHYSICS.md section 2 step 9: what helps only where it was fitted is no physics

#include "engine/search/forward_selection.hpp"
#include "engine/statistics/prediction_energies.hpp"

namespace torquescope {

// of the torque that the names add, on one stretch of rows: its own energy, and its product with what is left without
// the names
struct AddedTorque {
  double energy = 0.0, found = 0.0;
};

struct UnseenEnergies {
  PredictionEnergies found{};
  // that twins with the names leave; 0 where they run away, which a right law's do not; NaN: unknown
  double floor = 0.0;
  std::vector<AddedTorque> blocks{};  // of all recordings
  // of twins that have the names, predicted as the recordings are, over all of these; empty: not known
  std::vector<PredictionEnergies> twins{};
};

inline constexpr double enough_moved = 0.1;  // of the residual: less says nothing

// share in twins that have the law: three standard deviations below their mean; infinite where there are none
double least_by_chance(std::vector<PredictionEnergies> const& twins);

bool speak_against(UnseenEnergies const& energies);
// the same of names that both recordings say are not all: they must keep half of what twins promise, too
bool speak_against_a_part(UnseenEnergies const& energies);

// of the residuals without and with the names, in equal stretches
std::vector<AddedTorque> added_torque(Eigen::VectorXd const& left_before, Eigen::VectorXd const& left_after);

// the sums, twin by twin; empty where those of one recording are
std::vector<PredictionEnergies> over_recordings(std::vector<std::vector<PredictionEnergies>> const& twins);

// whether a law, or all that was accepted, must hold in another recording too
bool must_carry_over(Effect const& effect);
bool must_carry_over(std::vector<AcceptedEffect> const& accepted);

}  // namespace torquescope
