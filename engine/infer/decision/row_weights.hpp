#pragma once
// How much each row of a strip says: less where replicates of the model leave much, because nobody knows how friction
// sticks there.
//
// Equation   weight^2 = v / (v + u): u, the mean square that replicates without noise leave on the row; v, the noise:
//            the mean square that the recording leaves on the half of its rows where u is least
// Why        weights learnt from the recording's own residual hide what is missing in the model
// Threads    simulates replicates on the question's threads, fits them on one; same bits for any number
// Source     engine/infer/decision/THEORY.md, Rows

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

// rows with the weights that this model gives them; its strips are those of rows, with whatever weights they have
JointStrips weighed_rows(DecisionQuestion const& question, JointStrips rows, FittedModel const& model);
// all rows alike
JointStrips unweighed_rows(JointStrips rows);
// the same model at the same delay, fitted to other rows of the same recordings
FittedModel fitted_alike(JointStrips const& rows, FittedModel const& model);

}  // namespace torquescope
