#pragma once
// The files of a case: train.csv, unseen.csv, robot.toml and job.toml for the engine, truth.json for the scorer.
//
// Errors     std::runtime_error with the path when a file cannot be written

#include <filesystem>

#include "concealed_arms/arm_case.hpp"

namespace concealed_arms {

void write_case(MadeCase const& made, std::filesystem::path const& folder);

}  // namespace concealed_arms
