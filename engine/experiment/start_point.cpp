#include "engine/experiment/start_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/stored_objects.hpp"
#include "engine/store/look_at_result.hpp"

namespace torquescope {
namespace {

struct StoredBest {
  std::string label;  // of the estimator that found it
  double mse = std::numeric_limits<double>::infinity();
  std::vector<double> values;
  std::vector<std::string> names, units;
};

StoredBest best_estimate(ResultReader const& reader) {
  validate(reader.exists("/runs"), [&] {
    return Problem{.code = ExitCode::bad_job,
                   .what = reader.name().string() + " holds no runs to start from",
                   .help = "start_from takes a result of torquescope run"};
  });
  StoredObjects const in(reader);
  StoredBest best;
  best.names = in.text_column("/model/names");
  best.units = in.text_column("/model/units");
  in.check_same_length("/model", best.names.size(), best.units);
  for (auto const& label : in.texts("/runs", "order")) {
    std::string const group = "/runs/" + label;
    auto const mse = in.numbers(group + "/mse"), parameters = in.numbers(group + "/parameters");
    in.check_same_length(group, mse.size() * best.names.size(), parameters);
    for (std::size_t run = 0; run < mse.size(); ++run) {
      if (!(mse[run] < best.mse)) continue;
      best.label = label;
      best.mse = mse[run];
      auto const from = parameters.begin() + static_cast<std::ptrdiff_t>(run * best.names.size());
      best.values.assign(from, from + static_cast<std::ptrdiff_t>(best.names.size()));
    }
  }
  validate(!best.values.empty(),
           [&] { return contradiction(reader, "/runs", "no run has a finite MSE").problems().front(); });
  return best;
}

StoredBest read_best(std::filesystem::path const& file) {
  look_at_result(file, [](ResultReader const& reader) { best_estimate(reader); });
  return best_estimate(ResultReader(file));
}

// by parameter of the job; NaN where the result has none of this name
std::vector<double> start_of(StoredBest const& best, Experiment::Parts const& parts, Section const& section) {
  auto const names = parts.parameter_names(), units = parts.parameter_units();
  std::vector<double> start(names.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Problem> problems;
  for (std::size_t j = 0; j < names.size(); ++j) {
    auto const found = std::find(best.names.begin(), best.names.end(), names[j]);
    if (found == best.names.end()) continue;
    auto const k = static_cast<std::size_t>(found - best.names.begin());
    if (best.units[k] != units[j])
      problems.push_back(problem_at(section, "start_from",
                                    fmt::format("{} is in {} there, and in {} here", names[j], best.units[k], units[j]),
                                    "start from a result of the same kind of joint"));
    start[j] = best.values[k];
  }
  if (std::all_of(start.begin(), start.end(), [](double value) { return std::isnan(value); }))
    problems.push_back(problem_at(section, "start_from", "the result has no parameter of this model",
                                  "start from a result of a model with some of these terms"));
  if (!problems.empty()) throw Error(std::move(problems));
  return start;
}

// "de starts at old.h5 (ols): inertia 0.5, viscous 0.2; moved into the box: viscous; not there: offset"
std::string words_of(EstimatorPlan const& plan, StoredBest const& best, Experiment::Parts const& parts) {
  std::vector<std::string> known, moved, absent;
  auto const names = parts.parameter_names();
  for (std::size_t j = 0; j < names.size(); ++j) {
    double const value = plan.start[j];
    if (std::isnan(value))
      absent.push_back(names[j]);
    else
      known.push_back(fmt::format("{} {:.4g}", names[j], value));
    if (value < parts.box.lower[j] || value > parts.box.upper[j]) moved.push_back(names[j]);
  }
  std::string words =
      fmt::format("{} starts at {} ({}): {}", plan.label, plan.start_from, best.label, fmt::join(known, ", "));
  if (!moved.empty()) words += fmt::format("; moved into the box: {}", fmt::join(moved, ", "));
  if (!absent.empty()) words += fmt::format("; not there: {}", fmt::join(absent, ", "));
  return words;
}

}  // namespace

void set_starts(Experiment::Parts& parts) {
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < parts.estimators.size(); ++i) {
    auto& plan = parts.estimators[i];
    if (plan.start_from.empty()) continue;
    StoredBest const best = read_best(parts.job.resolve(plan.start_from));
    plan.start = start_of(best, parts, *sections[i]);
    plan.start_words = words_of(plan, best, parts);
    plan.make_optimiser = [make = std::move(plan.make_optimiser), start = plan.start](Bounds const& box,
                                                                                      RandomKey key) {
      auto search = make(box, key);
      search->start_at(start);
      return search;
    };
  }
}

}  // namespace torquescope
