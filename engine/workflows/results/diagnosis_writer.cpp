#include "engine/workflows/results/diagnosis_writer.hpp"

#include <fmt/format.h>

#include "engine/account/verdict_lines.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/diagnosis_json.hpp"
#include "engine/workflows/results/model_code.hpp"
#include "engine/workflows/results/table_columns.hpp"

namespace torquescope {

namespace {

void text_list(ResultWriter& writer, std::string const& object, std::string const& name,
               std::vector<std::string> const& texts) {
  if (!texts.empty()) writer.attribute(object, name, texts);
}

void write_interval(ResultWriter& writer, std::string const& group, std::string const& name,
                    AxisInterval const& interval) {
  writer.attribute(group, name + "_axis", interval.axis);
  writer.attribute(group, name + "_from", interval.from);
  writer.attribute(group, name + "_to", interval.to);
  writer.attribute(group, name + "_unit", interval.unit);
}

void write_parameters(ResultWriter& writer, std::string const& group,
                      std::vector<ParameterEstimate> const& parameters) {
  using P = ParameterEstimate;
  TableColumns<P>(writer, group, parameters, "parameter")
      .texts(
          "parameter", [](P const& p) { return p.name; }, "parameter")
      .texts(
          "names", [](P const& p) { return p.name; }, "parameter names")
      .texts(
          "units", [](P const& p) { return p.unit; }, "parameter units")
      .numbers("values", [](P const& p) { return p.value; }, {"SI", "estimates"});
  std::vector<double> intervals;
  for (auto const& parameter : parameters) intervals.insert(intervals.end(), {parameter.lower, parameter.upper});
  if (intervals.empty()) return;
  writer.numbers(group + "/ci95", {parameters.size(), 2}, intervals,
                 Note{"SI", "95 % intervals: lower, upper"}.over({"parameter", "bound"}));
  write_bounds(writer, group);
}

void write_map_axis(ResultWriter& writer, std::string const& map, MapAxis const& axis, std::string const& torque) {
  std::string const group = map + "/" + axis.axis;
  writer.attribute(group, "unit", axis.unit);
  writer.attribute(group, "is_spectrum", axis.is_spectrum);
  writer.attribute(group, "energy_share", axis.energy_share);
  writer.attribute(group, "p", axis.p);
  if (axis.cells.empty()) return;

  std::vector<std::int64_t> samples;
  for (auto const& cell : axis.cells) samples.push_back(cell.samples);
  writer.whole_numbers(group + "/samples", {samples.size()}, samples, Note{"1", "rows in the cell"}.over({"centre"}));
  using C = MapCell;
  TableColumns<C>(writer, group, axis.cells, "centre")
      .numbers("from", [](C const& c) { return c.from; }, {axis.unit, "lower end of the cell"})
      .numbers("to", [](C const& c) { return c.to; }, {axis.unit, "upper end of the cell"})
      .numbers("centre", [](C const& c) { return 0.5 * (c.from + c.to); }, {axis.unit, "middle of the cell"})
      .numbers("mean_residual", [](C const& c) { return c.mean_residual; }, {torque, "mean residual"})
      .numbers("twin_mean", [](C const& c) { return c.replicate_mean; }, {torque, "mean residual of the replicates"})
      .numbers("twin_std", [](C const& c) { return c.replicate_std; },
               {torque, "spread of one replicate's mean residual"})
      .numbers("z", [](C const& c) { return c.z; }, {"1", "mean residual beyond the replicates, in their spread"})
      .numbers("after_residual", [](C const& c) { return c.after_residual; },
               {torque, "mean residual with everything named in the model"})
      .numbers("after_z", [](C const& c) { return c.after_z; }, {"1", "z with everything named in the model"});
  writer.plottable(group, "mean_residual", {"centre"});

  using R = MismatchRegion;
  TableColumns<R>(writer, group + "/regions", axis.regions)
      .numbers("from", [](R const& r) { return r.where.from; }, {axis.unit, "lower end of the region"})
      .numbers("to", [](R const& r) { return r.where.to; }, {axis.unit, "upper end of the region"})
      .numbers("time_share", [](R const& r) { return r.time_share; }, {"1", "share of the rows"})
      .numbers("energy_share", [](R const& r) { return r.energy_share; }, {"1", "share of the residual's energy"})
      .numbers("repeatable_share", [](R const& r) { return r.repeatable_share; },
               {"1", "share of the region's energy that replicates never show"});
}

void write_candidates(ResultWriter& writer, std::string const& group, std::vector<Candidate> const& candidates) {
  using C = Candidate;
  TableColumns<C>(writer, group, candidates, "candidate")
      .texts(
          "candidate", [](C const& c) { return c.name; }, "candidate")
      .texts(
          "names", [](C const& c) { return c.name; }, "effects, strongest first")
      .texts(
          "families", [](C const& c) { return c.family; }, "families")
      .texts(
          "decisions", [](C const& c) { return word(c.decision); }, "named, class, measurement, no, not tested")
      .texts(
          "reasons", [](C const& c) { return c.reason; }, "why this decision")
      .numbers("z", [](C const& c) { return c.z; }, {"1", "strength among the replicates"})
      .numbers("p", [](C const& c) { return c.p; }, {"1", "p-value from the replicates"})
      .numbers("q", [](C const& c) { return c.q; }, {"1", "false-discovery level"})
      .numbers("gain", [](C const& c) { return c.gain; }, {"1", "share of the mismatch explained"})
      .numbers("cv_gain", [](C const& c) { return c.cv_gain; },
               {"1", "of the mismatch on blocks of time that nothing was fitted to"});
}

void write_curve(ResultWriter& writer, std::string const& group, EffectCurve const& curve, std::string const& torque) {
  if (curve.at.empty()) return;
  write_interval(writer, group, "range", curve.axis);
  h5::Shape const shape{curve.at.size()};
  writer.numbers(group + "/at", shape, curve.at, Note{curve.axis.unit, curve.axis.axis}.over({"at"}));
  auto const column = [&](char const* name, std::vector<double> const& values, char const* long_name) {
    writer.numbers(group + "/" + name, shape, values, Note{torque, long_name}.over({"at"}));
  };
  column("partial", curve.partial, "effect and what is left, mean");
  column("modelled", curve.modelled, "effect as modelled, mean");
  column("spread", curve.spread, "spread of one replicate's mean");
  writer.plottable(group, "partial", {"at"});
}

void write_effect(ResultWriter& writer, std::string const& group, NamedEffect const& effect,
                  std::string const& torque) {
  writer.attribute(group, "name", effect.name);
  writer.attribute(group, "family", effect.family);
  writer.attribute(group, "title", effect.title);
  writer.attribute(group, "equation", effect.equation);
  writer.attribute(group, "acts_on", effect.acts_on);
  writer.attribute(group, "is_fault", is_fault(effect));
  text_list(writer, group, "equivalent", effect.equivalent);
  writer.attribute(group, "p", effect.p);
  writer.attribute(group, "q", effect.q);
  writer.attribute(group, "z", effect.z);
  writer.attribute(group, "gain_train", effect.gain.train);
  writer.attribute(group, "gain_cv", effect.gain.cv);
  write_interval(writer, group, "region", effect.region);
  TableColumns<AxisInterval>(writer, group + "/places", effect.places)
      .numbers("from", [](AxisInterval const& i) { return i.from; }, {effect.region.unit, "lower end"})
      .numbers("to", [](AxisInterval const& i) { return i.to; }, {effect.region.unit, "upper end"});
  writer.attribute(group, "rms", effect.rms);
  writer.attribute(group, "peak", effect.peak);
  writer.attribute(group, "sentence", effect.sentence);
  write_parameters(writer, group + "/parameters", effect.parameters);
  write_curve(writer, group + "/curve", effect.curve, torque);
}

void write_trace(ResultWriter& writer, std::string const& group, TorqueTrace const& trace,
                 JointDiagnosis const& joint) {
  writer.attribute(group, "recording", trace.recording);
  writer.attribute(group, "rate_hz", trace.rate_hz);
  auto const column = [&](char const* name, Eigen::VectorXd const& values, Note const& note) {
    auto const n = static_cast<std::size_t>(values.size());
    if (n > 0) writer.numbers(group + "/" + name, {n}, {values.data(), n}, note.over({"time"}));
  };
  column("time", trace.time_s, {"s", "time"});
  column("torque", trace.torque, {joint.unit_torque, "measured torque, filtered"});
  column("before", trace.before, {joint.unit_torque, "residual of the baseline"});
  column("after", trace.after, {joint.unit_torque, "residual with everything named in the model"});
  column("velocity", trace.velocity, {joint.unit_position + "/s", "velocity"});
  column("position", trace.position, {joint.unit_position, "position"});
  if (trace.torque.size() > 0) writer.plottable(group, "torque", {"time"});
}

void write_lists(ResultWriter& writer, std::string const& group, JointDiagnosis const& joint) {
  using U = UnexplainedPart;
  TableColumns<U>(writer, group + "/unexplained", joint.unexplained)
      .texts(
          "axes", [](U const& u) { return u.where.axis; }, "axes")
      .texts(
          "units", [](U const& u) { return u.where.unit; }, "units of the axes")
      .numbers("from", [](U const& u) { return u.where.from; }, {"SI", "lower ends"})
      .numbers("to", [](U const& u) { return u.where.to; }, {"SI", "upper ends"})
      .numbers("energy_share", [](U const& u) { return u.energy_share; }, {"1", "share of the residual's energy"});
  using F = ForwardSimulation;
  std::string const length = joint.unit_position;
  TableColumns<F>(writer, group + "/forward", joint.forward, "recording")
      .texts(
          "recording", [](F const& f) { return f.recording; }, "recording")
      .texts(
          "recordings", [](F const& f) { return f.recording; }, "recordings")
      .numbers("before_rms", [](F const& f) { return f.before_rms; }, {length, "position error of the baseline"})
      .numbers("after_rms", [](F const& f) { return f.after_rms; }, {length, "position error with everything named"})
      .numbers("motion_rms", [](F const& f) { return f.motion_rms; }, {length, "size of the motion"})
      .numbers("encoder_step", [](F const& f) { return f.encoder_step; }, {length, "encoder step"});
  for (std::size_t i = 0; i < joint.excitation.size(); ++i) {
    std::string const advice = fmt::format("{}/excitation/advice_{}", group, i + 1);
    writer.attribute(advice, "lacks", joint.excitation[i].lacks);
    text_list(writer, advice, "would_separate", joint.excitation[i].would_separate);
  }
}

void write_joint_attributes(ResultWriter& writer, std::string const& group, JointDiagnosis const& joint) {
  writer.attribute(group, "joint", std::int64_t{joint.joint});
  writer.attribute(group, "name", joint.name);
  if (!joint.reason.empty()) {
    writer.attribute(group, "verdict", word(joint.verdict));
    writer.attribute(group, "reason", joint.reason);
  }
  writer.attribute(group, "unit_position", joint.unit_position);
  writer.attribute(group, "unit_torque", joint.unit_torque);
  writer.attribute(group, "train_relerr", joint.train_relerr);
  writer.attribute(group, "validation_relerr", joint.validation_relerr);
  writer.attribute(group, "cv_relerr", joint.cv_relerr);
  writer.attribute(group, "augmented_train_relerr", joint.augmented_train_relerr);
  writer.attribute(group, "augmented_validation_relerr", joint.augmented_validation_relerr);
  writer.attribute(group, "augmented_cv_relerr", joint.augmented_cv_relerr);
  writer.attribute(group, "explained_share", joint.explained_share);
  writer.attribute(group, "friction_sign_forward", joint.effect_levels.forward);
  writer.attribute(group, "friction_sign_backward", joint.effect_levels.backward);
  writer.attribute(group, "baseline_inertia", joint.effect_levels.inertia);
  writer.attribute(group, "budget_parameter_error", joint.budget.parameter_error);
  writer.attribute(group, "budget_missing_physics", joint.budget.missing_physics);
  writer.attribute(group, "budget_unexplained", joint.budget.unexplained);
  writer.attribute(group, "budget_noise", joint.budget.noise);
  text_list(writer, group, "nuisances", joint.nuisances);
  writer.attribute(group, "rows", std::string("all"));  // what errors are of, for readers: version 0.1 had other rows
  writer.attribute(group, "twins", static_cast<std::int64_t>(joint.replicates));
  writer.attribute(group, "omnibus_p", joint.omnibus_p);
  writer.attribute(group, "mismatch_rms", joint.mismatch_rms);
  writer.attribute(group, "left_rms", joint.left_rms);
  writer.attribute(group, "power_sentence", joint.power_sentence);
  writer.attribute(group, "timing_sentence", joint.timing_sentence);
  writer.attribute(group, "validation_torque_energy", joint.validation_torque_energy);
}

void write_joint(ResultWriter& writer, std::string const& group, JointDiagnosis const& joint) {
  write_joint_attributes(writer, group, joint);
  write_parameters(writer, group + "/baseline", joint.baseline);
  write_parameters(writer, group + "/augmented", joint.augmented);
  std::vector<std::string> order;
  for (auto const& axis : joint.map) {
    write_map_axis(writer, group + "/map", axis, joint.unit_torque);
    order.push_back(axis.axis);
  }
  text_list(writer, group + "/map", "order", order);
  write_candidates(writer, group + "/candidates", joint.candidates);
  for (std::size_t i = 0; i < joint.effects.size(); ++i)
    write_effect(writer, fmt::format("{}/effects/effect_{}", group, i + 1), joint.effects[i], joint.unit_torque);
  for (std::size_t i = 0; i < joint.traces.size(); ++i)
    write_trace(writer, fmt::format("{}/traces/trace_{}", group, i + 1), joint.traces[i], joint);
  write_lists(writer, group, joint);
  if (joint.replicate_energy.empty()) return;
  writer.numbers(group + "/twin_energy", {joint.replicate_energy.size()}, joint.replicate_energy,
                 Note{"1", "residual energy of each replicate over that of the recording"}.over({"twin"}));
  write_index(writer, group, "twin", joint.replicate_energy.size());
}

}  // namespace

void write_diagnosis(ResultWriter& writer, Diagnosis const& diagnosis) {
  std::string const group = "/diagnosis";
  writer.attribute(group, "verdict", word(diagnosis.verdict));
  writer.attribute(group, "headline", headline_of(diagnosis));
  writer.attribute(group, "reason", diagnosis.reason);
  writer.attribute(group, "finding", diagnosis.finding);
  writer.attribute(group, "way_out", diagnosis.way_out);
  writer.attribute(group, "seed", static_cast<std::int64_t>(diagnosis.seed));
  writer.attribute(group, "q", diagnosis.q);
  writer.attribute(group, "joints", static_cast<std::int64_t>(diagnosis.joints.size()));
  writer.texts(group + "/verdict_json", std::vector<std::string>{diagnosis_json(diagnosis)},
               {"1", "the verdict as the JSON document of torquescope diagnose --json"});
  if (diagnosis.arm) {
    write_candidates(writer, group + "/arm/candidates", diagnosis.arm->candidates);
    for (std::size_t i = 0; i < diagnosis.arm->effects.size(); ++i)
      write_effect(writer, fmt::format("{}/arm/effects/effect_{}", group, i + 1), diagnosis.arm->effects[i], "N m");
  }
  for (std::size_t i = 0; i < diagnosis.joints.size(); ++i) {
    JointDiagnosis const& joint = diagnosis.joints[i];
    std::string const own = fmt::format("{}/joint_{}", group, i + 1);
    write_joint(writer, own, joint);
    writer.attribute(own, "model_c", c_of_joint(diagnosis, joint));
    writer.attribute(own, "model_mjcf", mjcf_of_joint(joint));
  }
}

}  // namespace torquescope
