#pragma once
// What a diagnosis of many recordings says: facts and numbers; text is made of it elsewhere (servo_words.hpp).
//
// Errors     mean absolute, of the position, rad, over all samples of the recordings that a number is about
// Threads    plain records

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/experiment/recording_set.hpp"
#include "engine/infer/decision/servo_spread.hpp"
#include "engine/simulate/rollout/replay.hpp"

namespace torquescope {

struct ServoError {
  std::int64_t recordings = 0, samples = 0;
  double before = 0.0, after = 0.0;
};

struct ServoRow {
  std::string value;  // of the quantity
  ServoError train{}, validate{};
};

// errors by one quantity of the recordings
struct ServoTable {
  std::string quantity;
  std::vector<ServoRow> rows{};
};

enum class ServoNote {
  one_load,        // nothing tells friction of the load from dry friction, but over the angle
  no_scale,        // no known load: torques are in units of the command
  no_validation,   // nothing says how the effects predict
  no_gain,         // the command is the error itself
  always_on,       // viscous friction and back-EMF are one number
  few_recordings,  // one recording alone
  other_gain,      // the recorded command is another multiple of the error; number: of the known one
};

struct ServoRemark {
  ServoNote note{};
  double number = 0.0;
};

struct ServoReport {
  std::string name;
  Verdict verdict = Verdict::insufficient;
  ServoDecision decision{};
  ServoFit fit{};
  std::string command_unit;  // "V", "A", "rad"
  std::vector<LoopNumber> base_numbers{};
  ServoError train{}, validate{};
  std::vector<ServoTable> tables{};
  std::vector<ServoTable> left_out{};  // train: fitted without these recordings; `train` of a row are those left out
  std::vector<ServoRemark> notes{};
  std::vector<SetEntry> entries{};  // of each recording of the replay
  Replay replay{};
};

}  // namespace torquescope
