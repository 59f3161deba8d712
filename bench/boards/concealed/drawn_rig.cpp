#include "concealed/drawn_rig.hpp"

namespace concealed {
namespace {

template <class Item>
Item const& pick(Random& random, std::vector<Item> const& items) {
  return items[random.index(items.size())];
}

Feedforward nearly(Baseline const& truth, double peak_speed, Random& random) {
  auto wrong = [&] { return random.between(0.9, 1.1); };
  Feedforward known{wrong() * truth.inertia, wrong() * truth.viscous, 0.0, 0.01 * peak_speed};
  if (random.uniform() < 0.5) known.coulomb = wrong() * truth.coulomb;
  return known;
}

}  // namespace

std::vector<std::string> const& all_joint_names() {
  static std::vector<std::string> const names = {"elbow", "wrist", "shoulder", "stage", "base", "belt"};
  return names;
}

Rig drawn_rig(Random& random, std::vector<std::string> const& joints, std::vector<std::string> const& noises) {
  JointDesign joint = joint_named(pick(random, joints));
  Baseline& base = joint.baseline;
  base.inertia *= random.between(0.75, 1.3);
  base.viscous *= random.between(0.6, 1.5);
  base.coulomb *= random.between(0.6, 1.5);
  base.offset *= random.between(-2.0, 2.0);
  base.gravity_sin *= random.between(0.7, 1.2);
  ControllerDesign controller =
      controller_named(pick<std::string>(random, {"pd", "soft_pd", "pid", "cascade", "stiff_cascade"}));
  if (random.uniform() < 0.4) {
    controller.feedforward = nearly(base, joint.limits.speed, random);
    controller.name += "_feedforward";
  }
  NoiseLevel const noise = noise_named(pick(random, noises));
  Rig rig;
  rig.joint = joint;
  rig.controller = controller;
  rig.noise = noise;
  rig.encoder_bits = 16 + static_cast<int>(random.index(4));
  return rig;
}

Motions drawn_motions(Random& random) {
  Recipe const train =
      random.uniform() < 0.6 ? Recipe::mixed : pick<Recipe>(random, {Recipe::staircase, Recipe::multisine});
  return {train, train == Recipe::multisine ? Recipe::staircase : Recipe::multisine};
}

Motions drawn_everyday_motions(Random& random) {
  using enum Recipe;
  Recipe const train = pick<Recipe>(random, {mixed, multisine, staircase, chirp, pick_and_place, everyday});
  Recipe const validate = train == multisine ? staircase : multisine;
  return {train, validate, train == everyday ? 20.0 : 40.0};
}

}  // namespace concealed
