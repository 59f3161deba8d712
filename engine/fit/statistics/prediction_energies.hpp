#pragma once
// How well a recording, or a replicate of it, is predicted without and with an effect, or with all that was named.
//
// Energies   of residuals, summed over rows and recordings
// Share      of the effect's torque, how much is there: 1 of a right one, 0 of one that has nothing to do with
//            the recording, NaN or infinite of one that adds none
// Threads    plain record

#include <cstddef>
#include <vector>

namespace torquescope {

struct PredictionEnergies {
  double before = 0.0, after = 0.0;
  double moved = 0.0;  // of the difference between both predictions

  double gain() const { return before - after; }  // negative: the effect spoils the prediction
  double share() const { return 0.5 * (1.0 + gain() / moved); }
  PredictionEnergies& operator+=(PredictionEnergies const& other) {
    before += other.before;
    after += other.after;
    moved += other.moved;
    return *this;
  }
};

}  // namespace torquescope
