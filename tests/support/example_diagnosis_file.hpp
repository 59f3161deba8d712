#pragma once
// A result file around an INVENTED diagnosis: /job, /model, /data, /provenance and /diagnosis as `torquescope diagnose`
// writes them. Every number in it is made up by a formula.

#include <filesystem>
#include <string>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope::example {

// returns content_sha256
std::string write_diagnosis_file(std::filesystem::path const& name, Diagnosis const& diagnosis);

}  // namespace torquescope::example
