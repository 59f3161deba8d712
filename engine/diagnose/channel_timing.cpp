#include "engine/diagnose/channel_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// of a sample period
constexpr double longest = 0.6;
// Without a reference nobody knows the controller's rate either: a torque may be the one told at its row, the one that
// acts then, or the one that acted until then
constexpr double longest_without_reference = 0.99;

}  // namespace

std::optional<double> delay_within_a_sample(Selection const& selection, double rate_hz) {
  static Effect const* const delay = find_effect("delay");
  double const most = selection.final->twin->colour ? longest_without_reference : longest;
  auto const& effects = selection.final->model().effects();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].effect != delay) continue;
    double const late_s = selection.final->model().effect_parameters(i, selection.final->parameters()).front();
    if (std::abs(late_s) * rate_hz <= most) return late_s;
  }
  return std::nullopt;
}

Recording with_torque_earlier(Recording recording, double late_s) {
  double const samples = late_s * recording.rate_hz;
  TORQUESCOPE_EXPECT(std::abs(samples) < 1.0);
  Eigen::VectorXd const read = recording.torque;
  Eigen::Index const step = samples < 0.0 ? -1 : 1, last = read.size() - 1;
  double const share = std::abs(samples);
  for (Eigen::Index k = 0; k <= last; ++k)
    recording.torque[k] = (1.0 - share) * read[k] + share * read[std::clamp<Eigen::Index>(k + step, 0, last)];
  return recording;
}

std::string timing_remark(double late_s, double rate_hz) {
  return fmt::format(
      "torque taken {:.2g} ms {} than its rows say, {:.2g} of a sample: it was read there, as drives do that are "
      "faster "
      "than their log",
      1e3 * std::abs(late_s), late_s > 0.0 ? "earlier" : "later", std::abs(late_s) * rate_hz);
}

}  // namespace torquescope
