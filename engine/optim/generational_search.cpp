#include "engine/optim/generational_search.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "engine/optim/optimiser_state.hpp"
#include "engine/optim/selection.hpp"

namespace torquescope {

namespace {

constexpr double state_version = 1.0;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

GenerationalSearch::GenerationalSearch(std::string kind, Bounds bounds, RandomKey key, std::size_t n_members)
    : kind_(std::move(kind)), bounds_(std::move(bounds)), key_(key), population_(n_members, bounds_.dimension()) {
  TORQUESCOPE_EXPECT(n_members >= 4 && bounds_.dimension() >= 1);
  TORQUESCOPE_EXPECT(bounds_.lower.size() == bounds_.upper.size());
  progress_.best_fitness = std::numeric_limits<double>::infinity();
  progress_.best.assign(bounds_.dimension(), none);
  progress_.F = progress_.CR = progress_.PC = progress_.FC = none;
}

void GenerationalSearch::ask(MatrixView<double> candidates) const {
  TORQUESCOPE_EXPECT(candidates.rows() == batch_size() && candidates.columns() == dimension());
  if (!begun()) {
    fill_initial_population(key_, bounds_, candidates);
    return;
  }
  make_trials({key_, static_cast<std::uint32_t>(progress_.generation + 1)}, candidates);
}

void GenerationalSearch::tell(MatrixView<double const> asked, std::span<double const> fitness) {
  TORQUESCOPE_EXPECT(asked.rows() >= 1 && asked.rows() <= batch_size() && asked.columns() == dimension());
  TORQUESCOPE_EXPECT(fitness.size() == asked.rows());
  if (begun()) {
    select_and_learn(asked, fitness);
  } else {
    keep_initial_population(asked, fitness);
  }
  progress_.evaluations += static_cast<std::int64_t>(fitness.size());
  progress_.nonfinite += static_cast<std::int64_t>(count_nonfinite(fitness));
  record_best();
}

void GenerationalSearch::keep_initial_population(MatrixView<double const> asked, std::span<double const> fitness) {
  // members that a truncated batch left out keep their place, with the worst fitness
  if (asked.rows() < batch_size()) fill_initial_population(key_, bounds_, population_.members());
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
  learn({before_, population_, winners_}, progress_);
}

void GenerationalSearch::record_best() {
  std::size_t const best = best_index(population_.fitness);
  double const best_fitness = population_.fitness[best];
  // selection never loses the best member, so only a smaller value is news
  if (!(best_fitness < progress_.best_fitness)) return;
  progress_.best_fitness = best_fitness;
  progress_.last_improvement = progress_.generation;
  auto const member = std::as_const(population_).members().row(best);
  progress_.best.assign(member.begin(), member.end());
}

OptimiserState GenerationalSearch::save() const {
  OptimiserState state{{"kind " + kind_, {state_version}},  {"key", numbers_of(key_)},
                       {"progress", numbers_of(progress_)}, {"best", progress_.best},
                       {"population", population_.numbers}, {"fitness", population_.fitness}};
  save_more(state);
  return state;
}

void GenerationalSearch::restore(OptimiserState const& state) {
  if (state_entry(state, "kind " + kind_, 1).front() != state_version) {
    throw std::invalid_argument("the saved state is of another version of " + kind_);
  }
  auto const key = numbers_of(key_);
  if (state_entry(state, "key", key.size()) != key) {
    throw std::invalid_argument("the saved state belongs to another seed or run");
  }
  auto const& progress = state_entry(state, "progress", numbers_of(progress_).size());
  auto const& best = state_entry(state, "best", dimension());
  auto const& population = state_entry(state, "population", population_.numbers.size());
  auto const& fitness = state_entry(state, "fitness", population_.size());
  // from here on nothing of ours can fail
  restore_more(state);
  progress_ = progress_of(progress, best);
  population_.numbers = population;
  population_.fitness = fitness;
  forget_generation_before();
}

}  // namespace torquescope
