#pragma once
// What an encoder shows of a position: the nearest of its steps.
//
// Error      at most half a step; none when the step is 0
// Units      rad or m

#include "engine/base/options.hpp"

namespace torquescope {

struct EncoderOptions {
  double counts_per_revolution = 0.0;
  double step = 0.0;

  static OptionTable<EncoderOptions> const& table();
};

class Encoder {
 public:
  explicit Encoder(EncoderOptions const& options);
  double step() const { return step_; }  // 0: exact
  double read(double position) const;

 private:
  double step_;
};

}  // namespace torquescope
