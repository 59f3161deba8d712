#include "engine/experiment/catalogue.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/data/motion.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/effects/given_effect.hpp"
#include "engine/effects/instant_code.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/experiment/estimator_plan.hpp"
#include "engine/experiment/job/job_options.hpp"
#include "engine/experiment/level_options.hpp"
#include "engine/experiment/recording_set.hpp"
#include "engine/fit/excite/excite_options.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/loss.hpp"
#include "engine/robot/robot_options.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"
#include "engine/simulate/rollout/loop_options.hpp"
#include "engine/simulate/simulation_plan.hpp"

namespace torquescope {

namespace {

template <class Word>
std::string joined(std::vector<Word> const& words) {
  std::string text;
  for (auto const& each : words) text += (text.empty() ? "" : ", ") + word(each);
  return text;
}

// "parameter  stribeck in N m (N on a slide): 0 to 2 x Coulomb level"
// "shape      stribeck_speed in rad/s (m/s on a slide): 0.002 x peak speed to 0.2 x peak speed, logarithmic"
std::string parameter_line(EffectParameter const& parameter) {
  std::string slide = fmt::format(" ({} on a slide)", parameter.unit_prismatic);
  if (parameter.unit_prismatic.empty()) slide = " (revolute joints only)";
  if (parameter.unit_prismatic == parameter.unit_revolute) slide = "";
  auto line = fmt::format("{}  {} in {}{}", parameter.is_shape ? "shape    " : "parameter", parameter.name,
                          parameter.unit_revolute, slide);
  if (!std::isinf(parameter.lower.factor) || !std::isinf(parameter.upper.factor))
    line += fmt::format(": {} to {}", bound_text(parameter.lower), bound_text(parameter.upper));
  if (parameter.spacing == Spacing::logarithmic) line += ", logarithmic";
  if (parameter.spacing == Spacing::cubic) line += ", closest near 0";
  return line;
}

bool is_time_of_a_channel(Effect const& effect) {
  return effect.acts_on() == ActsOn::recorded_torque && effect.parameters().front().unit_revolute == "s";
}

void add_effects(std::vector<CatalogueEntry>& entries) {
  std::vector<Effect const*> effects = effect_choices();
  effects.insert(effects.end(), arm_effect_choices().begin(), arm_effect_choices().end());
  for (Effect const* effect : effects) {
    CatalogueEntry entry{effect->name(), "effect", effect->title() + " [" + word(effect->family()) + "]", {}, {}};
    entry.text.push_back("family     " + joined(effect->families()));
    entry.text.push_back(
        fmt::format("equation   {}{}", effect->acts_on() == ActsOn::joint ? "tau = " : "", effect->equation()));
    entry.text.push_back("code       " +
                         (effect->code().empty() ? "none: it " + why_no_code(*effect) : effect->code()) +
                         (effect->plain_code().empty() ? "" : ", as a term of a model " + effect->plain_code()));
    for (auto const& parameter : effect->parameters()) entry.text.push_back(parameter_line(parameter));
    entry.text.push_back(
        fmt::format("signature  {}; {} in the velocity", joined(effect->signature()),
                    effect->parity() == Parity::neither ? "neither odd nor even" : word(effect->parity())));
    entry.text.push_back(fmt::format("acts on    {}{}", word(effect->acts_on()),
                                     effect->is_plain_term() ? "; may be a term of [model]" : "") +
                         (effect->has_plain_form() ? fmt::format(", there {}", effect->plain_equation()) : ""));
    if (effect->is_given())
      entry.text.push_back(effect->is_of_whole_arm() ? "arms       looked for in all joints of a whole arm at once"
                                                     : "arms       looked for at the joints of whole arms alone");
    if (is_time_of_a_channel(*effect))
      entry.text.push_back(
          "counted    from a drive that holds the torque of a row until the next row; where rows are instants it is "
          "half a row less, "
          "where they are means of the last period a whole row less");
    entry.text.push_back("source     " + effect->source());
    entries.push_back(std::move(entry));
  }
}

void add_drive_effects(std::vector<CatalogueEntry>& entries) {
  for (DriveEffect const* effect : drive_effects())
    entries.push_back(
        {effect->name,
         "law",
         effect->title,
         {fmt::format("equation   {}", effect->equation), fmt::format("confused   with {}", effect->confused)},
         {}});
}

void append(std::vector<OptionDescription>& options, std::vector<OptionDescription> const& more) {
  options.insert(options.end(), more.begin(), more.end());
}

void add_estimators(std::vector<CatalogueEntry>& entries) {
  for (auto const& choice : estimator_choices())
    entries.push_back({choice.name, "estimator", choice.title, {"source     " + choice.source}, choice.options});
  entries.push_back({lm_name,
                     "estimator",
                     lm_title,
                     {"source     Marquardt 1963, doi:10.1137/0111030"},
                     LmOptions::table().describe()});
  for (auto const& choice : optimiser_choices()) {
    CatalogueEntry entry{choice.name, "optimiser", choice.title, {"source     " + choice.source}, choice.options};
    append(entry.options, StopRules::table().describe());
    append(entry.options, ObjectiveOptions::table().describe());
    append(entry.options, StartOptions::table().describe());
    entries.push_back(std::move(entry));
  }
}

void add_readers_and_losses(std::vector<CatalogueEntry>& entries) {
  for (auto const& choice : reader_choices()) entries.push_back({choice.name, "reader", choice.meaning, {}, {}});
  for (auto const& choice : loss_choices())
    entries.push_back({choice.name, "loss", choice.title, {"equation   " + choice.equation}, {}});
}

template <class Options>
void add_section(std::vector<CatalogueEntry>& entries, char const* kind = "section") {
  auto const& table = Options::table();
  entries.push_back({table.section(), kind, table.meaning(), {}, table.describe()});
}

void add_sections(std::vector<CatalogueEntry>& entries) {
  add_section<ExperimentOptions>(entries);
  add_section<RecordingOptions>(entries);
  add_section<RecordingsOptions>(entries);
  entries.back().text = {
      "files = \"train/servo_m{mass_kg}_kp{kp}_{motion}.csv.gz\"    a name whose matches are all numbers is a number",
      "supply_v = 12.0    any other key is a quantity of each of these recordings, a number or a text",
      "Channels and units are those of [recording], whose train is left out; columns.torque may be missing."};
  entries.push_back(
      {"known",
       "section",
       "what is known of each recording: a number, or a product of numbers and its quantities, joined by *",
       {},
       describe_known()});
  add_section<FilterOptions>(entries);
  entries.back().text = {
      "Choosing: cutoff_hz well above the fastest motion (ten times it, or where the measured acceleration drowns in "
      "the encoder's "
      "noise); parallel_cutoff_hz half of that, never above it, or the torque keeps what the motion has lost; "
      "decimate_to_hz 2.5 to 4 "
      "times parallel_cutoff_hz, so that nothing folds back and rows are not all the same.",
      "What lies above parallel_cutoff_hz is filtered away: raise both where backlash, elasticity or ripple is looked "
      "for. "
      "A lower one makes "
      "errors smaller, not the model better: compare errors at the same one only."};
  add_section<ModelOptions>(entries);
  add_section<JointModelOptions>(entries);
  entries.push_back(
      {"model.bounds",
       "section",
       "box of the population methods, by parameter",
       {"every = [-1.0, 1.0]     for all parameters (this is the default)", "inertia = [0.0, 2.0]    for one of them"},
       {}});
  entries.push_back({"model.given",
                     "section",
                     "parameters of model.terms as they are known, for replay and as the start of rollouts",
                     {"inertia = 95.1    those that are left out are fitted by least squares"},
                     {}});
  entries.push_back(
      {"model.effects",
       "section",
       "one effect beside model.terms, for rollouts; of an arm, at one joint; written [[model.effects]], as often as "
       "there are effects",
       {"name = \"cogging\", and where its parameters begin: cogging_order = 7.0, ...",
        "joint = 2, name = \"stribeck\"    of an arm: its shapes are refined in the fit, from the grid of `diagnose`, "
        "or "
        "from all of them where they stand: stribeck_speed = 0.03, stribeck_exponent = 1.0"},
       {}});
  add_section<LoopOptions>(entries);
  add_section<EstimatorOptions>(entries);
  add_section<SimulationOptions>(entries);
  entries.push_back({"simulate.plant",
                     "section",
                     "the simulated joint: a value for every parameter of its effects",
                     {"inertia = 0.09          parameters as `torquescope list effects` names them",
                      "viscous = [2.0, 3.0]    of an arm: a number for each joint, or one for all; so in all sections "
                      "of [simulate]"},
                     {}});
  add_section<ReferenceOptions>(entries);
  add_section<ControllerOptions>(entries);
  add_section<EncoderOptions>(entries);
  add_section<NoiseOptions>(entries);
  entries.push_back(
      {"simulate.effects",
       "section",
       "one effect at one joint of a simulated arm; written [[simulate.effects]], as often as there are effects",
       {"joint = 3, name = \"stribeck\", and its parameters: stribeck = 0.4, stribeck_speed = 0.1, ..."},
       {}});
  add_section<ExciteOptions>(entries);
  add_section<LevelOptions>(entries);
  add_section<DiagnoseOptions>(entries);
  entries.back().text = {
      "CV gain, in the table of candidates: share of the mismatch (what the residual has beyond the replicates) that "
      "the "
      "effect predicts on blocks of time it was not fitted to. Above 100 % where the model alone predicts such blocks "
      "worse than nothing does; none where the effect predicts them no better.",
      "Decisions: named; class (fits as well as what is named); measurement (a fault of a recorded channel); no (why "
      "stands "
      "below the table); not tested (the model's own columns explain it on this motion)."};
  add_section<OutputOptions>(entries);
}

void add_robots(std::vector<CatalogueEntry>& entries) {
  add_section<RobotOptions>(entries, "robot");
  add_section<JointOptions>(entries, "robot");
  entries.back().text = {"written [[joint]] for each joint, from the base to the tip"};
}

}  // namespace

std::vector<CatalogueEntry> const& catalogue() {
  static std::vector<CatalogueEntry> const entries = [] {
    std::vector<CatalogueEntry> made;
    add_effects(made);
    add_drive_effects(made);
    add_estimators(made);
    add_readers_and_losses(made);
    add_sections(made);
    add_robots(made);
    return made;
  }();
  return entries;
}

}  // namespace torquescope
