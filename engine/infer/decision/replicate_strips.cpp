#include "engine/infer/decision/replicate_strips.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/parallel.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/joint_bounds.hpp"

namespace torquescope {
namespace {

constexpr double step_s = 1e-4;            // of the integrator
constexpr double lightest = 0.03;          // of the inertia that would take all of the torque: what a loop can hold
constexpr std::uint32_t sets_before = 64;  // of the same seed, taken by others

// torque of the model's given terms, by columns that these signals tell; none: empty
Eigen::VectorXd given_torque(JointModel const& model, Eigen::VectorXd const& parameters, GivenSignals const* signals) {
  Eigen::VectorXd torque{};
  Eigen::Index first = 0;
  for (auto const* term : model.regressor().terms()) {
    auto const width = static_cast<Eigen::Index>(term->n_linear());
    Eigen::MatrixXd const* const columns = term->is_given() && signals ? signals->of(term->name()) : nullptr;
    if (columns != nullptr) {
      Eigen::VectorXd const own = *columns * parameters.segment(first, width);
      torque = torque.size() > 0 ? (torque + own).eval() : own;
    }
    first += width;
  }
  return torque;
}

Eigen::VectorXd without_given(Eigen::VectorXd parameters, JointModel const& model) {
  Eigen::Index first = 0;
  for (auto const* term : model.regressor().terms()) {
    auto const width = static_cast<Eigen::Index>(term->n_linear());
    if (term->is_given()) parameters.segment(first, width).setZero();
    first += width;
  }
  return parameters;
}

// a recording of the joint as if nothing but its own terms acted on it
Recording less_given(Recording recording, Eigen::VectorXd const& given) {
  if (given.size() == 0) return recording;
  recording.torque -= torque_to_hold(given);
  recording.gear_load = recording.gear_load.size() > 0 ? (recording.gear_load + given).eval() : given;
  return recording;
}

// what a joint can be: not driven by its friction, and with some inertia
Eigen::VectorXd possible(Eigen::VectorXd parameters, JointModel const& model, Strip const& strip) {
  Eigen::VectorXd torque = strip.torque;
  if (Eigen::VectorXd const given = given_torque(model, parameters, strip.beside.given.get()); given.size() > 0)
    torque -= given;
  parameters = without_negatives(std::move(parameters), model);
  JointBounds const bounds = joint_bounds(model);
  auto const no_less = [&](Eigen::Index at, double least) {
    if (at != JointBounds::none) parameters[at] = std::max(parameters[at], least);
  };
  double const fastest = strip.motion.ddq.norm();
  no_less(bounds.inertia, fastest > 0.0 ? lightest * torque.norm() / fastest : 0.0);
  no_less(bounds.friction, 0.0);
  if (bounds.has_directions() && parameters[bounds.forward] < parameters[bounds.backward])
    parameters[bounds.forward] = parameters[bounds.backward] =
        0.5 * (parameters[bounds.forward] + parameters[bounds.backward]);
  return parameters;
}

TrackedJoint tracked(ReplicateJoint const& joint) {
  return {joint.lanes.inertia,
          joint.lanes.viscous,
          joint.coulomb_forward + joint.offset,
          joint.coulomb_backward + joint.offset,
          joint.lanes.gravity_sin,
          joint.lanes.gravity_cos};
}

// one of a group as if it had been recorded; takes its samples, which are many, out of the group
Recording taken_out(ReplicateGroup& group, std::size_t lane, double rate_hz) {
  Recording recording;
  recording.name = "a replicate";
  recording.rate_hz = rate_hz;
  recording.position = std::exchange(group.position[lane], {});
  recording.torque = std::exchange(group.torque[lane], {});
  Eigen::Index const samples = recording.torque.size();
  recording.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / rate_hz);
  return recording;
}

}  // namespace

ReplicateMaker::ReplicateMaker(ReplicateSetting const& setting, std::size_t recording, ModelOnStrips const& on,
                               ChosenTreatment const& chosen)
    : setting_(setting),
      recording_(&setting.recordings[recording]),
      strip_(&on.strips()[recording]),
      on_(&on),
      place_(recording),
      chosen_(&chosen) {
  auto const size = static_cast<Eigen::Index>(on.model().size());
  Eigen::VectorXd const parameters = possible(chosen.fit.parameters.head(size), on.model(), *strip_);
  given_ = given_torque(on.model(), parameters, recording_->given.get());
  Recording const alone = less_given(*recording_, given_);
  JointModel model = on.model();
  model.load_as_in(alone);
  try {
    ReplicateJoint const joint = model.replicate_joint(without_given(parameters, model));
    auto const led = [&](RecordedLoop loop, ReplicateSource source) {
      loop.loop.torque_noise = loop.loop.slow_torque_noise = {};
      loop.loop.sticking = {setting.sticking.least_creep, setting.sticking.most_creep, setting.sticking.most_length};
      ReplicateSimulator replicate(joint, loop.loop, loop.track, step_s);
      ReplicateGroup group;
      replicate.simulate({setting.seed, static_cast<std::uint32_t>(recording), sets_before + setting.step}, 0, group);
      if (std::find(group.ran_away.begin(), group.ran_away.end(), true) != group.ran_away.end()) return false;
      loop_ = std::move(loop);
      replicate_.emplace(std::move(replicate));
      source_ = source;
      return true;
    };
    Recording fed = alone;
    fed.torque = earlier(alone.torque, chosen.late_s, alone.rate_hz);
    if (led(torque_fed_loop(fed, joint.lanes.inertia, setting.filter), ReplicateSource::recorded_torque)) return;
    led(tracking_loop(alone, tracked(joint), setting.filter), ReplicateSource::tracking_loop);
  } catch (Error const&) {
    // parameters that are no joint: the measured motion is left
  }
}

std::vector<Strip> ReplicateMaker::strips(std::size_t first, std::size_t count) const {
  if (replicate_) return simulated(first, count);
  std::vector<Strip> all;
  for (std::size_t i = first; i < first + count; ++i) all.push_back(on_measured_motion(i));
  return all;
}

std::vector<Strip> ReplicateMaker::simulated(std::size_t first, std::size_t count) const {
  ReplicateAddress const address{setting_.seed, static_cast<std::uint32_t>(place_), sets_before + setting_.step};
  std::size_t const groups = (count + replicate_lanes - 1) / replicate_lanes;
  std::vector<ReplicateGroup> made(groups);
  parallel_for(groups, setting_.threads, [&](std::size_t g, int) {
    replicate_->simulate(address, static_cast<std::uint32_t>(first / replicate_lanes + g), made[g]);
  });
  std::vector<Strip> all(count);
  parallel_for(count, setting_.threads, [&](std::size_t i, int) {
    ReplicateGroup& group = made[i / replicate_lanes];
    if (group.ran_away[i % replicate_lanes]) {
      all[i] = on_measured_motion(first + i);
      return;
    }
    Recording recording = taken_out(group, i % replicate_lanes, recording_->rate_hz);
    recording.rows.encoder_step = recording_->rows.encoder_step;
    if (given_.size() > 0) recording.torque += torque_to_hold(given_);
    all[i] = strip_of(recording, strip_->filters, strip_->resolution);
    all[i].rows = strip_->rows;
    all[i].row_weight = strip_->row_weight;
    all[i].beside = strip_->beside;
  });
  return all;
}

Strip ReplicateMaker::on_measured_motion(std::size_t replicate) const {
  Strip strip = *strip_;
  RandomStream random({setting_.seed, static_cast<std::uint32_t>(replicate), RandomDomain::resampling}, setting_.step,
                      1);
  Eigen::VectorXd sticking = Eigen::VectorXd::Zero(strip.sides.cols());
  // one of the shapes, or none of them
  auto const drawn = static_cast<Eigen::Index>(random.below(static_cast<std::uint32_t>(sticking.size()) + 1));
  if (drawn < sticking.size()) sticking[drawn] = 1.0;
  auto const samples = treated_samples(*on_, chosen_->late_s, chosen_->fit.parameters, sticking);
  strip.torque = model_torque(*on_, place_, samples[place_], chosen_->fit.parameters);
  strip.motion.torque = strip.torque;
  return strip;
}

}  // namespace torquescope
