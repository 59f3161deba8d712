#pragma once
// A result file as tables of at most 80 columns: the same text after `run` and in `show`.

#include <string>

#include "engine/app/result/result_summary.hpp"
#include "engine/app/terminal/colour.hpp"

namespace torquescope {

// parameters by estimator, errors, gap to least squares; then "61 runs, 183 000 evaluations, 4.2 s"
std::string result_table(ResultSummary const& summary, Ink const& ink);

// one line or two per estimator: median, quartiles, best, worst of the MSE and why the runs ended
std::string estimator_lines(ResultSummary const& summary, Ink const& ink);

// what `check` would warn of: stands above every table; "" where there is nothing
std::string warning_lines(ResultSummary const& summary, Ink const& ink);

// job, data and machine: how the file was made
std::string origin_lines(ResultSummary const& summary, Ink const& ink);

// "OLS" for an estimator named after its kind, else its label
std::string column_title(EstimatorSummary const& estimator);

}  // namespace torquescope
