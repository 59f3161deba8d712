#include "engine/workflows/results/loop_json.hpp"
#include "engine/workflows/results/json_values.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

Json loop_number_json(DecisionAccount::Number const& of) {
  return {{"name", of.name},
          {"unit", of.unit},
          {"value", json_number(of.value)},
          {"ci95", Json::array({json_number(of.lower), json_number(of.upper)})}};
}

Json loop_move_json(DecisionAccount::Move const& move) {
  return {{"name", move.name},
          {"refusal", move.refusal},
          {"gain", json_number(move.gain)},
          {"gain_by_chance", json_number(move.level)},
          {"p", json_number(move.p)},
          {"error_before", json_number(move.before)},
          {"error_after", json_number(move.after)}};
}

Json kept_move_json(DecisionAccount::Move const& move) {
  return {{"name", move.name},
          {"gain", json_number(move.gain)},
          {"p", json_number(move.p)},
          {"numbers", json_list(move.numbers, loop_number_json)},
          {"rivals", move.rivals}};
}

Json rung_json(DecisionAccount::Rung const& rung) {
  return {{"model", rung.model}, {"replicates", rung.replicates}, {"moves", json_list(rung.moves, loop_move_json)}};
}

}  // namespace

nlohmann::ordered_json loop_json(DecisionAccount::Loop const& loop) {
  auto const errors = [](DecisionAccount::Simulated const& of) -> Json {
    return {{"position", json_number(of.position)}, {"torque", json_number(of.torque)}};
  };
  return {{"reason", loop.reason},
          {"decides", loop.decides},
          {"controller", loop.controller},
          {"counts_torque", loop.counts_torque},
          {"loop_error", json_number(loop.loop_error)},
          {"fitted_share", json_number(loop.fitted_share)},
          {"base", {{"train", errors(loop.base_train)}, {"validation", errors(loop.base_validation)}}},
          {"final", {{"train", errors(loop.final_train)}, {"validation", errors(loop.final_validation)}}},
          {"kept", json_list(loop.kept, kept_move_json)},
          {"numbers", json_list(loop.numbers, loop_number_json)},
          {"steps", json_list(loop.steps, rung_json)}};
}

}  // namespace torquescope
