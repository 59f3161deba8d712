#include "engine/experiment/estimator_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "engine/experiment/job_sections.hpp"

namespace torquescope {

OptionTable<EstimatorOptions> const& EstimatorOptions::table() {
  static OptionTable<EstimatorOptions> const table(
      "estimator", "one method that estimates the parameters; write as many [[estimator]] as there are to compare",
      {{"name", &EstimatorOptions::name, "which one (torquescope list estimators, torquescope list optimisers)"},
       {"label", &EstimatorOptions::label, "its name in results; default: name. Two of one kind need two labels"}});
  return table;
}

OptionTable<StartOptions> const& StartOptions::table() {
  static OptionTable<StartOptions> const table(
      "estimator", "where a population method begins",
      {{"start_from", &StartOptions::start_from,
        "a result whose best estimate every run begins with: as its first member, or cmaes as its first mean"}});
  return table;
}

namespace {

template <class Options>
std::vector<std::string> keys_of(OptionTable<Options> const& table) {
  std::vector<std::string> keys;
  for (auto const& option : table.describe()) keys.push_back(option.key);
  return keys;
}

// the settings of a section that belong to one table
template <class Options>
void apply_own(OptionTable<Options> const& table, Section const& section, Options& options,
               std::vector<Problem>& problems) {
  auto const keys = keys_of(table);
  Section own{section.name, section.place, {}};
  for (auto const& setting : section.settings)
    if (std::find(keys.begin(), keys.end(), setting.key) != keys.end()) own.settings.push_back(setting);
  table.apply(own, options, problems);
}

// "0.5" as the number it is, "\"midpoint\"" as its text
OptionValue default_value(std::string const& text) {
  double number = 0.0;
  auto const result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec == std::errc() && result.ptr == text.data() + text.size()) return number;
  bool const quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

// what was written, and the default of everything else
void append_options(std::vector<OptionDescription> const& described, Section const& section, EstimatorPlan& plan) {
  for (auto const& option : described) {
    Setting const* written = section.find(option.key);
    plan.options.emplace_back(option.key, written ? written->value : default_value(option.default_value));
  }
}

template <class Choices>
void append_names(Choices const& choices, std::vector<std::string>& names) {
  for (auto const& choice : choices) names.push_back(choice.name);
}

Problem unknown_estimator(Section const& section, std::string const& name) {
  std::vector<std::string> names;
  append_names(estimator_choices(), names);
  append_names(optimiser_choices(), names);
  names.emplace_back(lm_name);
  Problem problem =
      problem_at(section, "name",
                 name.empty() ? "an [[estimator]] has no name" : fmt::format("no estimator is called \"{}\"", name),
                 fmt::format("name is one of: {}", fmt::join(names, ", ")));
  std::string const close = closest_name(name, names);
  if (!close.empty()) problem.caret_note = fmt::format("did you mean \"{}\"?", close);
  return problem;
}

EstimatorPlan plan_population_method(OptimiserChoice const& choice, Section const& section, EstimatorPlan plan,
                                     std::vector<Problem>& problems) {
  std::vector<std::string> shared = keys_of(EstimatorOptions::table());
  for (auto const& key : keys_of(StopRules::table())) shared.push_back(key);
  for (auto const& key : keys_of(ObjectiveOptions::table())) shared.push_back(key);
  for (auto const& key : keys_of(StartOptions::table())) shared.push_back(key);
  StartOptions start;
  apply_own(StartOptions::table(), section, start, problems);
  plan.start_from = start.start_from;
  apply_own(StopRules::table(), section, plan.stop_rules, problems);
  apply_own(ObjectiveOptions::table(), section, plan.objective, problems);
  if (auto problem = contradiction(plan.objective, section)) problems.push_back(*std::move(problem));
  plan.make_optimiser = choice.prepare(section, shared, problems);
  if (choice.controller) plan.controller = choice.controller(section);
  if (plan.stop_rules.generations < 1) {
    problems.push_back(problem_at(section, "generations",
                                  "generations = 0: a run needs a limit, and its history a size",
                                  "write generations = 100, and the other stop rules beside it"));
  }
  append_options(choice.options, section, plan);
  append_options(StopRules::table().describe(), section, plan);
  append_options(ObjectiveOptions::table().describe(), section, plan);
  append_options(StartOptions::table().describe(), section, plan);
  return plan;
}

EstimatorPlan plan_closed_form(EstimatorChoice const& choice, Section const& section, EstimatorPlan plan,
                               std::vector<Problem>& problems) {
  plan.fit = choice.prepare(section, keys_of(EstimatorOptions::table()), problems);
  plan.needs_instruments = choice.needs_instruments;
  append_options(choice.options, section, plan);
  return plan;
}

EstimatorPlan plan_lm(Section const& section, EstimatorPlan plan, std::vector<Problem>& problems) {
  plan.title = lm_title;
  plan.lm.emplace();
  LmOptions::table().apply(section, *plan.lm, problems, keys_of(EstimatorOptions::table()));
  append_options(LmOptions::table().describe(), section, plan);
  return plan;
}

}  // namespace

std::vector<EstimatorPlan> plan_estimators(std::vector<Section const*> const& sections,
                                           std::vector<Problem>& problems) {
  std::vector<EstimatorPlan> plans;
  std::set<std::string> labels;
  for (Section const* section : sections) {
    EstimatorOptions options;
    apply_own(EstimatorOptions::table(), *section, options, problems);
    EstimatorPlan plan;
    plan.kind = options.name;
    plan.label = options.label.empty() ? options.name : options.label;
    if (!is_a_name(plan.label))
      problems.push_back(problem_at(*section, "label", "a label has no \"/\" and no control characters",
                                    "it names a group of the result and files of figures"));
    if (!labels.insert(plan.label).second) {
      problems.push_back(problem_at(*section, options.label.empty() ? "name" : "label",
                                    fmt::format("two estimators are called \"{}\"", plan.label),
                                    fmt::format("give one of them a label of its own: label = \"{}_2\"", plan.label)));
    }
    if (options.name == lm_name) {
      plans.push_back(plan_lm(*section, std::move(plan), problems));
    } else if (auto const* closed_form = find_estimator(options.name)) {
      plan.title = closed_form->title;
      plans.push_back(plan_closed_form(*closed_form, *section, std::move(plan), problems));
    } else if (auto const* method = find_optimiser(options.name)) {
      plan.title = method->title;
      plans.push_back(plan_population_method(*method, *section, std::move(plan), problems));
    } else {
      problems.push_back(unknown_estimator(*section, options.name));
    }
  }
  return plans;
}

}  // namespace torquescope
