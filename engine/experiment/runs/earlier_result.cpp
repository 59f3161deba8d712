#include "engine/experiment/runs/earlier_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/experiment/runs/earlier_search.hpp"
#include "engine/experiment/runs/last_states.hpp"
#include "engine/experiment/stored_objects.hpp"
#include "engine/fit/optim/optimiser_state.hpp"
#include "engine/store/look_at_result.hpp"

namespace torquescope {
namespace {

void read_all(ResultReader const& reader) {
  static_cast<void>(reader.verify());
  for (auto const& [label, method] : read_earlier_search(reader).methods)
    static_cast<void>(read_last_states(reader, label));
}

std::string line_of(std::string const& label, std::vector<OptimiserState> const& states, std::int64_t runs) {
  std::int64_t least = 0, most = 0, count = 0;
  for (std::size_t run = 0; run < std::min(states.size(), static_cast<std::size_t>(runs)); ++run) {
    if (states[run].empty()) continue;
    std::int64_t const generation = generation_of(states[run]);
    least = count == 0 ? generation : std::min(least, generation);
    most = std::max(most, generation);
    ++count;
  }
  if (count == 0) return fmt::format("{}: {} runs begin anew", label, runs);
  std::string const from = least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
  std::string const others = count == runs ? "" : fmt::format(", {} begin anew", runs - count);
  return fmt::format("{}: {} runs go on from generation {}{}", label, count, from, others);
}

}  // namespace

EarlierResult::EarlierResult(std::filesystem::path const& file, Experiment::Parts const& parts, bool allow_mixed) {
  look_at_result(file, read_all);
  reader_ = std::make_unique<ResultReader const>(file);
  auto const earlier = read_earlier_search(*reader_);
  if (auto problems = reasons_to_begin_anew(earlier, parts, allow_mixed); !problems.empty()) throw Error(problems);
  for (auto const& plan : parts.estimators) {
    if (plan.is_closed_form()) continue;
    auto& states = states_[plan.label];
    if (earlier.methods.contains(plan.label)) states = read_last_states(*reader_, plan.label);
    try {
      lines_.push_back(line_of(plan.label, states, parts.experiment.runs));
    } catch (std::invalid_argument const& reason) {
      throw contradiction(*reader_, "/runs/" + plan.label + "/last_state", reason.what());
    }
  }
}

std::optional<RunPart> EarlierResult::load(std::string const& label, HistoryShape const& shape, std::size_t run) const {
  auto const known = states_.find(label);
  if (known == states_.end() || run >= known->second.size() || known->second[run].empty()) return std::nullopt;
  OptimiserState const& state = known->second[run];
  std::string const group = "/runs/" + label + "/";
  auto const stored = reader_->shape(group + "population");
  auto const generation = static_cast<std::size_t>(generation_of(state));
  bool const fits = stored.size() == 4 && generation < stored[1] && generation <= shape.generations &&
                    stored[3] == shape.parameters && (shape.members == 0 || stored[2] == shape.members);
  if (!fits) throw contradiction(*reader_, group + "population", "its shape is not that of the search");
  // of this run, up to the generation of its state
  auto const rows = [&](std::string const& name, std::size_t width) {
    auto values = reader_->number_rows(group + name, run, 1);
    if (values.size() != stored[1] * width) throw contradiction(*reader_, group + name, "it has another size");
    values.resize((generation + 1) * width);
    return values;
  };
  RunPart part{.run = run, .first = 0, .count = generation + 1};
  auto population = rows("population", stored[2] * stored[3]), fitness = rows("fitness", stored[2]);
  auto const last_fitness = std::span(fitness).last(stored[2]);
  auto const none = std::find_if(last_fitness.begin(), last_fitness.end(), [](double f) { return std::isnan(f); });
  auto const members = static_cast<std::size_t>(none - last_fitness.begin());
  part.state = with_population(state, std::span(population).last(stored[2] * stored[3]).first(members * stored[3]),
                               last_fitness.first(members));
  for (auto const& list : history_lists)
    if (list.width(shape) == 1) part.history.*list.values = rows(list.name, 1);
  if (shape.members > 0) {
    part.history.population = std::move(population);
    part.history.fitness = std::move(fitness);
  }
  part.history.evaluations = reader_->whole_number_rows(group + "evaluations", run, 1);
  if (part.history.evaluations.size() != stored[1])
    throw contradiction(*reader_, group + "evaluations", "it has another size");
  part.history.evaluations.resize(generation + 1);
  return part;
}

}  // namespace torquescope
