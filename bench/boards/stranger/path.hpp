#pragma once
// The path a rig is asked to follow, sample by sample of its control loop: moves, rests, waves, one after the other.
#include <string>
#include <vector>

#include "stranger/chance.hpp"
#include "stranger/rig.hpp"

namespace stranger {

class Path {
 public:
  Path(double tick_s, double start) : tick_s_{tick_s}, positions_{start} {}
  double now() const { return tick_s_ * static_cast<double>(positions_.size()); }
  double here() const { return positions_.back(); }

  void rest(double duration_s);
  void trapezoid(double to, double speed, double acceleration);
  void min_jerk(double to, double duration_s);
  // sum of sines about here, faded in and out
  void multisine(Chance& chance, double duration_s, double reach, double top_speed, double from_hz, double to_hz);
  // one sine whose frequency rises (or falls); its speed stays within the limit
  void chirp(double duration_s, double reach, double top_speed, double from_hz, double to_hz);
  std::vector<double> const& positions() const { return positions_; }

 private:
  double tick_s_;
  std::vector<double> positions_;
};

// kinds: multisine trapezoids chirp pick_place irregular creep micro mixed one_speed narrow
std::vector<double> make_path(std::string const& kind, Rig const& rig, double tick_s, double duration_s, Chance chance);

}  // namespace stranger
