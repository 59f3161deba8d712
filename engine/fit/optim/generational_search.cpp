#include "engine/fit/optim/generational_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/search_progress.hpp"
#include "engine/fit/optim/selection.hpp"

namespace torquescope {

GenerationalSearch::GenerationalSearch(std::string kind, Bounds bounds, RandomKey key, std::size_t n_members)
    : kind_(std::move(kind)),
      bounds_(std::move(bounds)),
      key_(key),
      n_members_(n_members),
      population_(n_members, bounds_.dimension()),
      progress_(no_progress(bounds_.dimension())) {
  TORQUESCOPE_EXPECT(n_members >= 4 && bounds_.dimension() >= 1);
  TORQUESCOPE_EXPECT(bounds_.lower.size() == bounds_.upper.size());
}

void GenerationalSearch::start_at(std::span<double const> point) {
  TORQUESCOPE_EXPECT(!begun() && point.size() == dimension());
  start_.assign(point.begin(), point.end());
}

void GenerationalSearch::fill_first_batch(MatrixView<double> members) const {
  fill_initial_population(key_, bounds_, members);
  for (std::size_t j = 0; j < start_.size(); ++j)
    if (!std::isnan(start_[j])) members(0, j) = std::clamp(start_[j], bounds_.lower[j], bounds_.upper[j]);
}

void GenerationalSearch::ask(MatrixView<double> candidates) const {
  TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
  if (!begun()) {
    fill_first_batch(candidates);
    return;
  }
  make_trials({key_, static_cast<std::uint32_t>(progress_.generation + 1)}, candidates);
}

void GenerationalSearch::tell(MatrixView<double const> asked, std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(asked.rows() >= 1 && asked.rows() <= batch_size() && asked.columns() == dimension());
  TORQUESCOPE_EXPECT(fitness.size() == asked.rows());
  bool const first = !begun();
  count_batch(progress_, fitness);
  if (first) {
    keep_initial_population(asked, fitness);
  } else {
    select_and_learn(asked, fitness);
  }
  record_best(progress_, population_);
}

void GenerationalSearch::keep_initial_population(MatrixView<double const> asked, std::span<double const> fitness) {
  // members that a truncated batch left out keep their place, with the worst fitness
  if (asked.rows() < batch_size()) fill_first_batch(population_.members());
  std::copy_n(asked.data(), asked.rows() * asked.columns(), population_.numbers.begin());
  std::transform(fitness.begin(), fitness.end(), population_.fitness.begin(), ranked_fitness);
  forget_generation_before();
}

void GenerationalSearch::forget_generation_before() {
  before_ = population_;
  winners_.clear();
  winners_.reserve(population_.size());
}

void GenerationalSearch::select_and_learn(MatrixView<double const> asked, std::span<double const> fitness) {
  auto const members = std::as_const(population_).members();
  for (std::size_t const i : winners_) before_.set_member(i, members.row(i), population_.fitness[i]);
  select(asked, fitness, population_, winners_);
  ++progress_.generation;
  bool const whole = asked.rows() == population_.size();
  learn({before_, population_, winners_}, progress_);
  // a budget cut the batch: it was the last
  if (!whole || members_to_keep() >= population_.size()) return;
  population_.keep_best(members_to_keep());
  forget_generation_before();
}

OptimiserState GenerationalSearch::save() const {
  OptimiserState state = saved_state(kind_, key_, progress_, population_);
  save_more(state);
  return state;
}

void GenerationalSearch::restore(OptimiserState const& state) {
  auto saved = saved_search(state, kind_, key_, dimension(), least_members(), n_members_);
  // from here on nothing of ours can fail
  restore_more(state);
  progress_ = std::move(saved.progress);
  population_ = std::move(saved.population);
  forget_generation_before();
}

}  // namespace torquescope
