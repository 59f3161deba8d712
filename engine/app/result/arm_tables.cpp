#include "engine/app/result/arm_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/app/result/result_tables.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"

namespace torquescope {
namespace {

std::string in_percent(double share) { return std::isnan(share) ? "" : fmt::format("{:.3g}", 100.0 * share); }

std::string in_percent_of(std::vector<double> const& shares, std::size_t joint) {
  return joint < shares.size() ? in_percent(shares[joint]) : "";
}

// of some estimators, as many as fit on a page
std::string block_text(ResultSummary const& summary, std::vector<EstimatorSummary const*> const& estimators,
                       Ink const& ink) {
  using Align = TextTable::Align;
  std::vector<Align> columns{Align::left};
  std::vector<std::string> heading{"error, %"};
  for (auto const* estimator : estimators) {
    columns.push_back(Align::right);
    heading.push_back(column_title(*estimator) + " train");
    if (!summary.has_validation) continue;
    columns.push_back(Align::right);
    heading.push_back("validation");
  }
  columns.push_back(Align::left);
  TextTable table(columns, "  ");
  table.row(heading);
  auto const add = [&](std::string const& name, auto const& train, auto const& validation) {
    std::vector<std::string> cells{name};
    for (auto const* estimator : estimators) {
      cells.push_back(train(*estimator));
      if (summary.has_validation) cells.push_back(validation(*estimator));
    }
    table.row(cells);
  };
  for (std::size_t j = 0; j < summary.arm->joints.size(); ++j)
    add(
        fmt::format("{} {}", j + 1, printable(summary.arm->joints[j])),
        [j](EstimatorSummary const& e) { return in_percent_of(e.joint_relerr, j); },
        [j](EstimatorSummary const& e) { return in_percent_of(e.validation_joint_relerr, j); });
  add(
      "arm", [](EstimatorSummary const& e) { return in_percent(e.relerr_median); },
      [](EstimatorSummary const& e) { return in_percent(e.validation_relerr_median); });
  add(
      "arm, all rows", [](EstimatorSummary const& e) { return in_percent(e.relerr_all_rows); },
      [](EstimatorSummary const& e) { return in_percent(e.validation_relerr_all_rows); });
  std::string const text = table.text(page_width());
  auto const end = text.find('\n');
  return ink.bold(text.substr(0, end)) + text.substr(end);
}

}  // namespace

std::vector<std::string> unexplained_joints(ResultSummary const& summary) {
  constexpr double half = 0.5;
  std::vector<std::string> sentences;
  if (!summary.arm) return sentences;
  for (std::size_t j = 0; j < summary.arm->joints.size(); ++j) {
    double least = std::numeric_limits<double>::infinity();
    for (auto const& estimator : summary.estimators) {
      auto const& errors = summary.has_validation ? estimator.validation_joint_relerr : estimator.joint_relerr;
      if (j < errors.size() && errors[j] < least) least = errors[j];
    }
    if (!std::isfinite(least) || least <= half) continue;
    sentences.push_back(fmt::format(
        "joint {} ({}): no fit explains its torque, the error is {:.3g} %{}, and no other sign, order, zero or unit "
        "that the check tries mends it: look at its columns, at their timing, and whether it moves enough",
        j + 1, summary.arm->joints[j], 100.0 * least, summary.has_validation ? " on validation rows" : ""));
  }
  return sentences;
}

std::string joint_error_table(ResultSummary const& summary, Ink const& ink) {
  constexpr std::size_t most_together = 3;
  std::string text;
  for (std::size_t begin = 0; begin < summary.estimators.size(); begin += most_together) {
    std::vector<EstimatorSummary const*> some;
    for (std::size_t k = begin; k < std::min(begin + most_together, summary.estimators.size()); ++k)
      some.push_back(&summary.estimators[k]);
    text += (begin ? "\n" : "") + block_text(summary, some, ink);
  }
  return text + hanging("  ",
                        "rows where the joint moves one way, or all: near a reversal friction is more than a "
                        "Coulomb step");
}

}  // namespace torquescope
