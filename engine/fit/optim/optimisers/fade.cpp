// Fuzzy Adaptive DE: DE/rand/1/bin whose F and CR follow the movement of the population through two fuzzy controllers.
//
// Generation 1 has no movement before it and takes F_first, CR_first; from generation 2 on the controllers decide.
// Source     Liu, Lampinen: A fuzzy adaptive differential evolution algorithm, Soft Computing 9 (2005) 448-462; the
//            seed, section 3. Where they disagree or are silent there is an option (fuzzy_controller.hpp,
//            bound_repair.hpp)

#include <memory>

#include "engine/fit/optim/fuzzy_controller.hpp"
#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/movement.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/trial_vector.hpp"

namespace torquescope {

namespace {

struct FadeOptions {
  std::int64_t population = 30;
  std::string pairing = "original";
  double F_universe = 2.0;
  double d12_small_mean = 0.1;
  std::string defuzzification = "centroid";
  std::int64_t centroid_points = 1001;
  std::string norm = "raw";
  double F_first = 0.5;
  double CR_first = 0.9;
  std::string repair = "midpoint";
};

OptionTable<FadeOptions> const& fade_options() {
  using O = FadeOptions;
  static OptionTable<O> const table(
      "estimator", "fuzzy adaptive differential evolution",
      {{"population", &O::population, "members", 4, 1e5,
        "members per generation; more in more parameters did not help"},
       {"pairing", &O::pairing, pairing_words(),
        "which change levels each fuzzy controller reads; the seed contradicts the original paper"},
       {"F_universe", &O::F_universe, "1", 0.1, 2.0,
        "F is sought in 0 to this; 2 as in the original, 1 converges faster (the seed does not say)"},
       {"d12_small_mean", &O::d12_small_mean, "1", 0.0, 0.4,
        "mean of the set small of d12: 0.1 in the seed, also 0.01"},
       {"defuzzification", &O::defuzzification, defuzzification_words(), "from clipped sets to F and CR"},
       {"centroid_points", &O::centroid_points, "points", 101, 1e5, "grid of the centroid"},
       {"norm", &O::norm, movement_norm_words(),
        "PC and FC as printed (raw), in units of the box and of the spread of fitness (relative), or of spreads "
        "(spread)"},
       {"F_first", &O::F_first, "1", 0.0, 2.0, "F of generation 1, before there is any movement"},
       {"CR_first", &O::CR_first, "1", 0.0, 1.0, "CR of generation 1"},
       {"repair", &O::repair, bound_repair_words(), "what happens to a parameter outside its bounds"}});
  return table;
}

class FuzzyAdaptiveDe final : public GenerationalSearch {
 public:
  FuzzyAdaptiveDe(Bounds const& bounds, RandomKey key, std::size_t n_members, TrialSettings first, MovementNorm norm,
                  std::shared_ptr<FuzzyController const> controller)
      : GenerationalSearch("fade", bounds, key, n_members),
        next_(first),
        norm_(norm),
        controller_(std::move(controller)) {}

 private:
  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    make_rand_1_bin_trials(population(), next_, bounds(), streams, trials);
  }

  void learn(Selected const& step, Progress& progress) override {
    auto const movement = movement_between(step.before, step.after, step.winners, bounds(), norm_);
    progress.F = next_.F;
    progress.CR = next_.CR;
    progress.PC = movement.PC;
    progress.FC = movement.FC;
    auto const [F, CR] = (*controller_)(movement.PC, movement.FC);
    next_.F = F;
    next_.CR = CR;
  }

  void save_more(OptimiserState& state) const override { state["next F, CR"] = {next_.F, next_.CR}; }

  void restore_more(OptimiserState const& state) override {
    auto const& next = state_entry(state, "next F, CR", 2);
    next_.F = next[0];
    next_.CR = next[1];
  }

  TrialSettings next_;  // of the coming generation
  MovementNorm norm_;
  std::shared_ptr<FuzzyController const> controller_;  // shared by all runs
};

std::shared_ptr<FuzzyController const> make_controller(FadeOptions const& options) {
  return std::make_shared<FuzzyController const>(FuzzyControllerSettings{
      named_choice<Pairing>(pairing_words(), options.pairing), options.F_universe, options.d12_small_mean,
      named_choice<Defuzzification>(defuzzification_words(), options.defuzzification),
      static_cast<std::size_t>(options.centroid_points)});
}

MakeSearch configure_fade(FadeOptions const& options) {
  auto const controller = make_controller(options);
  auto const n_members = static_cast<std::size_t>(options.population);
  auto const norm = named_choice<MovementNorm>(movement_norm_words(), options.norm);
  TrialSettings const first{options.F_first, options.CR_first,
                            named_choice<BoundRepair>(bound_repair_words(), options.repair)};
  return [=](Bounds const& bounds, RandomKey key) {
    return std::make_unique<FuzzyAdaptiveDe>(bounds, key, n_members, first, norm, controller);
  };
}

}  // namespace

OptimiserChoice fade_optimiser() {
  auto choice = make_choice<FadeOptions>("fade", "Fuzzy Adaptive DE", "Liu, Lampinen: Soft Computing 9 (2005) 448-462",
                                         fade_options(), configure_fade);
  choice.controller = [](Section const& section) {
    // keys of other tables and problems were dealt with by prepare()
    FadeOptions options;
    std::vector<Problem> told_before;
    fade_options().apply(section, options, told_before);
    return make_controller(options);
  };
  return choice;
}

}  // namespace torquescope
