#include "engine/experiment/runs/earlier_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/code_identity.hpp"
#include "engine/experiment/runs/search_identity.hpp"

namespace torquescope {
namespace {

// the same estimator in both jobs
struct Pair {
  EstimatorPlan const& before;
  EstimatorPlan const& now;
  Section const& section_before;
  Section const& section_now;
};

std::string const begin_anew = "run without --continue, into another --out";

// "model.terms" -> as it is written; "[filter]" -> "" where the section is there
std::map<std::string, std::string> written(std::vector<Section> const& sections) {
  std::map<std::string, std::string> texts;
  std::map<std::string, int> count;
  for (auto const& section : sections) {
    int const number = ++count[section.name];
    std::string const name = number == 1 ? section.name : fmt::format("{} {}", section.name, number);
    texts["[" + name + "]"] = "";
    for (auto const& setting : section.settings) texts[name + "." + setting.key] = to_text(setting.value);
  }
  return texts;
}

std::vector<std::string> differences(std::map<std::string, std::string> before, std::map<std::string, std::string> now,
                                     std::string const& file) {
  std::vector<std::string> lines;
  auto const place = [&](std::string const& key, std::string const& where) {
    return fmt::format("{} stands in the job {} alone", key, where);
  };
  for (auto const& [key, text] : before) {
    auto const here = now.find(key);
    if (here == now.end())
      lines.push_back(place(key, "of " + file));
    else if (here->second != text)
      lines.push_back(fmt::format("{}: {} then, {} now", key, text, here->second));
    if (here != now.end()) now.erase(here);
  }
  for (auto const& [key, text] : now) lines.push_back(place(key, "now"));
  return lines;
}

// what may differ between two sections of an estimator
std::set<std::string> free_keys() {
  std::set<std::string> keys{"label", "fitness"};  // one is equal, of the other what it comes to is asked
  for (auto const& option : StopRules::table().describe()) keys.insert(option.key);
  return keys;
}

Section fixed_part(Section section) {
  std::erase_if(section.settings, [free = free_keys()](auto const& setting) { return free.contains(setting.key); });
  return section;
}

std::vector<std::string> differences_of_jobs(EarlierSearch const& earlier, Experiment::Parts const& parts,
                                             std::vector<Pair> const& pairs) {
  std::string const file = earlier.file.filename().string();
  auto notes = differences(written(search_sections(earlier.job)), written(search_sections(parts.job)), file);
  for (auto const& pair : pairs)
    for (auto const& line :
         differences(written({fixed_part(pair.section_before)}), written({fixed_part(pair.section_now)}), file))
      notes.push_back(fmt::format("{}: {}", pair.now.label, line));
  return notes;
}

std::vector<std::string> differences_of_data(EarlierSearch const& earlier, Experiment::Parts const& parts) {
  std::vector<std::string> notes;
  auto const& recordings = parts.train.recordings;
  std::size_t const n_before = earlier.recordings_sha256.size();
  if (recordings.size() != n_before)
    notes.push_back(fmt::format("training recordings: {} then, {} now", n_before, recordings.size()));
  for (std::size_t k = 0; k < std::min(recordings.size(), n_before); ++k)
    if (recordings[k].sha256 != earlier.recordings_sha256[k])
      notes.push_back(fmt::format("the recording {} holds other samples (its sha256 differs)", recordings[k].name));
  if (parts.arm && parts.arm->sha256 != earlier.robot_sha256)
    notes.push_back(fmt::format("the robot {} has other numbers", parts.arm->robot_file));
  return notes;
}

// NaN where a parameter had none
bool is_same_start(std::vector<double> const& before, std::vector<double> const& now) {
  auto const same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  return std::equal(before.begin(), before.end(), now.begin(), now.end(), same);
}

void compare_searches(EarlierSearch const& earlier, Experiment::Parts const& parts, std::vector<Pair> const& pairs,
                      std::vector<Problem>& problems) {
  auto notes = differences_of_jobs(earlier, parts, pairs);
  for (auto& line : differences_of_data(earlier, parts)) notes.push_back(std::move(line));
  for (auto const& pair : pairs)
    if (!is_same_start(earlier.methods.at(pair.now.label).start, pair.now.start))
      notes.push_back(fmt::format("{}: {} holds another best estimate", pair.now.label, pair.now.start_from));
  if (notes.empty()) return;
  constexpr std::size_t most_lines = 12;
  if (notes.size() > most_lines) {
    std::size_t const more = notes.size() - most_lines;
    notes.resize(most_lines);
    notes.push_back(fmt::format("and {} more", more));
  }
  problems.push_back(
      {.code = ExitCode::bad_job,
       .what = fmt::format("{} is of another search: its runs cannot go on under this job", earlier.file.string()),
       .notes = std::move(notes),
       .help = "only stop rules may change, such as generations; else " + begin_anew});
}

void compare_rules(Pair const& pair, std::vector<Problem>& problems) {
  StopRules const& before = pair.before.stop_rules;
  StopRules const& now = pair.now.stop_rules;
  for (auto const& key : stricter_rules(now, before))
    problems.push_back(
        problem_at(pair.section_now, key,
                   fmt::format("{} of {} is stricter than it was: a run might have ended earlier", key, pair.now.label),
                   "make it no stricter; or " + begin_anew));
}

void check_plan(Pair const& pair, Experiment::Parts const& parts, std::vector<Problem>& problems) {
  StopRules const& before = pair.before.stop_rules;
  StopRules const& now = pair.now.stop_rules;
  bool const same_limits = now.generations == before.generations && now.evaluations == before.evaluations;
  if (same_limits || !pair.now.make_optimiser(parts.box, {})->plans_by_budget()) return;
  problems.push_back(problem_at(
      pair.section_now, now.generations != before.generations ? "generations" : "evaluations",
      fmt::format("{} spends its budget by a plan: with a larger one it would have gone another way from the start",
                  pair.now.label),
      fmt::format("give {} the limits it had; or {}", pair.now.label, begin_anew)));
}

void check_fitness(Pair const& pair, EarlierSearch::Method const& method, Experiment::Parts const& parts,
                   std::vector<Problem>& problems) {
  std::string const now = fitness_choice(parts, pair.now).from_statistics ? "gram" : "direct";
  if (method.fitness_used.empty() || method.fitness_used == now) return;
  problems.push_back(
      problem_at(pair.section_now, "fitness",
                 fmt::format("the fitness of {} would be made by \"{}\" now, and was by \"{}\": its last "
                             "digits differ",
                             pair.now.label, now, method.fitness_used),
                 fmt::format("write fitness = \"{}\" for {}", method.fitness_used, pair.now.label)));
}

void check_states(std::string const& label, EarlierSearch const& earlier, std::vector<Problem>& problems) {
  auto const& method = earlier.methods.at(label);
  if (method.has_states) return;
  if (method.is_thinned) {
    problems.push_back({.code = ExitCode::bad_job,
                        .what = fmt::format("{} stores some generations of {} only: none can go on from there",
                                            earlier.file.string(), label),
                        .help = begin_anew + ", with [output] history = \"full\""});
    return;
  }
  problems.push_back(
      {.code = ExitCode::bad_job,
       .what = fmt::format("{} keeps no states of {} to go on from", earlier.file.string(), label),
       .notes = {method.has_populations ? "an earlier program wrote it"
                                        : "[output] populations = false leaves them out, with the populations"},
       .help = begin_anew + (method.has_populations ? "" : ", with populations = true")});
}

void check_program(EarlierSearch const& earlier, std::vector<Problem>& problems) {
  if (earlier.numerics_sha256 == numerics_sha256()) return;
  problems.push_back(
      {.code = ExitCode::bad_job,
       .what = fmt::format("{} was made by another program (sources, compiler or build differ)", earlier.file.string()),
       .notes = {"its runs may differ in their last digits from those of this one"},
       .help = "continue with the program that made it; or --allow-mixed; or " + begin_anew});
}

// section by section as their plans
std::vector<Pair> pairs_of(EarlierSearch const& earlier, std::vector<EstimatorPlan> const& plans_before,
                           Experiment::Parts const& parts) {
  auto const sections_before = earlier.job.all("estimator"), sections_now = parts.job.all("estimator");
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < parts.estimators.size(); ++i)
    for (std::size_t k = 0; k < plans_before.size(); ++k)
      if (parts.estimators[i].label == plans_before[k].label && !parts.estimators[i].is_closed_form() &&
          earlier.methods.contains(plans_before[k].label))
        pairs.push_back({plans_before[k], parts.estimators[i], *sections_before[k], *sections_now[i]});
  return pairs;
}

}  // namespace

EarlierSearch read_earlier_search(ResultReader const& reader) {
  EarlierSearch earlier;
  earlier.file = reader.name();
  validate(reader.exists("/runs") && reader.exists("/job/text"), [&] {
    return Problem{.code = ExitCode::bad_data,
                   .what = earlier.file.string() + " holds no runs that could go on",
                   .help = "--continue takes a result of torquescope run"};
  });
  auto const text = reader.texts("/job/text");
  earlier.job = parse_job(text.empty() ? std::string() : text.front(), earlier.file.string() + ":/job/text");
  earlier.recordings_sha256 = reader.attribute<std::vector<std::string>>("/data/train", "sha256");
  if (reader.exists("/robot")) earlier.robot_sha256 = reader.attribute<std::string>("/robot", "sha256");
  earlier.numerics_sha256 = reader.find_attribute<std::string>("/provenance", "numerics_sha256").value_or("");
  for (auto const& label : reader.attribute<std::vector<std::string>>("/runs", "order")) {
    std::string const group = "/runs/" + label;
    earlier.methods[label] = {
        reader.find_attribute<std::string>(group, "fitness_used").value_or(""),
        reader.find_attribute<std::vector<double>>(group, "start").value_or(std::vector<double>()),
        reader.exists(group + "/population"), reader.exists(group + "/last_state"),
        reader.exists(group + "/last_generation")};
  }
  return earlier;
}

std::vector<Problem> reasons_to_begin_anew(EarlierSearch const& earlier, Experiment::Parts const& parts,
                                           bool allow_mixed) {
  std::vector<Problem> problems;
  if (!allow_mixed) check_program(earlier, problems);
  std::vector<Problem> unreadable;
  auto const plans_before = plan_estimators(earlier.job.all("estimator"), unreadable);
  if (!unreadable.empty()) return unreadable;
  auto const pairs = pairs_of(earlier, plans_before, parts);
  compare_searches(earlier, parts, pairs, problems);
  if (pairs.empty())
    problems.push_back({.code = ExitCode::bad_job,
                        .what = fmt::format("{} has no search of this job: no label is in both", earlier.file.string()),
                        .help = begin_anew});
  if (!problems.empty()) return problems;
  for (auto const& pair : pairs) {
    check_states(pair.now.label, earlier, problems);
    compare_rules(pair, problems);
    check_plan(pair, parts, problems);
    check_fitness(pair, earlier.methods.at(pair.now.label), parts, problems);
  }
  return problems;
}

}  // namespace torquescope
