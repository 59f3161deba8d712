#pragma once
// Writes a diagnosis into a result file: /diagnosis (RESULT_FORMAT.md), everything a page needs, and the verdict's
// JSON.
//
// Absent     lists without entries are not written; unknown numbers are NaN
// Errors     those of ResultWriter

#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

void write_diagnosis(ResultWriter& writer, Diagnosis const& diagnosis);

}  // namespace torquescope
