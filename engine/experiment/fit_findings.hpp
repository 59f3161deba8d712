#pragma once
// What the least squares fit of a job's model says of its recordings: masses and frictions that are surely negative,
// a position in another unit (problem/position_factor.hpp), and one row that outweighs all others
// (problem/row_influence.hpp).
//
// Surely     data/levels.hpp, in HAC standard errors (problem/hac.hpp); fewer where the torque also takes work out
//            of the joint, which no passive joint allows: that is a fault, the other a warning
// Threads    free function

#include <optional>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/problem/least_squares.hpp"

namespace torquescope {

// of all rows alike, with HAC errors
LeastSquaresFit fit_with_errors(RegressionData const& data, Eigen::VectorXd parameters);

// a row that its neighbours contradict, and that moves a parameter by more than an error; of a joint or an arm. Of a
// position: what it does to the rows of its own joint
std::optional<Finding> influence_finding(Experiment::Parts const& parts);

// of recordings from files; needs parts.reductions
std::vector<Finding> fit_findings(Experiment::Parts const& parts, RecordingOptions const& options);

// the box of a job without [model.bounds] (search_box.hpp); needs parts.reductions
Bounds box_from_recordings(Experiment::Parts const& parts);

}  // namespace torquescope
