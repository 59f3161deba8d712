#pragma once
// The fitted baseline of a joint as replicates have it: the terms that fill the lanes directly, the rest as effects.
//
// Units      SI
// Errors     Error 65 when the parameters are no joint: inertia not above 0, dry friction that would drive
// Threads    plain record; makers are shared by all threads

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/effects/regressor.hpp"
#include "engine/simulate/lane_effect.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {

struct ReplicateJoint {
  LaneJoint lanes{};
  double coulomb_forward = 0.0;   // torque of dry friction while dq > 0
  double coulomb_backward = 0.0;  // and while dq < 0: below it
  double offset = 0.0;
  std::vector<LaneEffectMaker> effects{};  // accepted effects, and baseline terms with no place above
};

// adds a term's torque to the joint; false: the lanes have no place for it. value: its linear parameters
bool place_in_lanes(ReplicateJoint& joint, std::string const& term, double const* value);

// parameters: [regressor.size()], as a fit returns them
ReplicateJoint make_replicate_joint(Regressor const& regressor, Eigen::VectorXd const& parameters);

}  // namespace torquescope
