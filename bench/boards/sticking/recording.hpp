#pragma once
// A joint moves in its loop: what its drive logs, and what only the plant knows.

#include <vector>

#include "sticking/hidden_effect.hpp"
#include "sticking/rig.hpp"

namespace sticking {

struct Row {  // of the log, without the noise of the torque
  double reference = 0.0, position = 0.0, torque = 0.0;
};

struct Mean {                              // over the period that begins with a row
  double acceleration = 0.0, speed = 0.0;  // of the true motion
  double sliding = 0.0;                    // dry friction over its level
  double sine = 0.0, cosine = 0.0;         // of the position
  double given = 0.0;                      // torque of the drive
  double effect = 0.0;                     // of the hidden effect, per unit of amplitude
  double lag = 0.0;                        // command less given torque
  double sticking = 0.0;                   // dry friction less its level times the sign of the speed
};

struct Recording {
  std::vector<Row> rows;
  std::vector<Mean> means;
  std::vector<double> channel;  // of the torque column, without delay or noise, every step_s
  double tracking_error = 0.0;  // rms of position less reference over the standard deviation of the reference
  double chatter = 0.0;         // rms of the difference of rows that follow each other, over the rms, of the torque
};

// reference: at every tick of the controller; effect: null for none
Recording record(Rig const& rig, std::vector<double> const& reference, HiddenEffect const* effect);

// What a torque column that is late adds to each row's mean
std::vector<double> late_part(Recording const& recording, double delay_s, double log_hz);

// rms that the joint's own model leaves of `part` when it is fitted anew, over the torque's rms. Of rows that move:
// at rest dry friction takes over whatever there is
double relative_size(Recording const& recording, std::vector<double> part, bool has_gravity);
double relative_size(Recording const& recording, double Mean::*part, bool has_gravity);
double torque_rms(Recording const& recording);  // of rows that move

}  // namespace sticking
