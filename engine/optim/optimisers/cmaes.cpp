// CMA-ES in a box: a normal distribution that follows the landscape, sampled anew in every generation.
//
// Units      each parameter as a place in the box, 0 .. 1: one step size fits all
// Start      mean uniform in the box (many boxes are symmetric about what is sought), sigma 0.3 of its width
// Bounds     samples are mirrored; the distribution learns from the unmirrored ones. Resampling needs 2^R samples near
//            a corner; a penalty would change more than the order of fitness
// Restart    same population, new mean: when the distribution collapsed, or 100 + 100 R^1.5 / NP generations found
//            nothing better. A growing population (IPOP) has no end that the result file could make room for
// Cut batch  an evaluation budget ends with it: its best counts, the distribution learns nothing
// Population the candidates last passed to tell(); F, CR, PC, FC are NaN
// Random     sample of member i in generation t: stream (key, t, i); a start's mean: the last stream of its generation
// Source     Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016); restart: pycma's tolstagnation

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "engine/optim/bound_repair.hpp"
#include "engine/optim/covariance_adaptation.hpp"
#include "engine/optim/make_choice.hpp"
#include "engine/optim/optimiser_state.hpp"
#include "engine/optim/search_progress.hpp"
#include "engine/optim/selection.hpp"

namespace torquescope {

namespace {

std::size_t usual_cmaes_members(std::size_t dimension) {
  return 4 + static_cast<std::size_t>(3.0 * std::log(static_cast<double>(dimension)));
}

struct CmaesOptions {
  std::int64_t population = 0;
  double sigma = 0.3;
};

OptionTable<CmaesOptions> const& cmaes_options() {
  static OptionTable<CmaesOptions> const table(
      "estimator", "covariance matrix adaptation evolution strategy",
      {{"population", &CmaesOptions::population, "members", 0, 1e5,
        "candidates per generation; 0: 4 + 3 ln(parameters)"},
       {"sigma", &CmaesOptions::sigma, "box", 1e-6, 1.0, "standard deviation of the first candidates"}});
  return table;
}

class Cmaes final : public Optimiser {
 public:
  Cmaes(Bounds bounds, RandomKey key, std::size_t n_members, double sigma)
      : bounds_(std::move(bounds)),
        key_(key),
        first_sigma_(sigma),
        population_(n_members, bounds_.dimension()),
        progress_(no_progress(bounds_.dimension())),
        distribution_(start(0)) {}

  std::size_t dimension() const override { return bounds_.dimension(); }
  std::size_t batch_size() const override { return population_.size(); }

  void ask(MatrixView<double> candidates) const override {
    TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
    for (std::size_t i = 0; i < candidates.rows(); ++i) {
      Eigen::VectorXd const place = distribution_.sample(deviates(i));
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
    bool const whole = asked.rows() == batch_size();
    if (whole) distribution_.learn(ranked_deviates());

    progress_.generation = next_generation();
    count_batch(progress_, fitness);
    record_best(progress_, population_);
    if (whole) restart_if_stuck();
  }

  Progress const& progress() const override { return progress_; }
  MatrixView<double const> population() const override { return population_.members(); }
  std::span<double const> fitness() const override { return population_.fitness; }

  OptimiserState save() const override {
    OptimiserState state = saved_state("cmaes", key_, progress_, population_);
    state["distribution"] = distribution_.numbers();
    state["start"] = {start_best_, static_cast<double>(start_improved_)};
    return state;
  }

  void restore(OptimiserState const& state) override {
    auto saved = saved_search(state, "cmaes", key_, dimension(), batch_size(), batch_size());
    auto const& distribution = state_entry(state, "distribution", CovarianceAdaptation::numbers_of(dimension()));
    auto const& start = state_entry(state, "start", 2);
    // from here on nothing can fail
    progress_ = std::move(saved.progress);
    population_ = std::move(saved.population);
    distribution_.restore(distribution);
    start_best_ = start[0];
    start_improved_ = static_cast<std::int64_t>(start[1]);
  }

 private:
  bool begun() const { return progress_.evaluations > 0; }
  std::int64_t next_generation() const { return begun() ? progress_.generation + 1 : 0; }

  // standard normal numbers of a member of the next batch
  Eigen::VectorXd deviates(std::size_t member) const {
    RandomStream random(key_, static_cast<std::uint32_t>(next_generation()), static_cast<std::uint32_t>(member));
    Eigen::VectorXd z(static_cast<Eigen::Index>(dimension()));
    for (double& number : z) number = random.normal();
    return z;
  }

  // of the members with finite fitness, best first
  Eigen::MatrixXd ranked_deviates() const {
    auto order = ranking(population_.fitness);
    std::erase_if(order, [&](std::size_t i) { return !std::isfinite(population_.fitness[i]); });
    Eigen::MatrixXd z(static_cast<Eigen::Index>(dimension()), static_cast<Eigen::Index>(order.size()));
    for (std::size_t k = 0; k < order.size(); ++k) z.col(static_cast<Eigen::Index>(k)) = deviates(order[k]);
    return z;
  }

  CovarianceAdaptation start(std::int64_t generation) const {
    RandomStream random(key_, static_cast<std::uint32_t>(generation), std::numeric_limits<std::uint32_t>::max());
    Eigen::VectorXd mean(static_cast<Eigen::Index>(dimension()));
    for (double& place : mean) place = random.uniform();
    return {mean, first_sigma_, batch_size()};
  }

  void restart_if_stuck() {
    double const best = population_.fitness[best_index(population_.fitness)];
    if (best < start_best_) {
      start_best_ = best;
      start_improved_ = progress_.generation;
    }
    double const patience =
        100.0 + 100.0 * std::pow(static_cast<double>(dimension()), 1.5) / static_cast<double>(batch_size());
    bool const stagnates = static_cast<double>(progress_.generation - start_improved_) > patience;
    if (!stagnates && !distribution_.is_collapsed()) return;
    distribution_ = start(next_generation());
    start_best_ = std::numeric_limits<double>::infinity();
    start_improved_ = next_generation();
  }

  Bounds bounds_;
  RandomKey key_;
  double first_sigma_;
  Population population_;
  Progress progress_;
  CovarianceAdaptation distribution_;
  // of this start: its best fitness, and the generation that found it
  double start_best_ = std::numeric_limits<double>::infinity();
  std::int64_t start_improved_ = 0;
};

MakeSearch configure_cmaes(CmaesOptions const& options) {
  return [options](Bounds const& bounds, RandomKey key) {
    auto const n_members = members_of(options.population, usual_cmaes_members, bounds.dimension());
    return std::make_unique<Cmaes>(bounds, key, n_members, options.sigma);
  };
}

}  // namespace

OptimiserChoice cmaes_optimiser() {
  return make_choice<CmaesOptions>("cmaes", "CMA-ES: covariance matrix adaptation, mirrored at the bounds",
                                   "Hansen: The CMA evolution strategy: a tutorial, arXiv 1604.00772 (2016)",
                                   cmaes_options(), configure_cmaes, usual_cmaes_members);
}

}  // namespace torquescope
