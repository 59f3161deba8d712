#pragma once
// A signal as it was some time ago: linear between samples, the first value before them.
//
// Memory     the samples of one lag; push() allocates only while these grow in number

#include <deque>

namespace torquescope {

class LaggedSignal {
 public:
  explicit LaggedSignal(double lag_s) : lag_s_(lag_s) {}
  void start(double time_s, double value);
  void push(double time_s, double value);  // later than the last one
  double lagged() const { return lagged_; }

 private:
  struct Sample {
    double time_s, value;
  };
  double lag_s_;
  std::deque<Sample> samples_;
  double lagged_ = 0.0;
};

}  // namespace torquescope
