// DE/rand/1/bin with fixed F and CR: the standard differential evolution, and the seed's competitor of FADE.
//
// Source     Storn, Price: Differential evolution, J. Global Optimization 11 (1997) 341-359

#include <algorithm>
#include <memory>

#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/movement.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/trial_vector.hpp"

namespace torquescope {

namespace {

// too few members stand still in a stretched valley before they have found its axes (bench/README.md)
std::size_t usual_de_members(std::size_t dimension) { return std::max<std::size_t>(30, 10 * dimension); }

struct DeOptions {
  std::int64_t population = 0;
  double F = 0.5;
  double CR = 0.9;
  std::string repair = "midpoint";
};

OptionTable<DeOptions> const& de_options() {
  static OptionTable<DeOptions> const table(
      "estimator", "differential evolution DE/rand/1/bin",
      {{"population", &DeOptions::population, "members", 0, 1e5,
        "members per generation; 0: 10 per parameter, at least 30"},
       {"F", &DeOptions::F, "1", 0.0, 2.0, "mutation factor"},
       {"CR", &DeOptions::CR, "1", 0.0, 1.0, "crossover rate"},
       {"repair", &DeOptions::repair, bound_repair_words(), "what happens to a parameter outside its bounds"}});
  return table;
}

class DifferentialEvolution final : public GenerationalSearch {
 public:
  DifferentialEvolution(Bounds const& bounds, RandomKey key, std::size_t n_members, TrialSettings settings)
      : GenerationalSearch("de", bounds, key, n_members), settings_(settings) {}

 private:
  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    make_rand_1_bin_trials(population(), settings_, bounds(), streams, trials);
  }

  // nothing is adapted; the movement is recorded to be compared with FADE's
  void learn(Selected const& step, Progress& progress) override {
    auto const movement = movement_between(step.before, step.after, step.winners, bounds(), MovementNorm::raw);
    progress.F = settings_.F;
    progress.CR = settings_.CR;
    progress.PC = movement.PC;
    progress.FC = movement.FC;
  }

  TrialSettings settings_;
};

MakeSearch configure_de(DeOptions const& options) {
  TrialSettings const settings{options.F, options.CR, named_choice<BoundRepair>(bound_repair_words(), options.repair)};
  return [population = options.population, settings](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(population, usual_de_members, bounds.dimension());
    return std::make_unique<DifferentialEvolution>(bounds, key, n_members, settings);
  };
}

}  // namespace

OptimiserChoice de_optimiser() {
  return make_choice<DeOptions>("de", "Differential evolution DE/rand/1/bin",
                                "Storn, Price: J. Global Optimization 11 (1997) 341-359", de_options(), configure_de,
                                usual_de_members);
}

}  // namespace torquescope
