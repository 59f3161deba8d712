#include "engine/data/zero_phase.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// in place, transposed direct form II, beginning as if the first sample had always been there
void run(std::vector<FilterSection> const& sections, Eigen::Ref<Eigen::VectorXd> signal) {
  for (auto const& s : sections) {
    // states for which a constant input of 1 gives the constant output 1
    double z1 = (1 - s.b0) * signal[0];
    double z2 = (s.b2 - s.a2) * signal[0];
    for (double& x : signal) {
      double const y = s.b0 * x + z1;
      z1 = s.b1 * x - s.a1 * y + z2;
      z2 = s.b2 * x - s.a2 * y;
      x = y;
    }
  }
}

}  // namespace

Eigen::Index padding_of(std::vector<FilterSection> const& sections) {
  bool const odd = !sections.empty() && sections.back().b2 == 0.0 && sections.back().a2 == 0.0;
  return 3 * (2 * static_cast<Eigen::Index>(sections.size()) + 1 - (odd ? 1 : 0));
}

Eigen::VectorXd zero_phase(std::vector<FilterSection> const& sections,
                           Eigen::Ref<Eigen::VectorXd const> const& signal) {
  Eigen::Index const n = signal.size(), pad = padding_of(sections);
  TORQUESCOPE_EXPECT(n > pad);
  Eigen::VectorXd padded(n + 2 * pad);
  padded.segment(pad, n) = signal;
  for (Eigen::Index i = 1; i <= pad; ++i) {
    padded[pad - i] = 2 * signal[0] - signal[i];
    padded[pad + n - 1 + i] = 2 * signal[n - 1] - signal[n - 1 - i];
  }
  run(sections, padded);
  padded.reverseInPlace();
  run(sections, padded);
  padded.reverseInPlace();
  return padded.segment(pad, n);
}

}  // namespace torquescope
