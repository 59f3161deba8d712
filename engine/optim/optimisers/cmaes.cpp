// CMA-ES in a box: a normal distribution that follows the landscape, sampled anew in every generation.
//
// Units      each parameter as a place in the box, 0 .. 1: one step size fits all
// Start      mean uniform in the box (many boxes are symmetric about what is sought), sigma 0.3 of its width
// Bounds     samples are mirrored; the distribution learns from the unmirrored ones. Resampling needs 2^R samples near
//            a corner; a penalty would change more than the order of fitness
// Restart    new mean and more samples (restart_plan.hpp), when the start is stuck (start_history.hpp) or its
//            distribution has collapsed. Batches never grow: the distribution learns from several of them together,
//            and "generation" counts batches
// Cut batch  an evaluation budget ends with it: its best counts, the distribution learns nothing
// Population the candidates last passed to tell(); F, CR, PC, FC are NaN
// Random     sample of member i in generation t: stream (key, t, i); a start's mean: the last stream of its generation
// Source     Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/optim/bound_repair.hpp"
#include "engine/optim/covariance_adaptation.hpp"
#include "engine/optim/make_choice.hpp"
#include "engine/optim/named_choice.hpp"
#include "engine/optim/optimiser_state.hpp"
#include "engine/optim/restart_plan.hpp"
#include "engine/optim/search_progress.hpp"
#include "engine/optim/selection.hpp"
#include "engine/optim/start_history.hpp"

namespace torquescope {

namespace {

std::size_t usual_cmaes_members(std::size_t dimension) {
  return 4 + static_cast<std::size_t>(3.0 * std::log(static_cast<double>(dimension)));
}

struct CmaesOptions {
  std::int64_t population = 0;
  double sigma = 0.3;
  std::string restarts = "ipop";
};

OptionTable<CmaesOptions> const& cmaes_options() {
  static OptionTable<CmaesOptions> const table(
      "estimator", "covariance matrix adaptation evolution strategy",
      {{"population", &CmaesOptions::population, "members", 0, 1e5,
        "candidates per generation; 0: 4 + 3 ln(parameters)"},
       {"sigma", &CmaesOptions::sigma, "box", 1e-6, 1.0, "standard deviation of the first candidates"},
       {"restarts", &CmaesOptions::restarts, restart_words(),
        "what a new start changes; ipop: samples double; bipop: small and large starts in turn; same: nothing"}});
  return table;
}

class Cmaes final : public Optimiser {
 public:
  Cmaes(Bounds bounds, RandomKey key, std::size_t n_members, double sigma, Restarts restarts)
      : bounds_(std::move(bounds)),
        key_(key),
        first_sigma_(sigma),
        population_(n_members, bounds_.dimension()),
        progress_(no_progress(bounds_.dimension())),
        plan_(restarts),
        distribution_(start(plan_, 0)),
        history_(bounds_.dimension(), n_members) {}

  std::size_t dimension() const override { return bounds_.dimension(); }
  std::size_t batch_size() const override { return population_.size(); }

  void start_at(std::span<double const> point) override {
    TORQUESCOPE_EXPECT(!begun() && point.size() == dimension());
    Eigen::VectorXd mean = distribution_.mean();
    for (std::size_t j = 0; j < dimension(); ++j) {
      double const width = bounds_.upper[j] - bounds_.lower[j];
      double const place = (point[j] - bounds_.lower[j]) / width;
      if (std::isfinite(place)) mean[static_cast<Eigen::Index>(j)] = std::clamp(place, 0.0, 1.0);
    }
    distribution_ = {mean, first_sigma_, batch_size()};
  }

  void ask(MatrixView<double> candidates) const override {
    TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
    for (std::size_t i = 0; i < candidates.rows(); ++i) {
      Eigen::VectorXd const place = distribution_.sample(deviates(next_generation(), i));
      for (std::size_t j = 0; j < dimension(); ++j) {
        double const lower = bounds_.lower[j], upper = bounds_.upper[j];
        double const inside = reflected(place[static_cast<Eigen::Index>(j)], 0.0, 1.0);
        candidates(i, j) = std::min(lower + inside * (upper - lower), upper);
      }
    }
  }

  void tell(MatrixView<double const> asked, std::span<double const> fitness) override {
    TORQUESCOPE_EXPECT(asked.rows() >= 1 && asked.rows() <= batch_size() && asked.columns() == dimension());
    TORQUESCOPE_EXPECT(fitness.size() == asked.rows());
    // members that a cut first batch left out keep their place, with the worst fitness
    if (!begun() && asked.rows() < batch_size()) ask(population_.members());
    for (std::size_t i = 0; i < fitness.size(); ++i)
      population_.set_member(i, asked.row(i), ranked_fitness(fitness[i]));

    progress_.generation = next_generation();
    count_batch(progress_, fitness);
    record_best(progress_, population_);
    plan_.count(static_cast<std::int64_t>(fitness.size()));
    if (asked.rows() < batch_size()) {
      told_.clear();
      return;
    }
    told_.insert(told_.end(), population_.fitness.begin(), population_.fitness.end());
    if (told_.size() == n_samples()) learn();
  }

  Progress const& progress() const override { return progress_; }
  MatrixView<double const> population() const override { return population_.members(); }
  std::span<double const> fitness() const override { return population_.fitness; }

  OptimiserState save() const override {
    OptimiserState state = saved_state("cmaes", key_, progress_, population_);
    state["distribution"] = distribution_.numbers();
    auto const plan = plan_.numbers();
    state["start"].assign(plan.begin(), plan.end());
    state["start history"] = history_.numbers();
    state["told"] = told_;
    return state;
  }

  void restore(OptimiserState const& state) override {
    auto saved = saved_search(state, "cmaes", key_, dimension(), batch_size(), batch_size());
    auto const& distribution = state_entry(state, "distribution", CovarianceAdaptation::numbers_of(dimension()));
    auto const& start_numbers = state_entry(state, "start", RestartPlan::n_numbers);
    auto const& history_numbers = state_rows(state, "start history", 1, 1, std::numeric_limits<std::size_t>::max());
    RestartPlan plan = plan_;
    if (!RestartPlan::accepts(start_numbers)) throw std::invalid_argument("the saved start is none that is made");
    plan.restore(start_numbers);
    auto const& told = state_rows(state, "told", batch_size(), 0, plan.samples() - 1);
    StartHistory history(dimension(), plan.samples() * batch_size());
    if (!history.accepts(history_numbers)) throw std::invalid_argument("the saved history of the start is cut short");
    history.restore(history_numbers);
    // from here on nothing can fail
    progress_ = std::move(saved.progress);
    population_ = std::move(saved.population);
    plan_ = plan;
    distribution_ = start(plan_, 0);
    distribution_.restore(distribution);
    history_ = std::move(history);
    told_ = told;
  }

 private:
  bool begun() const { return progress_.evaluations > 0; }
  std::int64_t next_generation() const { return begun() ? progress_.generation + 1 : 0; }

  std::size_t n_samples() const { return plan_.samples() * batch_size(); }

  // standard normal numbers of a member of that generation's batch
  Eigen::VectorXd deviates(std::int64_t generation, std::size_t member) const {
    RandomStream random(key_, static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(member));
    Eigen::VectorXd z(static_cast<Eigen::Index>(dimension()));
    for (double& number : z) number = random.normal();
    return z;
  }

  // of the samples with finite fitness, best first: as many as the distribution reads
  Eigen::MatrixXd ranked_deviates() const {
    auto order = ranking(told_);
    std::erase_if(order, [&](std::size_t i) { return !std::isfinite(told_[i]); });
    order.resize(std::min(order.size(), n_samples() / 2));
    std::int64_t const first = progress_.generation + 1 - static_cast<std::int64_t>(plan_.samples());
    Eigen::MatrixXd z(static_cast<Eigen::Index>(dimension()), static_cast<Eigen::Index>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k)
      z.col(static_cast<Eigen::Index>(k)) =
          deviates(first + static_cast<std::int64_t>(order[k] / batch_size()), order[k] % batch_size());
    return z;
  }

  CovarianceAdaptation start(RestartPlan const& plan, std::int64_t generation) const {
    RandomStream random(key_, static_cast<std::uint32_t>(generation), std::numeric_limits<std::uint32_t>::max());
    Eigen::VectorXd mean(static_cast<Eigen::Index>(dimension()));
    for (double& place : mean) place = random.uniform();
    return {mean, first_sigma_ * plan.width(), plan.samples() * batch_size()};
  }

  // the generation of the distribution is whole
  void learn() {
    distribution_.learn(ranked_deviates());
    bool const is_stuck = history_.is_stuck_after(told_);
    told_.clear();
    if (!is_stuck && !distribution_.is_collapsed() && !plan_.is_spent()) return;
    std::uint32_t const generation = static_cast<std::uint32_t>(next_generation());
    RandomStream random(key_, generation, std::numeric_limits<std::uint32_t>::max() - 1);
    plan_.begin_next(random);
    distribution_ = start(plan_, next_generation());
    history_ = StartHistory(dimension(), n_samples());
  }

  Bounds bounds_;
  RandomKey key_;
  double first_sigma_;
  Population population_;
  Progress progress_;
  RestartPlan plan_;
  CovarianceAdaptation distribution_;
  StartHistory history_;
  std::vector<double> told_;  // fitness of the batches from which the distribution has still to learn
};

MakeSearch configure_cmaes(CmaesOptions const& options) {
  auto const restarts = named_choice<Restarts>(restart_words(), options.restarts);
  return [options, restarts](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(options.population, usual_cmaes_members, bounds.dimension());
    return std::make_unique<Cmaes>(bounds, key, n_members, options.sigma, restarts);
  };
}

}  // namespace

OptimiserChoice cmaes_optimiser() {
  return make_choice<CmaesOptions>("cmaes", "CMA-ES: covariance matrix adaptation, mirrored at the bounds",
                                   "Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)",
                                   cmaes_options(), configure_cmaes, usual_cmaes_members);
}

}  // namespace torquescope
