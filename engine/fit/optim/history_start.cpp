#include "engine/fit/optim/history_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/fit/optim/current_to_pbest.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/fit/optim/selection.hpp"

namespace torquescope {

namespace {

constexpr std::size_t remembered_batches = 6;
constexpr double narrowest = 1e-12;

}  // namespace

HistoryStart::HistoryStart(RandomKey key, std::size_t dimension, HistoryStartSettings const& settings)
    : key_(key),
      settings_(settings),
      members_(settings.batch_size * settings.batches, dimension),
      before_(members_),
      history_(remembered_batches),
      archive_(dimension),
      sweeps_(dimension, members_.size()) {}

void HistoryStart::ask(std::int64_t generation, Bounds const& bounds, MatrixView<double> const& candidates) const {
  auto const number = static_cast<std::uint32_t>(generation);
  if (is_filling()) {
    fill_initial_population(key_, bounds, candidates, number);
    return;
  }
  make_current_to_pbest_trials(
      {members_.members(), members_.fitness, archive_, bounds, settings_.best_share, settings_.repair, next_},
      [this](std::size_t, RandomStream& random) { return history_.draw(random); }, {key_, number}, candidates);
}

TrialControls HistoryStart::controls_of(std::int64_t generation, std::size_t member) const {
  RandomStream random(key_, static_cast<std::uint32_t>(generation), static_cast<std::uint32_t>(member));
  return history_.draw(random);
}

bool HistoryStart::is_over_after(std::int64_t generation, MatrixView<double const> asked,
                                 std::span<double const> fitness, Bounds const& bounds, Progress& progress) {
  TORQUESCOPE_EXPECT(fitness.size() == settings_.batch_size);
  if (is_filling()) {
    for (std::size_t i = 0; i < fitness.size(); ++i)
      members_.set_member(n_members_ + i, asked.row(i), ranked_fitness(fitness[i]));
    n_members_ += fitness.size();
    before_ = members_;
    return false;
  }
  record_controls(generation, progress);
  select_and_learn(generation, asked, fitness);
  next_ = (next_ + fitness.size()) % members_.size();
  if (next_ != 0) return false;
  std::vector<std::size_t> all(members_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  auto const movement = movement_between(before_, members_, all, bounds, MovementNorm::spread);
  progress.PC = movement.PC;
  progress.FC = movement.FC;
  before_ = members_;
  bool const is_stuck = sweeps_.is_stuck_after(members_.fitness);
  return is_stuck || population_width(std::as_const(members_).members(), bounds) < narrowest;
}

void HistoryStart::record_controls(std::int64_t generation, Progress& progress) const {
  auto const n = static_cast<double>(settings_.batch_size);
  progress.F = progress.CR = 0.0;
  for (std::size_t i = 0; i < settings_.batch_size; ++i) {
    auto const [F, CR] = controls_of(generation, next_ + i);
    progress.F += F / n;
    progress.CR += CR / n;
  }
}

void HistoryStart::select_and_learn(std::int64_t generation, MatrixView<double const> asked,
                                    std::span<double const> fitness) {
  RandomStream leaving(key_, static_cast<std::uint32_t>(generation), std::numeric_limits<std::uint32_t>::max() - 2);
  std::vector<Success> successes;
  for (std::size_t i = 0; i < fitness.size(); ++i) {
    std::size_t const member = next_ + i;
    if (!trial_wins(fitness[i], members_.fitness[member])) continue;
    double const gain = improvement(members_.fitness[member], fitness[i]);
    if (gain > 0.0) {
      successes.push_back({controls_of(generation, member), gain});
      archive_.add(std::as_const(members_).members().row(member), members_.size(), leaving);
    }
    members_.set_member(member, asked.row(i), fitness[i]);
  }
  history_.learn(successes);
}

void HistoryStart::save(OptimiserState& state) const {
  state["members"] = members_.numbers;
  state["members fitness"] = members_.fitness;
  state["members before"] = before_.numbers;
  state["members fitness before"] = before_.fitness;
  state["members, next"] = {static_cast<double>(n_members_), static_cast<double>(next_)};
  state["history"] = history_.numbers();
  state["archive"] = archive_.numbers();
  state["sweeps"] = sweeps_.numbers();
}

void HistoryStart::restore(OptimiserState const& state) {
  std::size_t const n = members_.size(), all = n * members_.dimension;
  auto const& members = state_entry(state, "members", all);
  auto const& fitness = state_entry(state, "members fitness", n);
  auto const& members_before = state_entry(state, "members before", all);
  auto const& fitness_before = state_entry(state, "members fitness before", n);
  auto const& places = state_entry(state, "members, next", 2);
  auto const& history = state_entry(state, "history", SuccessHistory::numbers_of(remembered_batches));
  auto const& archive = state_rows(state, "archive", members_.dimension, 0, n);
  auto const& sweeps = state_rows(state, "sweeps", 1, 1, std::numeric_limits<std::size_t>::max());
  auto const is_place = [&](double place, std::size_t most) {
    return place >= 0.0 && place <= static_cast<double>(most) &&
           std::fmod(place, static_cast<double>(settings_.batch_size)) == 0.0;
  };
  if (!is_place(places[0], n) || !is_place(places[1], n - settings_.batch_size) || !sweeps_.accepts(sweeps))
    throw std::invalid_argument("the saved members are none that a search has");
  // from here on nothing can fail
  members_.numbers = members;
  members_.fitness = fitness;
  before_.numbers = members_before;
  before_.fitness = fitness_before;
  n_members_ = static_cast<std::size_t>(places[0]);
  next_ = static_cast<std::size_t>(places[1]);
  history_.restore(history);
  archive_.restore(archive);
  sweeps_.restore(sweeps);
}

}  // namespace torquescope
