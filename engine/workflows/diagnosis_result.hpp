#pragma once
// The result file around a diagnosis: what the study was about, what was found, how it was made.
//
// Order      a file is made and taken away again before the work begins, so that a folder that cannot be written to is
//            told at once; the result is begun when everything is known, and nothing stands under its final name until
//            everything is in it
// Errors     those of ResultWriter and of find()

#include <functional>

#include "engine/workflows/workflows.hpp"

namespace torquescope {

// writes what find() returns, and returns it
Diagnosis diagnose_into_file(Experiment const& experiment, DiagnoseRequest const& request,
                             std::function<Diagnosis()> const& find);

}  // namespace torquescope
