#include "engine/experiment/diagnosis_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "engine/base/quantity_text.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

namespace {

// measured, one effect found (tests/unit/workflows/diagnosis_estimate.cpp)
constexpr double cpu_s_per_fitted = 8e-4, cpu_s_per_sample = 1e-4, cpu_s_per_row_replicate = 3e-4;
constexpr double most_cores_used = 8.0;
constexpr double bytes_at_least = 5e7, bytes_per_sample = 300.0, bytes_per_row_replicate = 250.0;
// rows a second for each Hz of the parallel cut-off (decision/strip.cpp)
constexpr double rows_per_cutoff = 2.56;
// from here on fewer rows are worth a word
constexpr double many_rows = 3e4;

// as they were read: a job that is loaded to be checked holds no channels any more
double samples_in(DataSet const& set) {
  return static_cast<double>(std::accumulate(set.n_samples.begin(), set.n_samples.end(), std::size_t{0}));
}

std::string rough_seconds(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string rough_bytes(double bytes) {
  return bytes < 1e9 ? two_digits(bytes / 1e6) + " MB" : two_digits(bytes / 1e9) + " GB";
}

std::string rough_count(double count) {
  return count < 1e5 ? fmt::format("{:.0f}", count) : two_digits(count / 1e6) + " million";
}

DecisionNumbers numbers_of(Experiment::Parts const& parts) {
  DecisionNumbers numbers = decision_numbers(parts.diagnose, parts.levels);
  numbers.alpha = numbers.alpha_of_joint(parts.joints());
  return numbers;
}

// so many that a name can come out
double replicates_of(DecisionNumbers const& numbers) {
  return std::max(static_cast<double>(numbers.replicates), std::ceil(1.0 / numbers.correction_alpha()));
}

}  // namespace

DiagnosisSize diagnosis_size(Experiment::Parts const& parts) {
  DiagnosisSize size;
  size.samples = samples_in(parts.train);
  double const rate_hz = parts.train.recordings.front().rate_hz, cutoff_hz = parallel_cutoff_of(parts.filter);
  size.rows = cutoff_hz > 0.0 ? size.samples * std::min(1.0, rows_per_cutoff * cutoff_hz / rate_hz) : size.samples;
  DecisionNumbers const numbers = numbers_of(parts);
  size.replicates = replicates_of(numbers);
  size.most_fitted = static_cast<double>(numbers.fitted_samples);
  size.joints = static_cast<double>(parts.joints());
  size.validation_samples = parts.validate ? samples_in(*parts.validate) : 0.0;
  return size;
}

DiagnosisEstimate estimate_diagnosis(DiagnosisSize const& size, int threads) {
  double const cpu_s =
      size.joints * (cpu_s_per_fitted * std::min(size.samples, size.most_fitted) + cpu_s_per_sample * size.samples +
                     cpu_s_per_row_replicate * size.rows * size.replicates);
  double const cores = std::clamp(static_cast<double>(threads), 1.0, most_cores_used);
  return {cpu_s / cores, bytes_at_least + bytes_per_sample * (size.samples + size.validation_samples) +
                             bytes_per_row_replicate * size.rows * size.replicates};
}

std::string estimate_words(DiagnosisSize const& size, DiagnosisEstimate const& estimate) {
  std::string const joints = size.joints > 1.0 ? fmt::format(" x {:.0f} joints", size.joints) : "";
  return fmt::format("{} rows x {:.0f} replicates{}: about {} and {} of memory for one effect", rough_count(size.rows),
                     size.replicates, joints, rough_seconds(estimate.seconds), rough_bytes(estimate.bytes));
}

std::optional<std::string> many_rows_warning(Experiment::Parts const& parts) {
  if (diagnosis_size(parts).rows < many_rows) return std::nullopt;
  return "many rows: a lower parallel_cutoff_hz in [filter] makes them fewer; torquescope init writes values that suit "
         "the recording";
}

}  // namespace torquescope
