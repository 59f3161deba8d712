#pragma once
// What the commands do, without a word of terminal: load, check, identify, diagnose, simulate. The app layer prints.
//
// Errors     Error with the exit codes of error.hpp; every problem of a job at once
// Threads    identify() spreads runs over threads itself; call it from one thread

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "engine/data/finding.hpp"
#include "engine/data/recorded_tables.hpp"
#include "engine/job/job.hpp"
#include "engine/run/progress_update.hpp"
#include "engine/store/segment_folder.hpp"
#include "engine/store/written_result.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

// instruction set of the kernels on this machine: "AVX3", "AVX2", ...
std::string vector_target();

// one line of `torquescope check`
struct CheckLine {
  enum class Level { ok, note, warn, fault };
  Level level = Level::ok;
  std::string topic;  // "recording", "delay", "excitation"
  std::string text;
};

// a job that was read, checked and turned into objects (recordings are read, nothing has run)
class Experiment {
 public:
  // what a job is loaded for decides what it must have: [[estimator]] to identify, nothing more to diagnose; to check
  // it, [[estimator]] or [diagnose]; to replay it, neither
  enum class Purpose { identify, diagnose, check, replay };
  // Errors: 66, 65, 78 with everything that can be refused before starting
  static Experiment load(std::filesystem::path const& job_file, Purpose purpose = Purpose::identify);
  // of a text that need not be a file yet; a recording that it names is looked for in `tables` before any file is
  static Experiment load(Job job, Purpose purpose, RecordedTables const& tables = {});
  Experiment(Experiment&&) noexcept;
  ~Experiment();

  std::string const& name() const;
  std::string job_line() const;                    // "crs_a465_joint: 1 joint, 4 parameters; ols, de, fade; 61 runs"
  std::string diagnose_line() const;               // "lab_joint_3: 1 joint, 4 parameters; 34 effects, 200 twins"
  std::string data_line() const;                   // "simulated, 2000 samples, 10 s at 200 Hz; cutoff 20 Hz"
  std::vector<std::string> fitness_lines() const;  // per population method: "de from sufficient statistics (auto): ..."
  std::uint64_t seed() const;
  std::string inputs_sha256() const;  // of the job's text and every recording: two results of equal inputs are equal
  std::filesystem::path output_file() const;  // [output] file, or NAME.h5 in the working folder
  std::vector<CheckLine> check(int threads) const;
  std::vector<std::string> warnings() const;  // one line each, printed by `run` before it starts
  std::vector<std::string> remarks() const;   // the same of what is healthy
  std::vector<Finding> findings() const;      // of the examination of every recording

  struct Parts;
  Parts const& parts() const { return *parts_; }
  // what only people look at: once written, a fit does without
  void forget_motion();
  // once the floor of the squared errors is known
  void forget_reductions();

 private:
  std::string filter_warning() const;  // empty: the cut-offs go together
  bool asks_for_values() const;        // of parameters; else the job asks for a verdict alone

  explicit Experiment(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

struct IdentifyOptions {
  ThreadChoice threads{};
  std::filesystem::path output{};
  std::function<bool()> stop_requested{};     // polled once a generation; true: what is done is saved, Error 75
  std::function<std::string()> stop_words{};  // by what: "SIGTERM", "time budget (3600 s)"
  std::function<void()> saving{};             // called before what is done is saved: by a stop, or by the result itself
  std::function<void(std::string const& topic, std::string const& text)> tell{};  // "resume", "warning"
  ShardChoice shard{};                                                            // of run_shard()
  double segment_seconds = 20.0;                                                  // between two segments, at least
  bool allow_mixed = false;           // go on from segments of another program, or another text of the job
  bool allow_full_disk = false;       // begin although the result does not seem to fit
  std::filesystem::path continued{};  // a result whose searches go on (earlier_result.hpp); empty: none
  std::function<void(std::size_t, std::size_t)>
      safe{};  // runs that a power cut cannot take any more, of all: after a segment
  std::vector<std::filesystem::path> more_segments{};  // folders beside OUTPUT.parts: of merge
};

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
  std::function<bool()> stop_requested{};  // asked from any thread, between twins and laws; true: Error 75
  std::function<void(std::string const& topic, std::string const& text)> tell{};  // "warning"
  bool allow_full_disk = false;   // begin although the result does not seem to fit
  ShardChoice shard{};            // of the twins; every shard makes the whole result
  double expected_seconds = 0.0;  // of the estimate, for progress; 0: none
};

// Finds the physics that the job's model lacks and writes the result file; stages "twins", "search", "verify". With
// several shards twins are exchanged in OUTPUT.parts (twin_folder.hpp), which goes when the result stands. Error 74
// when there is no room for the result; 73 when a living process is at this shard; 75 too when another shard has
// published the result
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
