#pragma once
// Which sign the parameters of a passive joint have.
//
// Rule       1 of a mass and of a friction whose column goes with the speed, -1 of one that goes against it (friction
//            of the negative direction), 0 of anything else
// Threads    free function

#include <Eigen/Core>

#include "engine/effects/regressor.hpp"

namespace torquescope {

Eigen::VectorXd passive_signs(Regressor const& regressor);  // [R]

}  // namespace torquescope
