#include "engine/experiment/diagnosis_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "engine/base/quantity_text.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

namespace {

// measured, one effect found (tests/unit/workflows/diagnosis_estimate.cpp)
constexpr double cpu_s_per_sample = 5e-4, cpu_s_per_row_replicate = 5e-6, most_cores_used = 8.0;
constexpr double bytes_at_least = 3e7, bytes_per_sample = 1400.0, bytes_per_row_replicate = 48.0;
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

}  // namespace

DiagnosisSize diagnosis_size(Experiment::Parts const& parts) {
  DiagnosisSize size;
  auto const& filter = parts.filter;
  size.samples = static_cast<double>(parts.train.n_samples.front());  // further ones are predicted, not fitted
  double const rate_hz = parts.train.recordings.front().rate_hz;
  double const kept_hz = filter.decimate_to_hz > 0.0 ? filter.decimate_to_hz : rate_hz;
  size.rows = size.samples * std::min(1.0, kept_hz / rate_hz);
  size.replicates = static_cast<double>(parts.diagnose.twins);
  size.joints = static_cast<double>(parts.joints());
  size.unseen_samples = samples_in(parts.train) - size.samples + (parts.validate ? samples_in(*parts.validate) : 0.0);
  return size;
}

DiagnosisEstimate estimate_diagnosis(DiagnosisSize const& size, int threads) {
  double const cpu_s =
      size.joints * (cpu_s_per_sample * size.samples + cpu_s_per_row_replicate * size.rows * size.replicates);
  double const cores = std::clamp(static_cast<double>(threads), 1.0, most_cores_used);
  return {cpu_s / cores, bytes_at_least + bytes_per_sample * (size.samples + size.unseen_samples) +
                             bytes_per_row_replicate * size.rows * size.replicates};
}

std::string estimate_words(DiagnosisSize const& size, DiagnosisEstimate const& estimate) {
  std::string const joints = size.joints > 1.0 ? fmt::format(" x {:.0f} joints", size.joints) : "";
  return fmt::format("{} rows x {:.0f} replicates{}: about {} and {} of memory for one effect", rough_count(size.rows),
                     size.replicates, joints, rough_seconds(estimate.seconds), rough_bytes(estimate.bytes));
}

std::optional<std::string> decimation_proposal(Experiment::Parts const& parts, int threads) {
  DiagnosisSize size = diagnosis_size(parts);
  if (size.rows < many_rows) return std::nullopt;
  double const rate_hz = parts.train.recordings.front().rate_hz;
  double cutoff_hz = parallel_cutoff_of(parts.filter);
  bool const has_cutoff = cutoff_hz > 0.0;
  if (!has_cutoff && parts.filter.cutoff_hz > 0.0) cutoff_hz = parts.filter.cutoff_hz / 2.0;
  if (!(cutoff_hz > 0.0)) {
    return "many rows: [filter] cutoff_hz, parallel_cutoff_hz and decimate_to_hz make them fewer; torquescope init "
           "writes values that suit the recording";
  }
  double const proposed_hz = suggested_kept_rate(rate_hz, cutoff_hz);
  double const now_hz = parts.filter.decimate_to_hz > 0.0 ? parts.filter.decimate_to_hz : rate_hz;
  constexpr double worth_it = 0.7;
  if (!(proposed_hz > 0.0) || proposed_hz > worth_it * now_hz) return std::nullopt;
  size.rows *= proposed_hz / now_hz;
  DiagnosisEstimate const then = estimate_diagnosis(size, threads);
  std::string const cutoff = has_cutoff ? "" : fmt::format("parallel_cutoff_hz = {:g} and ", cutoff_hz);
  return fmt::format(
      "{}decimate_to_hz = {:g} in [filter] would keep {} of these rows, which is all that a cut-off of "
      "{:g} Hz leaves to see: about {} and {}",
      cutoff, proposed_hz, rough_count(size.rows), cutoff_hz, rough_seconds(then.seconds), rough_bytes(then.bytes));
}

}  // namespace torquescope
