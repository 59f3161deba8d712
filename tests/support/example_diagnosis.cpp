#include "support/example_diagnosis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/account/sentences.hpp"
#include "engine/effects/effect.hpp"

namespace torquescope::example {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double stribeck_level = 0.35, stribeck_speed = 0.06;  // N m, rad/s
constexpr double cogging_level = 0.06;                          // N m, 12 waves per turn

double stribeck_torque(double dq) {
  return std::copysign(stribeck_level, dq) * std::exp(-std::abs(dq) / stribeck_speed) - 0.1 * dq;
}
double cogging_torque(double q) { return cogging_level * std::cos(12.0 * q); }

// looks like noise, is a formula
double wobble(double i) { return std::sin(12.9898 * i) * std::cos(78.233 * i + 0.3 * i * i); }

// an axis whose cells hold `shape` before and a tenth of it after
template <class Shape>
MapAxis axis_of(std::string name, std::string unit, double from, double to, bool is_spectrum, double energy_share,
                Shape&& shape) {
  MapAxis axis;
  axis.axis = std::move(name);
  axis.unit = std::move(unit);
  axis.is_spectrum = is_spectrum;
  axis.energy_share = energy_share;
  axis.p = energy_share > 0.02 ? 1.0 / 201.0 : 0.43;
  constexpr int n_cells = 54;
  for (int i = 0; i < n_cells; ++i) {
    MapCell cell;
    cell.from = from + (to - from) * i / n_cells;
    cell.to = from + (to - from) * (i + 1) / n_cells;
    cell.samples = 20 + 11 * (i % 7);
    double const middle = 0.5 * (cell.from + cell.to);
    cell.replicate_std = 0.008 + 0.001 * std::abs(wobble(i));
    double const chance = 0.8 * cell.replicate_std * wobble(i + 0.5);
    cell.replicate_mean = is_spectrum ? 0.01 : 0.001 * wobble(i + 0.25);
    cell.mean_residual = cell.replicate_mean + shape(middle) + chance;
    if (is_spectrum) cell.mean_residual = std::abs(cell.mean_residual);
    cell.z = (cell.mean_residual - cell.replicate_mean) / cell.replicate_std;
    cell.after_residual = cell.replicate_mean + 0.1 * shape(middle) + chance;
    cell.after_z = (cell.after_residual - cell.replicate_mean) / cell.replicate_std;
    axis.cells.push_back(cell);
  }
  return axis;
}

MismatchRegion region_of(MapAxis const& axis, double from, double to, double time_share, double energy_share) {
  return {{axis.axis, from, to, axis.unit}, time_share, energy_share, 0.93};
}

std::vector<MapAxis> invented_map() {
  auto const nothing = [](double) { return 0.0; };
  std::vector<MapAxis> map;
  map.push_back(
      axis_of("velocity", "rad/s", -1.1, 1.0, false, 0.46, [](double dq) { return 0.35 * stribeck_torque(dq); }));
  map.back().regions.push_back(region_of(map.back(), -0.12, 0.12, 0.17, 0.46));
  map.push_back(axis_of("since_velocity_reversal", "rad", 0.0, 0.4, false, 0.31,
                        [](double x) { return 0.1 * std::exp(-x / 0.03); }));
  map.push_back(axis_of("since_torque_reversal", "rad", 0.0, 0.4, false, 0.0, nothing));
  map.push_back(axis_of("load", "N m", -1.5, 1.4, false, 0.09, [](double t) { return t > 1.0 ? 0.03 : 0.0; }));
  map.back().regions.push_back(region_of(map.back(), 0.95, 1.29, 0.06, 0.09));
  map.push_back(axis_of("position", "rad", -0.8, 0.9, false, 0.11, [](double q) { return 0.5 * cogging_torque(q); }));
  map.push_back(axis_of("acceleration", "rad/s2", -6.0, 6.0, false, 0.0, nothing));
  map.push_back(axis_of("time", "s", 0.0, 60.0, false, 0.0, nothing));
  map.push_back(
      axis_of("order", "1/rad", 1.0, 28.0, true, 0.12, [](double n) { return std::abs(n - 12.0) < 0.5 ? 0.06 : 0.0; }));
  map.back().regions.push_back(region_of(map.back(), 11.5, 12.5, 1.0, 0.12));
  map.push_back(axis_of("frequency", "Hz", 0.5, 25.0, true, 0.0, nothing));
  // a speed the joint never had: no samples, nothing measured
  map.front().cells[40].samples = 0;
  map.front().cells[40].mean_residual = map.front().cells[40].z = unknown;
  map.front().cells[40].after_residual = map.front().cells[40].after_z = unknown;
  return map;
}

// all of the catalogue, strength falling; the first ones as the verdict says
std::vector<Candidate> invented_candidates() {
  std::vector<Candidate> candidates;
  auto const add = [&](std::string const& name, double z, double p, double q, double gain, double cv, Decision decision,
                       std::string reason) {
    Effect const* effect = find_effect(name);
    candidates.push_back({name, word(effect->family()), z, p, q, gain, cv, decision, std::move(reason)});
  };
  double const least_p = 1.0 / 201.0;
  add("stribeck", 11.8, least_p, 0.004, 0.71, 0.284, Decision::named, "explains most of the mismatch");
  add("presliding", 10.9, least_p, 0.004, 0.69, 0.276, Decision::equivalent,
      "this motion cannot tell it from stribeck");
  add("cogging", 7.4, least_p, 0.004, 0.12, 0.061, Decision::named, "named beside stribeck");
  add("power_law_viscous", 6.1, 0.015, 0.060, 0.31, 0.122, Decision::rejected, "nothing is left of it beside stribeck");
  double z = 3.6;
  for (Effect const* effect : effect_choices()) {
    bool const listed = std::any_of(candidates.begin(), candidates.end(),
                                    [&](Candidate const& one) { return one.name == effect->name(); });
    if (listed || effect->family() == EffectFamily::baseline || candidates.size() == 34) continue;
    z -= 0.15;
    double const p = std::min(1.0, 0.02 * std::exp(0.25 * static_cast<double>(candidates.size())));
    add(effect->name(), z, p, std::min(1.0, 3.0 * p), std::max(0.0, 0.01 * z), 0.002 * z, Decision::rejected,
        "no stronger than chance");
  }
  // the catalogue may be shorter than the picture: the rest are its plain terms
  for (Effect const* effect : effect_choices()) {
    if (candidates.size() == 34) break;
    if (effect->family() == EffectFamily::baseline)
      add(effect->name(), unknown, 1.0, 1.0, 0.0, unknown, Decision::not_tested, "a term of the model already");
  }
  return candidates;
}

std::vector<ParameterEstimate> invented_parameters(double viscous, double coulomb) {
  return {{"inertia", "kg m2", 0.0905, 0.0899, 0.0911},
          {"viscous", "N m s/rad", viscous, viscous - 0.012, viscous + 0.012},
          {"coulomb", "N m", coulomb, coulomb - 0.009, coulomb + 0.009},
          {"offset", "N m", -0.012, -0.018, -0.006}};
}

EffectCurve curve_over(std::string axis, std::string unit, double from, double to, double (*torque)(double)) {
  EffectCurve curve;
  curve.axis = {std::move(axis), from, to, std::move(unit)};
  constexpr int n = 40;
  for (int i = 0; i < n; ++i) {
    double const at = from + (to - from) * (i + 0.5) / n;
    curve.at.push_back(at);
    curve.modelled.push_back(torque(at));
    curve.partial.push_back(torque(at) + 0.008 * wobble(i));
    curve.spread.push_back(0.009);
  }
  return curve;
}

NamedEffect named(std::string const& name) {
  Effect const& effect = *find_effect(name);
  NamedEffect result;
  result.name = name;
  result.family = word(effect.family());
  result.title = effect.title();
  result.equation = effect.equation();
  result.acts_on = word(effect.acts_on());
  result.p = result.q = 1.0 / 201.0;
  return result;
}

NamedEffect invented_stribeck() {
  NamedEffect effect = named("stribeck");
  effect.equivalent = {"presliding"};
  effect.z = 11.8;
  effect.gain = {0.281, 0.284};
  effect.region = {"velocity", -0.12, 0.12, "rad/s"};
  effect.places = {effect.region};
  effect.rms = 0.09;
  effect.peak = 0.34;
  effect.parameters = {{"stribeck", "N m", 0.354, 0.342, 0.366},
                       {"stribeck_speed", "rad/s", 0.0601, 0.0552, 0.0648},
                       {"stribeck_exponent", "1", 1.02, 0.91, 1.14}};
  effect.curve = curve_over("velocity", "rad/s", -1.1, 1.0, stribeck_torque);
  return effect;
}

NamedEffect invented_cogging() {
  NamedEffect effect = named("cogging");
  effect.z = 7.4;
  effect.gain = {0.058, 0.061};
  effect.region = {"order", 11.5, 12.5, "1/rad"};
  effect.places = {effect.region};
  effect.rms = 0.042;
  effect.peak = 0.06;
  effect.parameters = {{"cogging_cos", "N m", 0.0598, 0.0571, 0.0625},
                       {"cogging_sin", "N m", -0.0011, -0.0040, 0.0018},
                       {"cogging_order", "1/rad", 12.0, 11.97, 12.03}};
  effect.curve = curve_over("position", "rad", -0.8, 0.9, cogging_torque);
  return effect;
}

TorqueTrace invented_trace() {
  TorqueTrace trace;
  trace.recording = "invented_unseen.csv";
  trace.rate_hz = 100.0;
  constexpr Eigen::Index n = 2400;
  trace.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, (n - 1) / trace.rate_hz);
  trace.position = 0.8 * (2.0 * pi / 8.0 * trace.time_s.array()).sin() + 0.05;
  trace.velocity = 0.8 * 2.0 * pi / 8.0 * (2.0 * pi / 8.0 * trace.time_s.array()).cos();
  trace.torque.resize(n);
  trace.before.resize(n);
  trace.after.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const dq = trace.velocity[k], noise = 0.02 * wobble(0.37 * static_cast<double>(k));
    double const missing = 0.35 * stribeck_torque(dq) + cogging_torque(trace.position[k]);
    trace.torque[k] = 0.62 * dq + std::copysign(0.5, dq) + missing + noise;
    bool const masked = std::abs(dq) < 0.02;
    trace.before[k] = masked ? unknown : missing + noise;
    trace.after[k] = masked ? unknown : 0.1 * missing + noise;
  }
  return trace;
}

// as far as a fit alone goes
JointDiagnosis fitted_joint() {
  JointDiagnosis joint;
  joint.unit_position = "rad";
  joint.unit_torque = "N m";
  joint.baseline = invented_parameters(0.41, 0.52);
  joint.train_relerr = 0.1182;
  return joint;
}

JointDiagnosis invented_joint() {
  JointDiagnosis joint = fitted_joint();
  joint.validation_relerr = 0.1213;
  joint.cv_relerr = 0.1196;
  joint.map = invented_map();
  joint.candidates = invented_candidates();
  joint.effects = {invented_stribeck(), invented_cogging()};
  joint.augmented = invented_parameters(0.64, 0.44);
  joint.effect_levels = {1.05, -0.95, 0.0905};
  for (auto const& effect : joint.effects)
    joint.augmented.insert(joint.augmented.end(), effect.parameters.begin(), effect.parameters.end());
  joint.augmented_train_relerr = 0.0611;
  joint.augmented_validation_relerr = 0.0623;
  joint.augmented_cv_relerr = 0.0617;
  joint.budget = {0.03, 0.67, 0.05, 0.25};
  joint.unexplained = {{{"load", 0.95, 1.29, "N m"}, 0.09}};
  joint.excitation = {{"triangular strokes of 0.2, 1 and 5 mrad", {"stribeck", "presliding"}}};
  joint.nuisances = {"offset", "phase of cogging"};
  joint.traces = {invented_trace()};
  joint.forward = {{"invented_unseen.csv", 0.0124, 0.0031, 0.57, 1.5e-5}};
  joint.replicates = 200;
  joint.omnibus_p = 1.0 / 201.0;
  joint.mismatch_rms = 0.104;
  joint.left_rms = 0.012;
  for (int i = 0; i < 200; ++i) joint.replicate_energy.push_back(0.26 + 0.01 * wobble(i));
  return joint;
}

Diagnosis of(Verdict verdict, JointDiagnosis joint, std::string finding = {}, std::string way_out = {}) {
  Diagnosis diagnosis;
  diagnosis.verdict = verdict;
  for (auto& effect : joint.effects) effect.sentence = effect_sentence(joint, effect);
  diagnosis.joints.push_back(std::move(joint));
  diagnosis.seed = 7;
  diagnosis.finding = std::move(finding);
  diagnosis.way_out = std::move(way_out);
  diagnosis.reason = reason_sentence(diagnosis);
  return diagnosis;
}

// no effect is named: before is after
JointDiagnosis without_effects() {
  JointDiagnosis joint = invented_joint();
  joint.effects.clear();
  joint.augmented = joint.baseline;
  joint.augmented_train_relerr = joint.train_relerr;
  joint.augmented_validation_relerr = joint.validation_relerr;
  joint.augmented_cv_relerr = joint.cv_relerr;
  joint.excitation.clear();
  joint.nuisances.clear();
  for (auto& candidate : joint.candidates) {
    candidate.decision = Decision::rejected;
    candidate.reason = "no stronger than chance";
  }
  return joint;
}

}  // namespace

Diagnosis invented_diagnosis() { return of(Verdict::named, invented_joint()); }

Diagnosis invented_class() {
  JointDiagnosis joint = invented_joint();
  joint.effects.resize(1);
  joint.candidates[2].decision = Decision::rejected;
  joint.candidates[2].reason = "explains less than stribeck";
  return of(Verdict::one_of_class, std::move(joint));
}

Diagnosis invented_none() {
  JointDiagnosis joint = without_effects();
  for (auto& axis : joint.map) {
    axis.energy_share = 0.0;
    axis.p = 0.5;
    axis.regions.clear();
    for (auto& cell : axis.cells) cell.mean_residual = cell.after_residual, cell.z = cell.after_z;
  }
  for (auto& candidate : joint.candidates) candidate.z = 0.2 * candidate.z, candidate.p = candidate.q = 0.8;
  joint.unexplained.clear();
  joint.omnibus_p = 0.4129;
  joint.budget = {0.01, 0.0, 0.0, 0.99};
  joint.power_sentence = "A 5 % Stribeck effect would have shown.";
  return of(Verdict::none, std::move(joint));
}

Diagnosis invented_unexplained() {
  JointDiagnosis joint = without_effects();
  joint.unexplained = {{{"position", 0.4, 0.9, "rad"}, 0.31}};
  joint.budget = {0.03, 0.0, 0.64, 0.33};
  return of(Verdict::unexplained, std::move(joint));
}

Diagnosis invented_insufficient() {
  JointDiagnosis joint = fitted_joint();
  joint.excitation = {{"the other direction of motion", {"viscous", "coulomb"}}};
  return of(Verdict::insufficient, std::move(joint), "only one direction of motion was recorded",
            "record both directions");
}

Diagnosis invented_data_fault() {
  JointDiagnosis joint = without_effects();
  NamedEffect effect = named("delay");
  effect.z = 14.2;
  effect.region = {"acceleration", -6.0, 6.0, "rad/s2"};
  effect.places = {effect.region};
  effect.rms = 0.05;
  effect.peak = 0.21;
  effect.gain = {0.52, 0.51};
  effect.parameters = {{"delay", "s", 0.0038, 0.0037, 0.0039}, {"delay_span", "s", 0.004, 0.002, 0.006}};
  joint.effects = {std::move(effect)};
  return of(Verdict::data_fault, std::move(joint), "", "shift it (recording.delay_s = -0.0038) or fix the logger");
}

}  // namespace torquescope::example
