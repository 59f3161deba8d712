#pragma once
// Reads the diagnosis of a result file back: what `show`, and `diagnose` of a finished job, print again.
//
// Effect        read_diagnosis() of what write_diagnosis() wrote is the same diagnosis; the axis and unit of a map's
//            region come from its axis
// Errors     those of ResultReader; 65 also when columns that belong together differ in length, or a word is unknown

#include <string>

#include "engine/infer/verdict/diagnosis.hpp"
#include "engine/store/result_reader.hpp"

namespace torquescope {

bool has_diagnosis(ResultReader const& reader);
Diagnosis read_diagnosis(ResultReader const& reader);

// the document as it was written
std::string read_verdict_json(ResultReader const& reader);

}  // namespace torquescope
