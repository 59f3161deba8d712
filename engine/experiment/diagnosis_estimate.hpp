#pragma once
// What a diagnosis will take, told before it begins.
//
// Equation   seconds = joints (a samples fitted in the loop + b samples + c rows replicates) / cores used
//            bytes = d + e samples + f rows replicates
// Shapes     samples: of all recordings at their own rate; fitted: at most the level fitted_samples; rows: of training
//            that a decision looks at
// Accuracy   within a factor of three for one or two effects; every further one repeats the search
// Source     measured: tests/unit/workflows/diagnosis_estimate.cpp has the table
// Threads    plain functions

#include <optional>
#include <string>

#include "engine/experiment/experiment.hpp"

namespace torquescope {

struct DiagnosisSize {
  double samples = 0.0;  // of training
  double rows = 0.0;     // of training, kept
  double replicates = 0.0;
  double validation_samples = 0.0;
  double joints = 1.0;        // one after another
  double most_fitted = 1e99;  // samples that a fit in the loop takes
};
DiagnosisSize diagnosis_size(Experiment::Parts const& parts);

struct DiagnosisEstimate {
  double seconds = 0.0;
  double bytes = 0.0;
};
DiagnosisEstimate estimate_diagnosis(DiagnosisSize const& size, int threads);

// "100 000 rows x 200 replicates: about 3 min and 1.1 GB"
std::string estimate_words(DiagnosisSize const& size, DiagnosisEstimate const& estimate);

// for recordings of many rows
std::optional<std::string> many_rows_warning(Experiment::Parts const& parts);

}  // namespace torquescope
