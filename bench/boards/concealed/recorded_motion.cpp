#include "concealed/recorded_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "concealed/case_list.hpp"
#include "concealed/low_pass.hpp"

namespace concealed {
namespace {

std::vector<double> slope(std::vector<double> const& x) {
  std::vector<double> result(x.size(), 0.0);
  for (std::size_t k = 1; k + 1 < x.size(); ++k) result[k] = (x[k + 1] - x[k - 1]) / (2.0 * tick_s);
  return result;
}

}  // namespace

RecordedMotion recorded_motion(Recording const& recording) {
  RecordedMotion motion;
  motion.v = slope(low_passed(recording.position, position_cutoff_hz, 1.0 / tick_s));
  motion.a = slope(motion.v);
  return motion;
}

std::vector<char> far_from_reversals(Truth const& truth, double cutoff_hz) {
  auto const reach = static_cast<std::size_t>(std::ceil(1.6 / cutoff_hz / tick_s));
  std::size_t const n = truth.moves.size();
  std::vector<char> far(n, 0);
  std::size_t first = 0;  // of the stretch that moves one way
  for (std::size_t k = 0; k <= n; ++k) {
    bool const goes_on = k < n && truth.moves[k] && (k == first || (truth.v[k] > 0.0) == (truth.v[k - 1] > 0.0));
    if (goes_on) continue;
    for (std::size_t i = first + reach; i + reach < k; ++i) far[i] = 1;
    first = k < n && truth.moves[k] ? k : k + 1;
  }
  return far;
}

}  // namespace concealed
