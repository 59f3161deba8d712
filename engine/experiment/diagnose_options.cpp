#include "engine/experiment/diagnose_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/diagnose/all_rows_diagnosis.hpp"
#include "engine/effects/given_effect.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"
#include "engine/infer/pipeline/reversal_rows.hpp"
#include "engine/infer/replicates/null_kind.hpp"

namespace torquescope {

namespace {

bool contains(std::vector<std::string> const& names, std::string const& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> catalogue_names() {
  std::vector<std::string> names;
  for (Effect const* effect : effect_choices()) names.push_back(effect->name());
  for (Effect const* effect : arm_law_choices()) names.push_back(effect->name());
  return names;
}

std::vector<std::string> optimiser_names() {
  std::vector<std::string> names;
  for (auto const& choice : optimiser_choices()) names.push_back(choice.name);
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
  static OptionTable<DiagnoseOptions> const table(
      "diagnose", "what a diagnosis looks for and how sure it must be",
      {{"effects", &DiagnoseOptions::effects, "effects to look for: \"all\", or names (torquescope list effects)"},
       {"twins", &DiagnoseOptions::twins, "1", 60.0, 100000.0,
        "replicates: simulated recordings of the fitted model; no p is below 1 / (twins + 1)"},
       {"q", &DiagnoseOptions::q, "1", 1e-6, 0.5, "share of false names that is put up with among the names given"},
       {"max_effects", &DiagnoseOptions::max_effects, "1", 1.0, 20.0, "effects that are named at most"},
       {"delta", &DiagnoseOptions::delta, "1", 0.0, 1.0,
        "a model that leaves less than this share of the torque beyond chance is complete"},
       {"tolerance", &DiagnoseOptions::tolerance, "1", 0.0, 1.0,
        "so much of its own torque the form of a named effect may be off"},
       {"least_fall", &DiagnoseOptions::least_fall, "1", 0.0, 1.0,
        "effects that lower the error on held-out rows by less than this share of it are not named"},
       {"shape_optimiser", &DiagnoseOptions::shape_optimiser, optimiser_names(),
        "what searches the shapes of an effect, its linear parameters solved inside (torquescope list optimisers)"},
       {"reversals", &DiagnoseOptions::reversals, reversal_words(),
        "of moving rows: those near reversals left out, or weighed by what replicates of unknown sticking friction "
        "show there; both: weighed where too few rows are left without them"},
       {"decider", &DiagnoseOptions::decider, decider_words(),
        "rows that a verdict is decided on: all, or those that move one way; both: the latter decide, and the result "
        "holds what all say; auto: all of one joint; of an arm, and with reversals or an ablation, those that move one "
        "way"},
       {"null", &DiagnoseOptions::null, null_words(),
        "ablation, not for use: what chance is taken for; all but \"twins\" invent effects on clean recordings"},
       {"indirect_inference", &DiagnoseOptions::indirect_inference,
        "ablation, not for use: false makes replicates of the least-squares baseline, biased as the pipeline makes it"},
       {"twin_noise", &DiagnoseOptions::twin_noise, "1", 0.05, 20.0,
        "ablation, not for use: factor on all noise of the replicates, as if it were stated wrongly"},
       {"whitening", &DiagnoseOptions::whitening,
        "ablation, not for use: false lets all rows count alike, however much of them is noise of the encoder"}});
  return table;
}

std::vector<std::string> DiagnoseOptions::ablations() const {
  DiagnoseOptions const whole;
  std::vector<std::string> found;
  auto const note = [&](std::string const& key, auto const& here, auto const& method) {
    if (here != method) found.push_back(key + " = " + to_text(OptionValue{here}));
  };
  note("null", null, whole.null);
  note("indirect_inference", indirect_inference, whole.indirect_inference);
  note("twin_noise", twin_noise, whole.twin_noise);
  note("whitening", whitening, whole.whitening);
  return found;
}

void refuse_too_few_twins(DiagnoseOptions const& options, std::size_t joints, Section const& section,
                          std::vector<Problem>& problems) {
  double const level = level_of_joint(options.q, joints);
  if (1.0 / static_cast<double>(options.twins + 1) <= level) return;
  auto const fewest = static_cast<std::int64_t>(std::ceil(1.0 / level - 1e-9)) - 1;
  problems.push_back(problem_at(
      section, "twins",
      fmt::format("{} replicates cannot show a chance below {:.2g}, and a name needs {:.2g}{}: none could be given",
                  options.twins, 1.0 / static_cast<double>(options.twins + 1), level,
                  joints > 1 ? fmt::format(" (q over {} joints and the arm)", joints) : std::string()),
      fmt::format("write twins = {} or more", fewest)));
}

std::vector<Effect const*> chosen_effects(DiagnoseOptions const& options, JointKind joint,
                                          std::vector<std::string> const& model_terms, Section const& section,
                                          std::vector<Problem>& problems, JointsOfJob joints) {
  std::vector<Effect const*> chosen;
  if (options.effects == std::vector<std::string>{"all"}) {
    for (Effect const* effect : effect_choices())
      if (effect->exists_on(joint) && !contains(model_terms, effect->name())) chosen.push_back(effect);
    if (joints == JointsOfJob::of_an_arm)
      chosen.insert(chosen.end(), arm_law_choices().begin(), arm_law_choices().end());
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
