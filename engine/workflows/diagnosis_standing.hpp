#pragma once
// How far a diagnosis is: its process writes it into its lock (shard_lock.hpp), and `status` reads it there, while the
// process lives and after it was killed.
//
// Format     one JSON object below the lock's first line; anything else is no diagnosis
// Threads    plain functions

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/store/shard_lock.hpp"

namespace torquescope {

struct DiagnosisStanding {
  std::string who;                 // "process 4711 on node7"
  bool is_alive = false;           // as LockWords
  std::string job, inputs_sha256;  // of the job's text and recordings
  std::int64_t shard = 0, shards = 1;
  std::string began, told;     // UTC
  std::string stage, counted;  // "search", "effects"
  std::int64_t done = 0, total = 0;
  double seconds = 0.0;           // since it began
  double expected_seconds = 0.0;  // of the whole (diagnosis_estimate.hpp); 0: unknown
};

std::string standing_text(DiagnosisStanding const& standing);
std::optional<DiagnosisStanding> standing_of(LockWords const& lock);

// of every process that is at a diagnosis, or was killed at one
std::vector<DiagnosisStanding> standings_in(std::filesystem::path const& segment_folder);

}  // namespace torquescope
