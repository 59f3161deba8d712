// Our side of the seed's job without simulation, reading and terminal: DE on a linear problem, with or without storing
// it.
//
// Use        bench_seed_search DATA FITNESS RUNS MEMBERS GENERATIONS THREADS[:TOGETHER] [OUT.h5]
//            DATA: a file of bench/seed_job.py, or random:N:R; FITNESS: in_time, direct, float32, gram
//            TOGETHER: runs side by side; without it as many as `torquescope run` takes
//            ("in_time" keeps every sample where it is; "direct" sorts by the direction of motion where it can)
// Prints     JSON: CPU seconds of setting up (packing, statistics), of the searches, of storing; the median MSE
// Threads    as many as said; CPU seconds are those of the process. Storing is measured in the thread that hands
//            results over; with one thread, what the writing thread takes is added

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "engine/base/heap.hpp"
#include "engine/experiment/runs/optimise.hpp"
#include "engine/experiment/runs/run_scheduler.hpp"
#include "engine/fit/problem/residual_objective.hpp"
#include "engine/fit/problem/single_precision.hpp"
#include "engine/fit/problem/squared_error_floor.hpp"
#include "engine/fit/problem/statistics_objective.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/estimator_writer.hpp"

namespace torquescope::bench {
namespace {

double seconds_of(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Request {
  std::string data, fitness;
  HistoryShape shape;
  int threads = 1;
  std::size_t together = 0;
  std::string output;
};

RegressionData read_file(std::string const& file) {
  std::ifstream stream(file, std::ios::binary);
  std::uint64_t size[2] = {};
  auto const read = [&](auto* numbers, auto count) {
    stream.read(reinterpret_cast<char*>(numbers),
                static_cast<std::streamsize>(static_cast<std::size_t>(count) * sizeof(*numbers)));
  };
  read(size, 2);
  RegressionData data;
  data.phi.resize(static_cast<Eigen::Index>(size[0]), static_cast<Eigen::Index>(size[1]));
  data.tau.resize(static_cast<Eigen::Index>(size[0]));
  read(data.phi.data(), data.phi.size());
  read(data.tau.data(), data.tau.size());
  if (!stream) throw std::runtime_error(file + " is not what bench/seed_job.py writes");
  return data;
}

// "random:N:R": columns uniform in -1 .. 1, parameters 0.1, 0.2, ..., noise a tenth of a column
RegressionData random_data(std::string const& request) {
  std::size_t const colon = request.find(':', 7);
  auto const n = static_cast<Eigen::Index>(std::stod(request.substr(7, colon - 7)));
  auto const R = static_cast<Eigen::Index>(std::stol(request.substr(colon + 1)));
  std::uint64_t state = 88172645463325252U;
  auto const uniform = [&] {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
  };
  RegressionData data;
  data.phi.resize(n, R);
  data.tau.resize(n);
  for (double& x : data.phi.reshaped()) x = uniform();
  for (double& e : data.tau) e = 0.1 * uniform();
  for (Eigen::Index r = 0; r < R; ++r) data.tau += std::fmod(0.1 * static_cast<double>(r + 1), 0.9) * data.phi.col(r);
  return data;
}

RegressionData read_data(Request const& request) {
  if (request.data.starts_with("random:")) return random_data(request.data);
  RegressionData data = read_file(request.data);
  // a trace of another column in each: none takes few values, so nothing is sorted
  if (request.fitness == "in_time")
    for (Eigen::Index c = 1; c < data.phi.cols(); ++c) data.phi.col(c) += 1e-13 * data.phi.col(0);
  return data;
}

std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)> make_de(std::size_t members) {
  Section const section{"estimator", {}, {{"population", static_cast<std::int64_t>(members)}, {"F", 0.8}, {"CR", 0.9}}};
  std::vector<Problem> problems;
  return find_optimiser("de")->prepare(section, {}, problems);
}

struct Fitness {
  std::optional<SufficientStatistics> statistics;
  std::unique_ptr<Objective> objective;
};

Fitness make_fitness(Request const& request, RegressionData const& data, Bounds const& box) {
  Fitness fitness;
  if (request.fitness == "gram") {
    fitness.statistics.emplace(data.phi, data.tau);
    if (!fitness.statistics->usable()) throw std::runtime_error(fitness.statistics->refusal());
    fitness.objective =
        std::make_unique<StatisticsObjective>(*fitness.statistics, static_cast<std::size_t>(data.rows()), box);
  } else if (request.fitness == "float32") {
    fitness.objective = std::make_unique<SinglePrecisionObjective>(data, box);
  } else {
    fitness.objective = std::make_unique<ResidualObjective>(data, box);
  }
  return fitness;
}

int run(Request const& request) {
  RegressionData const data = read_data(request);
  auto const R = static_cast<std::size_t>(data.parameters());
  HistoryShape shape = request.shape;
  shape.parameters = R;
  double const started = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  SquaredErrorFloor const floor(data);
  Bounds const box{std::vector<double>(R, -1.0), std::vector<double>(R, 1.0)};
  Fitness const fitness = make_fitness(request, data, box);
  double const set_up = seconds_of(CLOCK_PROCESS_CPUTIME_ID);

  double storing_s = 0.0;
  auto const timed = [&](auto&& store) {
    double const before = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    store();
    storing_s += seconds_of(CLOCK_THREAD_CPUTIME_ID) - before;
  };
  std::optional<ResultWriter> writer;
  if (!request.output.empty())
    timed([&] {
      writer.emplace(request.output);
      declare_histories(*writer, "de", shape, "N m");
    });

  auto const make_optimiser = make_de(shape.members);
  StopRules rules;
  rules.generations = static_cast<std::int64_t>(shape.generations);
  SearchSetting const setting{*fitness.objective, rules, 1.0,
                              [&](std::span<double const> candidate) { return floor.gap(candidate); }};
  std::vector<double> mse;
  schedule_runs(
      shape.runs, request.threads,
      request.together > 0 ? request.together : runs_side_by_side(*fitness.objective, rules, shape.members),
      [&](std::size_t first, std::size_t count, int team) {
        std::vector<RunStart> starts;
        for (std::size_t index = first; index < first + count; ++index)
          starts.push_back({make_optimiser(box, {1, static_cast<std::uint32_t>(index)})});
        std::vector<Workspace> workspaces;
        return optimise(std::move(starts), setting, team, workspaces);
      },
      [&](std::size_t index, RunHistory&& found) {
        auto const history = std::make_shared<RunHistory const>(std::move(found));
        mse.push_back(history->best.back());
        if (writer) timed([&] { write_history(*writer, "de", index, history); });
      });
  if (writer)
    timed([&] {
      // what the dimensions of the histories are named by
      write_index(*writer, "/runs/de", "run", shape.runs);
      std::vector<std::string> names;
      for (std::size_t k = 0; k < R; ++k) names.push_back("parameter_" + std::to_string(k));
      write_names(*writer, "/runs/de", "parameter", names);
      writer->finish();
    });
  writer.reset();
  // nothing else has a thread of its own then
  if (request.threads == 1) storing_s += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - seconds_of(CLOCK_THREAD_CPUTIME_ID);
  double const ended = seconds_of(CLOCK_PROCESS_CPUTIME_ID);

  std::sort(mse.begin(), mse.end());
  std::printf("{\"setup_s\": %.9g, \"search_s\": %.9g, \"storing_s\": %.9g, \"mse\": %.17g}\n", set_up - started,
              ended - set_up - storing_s, storing_s, mse[mse.size() / 2]);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace torquescope::bench

int main(int argc, char** argv) try {
  if (argc != 7 && argc != 8) {
    std::fprintf(stderr, "bench_seed_search DATA FITNESS RUNS MEMBERS GENERATIONS THREADS[:TOGETHER] [OUT.h5]\n");
    return 64;
  }
  torquescope::prepare_heap();  // as `torquescope run` does
  auto const count = [&](int i) { return static_cast<std::size_t>(std::stoul(argv[i])); };
  char const* const colon = std::strchr(argv[6], ':');
  std::size_t const together = colon ? std::stoul(colon + 1) : 0;
  return torquescope::bench::run({argv[1],
                                  argv[2],
                                  {.runs = count(3), .generations = count(5), .members = count(4)},
                                  static_cast<int>(count(6)),
                                  together,
                                  argc == 8 ? argv[7] : ""});
} catch (std::exception const& error) {
  std::fprintf(stderr, "bench_seed_search: %s\n", error.what());
  return EXIT_FAILURE;
}
