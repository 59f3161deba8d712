// Evaluations until a missing effect is found: projected searches against searches in all parameters.
//
// Problems   one planted mismatch per effect and recording (tests/science/projection), baseline of four parameters;
//            left out where the best lies outside the box of the search in all parameters
// Target     residual energy at most 0.1 % above the best known
// Read       median evaluations over the recordings, runs that reached the target within the budget, the median over
//            that of the first method, which is what a diagnosis does, and how far above the best known the worst run
//            ended; `>`: the median run spent the budget, or (methods that end by themselves) ended short of the target
// Bits       the table is the same on every run and for any number of threads; microseconds go to stderr
// Use        bench_evaluations_to_target [EFFECT...]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/parallel.hpp"
#include "science/projection/shape_race.hpp"

namespace torquescope::bench {
namespace {

using namespace torquescope::test;

constexpr std::uint32_t n_recordings = 9;
constexpr std::int64_t most_evaluations = 10'000;
constexpr std::uint64_t seed = 7;
constexpr std::int64_t members_of_shapes = 10;  // as shape_search() has them

struct Case {
  PlantedMismatch planted;
  std::uint32_t number = 0;
  double target = 0.0;
  bool is_in_box = true;  // the search in all parameters can reach it
};

struct Method {
  std::string name;
  std::function<RaceEnd(Case const&)> run;
};

Method projected(std::string const& optimiser) {
  return {"shapes alone, " + optimiser, [optimiser](Case const& problem) {
            return race(optimiser, members_of_shapes, ProjectedEnergy(problem.planted), problem.target,
                        most_evaluations, {seed, problem.number});
          }};
}

Method full(std::string const& optimiser, std::int64_t members) {
  return {fmt::format("all parameters, {} of {}", optimiser, members), [optimiser, members](Case const& problem) {
            return race(optimiser, members, FullEnergy(problem.planted), problem.target, most_evaluations,
                        {seed, problem.number});
          }};
}

Method as_diagnosed(std::string const& name, std::string const& optimiser, int generations) {
  return {name, [optimiser, generations](Case const& problem) {
            ShapeSearch search = shape_search(optimiser, seed + problem.number);
            search.generations = generations;
            return race_as_diagnosed(problem.planted, search, problem.target);
          }};
}

std::vector<Method> methods() {
  int const usual = ShapeSearch{}.generations;
  return {as_diagnosed("grid, de, polish", "de", usual),
          as_diagnosed("grid, fade, polish", "fade", usual),
          as_diagnosed("grid, polish", "de", -1),
          projected("de"),
          projected("fade"),
          projected("jde"),
          projected("jade"),
          full("de", 30),
          full("fade", 30),
          full("jde", 30),
          full("jade", 30)};
}

struct Median {
  double evaluations = 0.0;
  bool is_reached = false;
};

// a run that did not reach the target counts as longer than all that did
Median median_of(std::vector<RaceEnd> ends) {
  std::sort(ends.begin(), ends.end(), [](RaceEnd const& a, RaceEnd const& b) {
    return a.reached != b.reached ? a.reached : a.evaluations < b.evaluations;
  });
  RaceEnd const& middle = ends[ends.size() / 2];
  return {static_cast<double>(middle.evaluations), middle.reached};
}

double worst_excess(std::vector<RaceEnd> const& ends, std::vector<Case> const& cases) {
  double worst = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    worst = std::max(worst, ends[i].best * (1.0 + target_excess) / cases[i].target - 1.0);
  return worst;
}

void print_row(std::string const& effect, Method const& method, std::vector<RaceEnd> const& ends, Median const& first,
               double worst) {
  Median const median = median_of(ends);
  auto const reached = std::count_if(ends.begin(), ends.end(), [](RaceEnd const& end) { return end.reached; });
  char const* const more = median.is_reached ? "" : ">";
  std::string const ratio =
      first.is_reached ? fmt::format("{}{:.1f}", more, median.evaluations / first.evaluations) : "";
  fmt::print("{:<20}{:<28}{:>10}{:>8}/{}{:>9}{:>10.1e}\n", effect, method.name,
             fmt::format("{}{}", more, median.evaluations), reached, ends.size(), ratio, worst);
}

double microseconds(Objective const& objective) {
  constexpr std::size_t times = 50;
  std::vector<double> const candidates(times * objective.dimension(), 0.4);
  std::vector<double> fitness(times);
  Workspace workspace;
  auto const begin = std::chrono::steady_clock::now();
  objective.evaluate({candidates.data(), times, objective.dimension()}, fitness, workspace);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / times;
}

void compare(Effect const& effect, std::vector<std::unique_ptr<CleanStage>> const& stages, int threads) {
  std::vector<Case> cases(stages.size());
  parallel_for(stages.size(), threads, [&](std::size_t i, int) {
    cases[i] = {planted_mismatch(*stages[i], effect), stages[i]->number, 0.0, true};
    BestKnown const best = best_known(cases[i].planted);
    cases[i].target = (1.0 + target_excess) * best.energy;
    for (double const one : FullEnergy(cases[i].planted).best_at(best.shape))
      cases[i].is_in_box = cases[i].is_in_box && one >= 0.0 && one <= 1.0;
  });
  // a race that one side cannot win says nothing
  auto const left_out = std::erase_if(cases, [](Case const& one) { return !one.is_in_box; });
  if (left_out > 0) fmt::print(stderr, "{}: {} best outside the full box, left out\n", effect.name(), left_out);
  auto const rows = methods();
  std::vector<std::vector<RaceEnd>> ends(rows.size(), std::vector<RaceEnd>(cases.size()));
  parallel_for(rows.size() * cases.size(), threads, [&](std::size_t i, int) {
    std::size_t const row = i / cases.size(), column = i % cases.size();
    ends[row][column] = rows[row].run(cases[column]);
  });
  for (std::size_t row = 0; row < rows.size(); ++row)
    print_row(row == 0 ? effect.name() : "", rows[row], ends[row], median_of(ends.front()),
              worst_excess(ends[row], cases));
  std::fflush(stdout);
  FullEnergy const all(cases.front().planted);
  double const alone_us = microseconds(ProjectedEnergy(cases.front().planted)), all_us = microseconds(all);
  fmt::print(stderr, "{}: {} shapes, {} parameters; one evaluation takes {:.0f} us projected, {:.0f} us in all\n",
             effect.name(), effect.n_shape(), all.dimension(), alone_us, all_us);
}

}  // namespace
}  // namespace torquescope::bench

int main(int argc, char** argv) {
  using namespace torquescope;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty())
    names = {"power_law_viscous", "thermal_friction", "presliding", "cogging", "stribeck", "friction_lag", "backlash"};
  for (auto const& name : names)
    if (find_effect(name) == nullptr || find_effect(name)->n_shape() == 0) {
      fmt::print(stderr, "{}: no effect with a shape\n", name);
      return 64;
    }
  int const threads = choose_threads(0).count;
  std::vector<std::unique_ptr<bench::CleanStage>> stages;
  for (std::uint32_t number = 0; number < bench::n_recordings; ++number)
    stages.push_back(std::make_unique<bench::CleanStage>(number, threads));
  fmt::print("{:<20}{:<28}{:>10}{:>10}{:>9}{:>10}\n", "effect", "method", "median", "reached", "ratio", "worst");
  for (auto const& name : names) bench::compare(*find_effect(name), stages, threads);
  return 0;
}
