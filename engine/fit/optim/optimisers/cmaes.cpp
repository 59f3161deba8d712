// CMA-ES in a box: a normal distribution that follows the landscape, sampled anew in every generation.
//
// Start      mean uniform in the box, sigma 0.3 of its width; samples, bounds and ends: covariance_start.hpp
// Restart    new mean and more samples (restart_plan.hpp) when a start is over. Batches never grow: the distribution
//            learns from several of them together, and "generation" counts batches
// Cut batch  an evaluation budget ends with it: its best counts, the distribution learns nothing
// Population the candidates last passed to tell(); F, CR, PC, FC are NaN
// Source     Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)

#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/fit/optim/covariance_start.hpp"
#include "engine/fit/optim/make_choice.hpp"
#include "engine/fit/optim/named_choice.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/restart_plan.hpp"
#include "engine/fit/optim/search_progress.hpp"

namespace torquescope {

namespace {

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
        start_(begin(plan_, uniform_place(key_, 0, dimension()))) {}

  std::size_t dimension() const override { return bounds_.dimension(); }
  std::size_t batch_size() const override { return population_.size(); }

  void start_at(std::span<double const> point) override {
    TORQUESCOPE_EXPECT(!begun() && point.size() == dimension());
    start_ = begin(plan_, place_of(point, bounds_, uniform_place(key_, 0, dimension())));
  }

  void ask(MatrixView<double> candidates) const override {
    TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
    start_.ask(next_generation(), bounds_, candidates);
  }

  void tell(MatrixView<double const> asked, std::span<double const> fitness) override {
    TORQUESCOPE_EXPECT(asked.rows() >= 1 && asked.rows() <= batch_size() && asked.columns() == dimension());
    TORQUESCOPE_EXPECT(fitness.size() == asked.rows());
    // members that a cut first batch left out keep their place, with the worst fitness
    if (!begun() && asked.rows() < batch_size()) ask(population_.members());
    progress_.generation = next_generation();
    record_batch(asked, fitness, population_, progress_);
    plan_.count(static_cast<std::int64_t>(fitness.size()));
    if (asked.rows() < batch_size()) {
      start_.cut();
    } else if (start_.is_over_after(progress_.generation, population_.fitness) ||
               (start_.has_learned_all() && plan_.is_spent())) {
      begin_anew();
    }
  }

  Progress const& progress() const override { return progress_; }
  MatrixView<double const> population() const override { return population_.members(); }
  std::span<double const> fitness() const override { return population_.fitness; }

  OptimiserState save() const override {
    OptimiserState state = saved_state("cmaes", key_, progress_, population_);
    start_.save(state);
    auto const plan = plan_.numbers();
    state["start"].assign(plan.begin(), plan.end());
    return state;
  }

  void restore(OptimiserState const& state) override {
    auto saved = saved_search(state, "cmaes", key_, dimension(), batch_size(), batch_size());
    auto const& start_numbers = state_entry(state, "start", RestartPlan::n_numbers);
    RestartPlan plan = plan_;
    if (!RestartPlan::accepts(start_numbers)) throw std::invalid_argument("the saved start is none that is made");
    plan.restore(start_numbers);
    auto start = begin(plan, uniform_place(key_, 0, dimension()));
    start.restore(state);
    // from here on nothing can fail
    progress_ = std::move(saved.progress);
    population_ = std::move(saved.population);
    plan_ = plan;
    start_ = std::move(start);
  }

 private:
  bool begun() const { return progress_.evaluations > 0; }
  std::int64_t next_generation() const { return begun() ? progress_.generation + 1 : 0; }

  CovarianceStart begin(RestartPlan const& plan, Eigen::VectorXd mean) const {
    return {key_, std::move(mean), {batch_size(), plan.samples(), first_sigma_ * plan.width()}};
  }

  void begin_anew() {
    auto const generation = static_cast<std::uint32_t>(next_generation());
    RandomStream random(key_, generation, std::numeric_limits<std::uint32_t>::max() - 1);
    plan_.begin_next(random);
    start_ = begin(plan_, uniform_place(key_, next_generation(), dimension()));
  }

  Bounds bounds_;
  RandomKey key_;
  double first_sigma_;
  Population population_;
  Progress progress_;
  RestartPlan plan_;
  CovarianceStart start_;
};

MakeSearch configure_cmaes(CmaesOptions const& options) {
  auto const restarts = named_choice<Restarts>(restart_words(), options.restarts);
  return [options, restarts](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(options.population, usual_samples, bounds.dimension());
    return std::make_unique<Cmaes>(bounds, key, n_members, options.sigma, restarts);
  };
}

}  // namespace

OptimiserChoice cmaes_optimiser() {
  return make_choice<CmaesOptions>("cmaes", "CMA-ES: covariance matrix adaptation, mirrored at the bounds",
                                   "Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)",
                                   cmaes_options(), configure_cmaes, usual_samples);
}

}  // namespace torquescope
