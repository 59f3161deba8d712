#include "engine/infer/decision/decision_words.hpp"

namespace torquescope {

std::string word(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "none";
    case Refusal::chance:
      return "chance";
    case Refusal::smaller:
      return "smaller";
    case Refusal::too_small:
      return "too_small";
    case Refusal::at_bound:
      return "at_bound";
    case Refusal::not_predicted:
      return "not_predicted";
  }
  return {};
}

std::string clause(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return {};
    case Refusal::chance:
      return "replicates of the model without it gain as much";
    case Refusal::smaller:
      return "another effect explains more";
    case Refusal::too_small:
      return "its torque, or what it brings on rows that no fit has seen, is too small";
    case Refusal::at_bound:
      return "its parameters end where they can go no further";
    case Refusal::not_predicted:
      return "rows that no fit has seen are not predicted better";
  }
  return {};
}

std::string word(ReplicateSource source) {
  switch (source) {
    case ReplicateSource::recorded_torque:
      return "recorded_torque";
    case ReplicateSource::tracking_loop:
      return "tracking_loop";
    case ReplicateSource::measured_motion:
      return "measured_motion";
  }
  return {};
}

std::string word(LoopReason reason) {
  switch (reason) {
    case LoopReason::decides:
      return "decides";
    case LoopReason::no_reference:
      return "no_reference";
    case LoopReason::no_controller:
      return "no_controller";
    case LoopReason::diverges:
      return "diverges";
    case LoopReason::predicts_nothing:
      return "predicts_nothing";
  }
  return {};
}

std::string word(MoveRefusal refusal) {
  switch (refusal) {
    case MoveRefusal::none:
      return "none";
    case MoveRefusal::chance:
      return "chance";
    case MoveRefusal::smaller:
      return "smaller";
    case MoveRefusal::failed_fit:
      return "failed_fit";
    case MoveRefusal::at_bound:
      return "at_bound";
    case MoveRefusal::too_small:
      return "too_small";
    case MoveRefusal::not_predicted:
      return "not_predicted";
  }
  return {};
}

}  // namespace torquescope
