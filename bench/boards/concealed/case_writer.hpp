#pragma once
// The files of one case: FOLDER/train.csv, validate.csv, job.toml for the engine, truth.json for the scorer alone.
//
// Seal       SHA-256 of truth.json, returned and printed: a truth changed afterwards shows
// Bytes      the same for the same case on the same machine
// Errors     std::runtime_error: a file cannot be written

#include <filesystem>
#include <string>

#include "concealed/case_report.hpp"

namespace concealed {

std::string truth_text(Case const& one_case, CaseReport const& report);
// every word the truths may use for effects, families, parameters, units and axes, whatever the case
std::string words_text();
std::string job_text(Case const& one_case);

// writes the four files and returns the seal
std::string write_case(Case const& one_case, CaseReport const& report, std::filesystem::path const& folder);

}  // namespace concealed
