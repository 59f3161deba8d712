// JADE: DE/current-to-pbest/1/bin with an archive; F and CR are drawn round two means that follow what succeeded.
//
// Equation   current_to_pbest.hpp, trial_controls.hpp, adaptive_means.hpp. The archive holds NP members at most; after
//            a generation it loses any of its members, new ones too, until it does
// Fitness    nothing is learned from a member without finite fitness, nor from a tie: a trial that ties moves its
//            member, as in every evolution here, but is no success, as in the source
// Progress   F, CR: means of the generation's trials
// Random     trials as in current_to_pbest.hpp; the archive: own stream
// Source     Zhang, Sanderson: JADE, IEEE TEC 13 (2009) 945-958, doi:10.1109/TEVC.2009.2014613; settings as there (NP
//            30, 100 and 400 for 10, 30 and 100 parameters, p = 0.05, c = 0.1)

#include <limits>
#include <memory>

#include "engine/fit/optim/adaptive_means.hpp"
#include "engine/fit/optim/current_to_pbest.hpp"
#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"

namespace torquescope {

namespace {

std::size_t usual_jade_members(std::size_t dimension) {
  if (dimension <= 10) return 30;
  return dimension <= 30 ? 100 : 400;
}

struct JadeOptions {
  std::int64_t population = 0;
  double best_share = 0.05;
  double learning_rate = 0.1;
  double archive_share = 1.0;
  std::string repair = "midpoint";
};

OptionTable<JadeOptions> const& jade_options() {
  using O = JadeOptions;
  static OptionTable<O> const table(
      "estimator", "differential evolution that draws F and CR round what succeeded",
      {{"population", &O::population, "members", 0, 1e5,
        "members per generation; 0: 30 up to 10 parameters, 100 up to 30, else 400"},
       {"best_share", &O::best_share, "1", 0.0, 1.0,
        "share of the population that leads the others, at least two members"},
       {"learning_rate", &O::learning_rate, "1", 0.0, 1.0, "weight of a generation's successes in the means"},
       {"archive_share", &O::archive_share, "population", 0.0, 100.0, "members that were replaced and are kept"},
       {"repair", &O::repair, bound_repair_words(), "what happens to a parameter outside its bounds"}});
  return table;
}

struct JadeSettings {
  double best_share, learning_rate, archive_share;
  BoundRepair repair;
};

class Jade final : public GenerationalSearch {
 public:
  Jade(Bounds const& bounds, RandomKey key, std::size_t n_members, JadeSettings const& settings)
      : GenerationalSearch("jade", bounds, key, n_members),
        settings_(settings),
        key_(key),
        room_(share_of_members(settings.archive_share, n_members)),
        means_(settings.learning_rate),
        archive_(bounds.dimension()) {}

 private:
  DrawControls draw() const {
    return [this](std::size_t, RandomStream& random) { return means_.draw(random); };
  }

  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    make_current_to_pbest_trials({population(), fitness(), archive_, bounds(), settings_.best_share, settings_.repair},
                                 draw(), streams, trials);
  }

  void learn(Selected const& step, Progress& progress) override {
    auto const generation = static_cast<std::uint32_t>(progress.generation);
    auto const controls = controls_of_trials({key_, generation}, step.after.size(), draw());
    record_step(step, controls, bounds(), progress);

    std::vector<TrialControls> successes;
    RandomStream random(key_, generation, std::numeric_limits<std::uint32_t>::max());
    for (std::size_t const i : step.winners) {
      if (!(improvement_of(step, i) > 0.0)) continue;
      successes.push_back(controls[i]);
      archive_.add(step.before.members().row(i), room_ + successes.size(), random);
    }
    archive_.shrink(room_, random);
    means_.learn(successes);
  }

  void save_more(OptimiserState& state) const override {
    state["means of F, CR"] = means_.numbers();
    state["archive"] = archive_.numbers();
  }

  void restore_more(OptimiserState const& state) override {
    auto const& means = state_entry(state, "means of F, CR", 2);
    auto const& archive = state_rows(state, "archive", dimension(), 0, room_);
    means_.restore(means);
    archive_.restore(archive);
  }

  JadeSettings settings_;
  RandomKey key_;
  std::size_t room_;  // of the archive
  AdaptiveMeans means_;
  MemberArchive archive_;
};

MakeSearch configure_jade(JadeOptions const& options) {
  JadeSettings const settings{options.best_share, options.learning_rate, options.archive_share,
                              named_choice<BoundRepair>(bound_repair_words(), options.repair)};
  return [population = options.population, settings](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(population, usual_jade_members, bounds.dimension());
    return std::make_unique<Jade>(bounds, key, n_members, settings);
  };
}

}  // namespace

OptimiserChoice jade_optimiser() {
  return make_choice<JadeOptions>("jade", "JADE: adaptive DE with an archive",
                                  "Zhang, Sanderson: IEEE Trans. Evol. Comput. 13 (2009) 945-958", jade_options(),
                                  configure_jade, usual_jade_members);
}

}  // namespace torquescope
