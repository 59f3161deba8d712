// The named joints, loops and noises of the case list.
#include <stdexcept>

#include "concealed/one_turn.hpp"

#include "concealed/rig.hpp"

namespace concealed {
namespace {

template <class Item>
Item const& find(std::vector<Item> const& items, std::string const& name, char const* kind) {
  for (auto const& item : items) {
    if (item.name == name) return item;
  }
  throw std::invalid_argument(std::string("no ") + kind + " named " + name);
}

}  // namespace

JointDesign joint_named(std::string const& name) {
  static std::vector<JointDesign> const joints = {
      {"elbow",
       true,
       {.inertia = 0.115, .viscous = 0.74, .coulomb = 0.92, .offset = 0.06},
       {.range = 1.2, .speed = 2.2},
       14.0,
       one_turn},
      {"wrist",
       true,
       {.inertia = 0.0052, .viscous = 0.024, .coulomb = 0.131, .offset = -0.008},
       {.range = 2.1, .speed = 5.5},
       1.6,
       one_turn},
      {"shoulder",
       true,
       {.inertia = 0.68, .viscous = 2.6, .coulomb = 3.4, .offset = 0.12, .gravity_sin = 7.1, .gravity_cos = 0.9},
       {.range = 1.4, .speed = 1.7},
       60.0,
       one_turn},
      {"stage",
       false,
       {.inertia = 57.0, .viscous = 148.0, .coulomb = 26.5, .offset = -2.2},
       {.range = 0.13, .speed = 0.3},
       420.0,
       0.02},
      {"base",
       true,
       {.inertia = 2.3, .viscous = 6.5, .coulomb = 6.8, .offset = -0.2},
       {.range = 2.4, .speed = 1.5},
       150.0,
       one_turn},
      {"belt",
       false,
       {.inertia = 6.2, .viscous = 21.0, .coulomb = 8.5, .offset = 0.3},
       {.range = 0.32, .speed = 0.85},
       180.0,
       0.08},
  };
  return find(joints, name, "joint");
}

ControllerDesign controller_named(std::string const& name) {
  static std::vector<ControllerDesign> const controllers = {
      {"pd", Law::pd, 9.0, 3},
      {"soft_pd", Law::pd, 5.0, 4},
      {"pid", Law::pid, 8.0, 4},
      {"cascade", Law::cascade, 11.0, 3},
      {"stiff_cascade", Law::cascade, 15.0, 2},
  };
  return find(controllers, name, "controller");
}

NoiseLevel noise_named(std::string const& name) {
  static std::vector<NoiseLevel> const noises = {
      {"none", 0.0, 0.0, 0.0, 0.0, 0.0, 0},
      {"quiet", 0.006, 0.003, 0.001, 0.0, 0.0005, 14},
      {"bench", 0.015, 0.008, 0.002, 0.0, 0.001, 14},
      {"workshop", 0.03, 0.015, 0.004, 0.003, 0.002, 13},
  };
  return find(noises, name, "noise");
}

}  // namespace concealed
