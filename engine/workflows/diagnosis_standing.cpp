#include "engine/workflows/diagnosis_standing.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string standing_text(DiagnosisStanding const& standing) {
  Json const text = {{"diagnosis", standing.job},   {"inputs_sha256", standing.inputs_sha256},
                     {"shard", standing.shard},     {"shards", standing.shards},
                     {"began", standing.began},     {"told", standing.told},
                     {"stage", standing.stage},     {"counted", standing.counted},
                     {"done", standing.done},       {"total", standing.total},
                     {"seconds", standing.seconds}, {"expected_seconds", standing.expected_seconds}};
  return text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<DiagnosisStanding> standing_of(LockWords const& lock) {
  DiagnosisStanding standing;
  try {
    Json const text = Json::parse(lock.said);
    text.at("diagnosis").get_to(standing.job);
    text.at("inputs_sha256").get_to(standing.inputs_sha256);
    text.at("shard").get_to(standing.shard);
    text.at("shards").get_to(standing.shards);
    text.at("began").get_to(standing.began);
    text.at("told").get_to(standing.told);
    text.at("stage").get_to(standing.stage);
    text.at("counted").get_to(standing.counted);
    text.at("done").get_to(standing.done);
    text.at("total").get_to(standing.total);
    text.at("seconds").get_to(standing.seconds);
    text.at("expected_seconds").get_to(standing.expected_seconds);
  } catch (Json::exception const&) {
    return std::nullopt;  // the lock of a run, or one that was being written
  }
  standing.who = lock.who;
  standing.is_alive = lock.is_alive;
  return standing;
}

std::vector<DiagnosisStanding> standings_in(std::filesystem::path const& segment_folder) {
  std::vector<DiagnosisStanding> found;
  for (auto const& lock : locks_in(segment_folder))
    if (auto standing = standing_of(lock)) found.push_back(std::move(*standing));
  return found;
}

}  // namespace torquescope
