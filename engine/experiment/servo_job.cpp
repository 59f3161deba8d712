#include "engine/experiment/servo_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/servo_effects.hpp"

namespace torquescope {
namespace {

DriveCommand command_of(LoopOptions const& loop) {
  if (loop.drive == "current") return DriveCommand::current;
  return loop.drive == "position servo" ? DriveCommand::position_servo : DriveCommand::voltage;
}

// a servo answers the error of its position; without a known gain its command is that error
void check_drive(LoopOptions& loop, Section const& section, KnownKeys const& known, std::vector<Problem>& problems) {
  if (loop.controller != "identified" && loop.controller != "p" && loop.controller != "pd")
    problems.push_back(problem_at(section, "controller",
                                  fmt::format("controller = \"{}\" is none of a set of recordings", loop.controller),
                                  "p or pd; or a job of one recording (recording.train)"));
  if (loop.controller == "identified") loop.controller = "p";
  if (std::isnan(loop.kp)) loop.kp = 1.0;
  if (loop.controller == "pd" && std::isnan(loop.kd)) loop.kd = 0.0;
  if (loop.drive.empty()) loop.drive = known.command_gain ? "voltage" : "position servo";
}

void refuse_faults(std::vector<SetEntry> const& entries, std::vector<Recording> const& recordings,
                   std::vector<Problem>& problems) {
  for (std::size_t k = 0; k < entries.size(); ++k)
    for (auto const& finding : recordings[k].findings)
      if (is_fault(finding)) problems.push_back(problem_of(finding, entries[k].path.string()));
}

double ticks_rate(LoopOptions const& loop, double recording_rate_hz) {
  constexpr double slowest_hz = 500.0;
  if (loop.rate_hz > 0.0) return loop.rate_hz;
  return std::ceil(slowest_hz / recording_rate_hz) * recording_rate_hz;
}

}  // namespace

std::string ServoJob::inputs_sha256() const {
  Digest digest;
  digest.text(job.sha256);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    digest.text(recordings[k].sha256);
    TrackKnown const& of = entries[k].known;
    double const numbers[] = {of.gravity_moment, of.inertia,    of.command_gain,
                              of.command_limit,  of.arm_length, of.temperature};
    digest.numbers(numbers);
  }
  return digest.hex();
}

ServoQuestion ServoJob::question(int threads) const {
  ServoQuestion question{*regressor, loop, command, training, validation};
  question.numbers = decision_numbers(diagnose, levels);
  question.effects = effects;
  question.most_effects = static_cast<std::size_t>(diagnose.max_effects);
  question.seed = static_cast<std::uint64_t>(experiment.seed);
  question.threads = threads;
  return question;
}

LoopOptions servo_loop(Job const& job, std::vector<Problem>& problems) {
  auto loop = read_options<LoopOptions>(job, problems);
  Section const section = section_or_empty(job, "loop");
  check_drive(loop, section, known_keys(job), problems);
  check_loop(loop, section, problems);
  loop.channels = {"position"};
  return loop;
}

LoopOptions searched_servo_loop(LoopOptions loop, KnownKeys const& known) {
  auto const add = [&](char const* key, double given) {
    bool const is_listed = std::find(loop.fit.begin(), loop.fit.end(), key) != loop.fit.end();
    if (!is_listed && std::isnan(given)) loop.fit.emplace_back(key);
  };
  if (known.gravity_moment || known.inertia) add("motor_gain", loop.motor_gain);
  if (loop.drive == "voltage") add("back_emf", loop.back_emf);
  return loop;
}

ServoJob read_servo_job(Job job) {
  ServoJob made;
  std::vector<Problem> problems;
  check_section_names(job, problems);
  made.experiment = read_options<ExperimentOptions>(job, problems);
  if (made.experiment.name.empty()) made.experiment.name = job.path.stem().string();
  made.output = read_options<OutputOptions>(job, problems);
  made.diagnose = read_options<DiagnoseOptions>(job, problems);
  made.levels = read_options<LevelOptions>(job, problems);
  auto const recording = read_options<RecordingOptions>(job, problems);
  made.known = known_keys(job);
  LoopOptions loop = servo_loop(job, problems);
  if (!recording.columns.contains("reference"))
    problems.push_back(problem_at(section_or_empty(job, "recording"), "columns",
                                  "a set of recordings is simulated from its commands, and none is named",
                                  "columns = {..., reference = \"COLUMN OF THE COMMANDED POSITION\"}"));
  made.has_torque = recording.columns.contains("torque");
  auto const model = read_options<ModelOptions>(job, problems);
  made.entries = read_recording_set(job, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  made.regressor = make_regressor(model, section_or_empty(job, "model"));
  made.effects = servo_effects(made.diagnose, *made.regressor, section_or_empty(job, "diagnose"), problems);
  std::stable_partition(made.entries.begin(), made.entries.end(), [](auto const& one) { return !one.is_validation; });
  for (auto& one : read_recordings(job, made.entries)) made.recordings.push_back(std::move(one.recording));
  refuse_faults(made.entries, made.recordings, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  double const rate_hz = made.recordings.front().rate_hz;
  loop.rate_hz = ticks_rate(loop, rate_hz);
  made.loop = loop_setting(loop, rate_hz);
  made.command = command_of(loop);
  TrackOptions options = track_options(loop);
  options.has_torque = made.has_torque;
  for (std::size_t k = 0; k < made.entries.size(); ++k) {
    RolloutTrack track = track_of(made.recordings[k], options);
    track.known = made.entries[k].known;
    (made.entries[k].is_validation ? made.validation : made.training).push_back(std::move(track));
  }
  made.job = std::move(job);
  return made;
}

std::string unit_of_command(ServoJob const& job) {
  if (job.command == DriveCommand::current) return "A";
  return job.command == DriveCommand::voltage ? "V" : "rad";
}

std::vector<std::string> warnings_of(ServoJob const& job) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < job.entries.size(); ++k)
    for (auto const& finding : job.recordings[k].findings)
      if (finding.grade == Grade::warning)
        lines.push_back(fmt::format("{}: {}", job.entries[k].name, sentence_with_cure(finding)));
  return lines;
}

}  // namespace torquescope
