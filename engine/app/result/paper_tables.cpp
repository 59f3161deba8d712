#include "engine/app/result/paper_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"

namespace torquescope {

namespace {

struct PaperColumn {
  char const* kind;  // estimator of ours that belongs beside it
  char const* title;
  std::array<double, 4> parameters;  // Table 3: a1 .. a4
  double mse, standard_deviation;    // Table 4
};

constexpr std::array<PaperColumn, 3> crs_a465{{
    {"ols", "OLS", {0.0036, 0.0164, 0.0089, -0.2582}, 9.259e-2, 2.099},
    {"de", "DE", {0.0037, 0.0143, 0.0594, -0.3060}, 8.872e-2, 1.415},
    {"fade", "FADE", {0.0038, 0.0169, 0.0112, -0.2261}, 5.233e-2, 1.380},
}};

EstimatorSummary const* ours(ResultSummary const& summary, std::string const& kind) {
  for (auto const& estimator : summary.estimators)
    if (estimator.kind == kind) return &estimator;
  return nullptr;
}

std::string four_decimals(double value) { return std::isnan(value) ? "" : fmt::format("{:.4f}", value); }

TextTable comparison() {
  using Align = TextTable::Align;
  return TextTable({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::right},
                   "  ");
}

// `paper` and `own` make the cell of one column
template <class Paper, class Own>
std::vector<std::string> comparison_row(ResultSummary const& summary, std::string const& name, Paper&& paper,
                                        Own&& own) {
  std::vector<std::string> cells{name};
  for (auto const& column : crs_a465) {
    EstimatorSummary const* estimator = ours(summary, column.kind);
    cells.push_back(paper(column));
    cells.push_back(estimator ? own(*estimator) : "");
  }
  return cells;
}

std::vector<std::string> heading() {
  std::vector<std::string> cells{""};
  for (auto const& column : crs_a465) {
    cells.push_back(column.title);
    cells.push_back("ours");
  }
  return cells;
}

}  // namespace

std::string paper_tables(ResultSummary const& summary, Ink const& ink) {
  if (summary.study != "crs_a465" || summary.names.size() != 4) return "";

  TextTable table_3 = comparison();
  table_3.row(heading());
  for (std::size_t i = 0; i < 4; ++i)
    table_3.row(comparison_row(
        summary, printable(summary.names[i]),
        [i](PaperColumn const& column) { return four_decimals(column.parameters[i]); },
        [i](EstimatorSummary const& estimator) { return four_decimals(estimator.parameters_mean.at(i)); }));

  TextTable table_4 = comparison();
  table_4.row(heading());
  table_4.row(comparison_row(
      summary, "MSE", [](PaperColumn const& column) { return fmt::format("{:.5f}", column.mse); },
      [](EstimatorSummary const& estimator) { return fmt::format("{:.5f}", estimator.mse_mean); }));
  table_4.row(comparison_row(
      summary, "std dev", [](PaperColumn const& column) { return fmt::format("{:.3f}", column.standard_deviation); },
      [](EstimatorSummary const& estimator) { return fmt::format("{:.3f}", estimator.residual_std_median); }));

  return ink.bold("Table 3 of the paper beside ours (mean of the runs)") + "\n" + table_3.text(page_width()) +
         ink.bold("Table 4 of the paper beside ours") + "\n" + table_4.text(page_width()) +
         hanging("  ",
                 "A table like the paper's cannot arise: on the data it was fitted to, nothing has a smaller squared "
                 "error than OLS, and no residual spreads wider than the root of its mean square (0.304 for OLS).");
}

}  // namespace torquescope
