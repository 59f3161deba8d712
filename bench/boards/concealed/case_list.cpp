#include "concealed/case_list.hpp"

#include <cmath>
#include <stdexcept>

#include "concealed/noise.hpp"

namespace concealed {
namespace {

struct Row {
  char const* name;
  char const* joint;
  char const* controller;
  char const* noise;
  int encoder_bits;
  Recipe train, validate;
  double train_s;
  std::vector<EffectMaker> effects;
  std::uint64_t seed;
};

std::vector<Row> const& rows() {
  using enum Recipe;
  static std::vector<Row> const table = {
      // name      joint       controller       noise      bits train      validate   s     concealed, size
      //           seed
      {"alder", "elbow", "cascade", "bench", 18, mixed, multisine, 60, {lorentzian_stribeck_of(0.12, 0.03)}, 101},
      {"birch", "stage", "pid", "bench", 17, mixed, staircase, 60, {}, 102},
      {"cedar", "elbow", "pd", "quiet", 19, mixed, multisine, 60, {cogging_of(0.02, 22.0)}, 103},
      {"elm", "shoulder", "cascade", "bench", 19, mixed, multisine, 60, {load_friction_of(0.04, 0.3)}, 104},
      {"fir", "wrist", "pd", "workshop", 15, staircase, multisine, 60, {}, 105},
      {"hazel", "stage", "stiff_cascade", "bench", 16, mixed, multisine, 60, {presliding_of(0.00015)}, 106},
      {"juniper", "shoulder", "pd", "quiet", 20, multisine, staircase, 60, {}, 107},
      {"larch", "elbow", "pid", "bench", 18, mixed, staircase, 120, {warm_up_of(0.08, 40.0, 160.0)}, 108},
      {"maple", "wrist", "soft_pd", "bench", 17, mixed, staircase, 60, {memory_drag_of(0.5, 1.5, 6.0, 0.05)}, 109},
      {"oak", "stage", "cascade", "workshop", 15, mixed, multisine, 60, {asymmetric_viscous_of(0.06)}, 110},
      {"pine", "elbow", "cascade", "quiet", 18, mixed, multisine, 60, {}, 111},
      {"rowan", "wrist", "pid", "bench", 17, mixed, staircase, 60, {gravity_of(0.06, 0.5)}, 112},
      {"spruce",
       "stage",
       "pd",
       "bench",
       17,
       mixed,
       multisine,
       60,
       {spring_of(0.12, 0.15, 0.2), rational_stribeck_of(0.15, 0.04)},
       113},
      {"willow", "elbow", "pd", "bench", 19, mixed, multisine, 60, {backlash_of(0.45, 0.0003, 45.0)}, 114},
      {"yew", "elbow", "soft_pd", "quiet", 18, mixed, staircase, 60, {sloshing_of(0.03, 1.1, 0.1)}, 115},
  };
  return table;
}

HiddenEffects laws_of(std::vector<ConcealedEffect> const& effects) {
  HiddenEffects laws;
  for (auto const& effect : effects) {
    if (effect.law) laws.push_back(effect.law);
  }
  return laws;
}

Case made(Row const& row) {
  Case made_case;
  made_case.name = row.name;
  made_case.rig = {joint_named(row.joint), controller_named(row.controller), noise_named(row.noise), row.encoder_bits};
  made_case.train = row.train;
  made_case.validate = row.validate;
  made_case.train_s = row.train_s;
  made_case.seed = row.seed;
  for (auto const& put_into : row.effects) made_case.effects.push_back(put_into(made_case.rig.joint));
  return made_case;
}

}  // namespace

HiddenEffects Case::laws() const { return laws_of(effects); }

std::string Case::expected_verdict() const {
  if (!expected.empty()) return expected;
  if (effects.empty()) return "none";
  for (auto const& effect : effects) {
    if (effect.name.empty()) return "unexplained";
  }
  return "named";
}

Excitation Case::excitation(bool for_training) const {
  double const duration_s = for_training ? train_s : validate_s;
  return {for_training ? train : validate, rig.joint.limits, duration_s, 2 * seed + (for_training ? 0 : 1)};
}

RunPlan Case::plan(Excitation const& excitation, bool for_training) const {
  return {excitation, for_training ? train_s : validate_s, 2 * seed + (for_training ? 0 : 1)};
}

Rig with_faults(Rig rig, std::vector<ConcealedEffect> const& effects) {
  for (auto const& effect : effects) {
    if (effect.fault) rig.instruments.push_back(effect.fault);
  }
  return rig;
}

LoopRun training_run(Case const& one_case, Rig const& rig, std::vector<ConcealedEffect> const& effects, double step_s) {
  Excitation const excitation = one_case.excitation(true);
  RunPlan plan = one_case.plan(excitation, true);
  plan.step_s = step_s;
  return run_closed_loop(with_faults(rig, effects), laws_of(effects), plan);
}

std::vector<Case> const& sealed_cases() {
  static std::vector<Case> const cases = [] {
    std::vector<Case> all;
    for (auto const& row : rows()) all.push_back(made(row));
    return all;
  }();
  return cases;
}

Case const& sealed_case(std::string const& name) {
  for (auto const& candidate : sealed_cases()) {
    if (candidate.name == name) return candidate;
  }
  throw std::invalid_argument("no sealed case named " + name);
}

Case clean_case(std::uint64_t seed, std::string const& sticking) {
  Random random(seed, "clean rig");
  auto pick = [&](std::vector<std::string> const& names) { return names[random.index(names.size())]; };
  JointDesign joint = joint_named(pick({"elbow", "wrist", "shoulder", "stage"}));
  Baseline& base = joint.baseline;
  base.inertia *= random.between(0.75, 1.3);
  base.viscous *= random.between(0.6, 1.5);
  base.coulomb *= random.between(0.6, 1.5);
  base.offset *= random.between(-2.0, 2.0);

  Case clean;
  clean.name = "clean_" + std::to_string(seed) + (sticking == "coulomb" ? "" : "_" + sticking);
  clean.rig = {joint, controller_named(pick({"pd", "soft_pd", "pid", "cascade", "stiff_cascade"})),
               noise_named(pick({"quiet", "bench", "workshop"})), 16 + static_cast<int>(random.index(4))};
  double const encoder_step = joint.travel_per_turn / std::exp2(clean.rig.encoder_bits);
  clean.rig.joint.baseline.sticking = sticking_named(sticking, encoder_step);
  clean.train = random.uniform() < 0.6 ? Recipe::mixed : random.uniform() < 0.5 ? Recipe::staircase : Recipe::multisine;
  clean.validate = clean.train == Recipe::multisine ? Recipe::staircase : Recipe::multisine;
  clean.train_s = 40.0;
  clean.validate_s = 20.0;
  clean.seed = 1000 + seed;
  return clean;
}

}  // namespace concealed
