#pragma once
// A job that was read, checked and turned into objects, and what `torquescope check` says of it.
//
// Errors     Error with the exit codes of error.hpp; every problem of a job at once
// Threads    a value that does not change but by forget_motion() and forget_reductions()

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/data/finding.hpp"
#include "engine/data/recorded_tables.hpp"
#include "engine/experiment/job/job.hpp"

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
  std::string diagnose_line() const;               // "lab_joint_3: 1 joint, 4 parameters; 34 effects, 200 replicates"
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

}  // namespace torquescope
