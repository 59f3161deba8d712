#include "engine/fit/excite/excitation_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/base/parallel.hpp"
#include "engine/fit/excite/motion_space.hpp"
#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

constexpr double too_near = 1e6;               // beyond any logarithm of a condition or a determinant
constexpr Index samples_per_harmonic = 16;     // of the rows that are judged
constexpr Index fine_per_harmonic = 64;        // where an effect may act at the lowest speeds alone
constexpr Index clearances_per_harmonic = 64;  // of the shortest period

struct Judge {
  SerialChain const& chain;
  RowModel const& model;
  ExciteCriterion criterion;
  ClearanceLimits clearance;
  MotionSpace space;
  FourierTable rows, places;

  MotionQuality quality(std::span<double const> point) const {
    return motion_quality(model, samples_of(space.motion(point), rows));
  }

  double lack(std::span<double const> point) const {
    if (!clearance.are_any()) return 0.0;
    auto const samples = samples_of(space.motion(point), places);
    double lack = 0.0;
    for (Index i = 0; i < samples.q.rows(); ++i)
      lack = std::max(lack, clearance_lack(chain, clearance, samples.q.row(i).transpose()));
    return lack;
  }

  double fitness(std::span<double const> point) const {
    if (double const near = lack(point); near > 0.0) return too_near * (1.0 + near);
    auto const found = quality(point);
    // an angle of 0: nothing tells the two apart, and no motion near it may be any better
    if (criterion == ExciteCriterion::angle)
      return found.angle > 0.0 ? -found.angle : std::numeric_limits<double>::infinity();
    return criterion == ExciteCriterion::condition ? std::log10(found.condition) : -found.log_determinant;
  }
};

std::unique_ptr<Optimiser> optimiser_of(ExciteOptions const& options, Bounds const& bounds, std::uint64_t seed) {
  std::vector<Problem> problems;
  auto const make = find_optimiser(options.optimiser)->prepare({"excite", {}, {}}, {}, problems);
  if (!problems.empty()) throw Error(std::move(problems));
  return make(bounds, {seed, 0, RandomDomain::optimiser});
}

void evaluate(Judge const& judge, MatrixView<double const> candidates, std::span<double> fitness, int threads) {
  parallel_for(candidates.rows(), threads, [&](std::size_t i, int) { fitness[i] = judge.fitness(candidates.row(i)); });
}

// the member in the middle of a generation, by fitness
std::size_t middle_member(std::span<double const> fitness) {
  std::vector<std::size_t> order(fitness.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return fitness[a] < fitness[b]; });
  return order[order.size() / 2];
}

void refuse_useless(double fitness) {
  validate(fitness < too_near, [&] {
    Problem problem;
    problem.key = "excite";
    if (std::isfinite(fitness)) {
      problem.what = "no motion was found that stays clear of the table and of the arm itself";
      problem.help = "lower floor_m, clearance_m or position_share, or raise evaluations";
    } else {
      problem.what = "no motion tells all parameters apart";
      problem.help = "torquescope describe ROBOT.toml shows what can be told; take terms out of friction";
    }
    return problem;
  });
}

}  // namespace

Eigen::VectorXd torque_noise(SerialChain const& chain, ExciteOptions const& options) {
  Index const n = chain.size();
  if (!options.torque_noise.empty()) return Eigen::Map<Eigen::VectorXd const>(options.torque_noise.data(), n);
  Eigen::VectorXd noise(n);
  for (Index j = 0; j < n; ++j) noise[j] = 0.01 * chain.joints[static_cast<std::size_t>(j)].max_torque;
  return noise.allFinite() ? noise : Eigen::VectorXd::Ones(n);
}

ExcitingMotion search_excitation(SerialChain const& chain, RowModel const& model, ExciteOptions const& options,
                                 std::uint64_t seed, int threads) {
  Index const harmonics = options.harmonics;
  Judge const judge{
      chain,
      model,
      criterion_of(options),
      {options.floor_m, options.clearance_m},
      {chain, {options.position_share, options.speed_share, options.acceleration_share}, harmonics, options.period_s},
      {(options.separate.empty() ? samples_per_harmonic : fine_per_harmonic) * harmonics, harmonics},
      {clearances_per_harmonic * harmonics, harmonics}};
  auto const search = optimiser_of(options, judge.space.bounds(), seed);
  ExcitingMotion found;
  std::vector<double> numbers, fitness;
  while (search->progress().evaluations < options.evaluations) {
    std::size_t const members = search->batch_size();
    numbers.resize(members * search->dimension());
    fitness.resize(members);
    MatrixView<double> const candidates(numbers.data(), members, search->dimension());
    search->ask(candidates);
    auto const left = static_cast<std::size_t>(options.evaluations - search->progress().evaluations);
    MatrixView<double const> const asked(numbers.data(), std::min(members, left), search->dimension());
    std::span<double> const told(fitness.data(), asked.rows());
    evaluate(judge, asked, told, threads);
    if (search->progress().evaluations == 0) found.usual = judge.quality(asked.row(middle_member(told)));
    search->tell(asked, told);
  }
  auto const& progress = search->progress();
  refuse_useless(progress.best_fitness);
  found.motion = judge.space.motion(progress.best);
  found.best = judge.quality(progress.best);
  found.evaluations = progress.evaluations;
  return found;
}

}  // namespace torquescope
