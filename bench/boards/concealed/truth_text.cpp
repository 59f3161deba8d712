// truth.json: everything about a case that its recordings do not say (read by score.py).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "concealed/case_writer.hpp"
#include "concealed/decoys.hpp"
#include "concealed/drawable_effects.hpp"

namespace concealed {
namespace {

using Json = nlohmann::ordered_json;

Json size_json(EffectSize const& size) {
  return {{"snr_eff", size.snr()},
          {"torque_share", size.torque_share()},
          {"residual_rms", size.residual_rms},
          {"noise_rms", size.noise_rms},
          {"torque_rms", size.torque_rms}};
}

Json region_json(TruthRegion const& region) {
  return {{"axis", region.axis},
          {"intervals", region.intervals()},
          {"edges", region.edges},
          {"occupancy", region.occupancy},
          {"inside", region.inside}};
}

Json effect_json(ConcealedEffect const& effect, EffectSize const& size, std::vector<TruthRegion> const& regions) {
  Json out = {{"name", effect.name},     {"families", effect.families},
              {"form", effect.form},     {"catalogue_form", effect.catalogue_form},
              {"size", size_json(size)}, {"parameters", Json::array()},
              {"regions", Json::array()}};
  for (auto const& parameter : effect.parameters) {
    out["parameters"].push_back({{"name", parameter.name}, {"value", parameter.value}, {"unit", parameter.unit}});
  }
  for (auto const& region : regions) out["regions"].push_back(region_json(region));
  return out;
}

Json baseline_json(Baseline const& baseline) {
  Json out = {{"inertia", baseline.inertia},
              {"viscous", baseline.viscous},
              {"coulomb", baseline.coulomb},
              {"offset", baseline.offset}};
  if (baseline.has_gravity()) {
    out["gravity_sin"] = baseline.gravity_sin;
    out["gravity_cos"] = baseline.gravity_cos;
  }
  return out;
}

}  // namespace

std::string words_text() {
  Json effects = Json::array();
  auto add = [&](ConcealedEffect const& effect, JointDesign const& joint) {
    if (effect.name.empty()) return;
    Json one = {{"name", effect.name}, {"families", effect.families}, {"parameters", Json::array()}};
    one["prismatic"] = !joint.revolute;
    for (auto const& parameter : effect.parameters) {
      one["parameters"].push_back({{"name", parameter.name}, {"unit", parameter.unit}});
    }
    if (std::find(effects.begin(), effects.end(), one) == effects.end()) effects.push_back(one);
  };
  for (auto const& one_case : sealed_cases()) {
    for (auto const& effect : one_case.effects) add(effect, one_case.rig.joint);
  }
  for (auto const& effect : catalogue_effects()) {
    for (auto const& name : effect.joints) {
      Random random(1, "words");
      JointDesign const joint = joint_named(name);
      add(effect.draw(random, joint)(effect.usual)(joint), joint);
    }
  }
  // in an order that tells nothing about the cases
  std::sort(effects.begin(), effects.end(), [](Json const& a, Json const& b) { return a.dump() < b.dump(); });
  return Json{{"effects", effects}, {"may_name", measurement_names()}, {"axes", truth_axes()}}.dump(1) + "\n";
}

namespace {

Json relerr_json(Relerr const& relerr) {
  return {
      {"baseline", relerr.baseline}, {"oracle", relerr.oracle}, {"oracle_of_recording", relerr.oracle_of_recording}};
}

}  // namespace

std::string truth_text(Case const& one_case, CaseReport const& report) {
  Rig const& rig = one_case.rig;
  Json truth = {
      {"schema", 1},
      {"case", one_case.name},
      {"seed", one_case.seed},
      {"expected", one_case.expected_verdict()},
      {"rig",
       {{"joint", rig.joint.name},
        {"controller", rig.controller.name},
        {"law", to_text(rig.controller.law)},
        {"noise", rig.noise.name},
        {"encoder_bits", rig.encoder_bits},
        {"train", to_text(one_case.train)},
        {"validate", to_text(one_case.validate)}}},
      {"baseline", baseline_json(rig.joint.baseline)},
      {"absorbed_baseline", baseline_json(report.fit.parameters)},
      {"size", size_json(report.together)},
      {"relerr", {{"train", relerr_json(report.train_relerr)}, {"validate", relerr_json(report.validate_relerr)}}},
      {"step_error", {{"torque", report.step_error.torque}, {"position", report.step_error.position}}},
      {"effects", Json::array()}};
  if (!one_case.drawn.empty()) {
    truth["tier"] = one_case.tier;
    truth["drawn"] = one_case.drawn;
    truth["wanted_snr"] = one_case.wanted_snr;
    if (one_case.plant_draws > 1) truth["plant_draws"] = one_case.plant_draws;
  }
  if (one_case.expected_verdict() == "measurement") truth["may_name"] = measurement_names();
  for (std::size_t i = 0; i < one_case.effects.size(); ++i) {
    truth["effects"].push_back(effect_json(one_case.effects[i], report.alone[i], report.regions[i]));
  }
  return truth.dump(1) + "\n";
}

}  // namespace concealed
