#pragma once
// Second-order sections of a filter over several signals side by side, in place: several recursions keep the processor
// busy while each waits for its own last sample.
//
// Equation   y_i = b0 x_i + z1;  z1 = b1 x_i - a1 y_i + z2;  z2 = b2 x_i - a2 y_i  (transposed direct form II), per
//            section
// Start      every section in the steady state of the first sample: gain 1 at f = 0 is assumed
// Shapes     samples: n_samples x signals, one sample of all signals after the other; signals: 2, 4 or 8
// Bits       the same on every instruction set and for any company: no operation is fused, each signal is its own lane
// Speed      two sections go along the samples together: the second fills the time in which the first waits
// Not faster 16 signals side by side; filtering piece by piece in the L1 cache; loading by squares of two signals
//            (60 000 samples, Intel Xeon, 2 MB of L2: 5 % better to 20 % worse). Memory traffic is the limit
// Threads    free function
// Source     Oppenheim, Schafer: Discrete-Time Signal Processing, section 6.3

#include <cstddef>

namespace torquescope::kernels {

inline constexpr std::size_t most_cascade_signals = 8;

struct CascadeSection {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

enum class CascadeDirection { forwards, backwards };

void run_cascade(CascadeSection const* sections, std::size_t n_sections, double* samples, std::size_t n_samples,
                 std::size_t signals, CascadeDirection direction);

}  // namespace torquescope::kernels
