#pragma once
// The model of joints as text for other programs: a function in C, a joint of MuJoCo's MJCF, JSON.
//
// Numbers    all their digits in C and JSON; MJCF has what it has words for and names the rest in a comment
// Names      of files are written as comments without what could end one; code has names of the catalogue alone
// Threads    free functions

#include <string>
#include <vector>

#include "engine/experiment/model_effects.hpp"
#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/robot/joint_kind.hpp"

namespace torquescope {

// "torque" of a revolute joint, "force" of a slide
std::string effort_word(JointKind joint);

// what the numbers of a model are of
struct ModelledJoint {
  JointKind kind = JointKind::revolute;
  std::string torque_unit;  // "N m"; "mA" where the factor of a current is not known
  std::string name;
};

// double NAME(double q, double dq, double ddq[, double load]); "" when none has code. remarks: lines of its comment
std::string c_function(std::vector<EstimatedEffect> const& effects, EffectLevels const& levels,
                       ModelledJoint const& joint, std::vector<std::string> const& remarks = {});
// the same as a file of its own
std::string c_text(std::vector<EstimatedEffect> const& effects, EffectLevels const& levels, ModelledJoint const& joint);
// <joint name=... damping=... frictionloss=... armature=.../> and comments; "" without friction that MJCF has
std::string mjcf_joint(std::vector<EstimatedEffect> const& effects, ModelledJoint const& joint);

std::string c_of_joint(Diagnosis const& diagnosis, JointDiagnosis const& joint);
std::string mjcf_of_joint(JointDiagnosis const& joint);

// every joint of a diagnosis as a file
struct ModelWriter {
  std::string name, meaning;  // "c"
  std::string (*write)(Diagnosis const& diagnosis);
};
std::vector<ModelWriter> const& model_writers();

}  // namespace torquescope
