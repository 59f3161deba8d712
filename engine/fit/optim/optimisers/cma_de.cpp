// Starts of an evolution strategy and of a differential evolution in turn: the first are quick where one valley leads
// to the minimum, turned or not; the second find it among many along the parameters.
//
// Covariance covariance_start.hpp, the worse half of the samples teaching too; each start has twice the samples of the
//            one before. The first two have all evaluations
// History    history_start.hpp; each start has twice the members of the one before
// Turns      afterwards a population owns the share of the evaluations that its movement deserves (movement_share.hpp:
//            FADE's rules on scale-free inputs), in whole sweeps and whole generations of a distribution
// Scale      neither units of parameters nor scale or offset of fitness change any step
// Cut batch  an evaluation budget ends with it: its best counts, nobody learns from it
// Progress   F, CR: means of a batch of trials; PC, FC: of a sweep, in spreads; NaN in other batches
// Population the candidates last passed to tell()
// Source     ours; parts: Hansen, arXiv 1604.00772 (2016); Tanabe, Fukunaga, doi:10.1109/CEC.2014.6900380; Liu,
//            Lampinen: Soft Computing 9 (2005) 448-462

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/fit/optim/covariance_start.hpp"
#include "engine/fit/optim/history_start.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/movement_share.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/restart_plan.hpp"
#include "engine/fit/optim/search_progress.hpp"

namespace torquescope {

namespace {

enum class Starts { both, covariance, history };
enum class Sharing { fuzzy, even };

std::vector<std::string> const& starts_words() {
  static std::vector<std::string> const words{"both", "covariance", "history"};
  return words;
}

std::vector<std::string> const& sharing_words() {
  static std::vector<std::string> const words{"fuzzy", "even"};
  return words;
}

std::vector<std::string> const& teaching_words() {
  static std::vector<std::string> const words{"better_half", "both_halves"};
  return words;
}

struct CmaDeOptions {
  std::int64_t population = 0;
  std::int64_t members = 30;
  double sigma = 0.3;
  double best_share = 0.11;
  std::string starts = "both";
  std::string sharing = "fuzzy";
  std::string teaching = "both_halves";
  std::string repair = "midpoint";
};

OptionTable<CmaDeOptions> const& cma_de_options() {
  using O = CmaDeOptions;
  static OptionTable<O> const table(
      "estimator", "CMA-ES and success-history differential evolution in turn",
      {{"population", &O::population, "members", 0, 1e5, "candidates per generation; 0: 4 + 3 ln(parameters)"},
       {"members", &O::members, "members", 4, 1e5,
        "of the first differential evolution, rounded up to whole generations"},
       {"sigma", &O::sigma, "box", 1e-6, 1.0, "standard deviation of a distribution's first candidates"},
       {"best_share", &O::best_share, "1", 0.0, 1.0,
        "share of a differential evolution that leads the others, at least two members"},
       {"starts", &O::starts, starts_words(), "both kinds, or one alone"},
       {"sharing", &O::sharing, sharing_words(),
        "evaluations of a differential evolution; fuzzy: by its movement; even: half"},
       {"teaching", &O::teaching, teaching_words(), "samples that teach the covariance"},
       {"repair", &O::repair, bound_repair_words(),
        "what happens to a parameter of a trial outside its bounds; samples of a distribution are mirrored"}});
  return table;
}

struct CmaDeSettings {
  std::size_t members;
  double sigma, best_share;
  Starts starts;
  Sharing sharing;
  Teaching teaching;
  BoundRepair repair;
};

class CmaDe final : public Optimiser {
 public:
  CmaDe(Bounds bounds, RandomKey key, std::size_t n_members, CmaDeSettings const& settings)
      : bounds_(std::move(bounds)),
        key_(key),
        settings_(settings),
        population_(n_members, bounds_.dimension()),
        progress_(no_progress(bounds_.dimension())),
        beginning_(dimension(), std::numeric_limits<double>::quiet_NaN()),
        covariance_(covariance_start(covariance_plan_, uniform_place(key_, 0, dimension()))),
        history_(history_start(history_plan_)),
        is_history_(settings.starts == Starts::history) {}

  std::size_t dimension() const override { return bounds_.dimension(); }
  std::size_t batch_size() const override { return population_.size(); }

  void start_at(std::span<double const> point) override {
    TORQUESCOPE_EXPECT(!begun() && point.size() == dimension());
    beginning_.assign(point.begin(), point.end());
    covariance_ = covariance_start(covariance_plan_, place_of(point, bounds_, uniform_place(key_, 0, dimension())));
  }

  void ask(MatrixView<double> candidates) const override {
    TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
    if (!is_history_) {
      covariance_.ask(next_generation(), bounds_, candidates);
      return;
    }
    history_.ask(next_generation(), bounds_, candidates);
    if (!history_.is_empty() || history_plan_.samples() > 1) return;
    for (std::size_t j = 0; j < dimension(); ++j)
      if (!std::isnan(beginning_[j])) candidates(0, j) = std::clamp(beginning_[j], bounds_.lower[j], bounds_.upper[j]);
  }

  void tell(MatrixView<double const> asked, std::span<double const> fitness) override {
    TORQUESCOPE_EXPECT(asked.rows() >= 1 && asked.rows() <= batch_size() && asked.columns() == dimension());
    TORQUESCOPE_EXPECT(fitness.size() == asked.rows());
    // members that a cut first batch left out keep their place, with the worst fitness
    if (!begun() && asked.rows() < batch_size()) ask(population_.members());
    progress_.generation = next_generation();
    progress_.F = progress_.CR = progress_.PC = progress_.FC = std::numeric_limits<double>::quiet_NaN();
    record_batch(asked, fitness, population_, progress_);
    if (asked.rows() < batch_size()) {
      covariance_.cut();
      return;
    }
    is_history_ ? learn_history(asked) : learn_covariance();
    take_turns();
  }

  Progress const& progress() const override { return progress_; }
  MatrixView<double const> population() const override { return population_.members(); }
  std::span<double const> fitness() const override { return population_.fitness; }

  OptimiserState save() const override {
    OptimiserState state = saved_state("cma_de", key_, progress_, population_);
    covariance_.save(state);
    history_.save(state);
    auto const covariance = covariance_plan_.numbers(), history = history_plan_.numbers();
    state["covariance starts"].assign(covariance.begin(), covariance.end());
    state["history starts"].assign(history.begin(), history.end());
    state["beginning"] = beginning_;
    state["turns"] = {is_history_ ? 1.0 : 0.0, share_, owed_};
    return state;
  }

  void restore(OptimiserState const& state) override {
    auto saved = saved_search(state, "cma_de", key_, dimension(), batch_size(), batch_size());
    auto const covariance_plan = saved_plan(state, "covariance starts");
    auto const history_plan = saved_plan(state, "history starts");
    auto const& beginning = state_entry(state, "beginning", dimension());
    auto const& turns = state_entry(state, "turns", 3);
    auto covariance = covariance_start(covariance_plan, uniform_place(key_, 0, dimension()));
    auto history = history_start(history_plan);
    covariance.restore(state);
    history.restore(state);
    // from here on nothing can fail
    progress_ = std::move(saved.progress);
    population_ = std::move(saved.population);
    beginning_ = beginning;
    covariance_plan_ = covariance_plan;
    history_plan_ = history_plan;
    covariance_ = std::move(covariance);
    history_ = std::move(history);
    is_history_ = turns[0] != 0.0;
    share_ = turns[1];
    owed_ = turns[2];
  }

 private:
  bool begun() const { return progress_.evaluations > 0; }
  std::int64_t next_generation() const { return begun() ? progress_.generation + 1 : 0; }

  static RestartPlan saved_plan(OptimiserState const& state, std::string const& name) {
    RestartPlan plan(Restarts::ipop);
    auto const& numbers = state_entry(state, name, RestartPlan::n_numbers);
    if (!RestartPlan::accepts(numbers)) throw std::invalid_argument("the saved start is none that is made");
    plan.restore(numbers);
    return plan;
  }

  CovarianceStart covariance_start(RestartPlan const& plan, Eigen::VectorXd mean) const {
    return {key_, std::move(mean), {batch_size(), plan.samples(), settings_.sigma, settings_.teaching}};
  }

  HistoryStart history_start(RestartPlan const& plan) const {
    std::size_t const batches = (settings_.members + batch_size() - 1) / batch_size();
    return {key_, dimension(), {batch_size(), batches * plan.samples(), settings_.best_share, settings_.repair}};
  }

  // the next start of a kind
  void double_samples(RestartPlan& plan) const {
    RandomStream random(key_, static_cast<std::uint32_t>(next_generation()),
                        std::numeric_limits<std::uint32_t>::max() - 1);
    plan.begin_next(random);
  }

  void learn_covariance() {
    if (!covariance_.is_over_after(progress_.generation, population_.fitness)) return;
    double_samples(covariance_plan_);
    covariance_ = covariance_start(covariance_plan_, uniform_place(key_, next_generation(), dimension()));
  }

  void learn_history(MatrixView<double const> asked) {
    bool const is_over = history_.is_over_after(progress_.generation, asked, population_.fitness, bounds_, progress_);
    if (history_.has_swept() && !std::isnan(progress_.PC) && settings_.sharing == Sharing::fuzzy)
      share_ = MovementShare()({progress_.PC, progress_.FC});
    if (!is_over) return;
    double_samples(history_plan_);
    history_ = history_start(history_plan_);
  }

  void take_turns() {
    constexpr std::size_t samples_of_third = 4;
    if (settings_.starts != Starts::both || covariance_plan_.samples() < samples_of_third) return;
    owed_ += (is_history_ ? share_ - 1.0 : share_) * static_cast<double>(batch_size());
    bool const may_change = is_history_ ? history_.has_swept() || history_.is_empty() : covariance_.has_learned_all();
    if (may_change) is_history_ = owed_ > 0.0;
  }

  Bounds bounds_;
  RandomKey key_;
  CmaDeSettings settings_;
  Population population_;
  Progress progress_;
  std::vector<double> beginning_;  // NaN: not known
  RestartPlan covariance_plan_{Restarts::ipop}, history_plan_{Restarts::ipop};
  CovarianceStart covariance_;
  HistoryStart history_;
  bool is_history_;     // whose batch comes next
  double share_ = 0.5;  // of the evaluations, that differential evolutions should have
  double owed_ = 0.0;   // evaluations that they have had too few of
};

MakeSearch configure_cma_de(CmaDeOptions const& options) {
  CmaDeSettings const settings{static_cast<std::size_t>(options.members),
                               options.sigma,
                               options.best_share,
                               named_choice<Starts>(starts_words(), options.starts),
                               named_choice<Sharing>(sharing_words(), options.sharing),
                               named_choice<Teaching>(teaching_words(), options.teaching),
                               named_choice<BoundRepair>(bound_repair_words(), options.repair)};
  return [population = options.population, settings](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(population, usual_samples, bounds.dimension());
    return std::make_unique<CmaDe>(bounds, key, n_members, settings);
  };
}

}  // namespace

OptimiserChoice cma_de_optimiser() {
  return make_choice<CmaDeOptions>("cma_de", "CMA-ES and success-history DE in turn, shared by fuzzy control",
                                   "Torquescope's own; parts: arXiv 1604.00772, CEC 2014, Soft Computing 9 (2005)",
                                   cma_de_options(), configure_cma_de, usual_samples);
}

}  // namespace torquescope
