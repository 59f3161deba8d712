#pragma once
// Torques on one joint that the motion of other joints makes, a unit of each parameter: columns that come with a
// recording, since the joint's own motion does not tell them.
//
// Shapes     columns: n samples at the full rate x L parameters of the effect of that name
// Units      N m (or N) per unit of the parameter
// Threads    plain record

#include <Eigen/Core>
#include <string>
#include <vector>

namespace torquescope {

struct GivenSignals {
  struct Effect {
    std::string name{};
    Eigen::MatrixXd columns{};
  };
  std::vector<Effect> effects{};

  // nullptr: the recording tells nothing of that effect
  Eigen::MatrixXd const* of(std::string const& effect) const {
    for (Effect const& one : effects)
      if (one.name == effect) return &one.columns;
    return nullptr;
  }
};

}  // namespace torquescope
