#pragma once
// A case: which rig moves how, what looks at it, and what is concealed.
#include <string>
#include <vector>

#include "stranger/drive.hpp"
#include "stranger/effect.hpp"

namespace stranger {

enum class PositionWord { si, degrees, counts };
enum class TorqueWord { si, amperes, permille };
enum class TimeWord { seconds, epoch, none };

struct Instruments {
  double log_hz = 1000;
  double counts_per_unit = 20861;  // encoder lines per rad or m
  double white = 0.006;            // noise of the torque channel, as a share of the rig's typical torque
  double coloured = 0.004;         // torque from outside, low-passed noise; the same share
  double coloured_hz = 8;
  bool mean_torque = false;  // the logger averages the torque since its last sample
  bool reference = true;
  bool velocity = false;  // a tachometer's column
  PositionWord position = PositionWord::si;
  TorqueWord torque = TorqueWord::si;
  TimeWord time = TimeWord::seconds;
};

struct Pipeline {  // [filter] of the job
  double cutoff_hz = 40, parallel_cutoff_hz = 20, decimate_to_hz = 100;
};

struct Place {       // where the concealed acts
  std::string axis;  // velocity position time
  double from = 0, to = 0;
};

struct Case {
  std::string name;
  std::string kind;  // clean single pair outside weak
  std::string rig;
  LoopDesign loop;
  std::string train_motion, validation_motion;
  double train_s = 30, validation_s = 20;
  Instruments instruments;
  Pipeline pipeline;
  std::vector<ConcealedLaw> laws;
  std::vector<Place> places;            // one per law, axis empty: everywhere
  std::vector<std::string> acceptable;  // names that an expert could give without being wrong
};

std::vector<Case> const& all_cases();

}  // namespace stranger
