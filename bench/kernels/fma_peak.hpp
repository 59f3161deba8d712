#pragma once
// The ceiling of this machine at this moment: fused multiply-adds of doubles per second of one thread.
//
// Runs on    the instruction set the kernels run on (kernels/dispatch.hpp); meaningless where it has no FMA
// Method     as many independent accumulators as registers hold, nothing but FMA in the loop; thread CPU time

namespace torquescope::bench {

// seconds of CPU time this thread has used
double thread_cpu_seconds();

// a mean rate, measured bit by bit between turns of something else
class FmaRate {
 public:
  // adds bursts of some 0.2 ms until `seconds` have passed
  void measure_for(double seconds);
  double per_second() const { return count_ / seconds_; }

 private:
  double count_ = 0.0;
  double seconds_ = 0.0;
};

}  // namespace torquescope::bench
