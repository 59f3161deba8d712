#include "engine/fit/optim/stop_rules.hpp"

#include <algorithm>

#include "engine/fit/optim/population.hpp"

namespace torquescope {

OptionTable<StopRules> const& StopRules::table() {
  constexpr double many = 1e15;
  constexpr double any = std::numeric_limits<double>::infinity();
  static OptionTable<StopRules> const table(
      "stop", "when a search ends; 0 switches a rule off",
      {{"generations", &StopRules::generations, "", 0, 4e9,
        "generations after the initial population; 0 leaves the end to the other rules"},
       {"evaluations", &StopRules::evaluations, "", 0, many, "candidates evaluated, exactly"},
       {"target", &StopRules::target, "", -any, any, "best fitness at or below this value"},
       {"fitness_range", &StopRules::fitness_range, "", 0, any,
        "largest minus smallest fitness of the population at or below this value"},
       {"stagnation", &StopRules::stagnation, "generations", 0, many, "generations without any improvement"},
       {"width", &StopRules::width, "box", 0, 1, "population no wider than this share of the box"},
       {"wall_clock_s", &StopRules::wall_clock_s, "s", 0, any, "time per run"}});
  return table;
}

std::optional<Problem> StopRules::endless(Section const& section) const {
  if (generations > 0 || evaluations > 0 || wall_clock_s > 0.0) return std::nullopt;
  Problem problem;
  problem.what = "generations, evaluations and wall_clock_s are all 0: the search might never end";
  problem.place = section.where("generations");
  problem.key = section.name + ".generations";
  problem.help = "set one of them, for example generations = 100";
  return problem;
}

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::target:
      return "target";
    case StopReason::fitness_range:
      return "fitness_range";
    case StopReason::width:
      return "width";
    case StopReason::stagnation:
      return "stagnation";
    case StopReason::generations:
      return "generations";
    case StopReason::evaluations:
      return "evaluations";
    case StopReason::wall_clock:
      break;
  }
  return "wall_clock";
}

namespace {

// with any member that has no finite fitness the range is infinite, or NaN when none has: neither is small
double range_of(std::span<double const> fitness) {
  auto const [least, most] = std::minmax_element(fitness.begin(), fitness.end());
  return *most - *least;
}

}  // namespace

std::optional<StopReason> reason_to_stop(StopRules const& rules, Optimiser const& search, Bounds const& bounds,
                                         double elapsed_s) {
  auto const& progress = search.progress();
  if (progress.best_fitness <= rules.target) return StopReason::target;
  if (rules.fitness_range > 0.0 && range_of(search.fitness()) <= rules.fitness_range) return StopReason::fitness_range;
  if (rules.width > 0.0 && population_width(search.population(), bounds) <= rules.width) return StopReason::width;
  if (rules.stagnation > 0 && progress.generation - progress.last_improvement >= rules.stagnation) {
    return StopReason::stagnation;
  }
  if (rules.generations > 0 && progress.generation >= rules.generations) return StopReason::generations;
  if (rules.evaluations > 0 && progress.evaluations >= rules.evaluations) return StopReason::evaluations;
  if (rules.wall_clock_s > 0.0 && elapsed_s >= rules.wall_clock_s) return StopReason::wall_clock;
  return std::nullopt;
}

double share_spent(StopRules const& rules, Progress const& progress) {
  auto const share = [](std::int64_t spent, std::int64_t limit) {
    return limit > 0 ? static_cast<double>(spent) / static_cast<double>(limit) : 0.0;
  };
  return std::max(share(progress.evaluations, rules.evaluations), share(progress.generation, rules.generations));
}

std::vector<std::string> stricter_rules(StopRules const& now, StopRules const& before) {
  // 0: no limit
  auto const limits_more = [](std::int64_t limit, std::int64_t limit_before) {
    return limit > 0 && (limit_before == 0 || limit < limit_before);
  };
  std::vector<std::string> keys;
  if (now.target > before.target) keys.emplace_back("target");
  if (now.fitness_range > before.fitness_range) keys.emplace_back("fitness_range");
  if (now.width > before.width) keys.emplace_back("width");
  if (limits_more(now.stagnation, before.stagnation)) keys.emplace_back("stagnation");
  if (limits_more(now.generations, before.generations)) keys.emplace_back("generations");
  if (limits_more(now.evaluations, before.evaluations)) keys.emplace_back("evaluations");
  return keys;
}

std::size_t allowed_rows(StopRules const& rules, Progress const& progress, std::size_t batch_size) {
  if (rules.evaluations <= 0) return batch_size;
  auto const left = std::max<std::int64_t>(0, rules.evaluations - progress.evaluations);
  return std::min(batch_size, static_cast<std::size_t>(left));
}

}  // namespace torquescope
