#pragma once
// [simulate.plant]: a number for each parameter of the joint, under the names the effects give them.
//
// Example    inertia = 0.0036, viscous = 0.0164, coulomb_positive = 0.0089, coulomb_negative = -0.2582
// Rules      an effect is in the plant when one of its parameters is written; its other linear ones are then 0, its
//            shape parameters must be written
// Errors     Problems with exit code 78: unknown parameter (with a suggestion), not a finite number, shape missing or
//            not above 0 where only that makes sense, an effect with memory, of a recorded channel or built on a fitted
//            model, an effect of an angle on a prismatic joint, nothing written at all

#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/simulate/joint_plant.hpp"

namespace torquescope {

// a joint alone has effects that follow from its motion; joints of an arm also those that remember, or follow the load
enum class PlantPlace { joint, arm };

std::vector<PlantTerm> read_plant(Section const& section, JointKind joint, std::vector<Problem>& problems,
                                  PlantPlace place = PlantPlace::joint);

// what a plant must be to move by itself: inertia above 0, friction that brakes, and no faster than the integrator's
// step
void check_plant_dynamics(std::vector<PlantTerm> const& terms, double position, double step_s, Section const& section,
                          std::vector<Problem>& problems);

// a problem unless dry friction at rest is a range: the backward branch not above the forward one
void check_friction_brakes(JointPlant const& plant, JointState const& rest, Section const& section,
                           std::vector<Problem>& problems);

struct TruthValue {
  std::string name, unit;
  double value = 0.0;
};
// every parameter of every term, in the order of the registry
std::vector<TruthValue> truth_values(std::vector<PlantTerm> const& terms, JointKind joint);

}  // namespace torquescope
