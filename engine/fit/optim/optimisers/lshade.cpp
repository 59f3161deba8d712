// L-SHADE: DE/current-to-pbest/1/bin with an archive, F and CR from a history of successes, and a population that
// shrinks linearly to four members while the budget is spent.
//
// Equation   current_to_pbest.hpp, success_history.hpp
//            NP = NP_0 + (4 - NP_0) share spent, rounded; the archive shrinks with it
// Budget     the job's: `evaluations` as in the paper, or `generations`, whichever is nearer its end. reduction =
//            "none": SHADE with these settings
// Fitness    nothing is learned from a member without finite fitness, and it does not go into the archive
// Progress   F, CR: means of the generation's trials
// Random     trials as in current_to_pbest.hpp; the archive: own stream
// Source     Tanabe, Fukunaga 2014, CEC, doi:10.1109/CEC.2014.6900380; settings as there (NP_0 = 18 R, H = 6, archive
//            2.6 NP, p = 0.11)

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/fit/optim/current_to_pbest.hpp"
#include "engine/fit/optim/generational_search.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/stop_rules.hpp"
#include "engine/fit/optim/success_history.hpp"

namespace torquescope {

namespace {

enum class Reduction { linear, none };

std::vector<std::string> const& reduction_words() {
  static std::vector<std::string> const words{"linear", "none"};
  return words;
}

std::size_t usual_lshade_members(std::size_t dimension) { return 18 * dimension; }

struct LshadeOptions {
  std::int64_t population = 0;
  std::int64_t memory = 6;
  double best_share = 0.11;
  double archive_share = 2.6;
  std::string reduction = "linear";
  std::string repair = "midpoint";
};

OptionTable<LshadeOptions> const& lshade_options() {
  using O = LshadeOptions;
  static OptionTable<O> const table(
      "estimator", "differential evolution that learns F and CR from its successes, with a shrinking population",
      {{"population", &O::population, "members", 0, 1e5, "members in the beginning; 0: 18 per parameter"},
       {"memory", &O::memory, "entries", 1, 1000, "generations of success that are remembered"},
       {"best_share", &O::best_share, "1", 0.0, 1.0,
        "share of the population that leads the others, at least two members"},
       {"archive_share", &O::archive_share, "population", 0.0, 100.0, "members that were replaced and are kept"},
       {"reduction", &O::reduction, reduction_words(),
        "linear: to four members at the end of the budget (evaluations or generations); none: constant, which is "
        "SHADE and can go on with a larger one (run --continue)"},
       {"repair", &O::repair, bound_repair_words(), "what happens to a parameter outside its bounds"}});
  return table;
}

struct LshadeSettings {
  std::size_t memory;
  double best_share, archive_share;
  Reduction reduction;
  BoundRepair repair;
  StopRules budget;
};

class Lshade final : public GenerationalSearch {
 public:
  Lshade(Bounds const& bounds, RandomKey key, std::size_t n_members, LshadeSettings const& settings)
      : GenerationalSearch("lshade", bounds, key, n_members),
        settings_(settings),
        key_(key),
        history_(settings.memory),
        archive_(bounds.dimension()),
        to_keep_(n_members) {}

  bool plans_by_budget() const override { return settings_.reduction != Reduction::none; }

 private:
  DrawControls draw() const {
    return [this](std::size_t, RandomStream& random) { return history_.draw(random); };
  }

  void make_trials(TrialStreams const& streams, MatrixView<double> const& trials) const override {
    make_current_to_pbest_trials({population(), fitness(), archive_, bounds(), settings_.best_share, settings_.repair},
                                 draw(), streams, trials);
  }

  void learn(Selected const& step, Progress& progress) override {
    auto const generation = static_cast<std::uint32_t>(progress.generation);
    auto const controls = controls_of_trials({key_, generation}, step.after.size(), draw());
    record_step(step, controls, bounds(), progress);

    std::vector<Success> successes;
    RandomStream random(key_, generation, std::numeric_limits<std::uint32_t>::max());
    for (std::size_t const i : step.winners) {
      double const improvement = improvement_of(step, i);
      if (!(improvement > 0.0)) continue;
      successes.push_back({controls[i], improvement});
      archive_.add(step.before.members().row(i), room_for(step.after.size()), random);
    }
    history_.learn(successes);

    to_keep_ = std::min(step.after.size(), members_after(progress));
    archive_.shrink(room_for(to_keep_), random);
  }

  std::size_t members_to_keep() const override { return to_keep_; }
  std::size_t least_members() const override {
    return settings_.reduction == Reduction::none ? largest_batch() : fewest_members;
  }

  void save_more(OptimiserState& state) const override {
    state["history"] = history_.numbers();
    state["archive"] = archive_.numbers();
  }

  void restore_more(OptimiserState const& state) override {
    auto const& history = state_entry(state, "history", SuccessHistory::numbers_of(settings_.memory));
    auto const& archive = state_rows(state, "archive", dimension(), 0, room_for(largest_batch()));
    history_.restore(history);
    archive_.restore(archive);
  }

  std::size_t room_for(std::size_t n_members) const { return share_of_members(settings_.archive_share, n_members); }

  std::size_t members_after(Progress const& progress) const {
    if (settings_.reduction == Reduction::none) return largest_batch();
    double const spent = std::min(1.0, share_spent(settings_.budget, progress));
    auto const most = static_cast<double>(largest_batch());
    return static_cast<std::size_t>(std::lround(most + (static_cast<double>(fewest_members) - most) * spent));
  }

  LshadeSettings settings_;
  RandomKey key_;
  SuccessHistory history_;
  MemberArchive archive_;
  std::size_t to_keep_;  // of the last generation passed to tell()
};

MakeSearch configure_lshade(LshadeOptions const& options, StopRules const& budget) {
  LshadeSettings const settings{static_cast<std::size_t>(options.memory),
                                options.best_share,
                                options.archive_share,
                                named_choice<Reduction>(reduction_words(), options.reduction),
                                named_choice<BoundRepair>(bound_repair_words(), options.repair),
                                budget};
  return [population = options.population, settings](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(population, usual_lshade_members, bounds.dimension());
    return std::make_unique<Lshade>(bounds, key, n_members, settings);
  };
}

}  // namespace

OptimiserChoice lshade_optimiser() {
  auto choice = make_choice<LshadeOptions>(
      "lshade", "L-SHADE: success-history adaptive DE, shrinking population", "Tanabe, Fukunaga: CEC 2014, 1658-1665",
      lshade_options(), [](LshadeOptions const& options) { return configure_lshade(options, {}); },
      usual_lshade_members);
  choice.prepare = [check = choice.prepare](Section const& section, std::vector<std::string> const& ignored,
                                            std::vector<Problem>& problems) {
    check(section, ignored, problems);
    // the stop rules of the same section are the budget: whoever searches checks them
    std::vector<Problem> told_elsewhere;
    LshadeOptions options;
    lshade_options().apply(section, options, told_elsewhere);
    StopRules budget;
    StopRules::table().apply(section, budget, told_elsewhere);
    return configure_lshade(options, budget);
  };
  return choice;
}

}  // namespace torquescope
