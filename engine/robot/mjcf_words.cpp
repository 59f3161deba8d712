#include "engine/robot/mjcf_words.hpp"

namespace torquescope {

namespace {

constexpr std::string_view actuator_attributes =
    "name class group nsample interp delay ctrllimited forcelimited actlimited ctrlrange forcerange actrange "
    "lengthrange "
    "gear damping armature cranklength joint jointinparent tendon slidersite cranksite site refsite user kp kv "
    "dampratio "
    "timeconst inheritrange dyntype gaintype biastype dynprm gainprm biasprm actearly actdim body plugin area diameter "
    "bias force scale lmin lmax vmax fpmax fvmax range tausmooth";
constexpr std::string_view body_children =
    "body frame inertial joint freejoint geom site camera light plugin composite flexcomp attach replicate";

}  // namespace

std::span<XmlWords const> mjcf_words() {
  static constexpr XmlWords words[] = {
      {"mujoco", "model",
       "compiler option size visual statistic default custom asset worldbody contact deformable equality tendon "
       "actuator "
       "sensor keyframe extension"},
      {"compiler",
       "autolimits boundmass boundinertia settotalmass balanceinertia strippath coordinate angle fitaabb eulerseq "
       "meshdir "
       "texturedir assetdir discardvisual usethread fusestatic inertiafromgeom inertiagrouprange saveinertial "
       "alignfree "
       "convexhull exactmeshinertia conflict",
       "lengthrange lengthrangeopt"},
      {"option",
       "timestep apirate impratio tolerance ls_tolerance noslip_tolerance ccd_tolerance mpr_tolerance sleep_tolerance "
       "gravity wind magnetic density viscosity o_margin o_solref o_solimp o_friction integrator cone jacobian solver "
       "iterations ls_iterations noslip_iterations ccd_iterations mpr_iterations sdf_iterations sdf_initpoints "
       "actuatorgroupdisable collision",
       "flag"},
      {"flag",
       "constraint equality frictionloss limit contact passive spring damper gravity clampctrl warmstart filterparent "
       "actuation refsafe sensor midphase eulerdamp autoreset nativeccd island override energy fwdinv invdiscrete "
       "multiccd sleep",
       ""},
      {"worldbody", "name childclass pos quat", body_children},
      {"body", "name childclass pos quat mocap axisangle xyaxes zaxis euler gravcomp sleep user", body_children},
      {"frame", "name childclass pos quat axisangle xyaxes zaxis euler", body_children},
      {"inertial", "pos quat mass diaginertia fullinertia axisangle xyaxes zaxis euler", ""},
      {"joint",
       "name class type group pos axis springdamper limited actuatorfrclimited solreflimit solimplimit solreffriction "
       "solimpfriction stiffness range actuatorfrcrange actuatorgravcomp margin ref springref armature damping "
       "frictionloss user",
       ""},
      {"freejoint", "name group align", ""},
      {"geom",
       "name class type contype conaffinity condim group priority size material friction mass density shellinertia "
       "solmix "
       "solref solimp margin gap fromto pos quat axisangle xyaxes zaxis euler hfield mesh fitscale rgba fluidshape "
       "fluidcoef user",
       "plugin"},
      {"default", "class",
       "mesh material joint geom site camera light pair equality tendon general motor position velocity intvelocity "
       "damper cylinder muscle adhesion dcmotor plugin default"},
      {"default/equality", "", "*"},
      {"actuator", "", "general motor position velocity intvelocity damper cylinder muscle adhesion dcmotor plugin"},
      {"general", actuator_attributes, "*"},
      {"motor", actuator_attributes, "*"},
      {"position", actuator_attributes, "*"},
      {"velocity", actuator_attributes, "*"},
      {"equality", "", "connect weld joint tendon flex flexvert flexstrain distance plugin"},
      {"equality/joint", "name class active joint1 joint2 polycoef solref solimp", ""},
  };
  return words;
}

}  // namespace torquescope
