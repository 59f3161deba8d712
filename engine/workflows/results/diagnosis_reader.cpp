#include "engine/workflows/results/diagnosis_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/experiment/stored_objects.hpp"

namespace torquescope {

namespace {

constexpr char root[] = "/diagnosis";

// Version 0.1 had errors of other rows: they would be told as those of all samples. A joint without an error (given up
// before its first fit) has none of other rows, whatever its word
void refuse_other_rows(ResultReader const& reader, StoredObjects const& in, std::string const& joint) {
  std::string const rows = in.text(joint, "rows");
  if (rows == "all" || !std::isfinite(in.number(joint, "train_relerr"))) return;
  Problem problem{ExitCode::bad_data, fmt::format("the errors of {} are of rows {}: it was made by Torquescope 0.1",
                                                  reader.name().string(), rows.empty() ? "moving one way" : rows)};
  problem.help = "delete it and run torquescope diagnose again with the job";
  throw Error(problem);
}

AxisInterval read_interval(StoredObjects const& in, std::string const& group, std::string const& name) {
  return {in.text(group, name + "_axis"), in.number(group, name + "_from"), in.number(group, name + "_to"),
          in.text(group, name + "_unit")};
}

std::vector<ParameterEstimate> read_parameters(StoredObjects const& in, std::string const& group) {
  auto const names = in.text_column(group + "/names"), units = in.text_column(group + "/units");
  auto const values = in.numbers(group + "/values"), intervals = in.numbers(group + "/ci95");
  in.check_same_length(group, names.size(), units, values);
  in.check_same_length(group, 2 * names.size(), intervals);
  std::vector<ParameterEstimate> parameters;
  for (std::size_t i = 0; i < names.size(); ++i)
    parameters.push_back({names[i], units[i], values[i], intervals[2 * i], intervals[2 * i + 1]});
  return parameters;
}

std::vector<MismatchRegion> read_regions(StoredObjects const& in, std::string const& group, MapAxis const& axis) {
  auto const from = in.numbers(group + "/from"), to = in.numbers(group + "/to");
  auto const time = in.numbers(group + "/time_share"), energy = in.numbers(group + "/energy_share");
  auto const repeatable = in.numbers(group + "/repeatable_share");
  in.check_same_length(group, from.size(), to, time, energy, repeatable);
  std::vector<MismatchRegion> regions;
  for (std::size_t i = 0; i < from.size(); ++i)
    regions.push_back({{axis.axis, from[i], to[i], axis.unit}, time[i], energy[i], repeatable[i]});
  return regions;
}

MapAxis read_map_axis(StoredObjects const& in, std::string const& map, std::string const& name) {
  std::string const group = map + "/" + name;
  MapAxis axis;
  axis.axis = name;
  axis.unit = in.text(group, "unit");
  axis.is_spectrum = in.whole(group, "is_spectrum") != 0;
  axis.energy_share = in.number(group, "energy_share");
  axis.p = in.number(group, "p");
  auto const column = [&](char const* dataset) { return in.numbers(group + "/" + dataset); };
  auto const from = column("from"), to = column("to"), residual = column("mean_residual");
  auto const replicate_mean = column("twin_mean"), replicate_std = column("twin_std"), z = column("z");
  auto const after_residual = column("after_residual"), after_z = column("after_z");
  auto const samples = in.whole_numbers(group + "/samples");
  in.check_same_length(group, from.size(), to, residual, replicate_mean, replicate_std, z, after_residual, after_z,
                       samples);
  for (std::size_t i = 0; i < from.size(); ++i)
    axis.cells.push_back({from[i], to[i], samples[i], residual[i], replicate_mean[i], replicate_std[i], z[i],
                          after_z[i], after_residual[i]});
  axis.regions = read_regions(in, group + "/regions", axis);
  return axis;
}

std::vector<Candidate> read_candidates(StoredObjects const& in, std::string const& group) {
  constexpr std::array decisions{Decision::named, Decision::equivalent, Decision::measurement, Decision::rejected,
                                 Decision::not_tested};
  auto const column = [&](char const* dataset) { return in.numbers(group + "/" + dataset); };
  auto const words = [&](char const* dataset) { return in.text_column(group + "/" + dataset); };
  auto const names = words("names"), families = words("families"), decided = words("decisions");
  auto const reasons = words("reasons");
  auto const z = column("z"), p = column("p"), q = column("q"), gain = column("gain");
  auto const cv_gain = column("cv_gain");
  in.check_same_length(group, names.size(), families, decided, reasons, z, p, q, gain, cv_gain);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < names.size(); ++i)
    candidates.push_back({names[i], families[i], z[i], p[i], q[i], gain[i], cv_gain[i],
                          in.choice(decided[i], decisions, group), reasons[i]});
  return candidates;
}

EffectCurve read_curve(StoredObjects const& in, std::string const& group) {
  EffectCurve curve;
  if (!in.exists(group)) return curve;
  curve.axis = read_interval(in, group, "range");
  curve.at = in.numbers(group + "/at");
  curve.partial = in.numbers(group + "/partial");
  curve.modelled = in.numbers(group + "/modelled");
  curve.spread = in.numbers(group + "/spread");
  in.check_same_length(group, curve.at.size(), curve.partial, curve.modelled, curve.spread);
  return curve;
}

NamedEffect read_effect(StoredObjects const& in, std::string const& group) {
  NamedEffect effect;
  effect.name = in.text(group, "name");
  effect.family = in.text(group, "family");
  effect.title = in.text(group, "title");
  effect.equation = in.text(group, "equation");
  effect.acts_on = in.text(group, "acts_on");
  effect.equivalent = in.texts(group, "equivalent");
  effect.p = in.number(group, "p");
  effect.q = in.number(group, "q");
  effect.z = in.number(group, "z");
  effect.gain = {in.number(group, "gain_train"), in.number(group, "gain_cv")};
  effect.region = read_interval(in, group, "region");
  auto const from = in.numbers(group + "/places/from"), to = in.numbers(group + "/places/to");
  in.check_same_length(group + "/places", from.size(), to);
  for (std::size_t i = 0; i < from.size(); ++i)
    effect.places.push_back({effect.region.axis, from[i], to[i], effect.region.unit});
  if (effect.places.empty()) effect.places = {effect.region};
  effect.rms = in.number(group, "rms");
  effect.peak = in.number(group, "peak");
  effect.sentence = in.text(group, "sentence");
  effect.parameters = read_parameters(in, group + "/parameters");
  effect.curve = read_curve(in, group + "/curve");
  return effect;
}

TorqueTrace read_trace(StoredObjects const& in, std::string const& group) {
  TorqueTrace trace;
  trace.recording = in.text(group, "recording");
  trace.rate_hz = in.number(group, "rate_hz");
  auto const vector = [&](char const* dataset) -> Eigen::VectorXd {
    auto const values = in.numbers(group + "/" + dataset);
    return Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  trace.time_s = vector("time");
  trace.torque = vector("torque");
  trace.before = vector("before");
  trace.after = vector("after");
  trace.velocity = vector("velocity");
  trace.position = vector("position");
  return trace;
}

void read_lists(StoredObjects const& in, std::string const& group, JointDiagnosis& joint) {
  std::string const left = group + "/unexplained";
  auto const axes = in.text_column(left + "/axes"), units = in.text_column(left + "/units");
  auto const from = in.numbers(left + "/from"), to = in.numbers(left + "/to");
  auto const share = in.numbers(left + "/energy_share");
  in.check_same_length(left, axes.size(), units, from, to, share);
  for (std::size_t i = 0; i < axes.size(); ++i)
    joint.unexplained.push_back({{axes[i], from[i], to[i], units[i]}, share[i]});

  std::string const forward = group + "/forward";
  auto const recordings = in.text_column(forward + "/recordings");
  auto const before = in.numbers(forward + "/before_rms"), after = in.numbers(forward + "/after_rms");
  auto const motion = in.numbers(forward + "/motion_rms"), step = in.numbers(forward + "/encoder_step");
  in.check_same_length(forward, recordings.size(), before, after, motion, step);
  for (std::size_t i = 0; i < recordings.size(); ++i)
    joint.forward.push_back({recordings[i], before[i], after[i], motion[i], step[i]});

  for (auto const& advice : in.numbered(group + "/excitation", "advice"))
    joint.excitation.push_back({in.text(advice, "lacks"), in.texts(advice, "would_separate")});
  for (auto const& effect : in.numbered(group + "/effects", "effect")) joint.effects.push_back(read_effect(in, effect));
  for (auto const& trace : in.numbered(group + "/traces", "trace")) joint.traces.push_back(read_trace(in, trace));
}

void read_joint_attributes(StoredObjects const& in, std::string const& group, JointDiagnosis& joint) {
  joint.joint = static_cast<int>(in.whole(group, "joint"));
  joint.name = in.text(group, "name");
  joint.unit_position = in.text(group, "unit_position");
  joint.unit_torque = in.text(group, "unit_torque");
  joint.train_relerr = in.number(group, "train_relerr");
  joint.validation_relerr = in.number(group, "validation_relerr");
  joint.cv_relerr = in.number(group, "cv_relerr");
  joint.augmented_train_relerr = in.number(group, "augmented_train_relerr");
  joint.augmented_validation_relerr = in.number(group, "augmented_validation_relerr");
  joint.augmented_cv_relerr = in.number(group, "augmented_cv_relerr");
  joint.explained_share = in.number(group, "explained_share");
  joint.effect_levels = {in.number(group, "friction_sign_forward"), in.number(group, "friction_sign_backward"),
                         in.number(group, "baseline_inertia")};
  joint.budget = {in.number(group, "budget_parameter_error"), in.number(group, "budget_missing_physics"),
                  in.number(group, "budget_unexplained"), in.number(group, "budget_noise")};
  joint.nuisances = in.texts(group, "nuisances");
  joint.replicates = static_cast<std::size_t>(std::max<std::int64_t>(0, in.whole(group, "twins")));
  joint.omnibus_p = in.number(group, "omnibus_p");
  joint.mismatch_rms = in.number(group, "mismatch_rms");
  joint.left_rms = in.number(group, "left_rms");
  joint.power_sentence = in.text(group, "power_sentence");
  joint.timing_sentence = in.text(group, "timing_sentence");
  joint.validation_torque_energy = in.number(group, "validation_torque_energy");
}

JointDiagnosis read_joint(StoredObjects const& in, std::string const& group) {
  JointDiagnosis joint;
  read_joint_attributes(in, group, joint);
  joint.baseline = read_parameters(in, group + "/baseline");
  joint.augmented = read_parameters(in, group + "/augmented");
  if (in.exists(group + "/map"))
    for (auto const& axis : in.texts(group + "/map", "order"))
      joint.map.push_back(read_map_axis(in, group + "/map", axis));
  joint.candidates = read_candidates(in, group + "/candidates");
  joint.replicate_energy = in.numbers(group + "/twin_energy");
  read_lists(in, group, joint);
  return joint;
}

constexpr std::array verdicts{Verdict::none,        Verdict::named,        Verdict::one_of_class, Verdict::partly,
                              Verdict::unexplained, Verdict::insufficient, Verdict::data_fault};

// each joint of an arm has its own; a single joint's is that of the diagnosis
void read_verdicts(StoredObjects const& in, Diagnosis& diagnosis) {
  auto const groups = in.numbered(root, "joint");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    JointDiagnosis& joint = diagnosis.joints[i];
    joint.reason = in.text(groups[i], "reason");
    joint.verdict = joint.reason.empty() ? diagnosis.verdict : in.choice(in.text(groups[i], "verdict"), verdicts, root);
  }
}

}  // namespace

bool has_diagnosis(ResultReader const& reader) { return reader.exists(root); }

Diagnosis read_diagnosis(ResultReader const& reader) {
  StoredObjects const in(reader);
  Diagnosis diagnosis;
  diagnosis.verdict = in.choice(reader.attribute<std::string>(root, "verdict"), verdicts, root);
  diagnosis.reason = in.text(root, "reason");
  diagnosis.finding = in.text(root, "finding");
  diagnosis.way_out = in.text(root, "way_out");
  diagnosis.seed = static_cast<std::uint64_t>(in.whole(root, "seed"));
  diagnosis.q = in.number(root, "q");
  for (auto const& group : in.numbered(root, "joint")) {
    refuse_other_rows(reader, in, group);
    diagnosis.joints.push_back(read_joint(in, group));
  }
  read_verdicts(in, diagnosis);
  std::string const arm = std::string(root) + "/arm";
  if (in.exists(arm)) {
    diagnosis.arm = WholeArmDiagnosis{{}, read_candidates(in, arm + "/candidates")};
    for (auto const& effect : in.numbered(arm + "/effects", "effect"))
      diagnosis.arm->effects.push_back(read_effect(in, effect));
  }
  return diagnosis;
}

std::string read_verdict_json(ResultReader const& reader) {
  auto const texts = reader.texts(std::string(root) + "/verdict_json");
  if (texts.size() != 1) throw contradiction(reader, std::string(root) + "/verdict_json", "not one text");
  return texts.front();
}

}  // namespace torquescope
