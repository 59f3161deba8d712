#include "engine/infer/replicates/baseline_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"
#include "engine/infer/pipeline/needed_torque.hpp"

namespace torquescope {
namespace {

struct Attempt {
  RecordedLoop loop;
  BaselineCorrection baseline{};
  NoiseLevel disturbance{}, friction_wander{};
  std::optional<TorqueColour> colour{};
  bool ran_away() const {
    return baseline.ran_away || disturbance.ran_away || friction_wander.ran_away || (colour && colour->ran_away);
  }
  bool is_louder_than_the_recording() const {
    constexpr double clearly = 4.0;
    return !ran_away() && disturbance.z < -clearly;
  }
  // What a law does not explain is noise of its twins. Twins that are louder than the recording, without any
  // disturbance and where effects have little to say, are so because the law lacks something: a feedforward of
  // friction, say
  bool law_is_too_poor() const { return loop.source == LoopSource::approximated && is_louder_than_the_recording(); }
};

TwinAddress wander_set(TwinOptions const& options) { return {options.seed, options.recording, 2}; }

// reads_colour: of the torque noise, from what the model leaves
Attempt attempt(RecordedLoop loop, bool reads_colour, ProcessedRecord const& record, RecordPipeline const& pipeline,
                TwinOptions const& options, TwinWorkers const& workers) {
  TwinAddress const correction_set{options.seed, options.recording, 0};
  TwinAddress const level_set{options.seed, options.recording, 1};
  Attempt result{std::move(loop)};
  for (double TwinLoop::*level : {&TwinLoop::disturbance_std, &TwinLoop::disturbance_variance_error,
                                  &TwinLoop::friction_wander, &TwinLoop::friction_wander_variance_error})
    result.loop.loop.*level = 0.0;
  result.loop.loop.sticking = options.draws_sticking ? sticking_range(result.loop.loop.encoder_step) : StickingRange{};
  auto const correct_from = [&](Eigen::VectorXd const& start) {
    result.baseline = correct_baseline(record, start, result.loop.loop, result.loop.track, pipeline, options.step_s,
                                       correction_set, options.twins, workers);
  };
  TwinLoop& law = result.loop.loop;
  auto const take_colour = [&](TorqueColour const& colour) {
    result.colour = colour;
    put_colour(colour, pipeline.rate_hz(), law);
  };
  auto const put_disturbance = [&](NoiseLevel const& level) {
    result.disturbance = level;
    law.disturbance_std = level.std;
    law.disturbance_variance_error = level.variance_error;
  };
  auto const put_wander = [&](NoiseLevel const& level) {
    result.friction_wander = level;
    law.friction_wander = level.std;
    law.friction_wander_variance_error = level.variance_error;
  };
  if (options.levels) {
    if (options.levels->colour) take_colour(*options.levels->colour);
    put_disturbance(options.levels->disturbance);
    put_wander(options.levels->friction_wander);
    correct_from(without_negatives(record.parameters + options.levels->correction, pipeline.model()));
    return result;
  }
  correct_from(without_negatives(record.parameters, pipeline.model()));
  if (result.baseline.ran_away) return result;
  auto const twin = [&] {
    return CleanTwin(pipeline.model().twin_joint(result.baseline.parameters), law, result.loop.track, options.step_s);
  };
  if (reads_colour) {
    take_colour(torque_colour(record, twin(), pipeline, level_set, options.twins, workers));
    if (result.colour->ran_away) return result;
  }
  put_disturbance(disturbance_level(record, twin(), pipeline, level_set, options.twins, workers));
  if (result.disturbance.ran_away) return result;
  put_wander(friction_wander(record, twin(), pipeline, options.wander, wander_set(options), options.twins, workers));
  if (result.friction_wander.ran_away) return result;
  if (law.disturbance_std > 0.0 || law.friction_wander > 0.0) correct_from(Eigen::VectorXd(result.baseline.parameters));
  return result;
}

TrackedJoint fitted_joint(JointModel const& model, Eigen::VectorXd const& parameters) {
  TwinJoint const joint = model.twin_joint(parameters);
  return {joint.lanes.inertia,
          joint.lanes.viscous,
          joint.coulomb_forward + joint.offset,
          joint.coulomb_backward + joint.offset,
          joint.lanes.gravity_sin,
          joint.lanes.gravity_cos};
}

// As its controller knows it: without what effects of the torque channel add, for it never saw a fault of the
// measurement
struct InLoop {
  Recording recording;
  NeededTorque needed_torque;
  bool has_channel_faults = false;
};

// keeps references to record and pipeline
InLoop in_loop_of(Recording recording, ProcessedRecord const& record, RecordPipeline const& pipeline) {
  JointModel const& model = pipeline.model();
  bool const has_faults = std::any_of(model.effects().begin(), model.effects().end(),
                                      [](auto const& one) { return one.effect->acts_on() == ActsOn::recorded_torque; });
  if (has_faults)
    recording.torque -=
        model.motor_torque(record.motion, record.drive, without_negatives(record.parameters, model)).channel_adds;
  return {std::move(recording),
          [&](std::vector<LimitedSample> const& limited) { return needed_torque(record, pipeline, limited); },
          has_faults};
}

RecordedLoop loop_to_try(InLoop const& in_loop, TrackedJoint const& joint, FilterOptions const& filter,
                         RecordedLoop const* decided) {
  // a loop of our own is made for the joint it leads
  if (decided != nullptr && decided->source == LoopSource::tracking)
    return tracking_loop(in_loop.recording, joint, filter);
  if (decided != nullptr && !in_loop.has_channel_faults) return *decided;
  return recorded_loop(in_loop.recording, joint, filter, in_loop.needed_torque);
}

// the channels of this recording that its source renews less often than the log writes: "q" at 66.7 Hz, "tau" at 50 Hz
std::string slow_channels(Recording const& recording) {
  std::string list;
  for (auto const& finding : recording.findings)
    if (finding.kind == FindingKind::slow_source)
      list += fmt::format("{}\"{}\" at {:.4g} Hz", list.empty() ? "" : ", ", finding.column, finding.size);
  return list;
}

// A loop that was fitted between the readings of a drive may hold no joint, and nothing is wrong with the columns then
Problem runaway_of_slow_source(Recording const& recording, std::string const& channels) {
  Problem problem{ExitCode::bad_data,
                  fmt::format("{}: the log writes at {:.4g} Hz what the drive renews less often ({}), and no loop "
                              "between its readings holds the fitted joint",
                              recording.name, recording.rate_hz, channels)};
  problem.help =
      "the parameters of `torquescope run` are those of one row a reading; for a diagnosis read position and torque "
      "from the drive as often as the log writes";
  return problem;
}

Problem runaway(Recording const& recording) {
  if (auto const channels = slow_channels(recording); !channels.empty())
    return runaway_of_slow_source(recording, channels);
  if (recording.reference.size() == recording.position.size()) {
    Problem problem{ExitCode::bad_data, recording.name + ": the fitted joint runs away from the measured motion"};
    problem.help =
        "the torque column may be another signal or have the wrong sign or unit: check recording.columns and "
        "torque_per_unit";
    return problem;
  }
  Problem problem{ExitCode::bad_data, recording.name +
                                          ": no reference was recorded, and the fitted joint cannot be led along the "
                                          "measured motion instead"};
  problem.help =
      "record what the controller was told to follow and name it, reference = \"COLUMN\" in recording.columns: "
      "replicates "
      "then move in the recording's own loop. If it cannot be had, check the torque's column, sign and torque_per_unit";
  return problem;
}

}  // namespace

TwinLevels levels_of(BaselineTwin const& made) {
  return {made.baseline.parameters - made.baseline.least_squares, made.disturbance, made.friction_wander, made.colour};
}

NoiseLevel measured_wander(Recording const& recording, BaselineTwin const& made, RecordPipeline const& pipeline,
                           TwinOptions const& options, TwinWorkers const& workers) {
  return friction_wander(pipeline.process(made.record.motions(), recording.name), made.twin, pipeline, options.wander,
                         wander_set(options), options.twins, workers);
}

BaselineTwin make_baseline_twin(Recording const& recording, RecordPipeline const& pipeline, FilterOptions const& filter,
                                TwinOptions const& options, TwinWorkers const& workers) {
  ProcessedRecord record =
      pipeline.process(options.motions ? *options.motions : pipeline.motions_of(recording), recording.name);
  TrackedJoint const joint = fitted_joint(pipeline.model(), without_negatives(record.parameters, pipeline.model()));
  InLoop const in_loop = in_loop_of(recording, record, pipeline);
  bool const decides = options.loop == nullptr;
  // a known controller separates the noise, even where its law is too poor to be simulated
  bool const reads_colour = options.reads_colour || recording.reference.size() != recording.position.size();
  auto const attempt_in = [&](RecordedLoop const& loop) {
    Attempt tried = attempt(loop, reads_colour, record, pipeline, options, workers);
    // a stiff controller answers its encoder: what the torque has at the highest frequencies is no white noise then
    bool const mistook_noise = loop.source == LoopSource::tracking && tried.is_louder_than_the_recording();
    if (reads_colour || options.levels || !mistook_noise) return tried;
    Attempt coloured = attempt(loop, true, record, pipeline, options, workers);
    return coloured.ran_away() ? tried : coloured;
  };
  // where the motion cannot tell friction from gravity both may be wrong and large: fed forward they throw the joint
  auto const led_by_error = [&] { return attempt_in(tracking_loop(in_loop.recording, {joint.inertia}, filter)); };
  auto const led = [&] {
    Attempt knowing = attempt_in(tracking_loop(in_loop.recording, joint, filter));
    return knowing.ran_away() ? led_by_error() : knowing;
  };
  Attempt made = attempt_in(loop_to_try(in_loop, joint, filter, options.loop.get()));
  if (made.ran_away() && made.loop.source == LoopSource::tracking) {
    std::string const remark = made.loop.remark;
    made = led_by_error();
    made.loop.remark = remark;
  } else if (decides && made.ran_away()) {
    made = led();
    made.loop.remark = "the loop found in the recording does not hold the fitted joint; " + made.loop.remark;
  } else if (decides && made.law_is_too_poor()) {
    Attempt tracking = led();
    tracking.loop.remark = "replicates in the loop found in the recording are louder than it; " + tracking.loop.remark;
    if (!tracking.ran_away()) made = std::move(tracking);
  }
  validate(!made.ran_away(), [&] { return runaway(recording); });
  CleanTwin twin(pipeline.model().twin_joint(made.baseline.parameters), made.loop.loop, made.loop.track,
                 options.step_s);
  return {std::move(record),    std::move(made.loop), std::move(made.baseline), made.disturbance,
          made.friction_wander, made.colour,          std::move(twin)};
}

}  // namespace torquescope
