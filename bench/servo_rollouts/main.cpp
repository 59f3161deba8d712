// Fits a second of our lanes on records of a servo: sums of squares of sixteen trials over all records, one thread.
//
//   bench_servo_rollouts FILE SECONDS
//
// FILE (ours.py writes it) is words: "track" samples, samples/s, ticks a sample, gravity_moment, inertia, command_gain,
// command_limit, then goal, position, enabled of each sample; "case" name, count, count pairs of a number's name and
// value: inertia, viscous, coulomb or a key of the loop. One line of JSON a case.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"

using namespace torquescope;

namespace {

struct Case {
  std::string name;
  RolloutTrial trial;
};

RolloutTrack read_track(std::istream& in) {
  Eigen::Index samples = 0;
  RolloutTrack track;
  auto& known = track.known;
  in >> samples >> track.rate_hz >> track.ticks_per_sample >> known.gravity_moment >> known.inertia >>
      known.command_gain >> known.command_limit;
  track.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1) / track.rate_hz);
  track.reference.resize(samples);
  track.position.resize(samples);
  track.enabled.resize(samples);
  for (Eigen::Index k = 0; k < samples; ++k) in >> track.reference[k] >> track.position[k] >> track.enabled[k];
  if (track.enabled.minCoeff() > 0.0) track.enabled.resize(0);  // as of a recording without that column
  track.segments = {{0, samples, track.position[0], 0.0, std::numeric_limits<double>::quiet_NaN()}};
  return track;
}

Case read_case(std::istream& in) {
  Case made;
  int count = 0;
  LoopValues values;
  values[LoopKey::kp] = 1.0;  // command_gain of each track is the gain
  in >> made.name >> count;
  for (int i = 0; i < count; ++i) {
    std::string name;
    double value = 0.0;
    in >> name >> value;
    if (name == "inertia")
      made.trial.joint.inertia = value;
    else if (name == "viscous")
      made.trial.joint.viscous = value;
    else if (name == "coulomb")
      made.trial.forward = value;
    else if (auto const key = loop_key_of(name))
      values[*key] = value;
    else {
      std::fprintf(stderr, "%s: no number is named %s\n", made.name.c_str(), name.c_str());
      std::exit(64);
    }
  }
  made.trial.backward = -made.trial.forward;
  made.trial.loop = numbers_of(LoopForm::p, values);
  made.trial.gear = gear_of(values);
  return made;
}

// lanes differ a little, as those of a search do
std::vector<RolloutTrial> lanes_of(RolloutTrial const& first) {
  std::vector<RolloutTrial> all(replicate_lanes, first);
  for (std::size_t i = 1; i < all.size(); ++i) all[i].joint.inertia *= 1.0 + 0.002 * static_cast<double>(i);
  return all;
}

void measure(Case const& one, std::vector<RolloutTrack> const& tracks, double seconds) {
  RolloutTask task{tracks, {}, {true, false}};
  double samples = 0.0;
  for (auto const& track : tracks) {
    RolloutStructure structure;
    structure.step_s = track.tick_s();
    task.structures.push_back(structure);
    samples += static_cast<double>(track.samples());
  }
  auto const trials = lanes_of(one.trial);
  using Clock = std::chrono::steady_clock;
  double fastest_s = 1e9, squares = 0.0;
  auto const end = Clock::now() + std::chrono::duration<double>(seconds);
  do {
    auto const start = Clock::now();
    squares = sums_of_squares(task, trials, 1).front()[0];
    fastest_s = std::min(fastest_s, std::chrono::duration<double>(Clock::now() - start).count());
  } while (Clock::now() < end);
  std::printf("{\"case\": \"%s\", \"fits_per_second\": %.4g, \"rms_rad\": %.6g}\n", one.name.c_str(),
              static_cast<double>(replicate_lanes) / fastest_s, std::sqrt(squares / samples));
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 64;
  std::ifstream in(words[1]);
  std::vector<RolloutTrack> tracks;
  std::vector<Case> cases;
  for (std::string what; in >> what;) {
    if (what == "track")
      tracks.push_back(read_track(in));
    else if (what == "case")
      cases.push_back(read_case(in));
    else
      return 65;
  }
  for (auto const& one : cases) measure(one, tracks, std::atof(words[2]));
  return 0;
}
