// `torquescope diagnose`: from a loaded job to a verdict in a result file.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>

#include "engine/account/error_words.hpp"
#include "engine/account/sentences.hpp"
#include "engine/data/arm_recording.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/diagnose/all_rows_diagnosis.hpp"
#include "engine/experiment/diagnosis_input.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/runs/disk_room.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/experiment/torque_findings.hpp"
#include "engine/store/shard_lock.hpp"
#include "engine/workflows/diagnosis_result.hpp"
#include "engine/workflows/diagnosis_standing.hpp"
#include "engine/workflows/twin_folder.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

// tells people, and the lock: seconds of an update count from the stage's beginning, those in the lock from the first
class Stages {
 public:
  Stages(ProgressSink const& progress, DiagnoseRequest const& request, Experiment const& experiment,
         ShardLock const& lock)
      : progress_(progress), request_(request), lock_(lock) {
    standing_.job = experiment.name();
    standing_.inputs_sha256 = experiment.inputs_sha256();
    standing_.shard = static_cast<std::int64_t>(request.shard.index);
    standing_.shards = static_cast<std::int64_t>(request.shard.count);
    standing_.began = utc_now();
    standing_.expected_seconds = request.expected_seconds;
    tell_lock("prepare", 0, 0);
  }

  void operator()(std::string const& stage, std::size_t done, std::size_t total) {
    if (request_.stop_requested && request_.stop_requested()) throw TwinsAbandoned();
    if (stage != stage_) start_ = Clock::now();
    stage_ = stage;
    tell_lock(stage, done, total);
    if (!progress_) return;
    ProgressUpdate update;
    update.stage = stage;
    update.counted = standing_.counted;
    update.runs_done = standing_.done;
    update.runs_total = standing_.total;
    update.seconds = seconds_since(start_);
    update.expected_seconds = request_.expected_seconds;
    progress_(update);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  void tell_lock(std::string const& stage, std::size_t done, std::size_t total) {
    standing_.told = utc_now();
    standing_.stage = stage;
    standing_.counted = stage.ends_with("replicates") ? "replicates" : "effects";
    standing_.done = static_cast<std::int64_t>(done);
    standing_.total = static_cast<std::int64_t>(total);
    standing_.seconds = seconds_since(began_);
    lock_.say(standing_text(standing_));
  }

  ProgressSink const& progress_;
  DiagnoseRequest const& request_;
  ShardLock const& lock_;
  DiagnosisStanding standing_{};
  std::string stage_;
  Clock::time_point began_ = Clock::now(), start_{};
};

bool is_there(std::filesystem::path const& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

// one diagnosis of several processes
class Shard {
 public:
  Shard(Experiment const& experiment, DiagnoseRequest const& request, bool existed)
      : result_(request.output), existed_(existed), twins_([&] {
          TwinFolder::Setting setting;
          setting.result = request.output;
          setting.shard = request.shard;
          setting.inputs_sha256 = experiment.inputs_sha256();
          setting.bytes_kept_free = diagnosis_bytes(experiment.parts());
          setting.must_end = [this, stop = request.stop_requested] { return (stop && stop()) || is_finished(); };
          setting.tell = request.tell;
          return setting;
        }()) {}

  TwinFolder& twins() { return twins_; }
  // another one has published the result
  bool is_finished() const { return !existed_ && is_there(result_); }

 private:
  std::filesystem::path result_;
  bool existed_;
  TwinFolder twins_;
};

Error stopped(DiagnoseRequest const& request, Shard const* shard) {
  if (shard == nullptr) {
    Problem problem{ExitCode::stopped, "stopped: nothing was written"};
    problem.help = "the same command begins anew; one with --shard 0/2 keeps its replicates and goes on with them";
    return Error(problem);
  }
  if (shard->is_finished())
    return Error(Problem{ExitCode::stopped, "another shard has finished " + request.output.string()});
  Problem problem{ExitCode::stopped,
                  "stopped: replicates so far are safe in " + segment_folder_of(request.output).string()};
  problem.help = "the same command goes on with them";
  return Error(problem);
}

// A fault that the examination found is the verdict: physics found in such rows would be the fault's
Diagnosis verdict_of_fault(Finding const& fault, Experiment::Parts const& parts) {
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::data_fault;
  diagnosis.finding = fmt::format("{}: {}", fault.recording, sentence_of(fault));
  diagnosis.way_out = cure_of(fault);
  for (std::size_t j = 0; j < parts.joints(); ++j) {
    bool const revolute =
        (parts.arm ? parts.arm->model.chain().joints[j].kind : parts.regressor->joint()) == JointKind::revolute;
    JointDiagnosis joint;
    joint.joint = static_cast<int>(j) + 1;
    joint.verdict = Verdict::data_fault;
    joint.unit_position = revolute ? "rad" : "m";
    joint.unit_torque = revolute ? "N m" : "N";
    diagnosis.joints.push_back(std::move(joint));
  }
  diagnosis.seed = static_cast<std::uint64_t>(parts.experiment.seed);
  diagnosis.q = parts.diagnose.q;
  diagnosis.reason = reason_sentence(diagnosis);
  return diagnosis;
}

// Where no effect is named, a zero that moves is what is wrong with the recording
Diagnosis with_moving_zero(Diagnosis diagnosis, std::vector<Finding> const& findings, Experiment::Parts const& parts) {
  auto const zero = zero_finding(findings);
  if (!zero || diagnosis.verdict != Verdict::unexplained) return diagnosis;
  diagnosis.verdict = Verdict::data_fault;
  for (std::size_t j = 0; j < diagnosis.joints.size(); ++j) {
    std::string const title = parts.arm ? joint_title(j, parts.arm->model.joint_names()) : zero->joint;
    auto const& likewise = zero->likewise;
    if (title == zero->joint || std::find(likewise.begin(), likewise.end(), title) != likewise.end())
      diagnosis.joints[j].verdict = Verdict::data_fault;
  }
  diagnosis.finding = fmt::format("{}: {}", zero->recording, sentence_of(*zero));
  diagnosis.way_out = cure_of(*zero);
  diagnosis.reason = reason_sentence(diagnosis);
  return diagnosis;
}

// "auto": all samples; moving rows of one joint where the job asks for what they alone know
Decider decider_for(Experiment::Parts const& parts) {
  if (parts.arm) return Decider::all_rows;
  Decider const asked = decider_of(parts.diagnose.decider);
  if (asked != Decider::by_job) return asked;
  DiagnoseOptions const usual;
  bool const is_of_moving_rows = !parts.diagnose.ablations().empty() || parts.diagnose.reversals != usual.reversals;
  return is_of_moving_rows ? Decider::moving_rows : Decider::all_rows;
}

Diagnosis diagnose_one_joint(Experiment::Parts const& parts, int threads, TwinExchange* exchange,
                             StageSink const& sink) {
  JobInput const job(parts, threads, exchange);
  Decider const decider = decider_for(parts);
  auto const on_all_rows = [&] { return diagnose_on_all_rows(job.input(), sink).diagnosis; };
  if (decider == Decider::all_rows) return on_all_rows();
  Diagnosis diagnosis = diagnose_joint(job.input(), sink).diagnosis;
  if (decider == Decider::both) diagnosis.joints.front().decision = on_all_rows().joints.front().decision;
  return diagnosis;
}

Diagnosis diagnose_whole_arm(Experiment::Parts const& parts, int threads, StageSink const& sink) {
  Section const filter = section_or_empty(parts.job, "filter");
  return diagnose_arm(arm_input(parts, filter, threads, nullptr), sink);
}

Diagnosis diagnose_parts(Experiment::Parts const& parts, int threads, TwinExchange* exchange, StageSink const& sink) {
  if (parts.arm) return diagnose_whole_arm(parts, threads, sink);
  return diagnose_one_joint(parts, threads, exchange, sink);
}

Diagnosis diagnose_examined(Experiment const& experiment, int threads, TwinExchange* exchange, StageSink const& sink) {
  auto const findings = experiment.findings();
  auto const fault = std::find_if(findings.begin(), findings.end(), [](Finding const& one) { return is_fault(one); });
  Diagnosis diagnosis =
      fault != findings.end()
          ? verdict_of_fault(*fault, experiment.parts())
          : with_moving_zero(diagnose_parts(experiment.parts(), threads, exchange, sink), findings, experiment.parts());
  diagnosis.findings = findings;
  return diagnosis;
}

}  // namespace

Diagnosis diagnose(Experiment const& experiment, DiagnoseRequest const& request, ProgressSink const& progress) {
  bool const existed = is_there(request.output);
  ShardLock const lock(request.output, request.shard);
  std::optional<Shard> shard;
  if (request.shard.count > 1) shard.emplace(experiment, request, existed);
  if (shard && request.tell && decider_for(experiment.parts()) == Decider::all_rows)
    request.tell("note",
                 "a decision on all samples is not shared: every shard makes all of it, the first one writes it");
  check_room({request.output, request.allow_full_disk, request.tell, "[output] samples = false"},
             diagnosis_bytes(experiment.parts()), request.output);
  TwinExchange* const exchange = shard ? &shard->twins() : nullptr;
  Stages stages(progress, request, experiment, lock);
  StageSink const sink = [&](std::string const& stage, std::size_t done, std::size_t total) {
    if (shard && shard->is_finished()) throw TwinsAbandoned();
    stages(stage, done, total);
  };
  Stoppable const stoppable(request.stop_requested);
  try {
    Diagnosis diagnosis = diagnose_into_file(
        experiment, request, [&] { return diagnose_examined(experiment, request.threads.count, exchange, sink); });
    if (shard && request.tell) request.tell("shard", shard->twins().account());
    // also what killed shards left, when one process made it all in the end
    for (auto const& warning : remove_segments(request.output, experiment.inputs_sha256()))
      if (request.tell) request.tell("warning", warning);
    return diagnosis;
  } catch (TwinsAbandoned const&) {
    throw stopped(request, shard ? &*shard : nullptr);
  } catch (Stopped const&) {
    throw stopped(request, shard ? &*shard : nullptr);
  }
}

}  // namespace torquescope
