#pragma once
// A job with [[recordings]] turned into tracks of position-controlled drives that share one set of parameters.
//
// Loop       P on the commanded position; [loop] drive says what its command is, [known] what each recording knows
// Ticks      loop.rate_hz, else the fewest a sample that answer every two milliseconds
// Errors     problems of the job, of its files and of its data, all at once
// Threads    read in one thread; a plain record then

#include <optional>
#include <string>
#include <vector>

#include "engine/experiment/job/job.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "engine/experiment/level_options.hpp"
#include "engine/experiment/recording_set.hpp"
#include "engine/infer/decision/servo_decision.hpp"
#include "engine/simulate/rollout/loop_options.hpp"

namespace torquescope {

struct ServoJob {
  Job job;
  ExperimentOptions experiment{};
  OutputOptions output{};
  DiagnoseOptions diagnose{};
  LevelOptions levels{};
  LoopSetting loop{};
  DriveCommand command = DriveCommand::voltage;
  std::optional<Regressor> regressor{};
  ServoEffects effects{};
  std::vector<SetEntry> entries{};      // of training, then of validation
  std::vector<Recording> recordings{};  // of each entry
  std::vector<RolloutTrack> training{}, validation{};
  bool has_torque = false;
  KnownKeys known{};

  std::string inputs_sha256() const;
  RolloutTrack const& track(std::size_t entry) const {
    return entry < training.size() ? training[entry] : validation[entry - training.size()];
  }
  ServoQuestion question(int threads) const;
};

ServoJob read_servo_job(Job job);

// [loop] of a job with [[recordings]], as its drive has it: P on the position, ticks left open
LoopOptions servo_loop(Job const& job, std::vector<Problem>& problems);
// the same for a fit without a choice of effects: back_emf is searched beside loop.fit; motor_gain beside a known load
// alone, which fixes the scale of torques
LoopOptions searched_servo_loop(LoopOptions loop, KnownKeys const& known);
std::string unit_of_command(ServoJob const& job);  // "V", "A", "rad"
// one line each
std::vector<std::string> warnings_of(ServoJob const& job);

}  // namespace torquescope
