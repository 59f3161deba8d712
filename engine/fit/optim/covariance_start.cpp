#include "engine/fit/optim/covariance_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "engine/fit/optim/bound_repair.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/population.hpp"

namespace torquescope {

namespace {

Eigen::VectorXd mirrored(Eigen::VectorXd place) {
  for (double& x : place) x = reflected(x, 0.0, 1.0);
  return place;
}

Eigen::MatrixXd columns(std::vector<Eigen::VectorXd> const& vectors) {
  if (vectors.empty()) return {};
  Eigen::MatrixXd matrix(vectors.front().size(), static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k) matrix.col(static_cast<Eigen::Index>(k)) = vectors[k];
  return matrix;
}

}  // namespace

std::size_t usual_samples(std::size_t dimension) {
  return 4 + static_cast<std::size_t>(3.0 * std::log(static_cast<double>(dimension)));
}

Eigen::VectorXd uniform_place(RandomKey key, std::int64_t generation, std::size_t dimension) {
  RandomStream random(key, static_cast<std::uint32_t>(generation), std::numeric_limits<std::uint32_t>::max());
  Eigen::VectorXd place(static_cast<Eigen::Index>(dimension));
  for (double& x : place) x = random.uniform();
  return place;
}

Eigen::VectorXd place_of(std::span<double const> point, Bounds const& bounds, Eigen::VectorXd otherwise) {
  for (std::size_t j = 0; j < point.size(); ++j) {
    double const place = (point[j] - bounds.lower[j]) / (bounds.upper[j] - bounds.lower[j]);
    if (std::isfinite(place)) otherwise[static_cast<Eigen::Index>(j)] = std::clamp(place, 0.0, 1.0);
  }
  return otherwise;
}

CovarianceStart::CovarianceStart(RandomKey key, Eigen::VectorXd mean, CovarianceStartSettings const& settings)
    : key_(key),
      settings_(settings),
      distribution_(mean, settings.sigma, settings.batches * settings.batch_size),
      history_(static_cast<std::size_t>(mean.size()), settings.batches * settings.batch_size) {}

void CovarianceStart::ask(std::int64_t generation, Bounds const& bounds, MatrixView<double> const& candidates) const {
  for (std::size_t i = 0; i < candidates.rows(); ++i) {
    Eigen::VectorXd const place = mirrored(distribution_.sample(deviates(generation, i)));
    for (std::size_t j = 0; j < candidates.columns(); ++j) {
      double const lower = bounds.lower[j], upper = bounds.upper[j];
      candidates(i, j) = std::min(lower + place[static_cast<Eigen::Index>(j)] * (upper - lower), upper);
    }
  }
}

bool CovarianceStart::is_over_after(std::int64_t generation, std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(fitness.size() == settings_.batch_size);
  told_.insert(told_.end(), fitness.begin(), fitness.end());
  if (told_.size() < settings_.batches * settings_.batch_size) return false;
  learn(generation);
  bool const is_stuck = history_.is_stuck_after(told_);
  told_.clear();
  return is_stuck || distribution_.is_collapsed();
}

// standard normal numbers of a member of that generation's batch
Eigen::VectorXd CovarianceStart::deviates(std::int64_t generation, std::size_t member) const {
  RandomStream random(key_, static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(member));
  Eigen::VectorXd z(distribution_.mean().size());
  for (double& number : z) number = random.normal();
  return z;
}

void CovarianceStart::learn(std::int64_t generation) {
  auto order = ranking(told_);
  std::erase_if(order, [&](std::size_t i) { return !std::isfinite(told_[i]); });
  std::int64_t const first = generation + 1 - static_cast<std::int64_t>(settings_.batches);
  std::size_t const mu = told_.size() / 2;
  bool all_inside = true;
  std::vector<Eigen::VectorXd> better, worse;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Eigen::VectorXd const z =
        deviates(first + static_cast<std::int64_t>(order[k] / settings_.batch_size), order[k] % settings_.batch_size);
    Eigen::VectorXd const place = distribution_.sample(z), inside = mirrored(place);
    bool const is_inside = inside == place;
    all_inside = all_inside && is_inside;
    // as if the distribution had drawn the mirrored sample itself
    (k < mu ? better : worse).push_back(is_inside ? z : distribution_.deviates_of(inside));
  }
  if (settings_.teaching == Teaching::better_half || !all_inside) worse.clear();
  distribution_.learn(columns(better), columns(worse));
}

void CovarianceStart::save(OptimiserState& state) const {
  state["distribution"] = distribution_.numbers();
  state["start history"] = history_.numbers();
  state["told"] = told_;
}

void CovarianceStart::restore(OptimiserState const& state) {
  auto const dimension = static_cast<std::size_t>(distribution_.mean().size());
  auto const& distribution = state_entry(state, "distribution", CovarianceAdaptation::numbers_of(dimension));
  auto const& history = state_rows(state, "start history", 1, 1, std::numeric_limits<std::size_t>::max());
  auto const& told = state_rows(state, "told", settings_.batch_size, 0, settings_.batches - 1);
  if (!history_.accepts(history)) throw std::invalid_argument("the saved history of the start is cut short");
  // from here on nothing can fail
  distribution_.restore(distribution);
  history_.restore(history);
  told_ = told;
}

}  // namespace torquescope
