#include "engine/effects/model_options.hpp"

namespace torquescope {

OptionTable<ModelOptions> const& ModelOptions::table() {
  static OptionTable<ModelOptions> const table(
      "model", "the torque of the joint as a sum of terms, or an arm",
      {{"joint", &ModelOptions::joint, std::vector<std::string>{"revolute", "prismatic"},
        "kind of joint: turns or slides"},
       {"terms", &ModelOptions::terms, "effects whose torques add up (torquescope list effects)"},
       {"velocity_deadband", &ModelOptions::velocity_deadband, "rad/s or m/s", 0.0, 1e3,
        "dry friction is zero at and below this speed; 0: only at rest"},
       {"robot", &ModelOptions::robot,
        "robot file of an arm (robots/panda.toml, a URDF, xacro or MJCF), relative to the job file; then joint and "
        "terms "
        "are not written"},
       {"root", &ModelOptions::root,
        "of an arm whose file has links: the link that stands still, with all before it; of a legged robot its body"},
       {"tip", &ModelOptions::tip,
        "of an arm whose file has links: the link where it ends, where the file has branches or a gripper"},
       {"friction", &ModelOptions::friction,
        "of an arm: effects that every joint has beside the rigid arm, e.g. viscous, coulomb, offset"},
       {"drive_inertia", &ModelOptions::drive_inertia,
        "of an arm: the inertia of each drive, on the joint's side, is a parameter"},
       {"gravity", &ModelOptions::gravity,
        "of an arm: m/s^2 in the base frame of its file, in place of what the file says; [0, 0, 0] where the torque "
        "has none of it"},
       {"drive_gains", &ModelOptions::drive_gains,
        "of an arm: the error of each torque_per_unit is a parameter; needs recording.payload_kg, and name = "
        "\"tls\""}});
  return table;
}

OptionTable<JointModelOptions> const& JointModelOptions::table() {
  static OptionTable<JointModelOptions> const table(
      "model.joint_1", "of an arm: what joint 1 has of its own; [model.joint_2] and so on likewise",
      {{"friction", &JointModelOptions::friction, "effects beside the rigid arm, in place of model.friction"},
       {"motor_turns_by", &JointModelOptions::motor_turns_by,
        "of a coupled drive: how far this motor turns per turn of each joint, on the joint's side. [0, 0, 0, 0, 1, 1] "
        "of "
        "joint 6: by q5 + q6, as in wrists with a common transmission. Its friction and inertia follow that angle and "
        "are felt at all these joints; torques are those at the joints"}});
  return table;
}

Regressor make_regressor(ModelOptions const& options, Section const& model) {
  auto const joint = options.joint == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  return {options.terms, joint, options.velocity_deadband, model};
}

}  // namespace torquescope
