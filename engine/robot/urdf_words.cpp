#include "engine/robot/urdf_words.hpp"

namespace torquescope {

std::span<XmlWords const> urdf_words() {
  static constexpr XmlWords words[] = {
      {"robot", "name version",
       "link joint material transmission gazebo sensor ros2_control mujoco model plugin group loop_joint group_state "
       "disable_collisions"},
      {"link", "name type", "inertial visual collision self_collision_checking contact sensor material"},
      {"inertial", "", "origin mass inertia"},
      {"mass", "value", ""},
      {"inertia", "ixx ixy ixz iyy iyz izz", ""},
      {"origin", "xyz rpy", ""},
      {"joint", "name type",
       "origin parent child axis limit dynamics mimic safety_controller calibration "
       "hardwareInterface"},
      {"parent", "link", ""},
      {"child", "link", ""},
      {"axis", "xyz", ""},
      {"limit", "lower upper effort velocity acceleration deceleration jerk", ""},
      {"dynamics", "damping friction", ""},
      {"mimic", "joint multiplier offset", ""},
  };
  return words;
}

}  // namespace torquescope
