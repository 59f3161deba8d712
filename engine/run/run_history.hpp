#pragma once
// Everything one run of a population method leaves behind: what RESULT_FORMAT.md stores under /runs/<estimator>.
//
// Shapes     G + 1 entries per list (generation 0 is the initial population), NP x R numbers per population; entries
//            after the run has stopped are NaN (evaluations: the last count)
// Threads    plain record of one run

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace torquescope {

struct RunHistory {
  RunHistory(std::size_t generations, std::size_t members, std::size_t dimension)
      : population((generations + 1) * members * dimension, not_a_number),
        fitness((generations + 1) * members, not_a_number),
        F(generations + 1, not_a_number),
        CR(generations + 1, not_a_number),
        PC(generations + 1, not_a_number),
        FC(generations + 1, not_a_number),
        best(generations + 1, not_a_number),
        gap(generations + 1, not_a_number),
        evaluations(generations + 1, 0) {}

  std::vector<double> population;
  std::vector<double> fitness;
  std::vector<double> F, CR, PC, FC;
  std::vector<double> best;  // best fitness so far, as MSE
  std::vector<double> gap;   // best minus the OLS floor, as MSE
  std::vector<std::int64_t> evaluations;

  std::vector<double> parameters;  // the best candidate
  std::string stop_reason;
  std::int64_t nonfinite = 0;  // candidates without finite fitness

 private:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace torquescope
