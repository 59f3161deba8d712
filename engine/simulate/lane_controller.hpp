#pragma once
// A loop controller (loop_controller.hpp) in all lanes: what it remembers of the positions it has read, and its answer.
//
// Threads    one object per group of lanes, used by one thread
// Requires   the controller outlives it

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/simulate/loop_controller.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {

class LaneController {
 public:
  // before the start the joint came along at its first velocity
  LaneController(LoopController const& controller, double start_position, double start_velocity, double rate_hz)
      : controller_(controller), seen_(controller.position.size() * replicate_lanes) {
    for (std::size_t lag = 0; lag < controller.position.size(); ++lag)
      std::fill_n(seen_.data() + lag * replicate_lanes, replicate_lanes,
                  start_position - static_cast<double>(lag + 1) * start_velocity / rate_hz);
  }

  void command(double const* measured, double open, double wanted, double* torque) {
    std::size_t const lags = controller_.position.size();
    newest_ = (newest_ == 0 ? lags : newest_) - 1;
    std::copy_n(measured, replicate_lanes, seen_.data() + newest_ * replicate_lanes);
    alignas(64) double sum[replicate_lanes];
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      summed_error_[lane] += wanted - measured[lane];
      sum[lane] = open + controller_.integral * summed_error_[lane];
    }
    std::size_t place = newest_;
    for (double const gain : controller_.position) {
      double const* const q = seen_.data() + place * replicate_lanes;
      for (std::size_t lane = 0; lane < replicate_lanes; ++lane) sum[lane] += gain * q[lane];
      if (++place == lags) place = 0;
    }
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane)
      torque[lane] = std::clamp(sum[lane], controller_.least, controller_.most);
  }

 private:
  LoopController const& controller_;
  std::vector<double> seen_;  // [lag][lanes], a ring
  std::size_t newest_ = 0;
  double summed_error_[replicate_lanes] = {};
};

}  // namespace torquescope
