#include "engine/experiment/job_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/data/health/finding_text.hpp"
#include "engine/experiment/job/stored_generations.hpp"
#include "engine/experiment/job_sections.hpp"

namespace torquescope {
namespace {

Problem missing(Job const& job, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place.file = job.path.string();
  problem.help = std::move(help);
  return problem;
}

}  // namespace

void check_work(Job const& job, Experiment::Purpose purpose, std::vector<Problem>& problems) {
  bool const needs_none = purpose == Experiment::Purpose::diagnose || purpose == Experiment::Purpose::replay;
  if (needs_none || !job.all("estimator").empty()) return;
  bool const diagnoses = job.find("diagnose") != nullptr;
  if (purpose == Experiment::Purpose::check && diagnoses) return;
  std::string help = "write [[estimator]] with name = \"ols\"";
  if (diagnoses) help += ", or run it with `torquescope diagnose`";
  if (purpose == Experiment::Purpose::check) help += ", or [diagnose] where it is for `torquescope diagnose`";
  problems.push_back(missing(job, "the job has no [[estimator]]", std::move(help)));
}

void check_name(Job const& job, std::string const& name, std::vector<Problem>& problems) {
  if (is_a_name(name)) return;
  auto const* section = job.find("experiment");
  if (section != nullptr)
    problems.push_back(problem_at(*section, "name", "the name of an experiment has no \"/\" and no control characters",
                                  "a path belongs into --out, or [output] file"));
}

void check_history(Job const& job, OutputOptions const& output, std::vector<Problem>& problems) {
  if (StoredGenerations::of(output.history, 0)) return;
  problems.push_back(problem_at(*job.find("output"), "history",
                                fmt::format("history = \"{}\" names no generations", output.history),
                                "write \"full\" (every generation), \"every 10\" (any whole number from 1 on) or "
                                "\"last\""));
}

void check_sources(Job const& job, RecordingOptions const& recording, Experiment::Purpose purpose,
                   std::vector<Problem>& problems) {
  bool const reads = !recording.train.empty();
  bool const simulates = job.find("simulate") != nullptr;
  if (Section const* set = job.find("recordings")) {
    if (purpose == Experiment::Purpose::identify || purpose == Experiment::Purpose::replay) return;
    problems.push_back(problem_at(*set, "", "this command works on recording.train, and the job has [[recordings]]",
                                  "write [recording] with train = [\"FILE.csv\"] in place of [[recordings]]"));
    return;
  }
  if (Section const* known = job.find("known"))
    problems.push_back(problem_at(*known, "", "[known] is about the recordings of [[recordings]], and there are none",
                                  "remove it, or write [[recordings]] with files = \"train/*.csv\""));
  if (!reads && !simulates)
    problems.push_back(missing(job, "the job has no data: neither recording.train nor [simulate]",
                               "write [recording] with train = \"FILE.csv\", or [simulate] with a plant"));
  if (reads && simulates)
    problems.push_back(problem_at(*job.find("simulate"), "", "the job has both recording.train and [simulate]",
                                  "remove one of them; `torquescope simulate` writes a recording that train can name"));
}

void check_sizes(Experiment::Parts const& parts, std::vector<Problem>& problems) {
  constexpr double tebibyte = 0x1p40, most_tebibytes = 1024.0;
  constexpr double numbers_beside_members = 7.0;  // F, CR, PC, FC, best, gap, evaluations
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < parts.estimators.size(); ++i) {
    auto const& plan = parts.estimators[i];
    if (plan.is_closed_form()) continue;
    double const members =
        parts.output.populations ? static_cast<double>(plan.make_optimiser(parts.box, {})->largest_batch()) : 0.0;
    double const entries = static_cast<double>(plan.stop_rules.generations) + 1.0;
    double const numbers_per_member = static_cast<double>(parts.parameters()) + 1.0;
    double const numbers = members * numbers_per_member + numbers_beside_members;
    double const bytes = static_cast<double>(parts.experiment.runs) * entries * numbers * sizeof(double);
    if (bytes <= most_tebibytes * tebibyte) continue;
    problems.push_back(
        problem_at(*sections[i], "generations",
                   fmt::format("{} runs of {} generations are {:.3g} TiB of history; a job may have {}",
                               parts.experiment.runs, plan.stop_rules.generations, bytes / tebibyte, most_tebibytes),
                   "fewer generations, a smaller population, or fewer experiment.runs"));
  }
}

void check_precision(Experiment::Parts& parts) {
  std::vector<Problem> problems;
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < sections.size(); ++i) {
    auto const& plan = parts.estimators[i];
    if (plan.is_closed_form() || plan.objective.precision != "float32") continue;
    if (!parts.single_precision)
      parts.single_precision = check_single_precision(parts.train.regression, *parts.statistics);
    auto const& check = *parts.single_precision;
    if (check.usable()) continue;
    std::string const why = std::isnan(check.noise)
                                ? parts.statistics->refusal()
                                : fmt::format("least squares leaves {:.1e} of the torque (float32 needs {:.0e})",
                                              check.noise, SinglePrecisionCheck::least_noise);
    problems.push_back(
        problem_at(*sections[i], "precision",
                   fmt::format("precision = \"float32\" {}: {}",
                               std::isnan(check.noise) ? "cannot be judged" : "on data without noise", why),
                   "its rounding would decide which candidate is better: remove precision"));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

void refuse_faults(Experiment::Parts const& parts, Job const& job, RecordingOptions const& options) {
  std::vector<Problem> problems;
  auto const add = [&](std::vector<Recording> const& recordings, std::vector<std::string> const& files) {
    for (std::size_t k = 0; k < std::min(recordings.size(), files.size()); ++k)
      for (auto const& finding : recordings[k].findings)
        if (is_fault(finding)) problems.push_back(problem_of(finding, job.resolve(files[k]).string()));
  };
  add(parts.train.recordings, options.train);
  if (parts.validate) add(parts.validate->recordings, options.validate);
  if (!problems.empty()) throw Error(std::move(problems));
}

void refuse_rollouts_of_arm(Experiment::Parts const& parts, std::vector<Problem>& problems) {
  char const* const help = "rollouts are of one joint: name its columns in a job with model.terms";
  for (char const* name : {"loop", "model.given"})
    if (Section const* section = parts.job.find(name))
      problems.push_back(problem_at(*section, "", fmt::format("[{}] in the job of an arm", name), help));
  auto const sections = parts.job.all("estimator");
  for (std::size_t i = 0; i < std::min(sections.size(), parts.estimators.size()); ++i)
    if (parts.estimators[i].rolls_out())
      problems.push_back(problem_at(
          *sections[i], parts.estimators[i].lm ? "name" : "fitness",
          fmt::format("{} simulates the recordings, and the job is about an arm", parts.estimators[i].label), help));
}

}  // namespace torquescope
