#include "engine/fit/problem/regressor_health.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"
#include "engine/fit/problem/row_reduction.hpp"

namespace torquescope {
namespace {

constexpr double worth_a_warning = 0.995, worth_a_remark = 0.95;  // correlations
constexpr double reported_condition = 30.0;
// a column belongs to a weak direction when it holds at least this share of it
constexpr double member_share = 0.2;

// "a", "a and b", "a, b and c"
std::string listed(std::vector<std::string> const& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

// the motion that the given columns need more of
std::string advice(RegressionData const& data, std::vector<std::size_t> const& members) {
  bool position = false, velocity = false, acceleration = false;
  for (auto const member : members) {
    position = position || data.columns[member].needs_position;
    velocity = velocity || data.columns[member].needs_velocity;
    acceleration = acceleration || data.columns[member].needs_acceleration;
  }
  std::vector<std::string> wanted;
  if (velocity) wanted.push_back(data.moves_both_ways() ? "wider speeds" : "motion in both directions");
  if (acceleration) wanted.push_back("stronger accelerations");
  if (position) wanted.push_back("a wider range of positions");
  return listed(wanted) + " would help";
}

double condition(Eigen::VectorXd const& singular_values) {
  double const least = singular_values[singular_values.size() - 1];
  return least > 0.0 ? singular_values[0] / least : std::numeric_limits<double>::infinity();
}

// singular values and right vectors, from the R x R factor of phi = Q R
RightSingular right_svd(ReducedRows const& reduced) { return right_singular(triangular_factor(reduced)); }

// columns that make up the weakest direction
std::vector<std::size_t> weakest_members(Eigen::MatrixXd const& right_vectors) {
  Eigen::VectorXd const direction = right_vectors.col(right_vectors.cols() - 1).cwiseAbs();
  std::vector<std::size_t> members;
  for (Eigen::Index r = 0; r < direction.size(); ++r)
    if (direction[r] >= member_share * direction.maxCoeff()) members.push_back(static_cast<std::size_t>(r));
  return members;
}

std::vector<std::string> names_of(RegressionData const& data, std::vector<std::size_t> const& members) {
  std::vector<std::string> names;
  for (auto const member : members) names.push_back(data.columns[member].name);
  return names;
}

// of pairs that correlate at least so much; trust: how far their values go, before the motion that would help
std::string pair_words(RegressionData const& data, Eigen::MatrixXd const& correlation, double least,
                       std::string const& trust) {
  std::string words;
  for (Eigen::Index i = 0; i < correlation.cols(); ++i) {
    for (Eigen::Index j = i + 1; j < correlation.cols(); ++j) {
      if (std::abs(correlation(i, j)) < least) continue;
      std::vector<std::size_t> const pair{static_cast<std::size_t>(i), static_cast<std::size_t>(j)};
      words += fmt::format("{}{} correlate {:.{}f}: {}{}", words.empty() ? "" : "; ", listed(names_of(data, pair)),
                           correlation(i, j), std::abs(correlation(i, j)) > 0.995 ? 4 : 2, trust, advice(data, pair));
    }
  }
  return words;
}

std::string few_rows_words(RegressionData const& data) {
  return fmt::format("{} samples are too few for {} parameters and their errors", data.rows(), data.parameters());
}

}  // namespace

bool too_few_rows(RegressionData const& data) { return data.rows() <= data.parameters(); }

RegressorHealth regressor_health(RegressionData const& data) {
  return regressor_health(data, too_few_rows(data) ? Reductions{} : reductions_of(data));
}

RegressorHealth regressor_health(RegressionData const& data, Reductions const& reductions) {
  TORQUESCOPE_EXPECT(data.columns.size() == static_cast<std::size_t>(data.phi.cols()));
  RegressorHealth health;
  if (too_few_rows(data)) {
    health.identifiable = false;
    health.condition_number = health.condition_number_raw = std::numeric_limits<double>::infinity();
    health.correlation = Eigen::MatrixXd::Identity(data.parameters(), data.parameters());
    health.words = few_rows_words(data);
    return health;
  }
  health.correlation = reductions.unit_columns.phi.transpose() * reductions.unit_columns.phi;
  auto const svd = right_svd(reductions.unit_columns);
  health.condition_number = condition(svd.values);
  health.condition_number_raw = condition(right_svd(reductions.raw).values);
  health.identifiable = health.condition_number * identifiable_threshold < 1.0;

  health.words =
      pair_words(data, health.correlation, worth_a_warning, "trust what both make together, neither value by itself; ");
  if (health.words.empty() && health.condition_number > reported_condition) {
    auto const members = weakest_members(svd.vectors);
    health.words = fmt::format(
        "{} are nearly dependent (condition number {:.0f}): trust what they make together, no value by itself; {}",
        listed(names_of(data, members)), health.condition_number, advice(data, members));
  }
  if (health.words.empty()) health.remark = pair_words(data, health.correlation, worth_a_remark, "");
  return health;
}

Error not_identifiable(RegressionData const& data) {
  Problem problem{ExitCode::bad_data, ""};
  problem.key = "model.terms";
  if (too_few_rows(data)) {
    problem.what = few_rows_words(data);
    problem.help = "use a longer recording, or a higher filter.decimate_to_hz";
    return Error(std::move(problem));
  }

  auto const lengths = column_lengths(data);
  std::vector<std::size_t> silent;
  for (Eigen::Index r = 0; r < lengths.size(); ++r)
    if (lengths[r] == 0.0) silent.push_back(static_cast<std::size_t>(r));
  auto const members = silent.empty() ? weakest_members(right_svd(reductions_of(data).unit_columns).vectors) : silent;
  auto const names = listed(names_of(data, members));
  problem.what = silent.empty() ? "the recording cannot tell " + names + " apart: they are proportional in this motion"
                                : "the recording never excites " + names + ": the regressor is zero there";
  problem.help = "remove a term, or record again: " + advice(data, members);
  return Error(std::move(problem));
}

}  // namespace torquescope
