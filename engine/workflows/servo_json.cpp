#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/diagnose/decision_account.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"
#include "engine/workflows/results/json_values.hpp"
#include "engine/workflows/results/loop_json.hpp"
#include "engine/workflows/servo_words.hpp"
#include "engine/workflows/servo_workflow.hpp"

namespace torquescope {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(LoopNumber const& of) {
  return {{"name", name_of_number(of)},
          {"unit", of.unit},
          {"value", json_number(of.value)},
          {"ci95", Json::array({json_number(of.lower), json_number(of.upper)})}};
}

Json numbers_json(std::vector<LoopNumber> const& numbers) {
  Json all = Json::array();
  for (auto const& one : numbers) all.push_back(number_json(one));
  return all;
}

Json error_json(ServoError const& error) {
  return {{"recordings", error.recordings},
          {"samples", error.samples},
          {"before", error.recordings > 0 ? json_number(error.before) : Json(nullptr)},
          {"after", error.recordings > 0 ? json_number(error.after) : Json(nullptr)}};
}

Json kept_json(KeptMove const& move) {
  bool const is_drive = move.subject.is_of_command();
  DriveEffect const* const effect = is_drive ? &drive_effect_of(move.subject.key) : nullptr;
  Json rivals = Json::array();
  for (auto const& rival : move.rivals) rivals.push_back(name_of(rival));
  return {{"name", name_of(move.subject)},
          {"title", is_drive ? effect->title : move.subject.effect->title()},
          {"equation", is_drive ? effect->equation : move.subject.effect->equation()},
          {"not_told_from", is_drive ? effect->confused : ""},
          {"gain", json_number(move.gain)},
          {"p", json_number(move.p)},
          {"parameters", numbers_json(move.numbers)},
          {"rivals", std::move(rivals)}};
}

Json table_json(ServoTable const& table, bool is_left_out) {
  Json rows = Json::array();
  for (auto const& row : table.rows) {
    Json one = {{"value", row.value}};
    if (is_left_out) {
      one["left_out"] = error_json(row.train);
    } else {
      one["train"] = error_json(row.train);
      one["validate"] = error_json(row.validate);
    }
    rows.push_back(std::move(one));
  }
  return {{"quantity", table.quantity}, {"rows", std::move(rows)}};
}

Json recording_json(SetEntry const& entry, RecordingReplay const& replay, Replay const& all) {
  Json quantities = Json::object();
  for (auto const& [name, value] : entry.numbers) quantities[name] = json_number(value);
  for (auto const& [name, value] : entry.words) quantities[name] = value;
  auto const& errors = replay.channels[0].errors;
  return {{"name", entry.name},
          {"role", entry.is_validation ? "validate" : "train"},
          {"quantities", std::move(quantities)},
          {"samples", errors.front().samples},
          {"before", json_number(errors[all.before].mae)},
          {"after", json_number(errors[all.after].mae)},
          {"relerr_before", json_number(errors[all.before].relerr)},
          {"relerr_after", json_number(errors[all.after].relerr)},
          {"horizon_s", json_number(replay.horizon_s)}};
}

}  // namespace

namespace {

// numbers of the drive and the gear that the job gives: known, and not fitted
Json given_json(LoopSetting const& loop) {
  Json given = Json::object();
  for (std::size_t k = 0; k < loop_keys; ++k) {
    auto const key = static_cast<LoopKey>(k);
    bool const is_free = std::find(loop.free.begin(), loop.free.end(), key) != loop.free.end();
    if (!is_free && loop.values[key] != facts_of(key).none) given[facts_of(key).name] = json_number(loop.values[key]);
  }
  return given;
}

}  // namespace

std::string servo_json(ServoReport const& report) {
  Json kept = Json::array(), tables = Json::array(), left_out = Json::array(), recordings = Json::array();
  Json notes = Json::array();
  for (auto const& move : report.decision.facts.kept) kept.push_back(kept_json(move));
  for (auto const& table : report.tables) tables.push_back(table_json(table, false));
  for (auto const& table : report.left_out) left_out.push_back(table_json(table, true));
  for (std::size_t k = 0; k < report.replay.recordings.size(); ++k)
    recordings.push_back(recording_json(report.entries[k], report.replay.recordings[k], report.replay));
  for (auto const& remark : report.notes) notes.push_back({{"note", word(remark.note)}, {"text", sentence_of(remark)}});
  Json const document = {
      {"schema", 1},
      {"kind", "servo"},
      {"name", report.name},
      {"verdict", word(report.verdict)},
      {"headline", headline(report)},
      {"error", {{"unit", "rad"}, {"train", error_json(report.train)}, {"validate", error_json(report.validate)}}},
      {"command_unit", report.command_unit},
      {"adequacy",
       {{"left_rms", json_number(report.fit.left_rms)},
        {"replicates_rms", json_number(report.fit.replicates_rms)},
        {"encoder_step", json_number(report.fit.encoder_step)}}},
      {"kept", std::move(kept)},
      {"parameters", numbers_json(report.decision.facts.numbers)},
      {"parameters_before", numbers_json(report.base_numbers)},
      {"given", given_json(report.decision.final.point.loop)},
      {"notes", std::move(notes)},
      {"tables", std::move(tables)},
      {"left_out", std::move(left_out)},
      {"recordings", std::move(recordings)},
      {"loop", loop_json(account_of(report.decision.facts))}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
