#include "engine/experiment/diagnose_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/effects/given_effect.hpp"

namespace torquescope {

namespace {

bool contains(std::vector<std::string> const& names, std::string const& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> catalogue_names() {
  std::vector<std::string> names;
  for (Effect const* effect : effect_choices()) names.push_back(effect->name());
  for (Effect const* effect : arm_effect_choices()) names.push_back(effect->name());
  return names;
}

// why a name cannot be looked for; a Problem without `what` when it can
Problem refusal(std::string const& name, Effect const* effect, JointKind joint,
                std::vector<std::string> const& model_terms, Section const& section) {
  auto const problem = [&](std::string const& what, std::string const& help) {
    return problem_at(section, "effects", what, help);
  };
  if (name == "all")
    return problem("\"all\" stands beside names of effects", "write effects = \"all\", or the names alone");
  if (!effect) {
    std::string const close = closest_name(name, catalogue_names());
    Problem unknown = problem(fmt::format("unknown effect \"{}\"", name), "torquescope list effects shows every name");
    if (!close.empty()) unknown.caret_note = fmt::format("did you mean \"{}\"?", close);
    return unknown;
  }
  if (!effect->exists_on(joint))
    return problem(
        fmt::format("effect \"{}\" needs an angle, but model.joint = \"prismatic\" moves along a line", name),
        "remove it");
  if (contains(model_terms, name))
    return problem(fmt::format("effect \"{}\" is a term of the model already", name),
                   "remove it from diagnose.effects, or from model.terms to let the diagnosis look for it");
  return {};
}

}  // namespace

OptionTable<DiagnoseOptions> const& DiagnoseOptions::table() {
  std::string const all_samples = "a diagnosis is decided on all samples by one rule: delete the line";
  std::string const levels = "the numbers of a decision are in [diagnose.levels]: delete the line";
  static OptionTable<DiagnoseOptions> const table(
      "diagnose", "what a diagnosis looks for and how sure it must be",
      {{"effects", &DiagnoseOptions::effects, "effects to look for: \"all\", or names (torquescope list effects)"},
       {"twins", &DiagnoseOptions::replicates, "1", 20.0, 100000.0,
        "replicates, simulated recordings of the fitted model, at most; more where q could not be shown with so few"},
       {"q", &DiagnoseOptions::q, "1", 1e-6, 0.5, "share of false names that is put up with among the names given"},
       {"max_effects", &DiagnoseOptions::max_effects, "1", 1.0, 20.0, "effects that are named at most"},
       {"delta", &DiagnoseOptions::delta, "1", 0.0, 1.0,
        "a model that leaves less than this share of the torque beyond chance is complete"},
       {"tolerance", &DiagnoseOptions::tolerance, "1", 0.0, 1.0,
        "so much of its own torque the form of a named effect may be off"},
       {"least_fall", &DiagnoseOptions::least_fall, "1", 0.0, 1.0,
        "effects that lower the error on held-out rows by less than this share of it are not named"}},
      {{"shape_optimiser", all_samples},
       {"reversals", all_samples},
       {"decider", all_samples},
       {"null", levels},
       {"indirect_inference", levels},
       {"twin_noise", levels},
       {"whitening", levels}});
  return table;
}

std::vector<Effect const*> chosen_effects(DiagnoseOptions const& options, JointKind joint,
                                          std::vector<std::string> const& model_terms, Section const& section,
                                          std::vector<Problem>& problems, JointsOfJob joints) {
  std::vector<Effect const*> chosen;
  if (options.effects == std::vector<std::string>{"all"}) {
    for (Effect const* effect : effect_choices())
      if (effect->exists_on(joint) && !contains(model_terms, effect->name())) chosen.push_back(effect);
    if (joints == JointsOfJob::of_an_arm)
      chosen.insert(chosen.end(), arm_effect_choices().begin(), arm_effect_choices().end());
    return chosen;
  }
  if (options.effects.empty())
    problems.push_back(
        problem_at(section, "effects", "diagnose.effects is empty", "write effects = \"all\", or names"));
  for (auto const& name : options.effects) {
    Effect const* effect = find_effect(name);
    Problem problem = refusal(name, effect, joint, model_terms, section);
    if (problem.what.empty() && effect->is_given() && joints == JointsOfJob::one)
      problem = problem_at(section, "effects", fmt::format("effect \"{}\" acts on the joints of an arm", name),
                           "name a robot file in [model], or remove it");
    if (problem.what.empty() && std::find(chosen.begin(), chosen.end(), effect) != chosen.end())
      problem = problem_at(section, "effects", fmt::format("effect \"{}\" stands twice", name), "remove one of them");
    if (problem.what.empty())
      chosen.push_back(effect);
    else
      problems.push_back(std::move(problem));
  }
  return chosen;
}

}  // namespace torquescope
