#pragma once
// A diagnosis as the JSON document that programs read: {"schema": 1, ...};
// tests/unit/workflows/diagnosis_json.cpp has all
// keys.
//
// Numbers    unrounded; unknown and infinite ones are null
// Stable     keys never change their meaning within a schema; a new key is a new schema
// Threads    free function

#include <string>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

std::string diagnosis_json(Diagnosis const& diagnosis);

}  // namespace torquescope
