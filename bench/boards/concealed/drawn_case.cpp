#include "concealed/drawn_case.hpp"

#include <algorithm>
#include <cmath>

#include "concealed/decoys.hpp"
#include "concealed/drawn_rig.hpp"
#include "concealed/sizing.hpp"

namespace concealed {
namespace {

std::vector<std::string> common_joints(std::vector<std::string> const& effects, bool turning) {
  std::vector<std::string> joints = all_joint_names();
  auto keep = [&](auto const& test) { std::erase_if(joints, [&](auto const& joint) { return !test(joint); }); };
  for (auto const& name : effects) {
    auto const& allowed = drawable_effect(name).joints;
    keep([&](auto const& joint) { return std::find(allowed.begin(), allowed.end(), joint) != allowed.end(); });
  }
  // turning on without end needs a joint that turns, and no weight that the baseline knows
  if (turning)
    keep([](auto const& joint) { return joint_named(joint).revolute && !joint_named(joint).baseline.has_gravity(); });
  return joints;
}

Recipe weak_recipe(std::string const& motion) {
  return motion == "one_speed" ? Recipe::one_speed : motion == "narrow" ? Recipe::narrow : Recipe::one_direction;
}

std::string expected_of(int tier, bool clean) {
  if (tier == 4) return "unexplained";
  if (tier == 5) return "insufficient";
  if (tier == 6) return "measurement";
  return clean ? "none" : "named";
}

struct Draw {
  Case drawn;
  double nearest = 0.0;  // smallest share of the wanted size among the effects
};

// without `to_the_end` the first effect that does not reach its size ends it
Draw draw(DrawnName const& name, std::uint64_t stream, std::vector<std::string> const& effects,
          std::string const& special, int attempt, bool to_the_end) {
  Random random(stream + static_cast<std::uint64_t>(attempt), "drawn rig");
  Draw out;
  Case& made = out.drawn;
  made.name = name.folder();
  made.tier = "T" + std::to_string(name.tier);
  made.drawn = name.text();
  made.wanted_snr = name.size;
  made.expected = expected_of(name.tier, effects.empty());
  made.seed = stream;
  // an error of the disc is a small effect
  bool const small = std::find(effects.begin(), effects.end(), "encoder_eccentricity") != effects.end();
  std::vector<std::string> const noises =
      small ? std::vector<std::string>{"quiet"} : std::vector<std::string>{"quiet", "bench", "workshop"};
  made.rig = drawn_rig(random, common_joints(effects, special == "one_direction"), noises);
  Motions const motions = name.tier == 0 || name.tier == 6 ? drawn_everyday_motions(random) : drawn_motions(random);
  made.train = motions.train;
  made.validate = motions.validate;
  made.train_s = motions.train_s;
  made.validate_s = motions.validate_s;
  if (name.tier == 6) put_decoy(made.rig, special, random);
  if (name.tier == 7) put_wrong_regime(made.rig, special, random);

  out.nearest = 1.0;
  if (!effects.empty()) {
    // a weak motion conceals what a rich one would show
    if (name.tier == 5) made.train = Recipe::mixed;
    Sizing const sizing(made);
    for (auto const& effect_name : effects) {
      DrawableEffect const& effect = drawable_effect(effect_name);
      Amplifier const amplify = effect.draw(random, made.rig.joint);
      SizedEffect const sized = sizing.find(amplify, effect.usual, effect.largest, name.size);
      made.effects.push_back(sized.effect);
      out.nearest = std::min(out.nearest, sized.reached ? 1.0 : std::min(0.99, sized.snr / name.size));
      if (out.nearest < 1.0 && !to_the_end) return out;
    }
    if (name.tier == 5) made.train = weak_recipe(special);
  }
  return out;
}

}  // namespace

Case drawn_case(DrawnName const& name, int again) {
  std::uint64_t const stream = name.stream(again);
  std::vector<std::string> effects = name.words;
  std::string special;
  if (name.tier >= 5) {
    special = effects.front();
    effects.erase(effects.begin());
  }
  int nearest_attempt = 0;
  double nearest = -1.0;
  for (int attempt = 0; attempt < most_draws; ++attempt) {
    Draw const next = draw(name, stream, effects, special, attempt, false);
    if (next.nearest >= 1.0) return next.drawn;
    if (next.nearest <= nearest) continue;
    nearest = next.nearest;
    nearest_attempt = attempt;
  }
  return draw(name, stream, effects, special, nearest_attempt, true).drawn;
}

}  // namespace concealed
