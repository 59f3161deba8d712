// jDE: DE/rand/1/bin in which every member carries an F and a CR of its own; those of trials that win live on.
//
// Equation   F' = 0.1 + 0.9 u_1 if u_2 < tau_F, else the member's F;  CR' = u_3 if u_4 < tau_CR, else the member's CR
// Progress   F, CR: means of the generation's trials
// Random     a trial: u_1 to u_4, all four always, then as DE's (trial_vector.hpp)
// Source     Brest, Greiner, Boskovic, Mernik, Zumer: Self-adapting control parameters in differential evolution, IEEE
//            TEC 10 (2006) 646-657, doi:10.1109/TEVC.2006.872133; settings as there

#include <memory>

#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/trial_controls.hpp"

namespace torquescope {

namespace {

struct JdeOptions {
  std::int64_t population = 100;
  double tau_F = 0.1;
  double tau_CR = 0.1;
  double F_first = 0.5;
  double CR_first = 0.9;
  std::string repair = "midpoint";
};

OptionTable<JdeOptions> const& jde_options() {
  using O = JdeOptions;
  static OptionTable<O> const table(
      "estimator", "differential evolution whose members carry their own F and CR",
      {{"population", &O::population, "members", 4, 1e5, "members per generation"},
       {"tau_F", &O::tau_F, "1", 0.0, 1.0, "probability that a trial has a new F, uniform in 0.1 to 1"},
       {"tau_CR", &O::tau_CR, "1", 0.0, 1.0, "probability that a trial has a new CR, uniform in 0 to 1"},
       {"F_first", &O::F_first, "1", 0.0, 2.0, "F of every member of the initial population"},
       {"CR_first", &O::CR_first, "1", 0.0, 1.0, "CR of every member of the initial population"},
       {"repair", &O::repair, bound_repair_words(), "what happens to a parameter outside its bounds"}});
  return table;
}

class SelfAdaptingDe final : public GenerationalSearch {
 public:
  SelfAdaptingDe(Bounds const& bounds, RandomKey key, JdeOptions const& options)
      : GenerationalSearch("jde", bounds, key, static_cast<std::size_t>(options.population)),
        key_(key),
        tau_F_(options.tau_F),
        tau_CR_(options.tau_CR),
        repair_(named_choice<BoundRepair>(bound_repair_words(), options.repair)),
        carried_(largest_batch(), {options.F_first, options.CR_first}) {}

 private:
  // F_l and F_u of the source
  static constexpr double least_F = 0.1, span_of_F = 0.9;

  TrialControls controls_of_trial(std::size_t member, RandomStream& random) const {
    TrialControls controls = carried_[member];
    double const F = least_F + random.uniform() * span_of_F;
    if (random.uniform() < tau_F_) controls.F = F;
    double const CR = random.uniform();
    if (random.uniform() < tau_CR_) controls.CR = CR;
    return controls;
  }

  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    for (std::size_t i = 0; i < trials.rows(); ++i) {
      RandomStream random(streams.key, streams.generation, static_cast<std::uint32_t>(i));
      auto const [F, CR] = controls_of_trial(i, random);
      make_rand_1_bin_trial(population(), i, {F, CR, repair_}, bounds(), random, trials.row(i));
    }
  }

  void learn(Selected const& step, Progress& progress) override {
    auto const controls =
        controls_of_trials({key_, static_cast<std::uint32_t>(progress.generation)}, step.after.size(),
                           [&](std::size_t i, RandomStream& random) { return controls_of_trial(i, random); });
    record_step(step, controls, bounds(), progress);
    for (std::size_t const i : step.winners) carried_[i] = controls[i];
  }

  void save_more(OptimiserState& state) const override {
    auto& numbers = state["F, CR of members"];
    for (auto const& [F, CR] : carried_) numbers.insert(numbers.end(), {F, CR});
  }

  void restore_more(OptimiserState const& state) override {
    auto const& numbers = state_entry(state, "F, CR of members", 2 * carried_.size());
    for (std::size_t i = 0; i < carried_.size(); ++i) carried_[i] = {numbers[2 * i], numbers[2 * i + 1]};
  }

  RandomKey key_;
  double tau_F_, tau_CR_;
  BoundRepair repair_;
  std::vector<TrialControls> carried_;  // by each member
};

MakeSearch configure_jde(JdeOptions const& options) {
  return
      [options](Bounds const& bounds, RandomKey key) { return std::make_unique<SelfAdaptingDe>(bounds, key, options); };
}

}  // namespace

OptimiserChoice jde_optimiser() {
  return make_choice<JdeOptions>("jde", "jDE: DE/rand/1/bin with self-adapting F and CR",
                                 "Brest et al.: IEEE Trans. Evol. Comput. 10 (2006) 646-657", jde_options(),
                                 configure_jde);
}

}  // namespace torquescope
