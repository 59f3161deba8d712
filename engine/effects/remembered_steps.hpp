#pragma once
// What a state computes from the length of a step, kept for the last few lengths.
//
// Why        the times of a recording are rounded: its steps are two or three neighbouring doubles in turns, each asked
//            for thousands of times, and exponentials and sines of them would be most of the work
// Threads    a value that belongs to one state

#include <array>
#include <cstddef>

namespace torquescope {

template <typename Value>
class RememberedSteps {
 public:
  // make(step_s): computes it; a function of step_s alone
  template <typename Make>
  Value const& of(double step_s, Make const& make) {
    for (std::size_t i = 0; i < count_; ++i)
      if (steps_s_[i] == step_s) return values_[i];
    std::size_t const place = next_;
    next_ = (next_ + 1) % most;
    if (count_ < most) ++count_;
    steps_s_[place] = step_s;
    return values_[place] = make(step_s);
  }

 private:
  static constexpr std::size_t most = 4;
  std::array<double, most> steps_s_{};
  std::array<Value, most> values_{};
  std::size_t count_ = 0, next_ = 0;
};

}  // namespace torquescope
