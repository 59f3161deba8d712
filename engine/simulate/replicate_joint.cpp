#include "engine/simulate/replicate_joint.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {
namespace {

Problem no_joint(std::string what) {
  Problem problem{ExitCode::bad_data, std::move(what)};
  problem.help =
      "such a joint cannot be simulated: record a motion that excites every term, or remove terms from the model";
  return problem;
}

}  // namespace

bool place_in_lanes(ReplicateJoint& joint, std::string const& term, double const* value) {
  if (term == "inertia") {
    joint.lanes.inertia += value[0];
  } else if (term == "viscous") {
    joint.lanes.viscous += value[0];
  } else if (term == "coulomb_positive") {
    joint.coulomb_forward += value[0];
  } else if (term == "coulomb_negative") {
    joint.coulomb_backward += value[0];
  } else if (term == "coulomb") {
    joint.coulomb_forward += value[0];
    joint.coulomb_backward -= value[0];
  } else if (term == "offset") {
    joint.offset += value[0];
  } else if (term == "gravity") {
    joint.lanes.gravity_sin += value[0];
    joint.lanes.gravity_cos += value[1];
  } else {
    return false;
  }
  return true;
}

ReplicateJoint make_replicate_joint(Regressor const& regressor, Eigen::VectorXd const& parameters) {
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(parameters.size()) == regressor.size());
  ReplicateJoint joint;
  joint.lanes.inertia = 0.0;
  double const* value = parameters.data();
  for (auto const* effect : regressor.terms()) {
    std::size_t const count = effect->n_linear();
    // what comes with a recording is placed by who knows the recording (JointModel::replicate_joint)
    if (effect->is_given()) {
      value += count;
      continue;
    }
    // a term of [model] needs nothing but the motion, so no scales of the data either
    if (!place_in_lanes(joint, effect->name(), value))
      joint.effects.push_back(lane_effect(*effect, {value, value + count}, JointScales{}));
    value += count;
  }
  validate(std::isfinite(parameters.sum()) && joint.lanes.inertia > 0.0, [&] {
    return no_joint(
        fmt::format("the fitted inertia is {:.4g} (a joint that moves has more than 0)", joint.lanes.inertia));
  });
  validate(joint.coulomb_backward <= joint.coulomb_forward, [&] {
    return no_joint(
        fmt::format("the fitted friction is {:.4g} forwards and {:.4g} backwards (it would drive the joint)",
                    joint.coulomb_forward, joint.coulomb_backward));
  });
  return joint;
}

}  // namespace torquescope
