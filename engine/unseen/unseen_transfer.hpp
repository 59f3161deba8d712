#pragma once
// Whether a validation recording agrees with a model in which the training recording misses nothing.
//
// Why        a motion shows only what it excites: a fast pendulum says little of its load's friction
// Null       replicates of the validation recording, each predicted by the parameters fitted to each training replicate
// Rule       a quarter more than the worst of them (3200 where there are 200 replicates, of 16 records), and more than
//            their mean by a hundredth of the torque
// Units      relerr: 1
// Threads    free functions
// Source     METHOD.md, Validation recordings

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

// relerr of a twin when its prediction is off by each of these errors of the parameters (one per column); columns,
// torque, left of the twin; left: with the parameters it was made with
std::vector<double> transfer_errors(Eigen::MatrixXd const& columns, Eigen::VectorXd const& torque,
                                    Eigen::VectorXd const& left, Eigen::MatrixXd const& parameter_errors);

// nothing where it agrees, or where there are no twins
std::optional<UnseenBeyond> beyond_twins(std::string const& recording, double relerr, std::vector<double> const& twins);

}  // namespace torquescope
