// Evaluations until an identification criterion is within 0.1 % of the best known: every optimiser on drawn problems.
//
// Usage      bench_identification_evaluations <first instance> <instances> [optimiser[:key=value[,key=value]...]]...
// Budget     20 000 evaluations; best known: of the truth and two long searches by CMA-ES from there
// Read       reached of N, median evaluations, and expected running time: all evaluations over the number reached
//            (Hansen et al., COCO: a platform, doi:10.1080/10556788.2020.1808977)

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/parallel.hpp"
#include "identification_problems.hpp"
#include "support/landscapes.hpp"
#include "word_settings.hpp"

namespace {

using namespace torquescope;

constexpr std::int64_t budget = 20000;
constexpr std::int64_t long_search = 8000;
constexpr double target_excess = 1e-3;

std::vector<Setting> const no_limit{{"generations", std::int64_t{0}}, {"evaluations", budget}};

double best_known(bench::IdentificationProblem const& problem) {
  double best = problem.criterion(problem.truth);
  for (std::uint32_t run = 0; run < 2; ++run) {
    auto const search = testing::make_optimiser("cmaes", testing::cube(problem.dimension, 0.0, 1.0), {1, run},
                                                {{"sigma", 0.02}, {"restarts", std::string("same")}});
    search->start_at(problem.truth);
    testing::evaluations_to_target(*search, problem.criterion, 0.0, long_search);
    best = std::min(best, search->progress().best_fitness);
  }
  return best;
}

struct Method {
  std::string word, name;
  std::vector<Setting> settings;
};

Method method_of(std::string const& word) {
  auto const colon = word.find(':');
  Method method{word, word.substr(0, colon), no_limit};
  if (colon == std::string::npos) return method;
  std::string rest = word.substr(colon + 1);
  for (std::size_t begin = 0; begin < rest.size();) {
    auto const end = std::min(rest.find(',', begin), rest.size());
    method.settings.push_back(bench::setting_of(rest.substr(begin, end - begin)));
    begin = end + 1;
  }
  return method;
}

void compare(std::string const& name, std::uint32_t first, std::uint32_t instances,
             std::vector<Method> const& methods) {
  int const threads = choose_threads(0).count;
  std::vector<bench::IdentificationProblem> problems(instances);
  std::vector<double> targets(instances);
  parallel_for(instances, threads, [&](std::size_t i, int) {
    problems[i] = bench::identification_problem(name, first + static_cast<std::uint32_t>(i));
    targets[i] = (1.0 + target_excess) * best_known(problems[i]);
  });
  std::vector<std::vector<std::int64_t>> spent(methods.size(), std::vector<std::int64_t>(instances));
  parallel_for(methods.size() * instances, threads, [&](std::size_t k, int) {
    std::size_t const m = k / instances, i = k % instances;
    auto const search = testing::make_optimiser(methods[m].name, testing::cube(problems[i].dimension, 0.0, 1.0),
                                                {57, first + static_cast<std::uint32_t>(i)}, methods[m].settings);
    spent[m][i] = testing::evaluations_to_target(*search, problems[i].criterion, targets[i], budget);
  });
  for (std::size_t m = 0; m < methods.size(); ++m)
    fmt::print("{:<10}{:<44}{}\n", m == 0 ? name : "", methods[m].word, bench::summary_of(spent[m], budget));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> const words(argv + 1, argv + argc);
  if (words.size() < 2) {
    fmt::print(stderr, "bench_identification_evaluations <first instance> <instances> [optimiser[:key=value]]...\n");
    return 64;
  }
  std::vector<Method> methods;
  for (std::size_t i = 2; i < words.size(); ++i) methods.push_back(method_of(words[i]));
  if (methods.empty())
    for (auto const& choice : optimiser_choices()) methods.push_back(method_of(choice.name));
  for (auto const& name : bench::identification_names())
    compare(name, static_cast<std::uint32_t>(std::stoul(words[0])), static_cast<std::uint32_t>(std::stoul(words[1])),
            methods);
}
