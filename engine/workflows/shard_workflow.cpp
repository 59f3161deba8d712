// `torquescope run --shard I/N`: some runs of a job, into segments that `merge` makes a result of; and what segments
// say.

#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is POSIX, <csignal> does not promise it

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/disk_room.hpp"
#include "engine/experiment/runs/population_stage.hpp"
#include "engine/experiment/runs/segment_look.hpp"
#include "engine/store/shard_lock.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

ShardReport run_shard(Experiment experiment, IdentifyOptions const& options, ProgressSink const& progress) {
  auto const start = std::chrono::steady_clock::now();
  ShardLock const lock(options.output, options.shard);
  Attempt attempt(experiment, options, LeftSegments::are_gathered);
  for (auto const& warning : attempt.saved.warnings())
    if (options.tell) options.tell("warning", warning);
  for (auto const& line : attempt.earlier.lines())
    if (options.tell) options.tell("continue", line);
  experiment.forget_motion();
  auto const& parts = experiment.parts();
  check_room(options, segment_bytes(parts, attempt.runs_left()), segment_folder_of(options.output));
  SquaredErrorFloor const floor(parts.train.regression, parts.reductions);
  experiment.forget_reductions();
  try {
    for (auto const& plan : parts.estimators) {
      if (plan.is_closed_form()) continue;
      auto const choice = fitness_choice(parts, plan);
      // what segments have to the end needs no second look
      auto runs = runs_of_shard(parts, options.shard);
      std::erase_if(runs, [&](std::size_t run) { return attempt.saved.has_ended(plan.label, run); });
      run_population({parts, plan, choice, floor, progress, attempt}, runs, [](std::size_t, auto const&) {});
    }
  } catch (Error const& error) {
    if (error.code() != ExitCode::stopped) throw;
    stop_and_save(attempt);
  }
  attempt.keeper.write_all();
  return {attempt.runs_total, attempt.runs_before,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

namespace {

// a process that was killed and that nobody has asked after is still in the list, as "Z"
bool is_alive(SegmentOrigin const& origin) {
  if (origin.host != host_name() || (::kill(static_cast<pid_t>(origin.pid), 0) != 0 && errno != EPERM)) return false;
  std::ifstream file("/proc/" + std::to_string(origin.pid) + "/stat");
  std::string const stat{std::istreambuf_iterator<char>(file), {}};
  std::size_t const state = stat.rfind(") ");
  return state == std::string::npos || stat.compare(state, 3, ") Z") != 0;
}

// distinct generations of every run, and which runs have their end
struct Covered {
  HistoryShape shape;
  std::map<std::size_t, std::map<std::size_t, std::size_t>> parts;  // by run: first -> end
  std::map<std::size_t, std::size_t> ended;                         // by run: where
};

bool has_ended(Covered const& covered, std::size_t run) {
  auto const told = covered.ended.find(run);
  if (told == covered.ended.end()) return false;
  std::size_t end = 0;
  for (auto const& [first, part_end] : covered.parts.at(run))
    if (first <= end) end = std::max(end, part_end);
  return told->second <= end;
}

void find_unfinished_shares(std::map<std::string, Covered> const& estimators, JobStatus& status) {
  if (status.writers.empty() || estimators.empty()) return;
  auto const shares = status.writers.front().shards;
  auto const is_of_them = [&](auto const& writer) { return writer.shards == shares; };
  if (shares < 2 || !std::all_of(status.writers.begin(), status.writers.end(), is_of_them)) return;
  status.shares = static_cast<std::size_t>(shares);
  std::size_t const runs = estimators.begin()->second.shape.runs;
  status.unfinished_shares = unfinished_shares(runs, status.shares, [&](std::size_t run) {
    return std::all_of(estimators.begin(), estimators.end(),
                       [&](auto const& one) { return has_ended(one.second, run); });
  });
}

JobStatus::Estimator summed(std::string const& label, Covered const& covered) {
  JobStatus::Estimator estimator;
  estimator.label = label;
  estimator.runs = static_cast<std::int64_t>(covered.shape.runs);
  estimator.generations = estimator.runs * static_cast<std::int64_t>(covered.shape.generations + 1);
  for (auto const& [run, parts] : covered.parts) {
    std::size_t end = 0;
    for (auto const& [first, part_end] : parts)
      if (first <= end) end = std::max(end, part_end);
    bool const ended = has_ended(covered, run);
    ended ? ++estimator.ended : ++estimator.begun;
    // a run that ended early has nothing left to do
    estimator.generations_done += static_cast<std::int64_t>(ended ? covered.shape.generations + 1 : end);
  }
  return estimator;
}

}  // namespace

namespace {

// false: a segment that was listed is gone, its process has gathered it into another one, or has finished
bool read_now(std::filesystem::path const& segment_folder, JobStatus& status) {
  bool is_whole = true;
  status = {};
  std::map<std::string, Covered> estimators;
  std::map<std::tuple<std::string, std::int64_t, std::string>, JobStatus::Writer> writers;
  OpenFolder const folder(segment_folder);
  SegmentLook look(segments_in(folder), [](SegmentFile&) {});
  for (std::size_t i = 0; i < look.places().size(); ++i) {
    try {
      SegmentFacts const facts = look.facts(i);
      auto const& origin = facts.origin;
      status.job_name = origin.job_name;
      status.job_sha256 = origin.job_sha256;
      status.bytes += facts.bytes;
      auto& writer = writers[{origin.host, origin.pid, origin.started}];
      writer.shard = static_cast<std::int64_t>(origin.shard_index);
      writer.shards = static_cast<std::int64_t>(origin.shard_count);
      writer.host = origin.host;
      writer.pid = origin.pid;
      writer.started = origin.started;
      writer.last_written = std::max(writer.last_written, origin.written);
      ++writer.segments;
      writer.is_alive = is_alive(origin);
      for (auto const& [label, index] : facts.estimators) {
        auto& covered = estimators[label];
        covered.shape = index.shape;
        for (auto const& entry : index.entries) {
          std::size_t const end = entry.first + entry.count;
          auto& known = covered.parts[entry.run][entry.first];
          known = std::max(known, end);
          if (entry.ended) covered.ended[entry.run] = end;
        }
      }
    } catch (Error const& error) {
      if (error.code() == ExitCode::no_input) is_whole = false;
      if (error.code() == ExitCode::bad_data) status.damaged.push_back(look.places()[i].name);
    }
  }
  for (auto const& [label, covered] : estimators) status.estimators.push_back(summed(label, covered));
  for (auto const& [who, writer] : writers) status.writers.push_back(writer);
  std::stable_sort(status.writers.begin(), status.writers.end(),
                   [](auto const& a, auto const& b) { return a.shard < b.shard; });
  find_unfinished_shares(estimators, status);
  return is_whole;
}

}  // namespace

JobStatus read_status(std::filesystem::path const& segment_folder) {
  constexpr int most_attempts = 10;
  JobStatus status;
  for (int listing = 1; !read_now(segment_folder, status) && listing < most_attempts; ++listing) {
  }
  return status;
}

}  // namespace torquescope
