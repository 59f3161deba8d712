// `torquescope diagnose`: from a loaded job to a verdict in a result file.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "engine/account/error_words.hpp"
#include "engine/account/sentences.hpp"
#include "engine/data/arm_recording.hpp"
#include "engine/data/health/finding_text.hpp"
#include "engine/experiment/diagnosis_input.hpp"
#include "engine/experiment/job_sections.hpp"
#include "engine/experiment/runs/disk_room.hpp"
#include "engine/experiment/runs/provenance_writer.hpp"
#include "engine/experiment/torque_findings.hpp"
#include "engine/store/shard_lock.hpp"
#include "engine/workflows/diagnosis_result.hpp"
#include "engine/workflows/diagnosis_standing.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

namespace {

// somebody asked for an end without a result. No Error: a search goes on without models that fail
class Abandoned : public std::exception {
 public:
  char const* what() const noexcept override { return "abandoned"; }
};

// tells people, and the lock: seconds of an update count from the stage's beginning, those in the lock from the first
class Stages {
 public:
  Stages(ProgressSink const& progress, DiagnoseRequest const& request, Experiment const& experiment,
         ShardLock const& lock)
      : progress_(progress), request_(request), lock_(lock) {
    standing_.job = experiment.name();
    standing_.inputs_sha256 = experiment.inputs_sha256();
    standing_.began = utc_now();
    standing_.expected_seconds = request.expected_seconds;
    tell_lock("prepare", 0, 0);
  }

  void operator()(std::string const& stage, std::size_t done, std::size_t total) {
    if (request_.stop_requested && request_.stop_requested()) throw Abandoned();
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

Error stopped() {
  Problem problem{ExitCode::stopped, "stopped: nothing was written"};
  problem.help = "the same command begins anew";
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

Diagnosis diagnose_one_joint(Experiment::Parts const& parts, int threads, StageSink const& sink) {
  JobInput const job(parts, threads);
  return diagnose_joint(job.input(), sink);
}

Diagnosis diagnose_whole_arm(Experiment::Parts const& parts, int threads, StageSink const& sink) {
  Section const filter = section_or_empty(parts.job, "filter");
  return diagnose_arm(arm_input(parts, filter, threads), sink);
}

Diagnosis diagnose_parts(Experiment::Parts const& parts, int threads, StageSink const& sink) {
  return parts.arm ? diagnose_whole_arm(parts, threads, sink) : diagnose_one_joint(parts, threads, sink);
}

Diagnosis diagnose_examined(Experiment const& experiment, int threads, StageSink const& sink) {
  auto const findings = experiment.findings();
  auto const fault = std::find_if(findings.begin(), findings.end(), [](Finding const& one) { return is_fault(one); });
  Diagnosis diagnosis = fault != findings.end() ? verdict_of_fault(*fault, experiment.parts())
                                                : with_moving_zero(diagnose_parts(experiment.parts(), threads, sink),
                                                                   findings, experiment.parts());
  diagnosis.findings = findings;
  return diagnosis;
}

}  // namespace

Diagnosis diagnose(Experiment const& experiment, DiagnoseRequest const& request, ProgressSink const& progress) {
  ShardLock const lock(request.output, {});
  check_room({request.output, request.allow_full_disk, request.tell, "[output] samples = false"},
             diagnosis_bytes(experiment.parts()), request.output);
  Stages stages(progress, request, experiment, lock);
  StageSink const sink = [&](std::string const& stage, std::size_t done, std::size_t total) {
    stages(stage, done, total);
  };
  Stoppable const stoppable(request.stop_requested);
  try {
    Diagnosis diagnosis = diagnose_into_file(
        experiment, request, [&] { return diagnose_examined(experiment, request.threads.count, sink); });
    // also what killed processes left
    for (auto const& warning : remove_segments(request.output, experiment.inputs_sha256()))
      if (request.tell) request.tell("warning", warning);
    return diagnosis;
  } catch (Abandoned const&) {
    throw stopped();
  } catch (Stopped const&) {
    throw stopped();
  }
}

}  // namespace torquescope
