#include "engine/data/health/slow_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/base/median.hpp"
#include "engine/data/health/value_runs.hpp"

namespace torquescope {
namespace {

// the median time from one of these rows to the next
double period_of_rows(std::vector<double> const& time_s, std::vector<std::size_t> const& rows) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < rows.size(); ++k) steps.push_back(time_s[rows[k]] - time_s[rows[k - 1]]);
  return upper_median(std::move(steps));
}

}  // namespace

void examine_slow_sources(Examination& exam) {
  for (auto const* name : {"position", "torque", "velocity", "acceleration"}) {
    if (!exam.has(name)) continue;
    auto& values = exam.values(name);
    auto const known = known_rows(values);
    std::vector<double> x;
    for (std::size_t row : known) x.push_back(values[row]);
    auto const source = slow_source_of(x);
    if (!source.is_slow()) continue;

    double const step_s = period_of_rows(exam.time_s, known);
    if (!(step_s > 0.0)) continue;
    double const rate_hz = 1.0 / (source.rows * step_s);
    exam.source_hz[name] = rate_hz;
    auto sample = source.samples.begin();
    std::vector<std::size_t> repeated;
    for (std::size_t place = 0; place < known.size(); ++place) {
      if (sample != source.samples.end() && *sample == place) {
        ++sample;
        continue;
      }
      values[known[place]] = missing;
      repeated.push_back(known[place]);
    }
    exam.add(FindingKind::slow_source, Grade::warning, Repair::left_out, name, repeated, rate_hz,
             fmt::format("{:.3g}", source.rows));
  }
}

}  // namespace torquescope
