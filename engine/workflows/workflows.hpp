#pragma once
// What the commands do, without a word of terminal: identify, merge, diagnose, simulate, excite. The app layer prints.
//
// Errors     Error with the exit codes of error.hpp; every problem of a job at once
// Threads    identify() spreads runs over threads itself; call it from one thread

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/experiment/experiment.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/progress_update.hpp"
#include "engine/experiment/runs/identify_options.hpp"
#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/store/segment_folder.hpp"
#include "engine/store/written_result.hpp"

namespace torquescope {

struct IdentifyReport {
  std::int64_t runs = 0;
  std::int64_t evaluations = 0;
  double seconds = 0.0;
  std::uintmax_t bytes = 0;
  std::string content_sha256;
  std::optional<WrittenResult> result{};  // what it says
};

// runs every estimator of the job and writes the result file; takes the experiment, to free what is written and not
// needed. Goes on from the segments of OUTPUT.parts, and leaves some there when it is stopped or killed
// (RESULT_FORMAT.md). Error 73 when a living process is at it, 74 when there is no room for the result
IdentifyReport identify(Experiment experiment, IdentifyOptions const& options, ProgressSink const& progress);

// the share of the runs that options.shard says, into segments alone
struct ShardReport {
  std::size_t runs = 0, runs_before = 0;  // all of the shard; those that segments had already
  double seconds = 0.0;
};
ShardReport run_shard(Experiment experiment, IdentifyOptions const& options, ProgressSink const& progress);

// the same file as identify() would have written, from segments alone. Error 75 when runs are missing, unless
// `partial`: these are NaN then
enum class Completeness { whole, partial };
IdentifyReport merge(Experiment experiment, IdentifyOptions const& options, Completeness wanted,
                     ProgressSink const& progress);

// what the segments of a result say, read without a word to whoever writes them
struct JobStatus {
  struct Estimator {
    std::string label;
    std::int64_t runs = 0, ended = 0, begun = 0;
    std::int64_t generations = 0, generations_done = 0;  // of all runs
  };
  struct Writer {
    std::int64_t shard = 0, shards = 1;
    std::string host;
    std::int64_t pid = 0;
    std::string started, last_written;
    std::int64_t segments = 0;
    bool is_alive = false;  // known on this host only
  };
  std::string job_name, job_sha256;
  std::vector<Estimator> estimators;
  std::vector<Writer> writers;
  std::uintmax_t bytes = 0;
  std::vector<std::string> damaged;  // names of segments that cannot be read
  // shares that lack runs, where all segments are of one division of the job; empty where all is done, or it is not so
  std::vector<std::size_t> unfinished_shares;
  std::size_t shares = 1;
};
JobStatus read_status(std::filesystem::path const& segment_folder);
struct DiagnoseRequest {
  ThreadChoice threads{};
  std::filesystem::path output{};
  std::function<bool()> stop_requested{};  // asked from any thread, between replicates and effects; true: Error 75
  std::function<void(std::string const& topic, std::string const& text)> tell{};  // "warning"
  bool allow_full_disk = false;   // begin although the result does not seem to fit
  double expected_seconds = 0.0;  // of the estimate, for progress; 0: none
};

// Finds the physics that the job's model lacks and writes the result file; stages "replicates", "search",
// "verify". Error 74 when there is no room for the result; 73 when a living process is at it; 75 when it was stopped
Diagnosis diagnose(Experiment const& experiment, DiagnoseRequest const& request, ProgressSink const& progress);

// writes the columns that every effect of the catalogue has on the job's recordings (column_export.hpp), for methods
// other than ours; no diagnosis is made. Returns how many effects have columns
struct ColumnsReport {
  std::size_t effects = 0;
  std::size_t rows = 0;  // of the training recording
};
ColumnsReport write_candidate_columns(Experiment const& experiment, DiagnoseRequest const& request);

// makes the recording that the job's [simulate] describes; CSV or HDF5 by the ending of `output`
struct SimulateReport {
  std::size_t samples = 0;
  double seconds = 0.0;
  double rate_hz = 0.0;
  std::uintmax_t bytes = 0;
};
SimulateReport simulate_recording(std::filesystem::path const& job_file, std::filesystem::path const& output);
SimulateReport simulate_recording(Job const& job, std::filesystem::path const& output);

// searches the motion that the job's [excite] asks for, and writes it: CSV. The same file on any number of threads
struct ExciteReport {
  std::string robot;
  std::size_t parameters = 0;
  double usual_condition = 0.0, condition = 0.0;  // of random Fourier motions within the limits; of the one found
  double usual_log_determinant = 0.0, log_determinant = 0.0;  // per parameter
  double usual_angle = 0.0, angle = 0.0;                      // rad, between the two to separate; 0: not asked for
  std::size_t evaluations = 0, samples = 0;
  double seconds = 0.0, rate_hz = 0.0;
};
ExciteReport excite_arm(std::filesystem::path const& job_file, std::filesystem::path const& output, int threads);

}  // namespace torquescope
