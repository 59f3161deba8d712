#include "engine/run/catalogue.hpp"

#include <fmt/format.h>

#include "engine/data/motion.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/effects/effect.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/job/job_options.hpp"
#include "engine/optim/optimiser.hpp"
#include "engine/problem/estimator.hpp"
#include "engine/problem/loss.hpp"
#include "engine/run/estimator_plan.hpp"
#include "engine/simulate/simulation_plan.hpp"

namespace torquescope {

namespace {

void add_effects(std::vector<CatalogueEntry>& entries) {
  for (Effect const* effect : effect_choices()) {
    CatalogueEntry entry{effect->name(), "effect", effect->title(), {}, {}};
    entry.text.push_back("equation   tau = " + effect->equation());
    for (auto const& parameter : effect->parameters()) {
      std::string const slide =
          parameter.unit_prismatic.empty() ? "revolute joints only" : parameter.unit_prismatic + " (prismatic)";
      entry.text.push_back(fmt::format("parameter  {} in {}, {}", parameter.name, parameter.unit_revolute, slide));
    }
    entry.text.push_back("source     " + effect->source());
    entries.push_back(std::move(entry));
  }
}

void append(std::vector<OptionDescription>& options, std::vector<OptionDescription> const& more) {
  options.insert(options.end(), more.begin(), more.end());
}

void add_estimators(std::vector<CatalogueEntry>& entries) {
  for (auto const& choice : estimator_choices())
    entries.push_back({choice.name, "estimator", choice.title, {"source     " + choice.source}, choice.options});
  for (auto const& choice : optimiser_choices()) {
    CatalogueEntry entry{choice.name, "optimiser", choice.title, {"source     " + choice.source}, choice.options};
    append(entry.options, StopRules::table().describe());
    append(entry.options, ObjectiveOptions::table().describe());
    entries.push_back(std::move(entry));
  }
}

void add_readers_and_losses(std::vector<CatalogueEntry>& entries) {
  for (auto const& choice : reader_choices()) entries.push_back({choice.name, "reader", choice.meaning, {}, {}});
  for (auto const& choice : loss_choices())
    entries.push_back({choice.name, "loss", choice.title, {"equation   " + choice.equation}, {}});
}

template <class Options>
void add_section(std::vector<CatalogueEntry>& entries) {
  auto const& table = Options::table();
  entries.push_back({table.section(), "section", table.meaning(), {}, table.describe()});
}

void add_sections(std::vector<CatalogueEntry>& entries) {
  add_section<ExperimentOptions>(entries);
  add_section<RecordingOptions>(entries);
  add_section<FilterOptions>(entries);
  add_section<ModelOptions>(entries);
  entries.push_back(
      {"model.bounds",
       "section",
       "box of the population methods, by parameter",
       {"every = [-1.0, 1.0]     for all parameters (this is the default)", "inertia = [0.0, 2.0]    for one of them"},
       {}});
  add_section<EstimatorOptions>(entries);
  add_section<SimulationOptions>(entries);
  entries.push_back({"simulate.plant",
                     "section",
                     "the simulated joint: a value for every parameter of its effects",
                     {"inertia = 0.09          parameters as `torquescope list effects` names them"},
                     {}});
  add_section<ReferenceOptions>(entries);
  add_section<ControllerOptions>(entries);
  add_section<EncoderOptions>(entries);
  add_section<NoiseOptions>(entries);
  add_section<OutputOptions>(entries);
}

}  // namespace

std::vector<CatalogueEntry> const& catalogue() {
  static std::vector<CatalogueEntry> const entries = [] {
    std::vector<CatalogueEntry> made;
    add_effects(made);
    add_estimators(made);
    add_readers_and_losses(made);
    add_sections(made);
    return made;
  }();
  return entries;
}

}  // namespace torquescope
