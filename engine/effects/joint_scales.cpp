#include "engine/effects/joint_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace torquescope {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

double cube(double x) { return x * x * x; }

// a wave of the angle must stand above the encoder's step and below the cutoff while the joint is slow; a turn has no
// more than 400 of them
double highest_order(JointScales const& scales) {
  double const by_filter = two_pi * scales.cutoff_hz / (0.1 * scales.peak_speed);
  double const by_encoder = two_pi / (4.0 * scales.resolution());
  double const order = std::min(by_filter, by_encoder);
  return scales.joint == JointKind::revolute ? std::min(order, 400.0) : order;
}

double coulomb_or_torque(JointScales const& scales) {
  return scales.coulomb() > 0.0 ? scales.coulomb() : scales.torque_rms;
}

double viscous_or_torque(JointScales const& scales) {
  return scales.viscous > 0.0 ? scales.viscous : scales.torque_rms / scales.peak_speed;
}

double inertia_or_torque(JointScales const& scales) {
  return scales.inertia > 0.0 ? scales.inertia : scales.torque_rms / (scales.peak_speed * two_pi * scales.cutoff_hz);
}

}  // namespace

double JointScales::resolution() const { return encoder_step > 0.0 ? encoder_step : 1e-6 * position_range; }

FrictionSign JointScales::friction_sign() const {
  if (!(coulomb() > 0.0)) return {};
  return {coulomb_positive / coulomb(), -coulomb_negative / coulomb()};
}

double bound_value(Bound const& bound, JointScales const& scales) {
  double const f = bound.factor;
  switch (bound.to) {
    case RelativeTo::absolute:
      return f;
    case RelativeTo::peak_speed:
      return f * scales.peak_speed;
    case RelativeTo::position_range:
      return f * scales.position_range;
    case RelativeTo::position:
      return scales.position_centre + f * scales.position_range;
    case RelativeTo::range_inverse2:
      return f / (scales.position_range * scales.position_range);
    case RelativeTo::resolution:
      return f * scales.resolution();
    case RelativeTo::duration:
      return f * scales.duration_s;
    case RelativeTo::instant:
      return scales.start_s + f * scales.duration_s;
    case RelativeTo::sample_period:
      return f / scales.rate_hz;
    case RelativeTo::filter_time:
      return f / (two_pi * scales.cutoff_hz);
    case RelativeTo::slowest_frequency:
      return f / scales.duration_s;
    case RelativeTo::cutoff_frequency:
      return f * scales.cutoff_hz;
    case RelativeTo::lowest_order:
      return f * two_pi / scales.position_range;
    case RelativeTo::highest_order:
      return f * highest_order(scales);
    case RelativeTo::torque:
      return f * scales.torque_rms;
    case RelativeTo::torque_peak:
      return f * scales.torque_peak;
    case RelativeTo::torque_highest:
      return f * scales.torque_highest;
    case RelativeTo::torque_lowest:
      return f * scales.torque_lowest;
    case RelativeTo::torque_inverse2:
      return f / (scales.torque_rms * scales.torque_rms);
    case RelativeTo::coulomb:
      return f * coulomb_or_torque(scales);
    case RelativeTo::coulomb_per_range:
      return f * coulomb_or_torque(scales) / scales.position_range;
    case RelativeTo::coulomb_per_duration:
      return f * coulomb_or_torque(scales) / scales.duration_s;
    case RelativeTo::viscous:
      return f * viscous_or_torque(scales);
    case RelativeTo::viscous_per_duration:
      return f * viscous_or_torque(scales) / scales.duration_s;
    case RelativeTo::inertia:
      return f * inertia_or_torque(scales);
    case RelativeTo::bears_only_inertia:
      return scales.bears_only_inertia ? f : 0.0;
    case RelativeTo::torque_per_duration:
      return f * scales.torque_rms / scales.duration_s;
    case RelativeTo::torque_per_speed:
      return f * scales.torque_rms / scales.peak_speed;
    case RelativeTo::torque_per_speed2:
      return f * scales.torque_rms / (scales.peak_speed * scales.peak_speed);
    case RelativeTo::torque_per_speed3:
      return f * scales.torque_rms / cube(scales.peak_speed);
    case RelativeTo::torque_per_range:
      return f * scales.torque_rms / scales.position_range;
    case RelativeTo::torque_per_range2:
      return f * scales.torque_rms / (scales.position_range * scales.position_range);
    case RelativeTo::torque_per_range3:
      return f * scales.torque_rms / cube(scales.position_range);
  }
  return f;
}

std::string bound_text(Bound const& bound) {
  if (std::isinf(bound.factor)) return "no bound";
  if (bound.factor == 0.0 && bound.to != RelativeTo::position && bound.to != RelativeTo::instant) return "0";
  char const* scale = "";
  switch (bound.to) {
    case RelativeTo::absolute:
      break;
    case RelativeTo::peak_speed:
      scale = " x peak speed";
      break;
    case RelativeTo::position_range:
      scale = " x position range";
      break;
    case RelativeTo::position:
      scale = " x position range from its centre";
      break;
    case RelativeTo::range_inverse2:
      scale = " / position range^2";
      break;
    case RelativeTo::resolution:
      scale = " x encoder step";
      break;
    case RelativeTo::duration:
      scale = " x duration";
      break;
    case RelativeTo::instant:
      scale = " x duration from the start";
      break;
    case RelativeTo::sample_period:
      scale = " x sample period";
      break;
    case RelativeTo::filter_time:
      scale = " / (2 pi cutoff)";
      break;
    case RelativeTo::slowest_frequency:
      scale = " / duration";
      break;
    case RelativeTo::cutoff_frequency:
      scale = " x cutoff";
      break;
    case RelativeTo::lowest_order:
      scale = " x wave per position range";
      break;
    case RelativeTo::highest_order:
      scale = " x order at the cutoff at 0.1 peak speed (400 per turn at most)";
      break;
    case RelativeTo::torque:
      scale = " x torque rms";
      break;
    case RelativeTo::torque_peak:
      scale = " x torque peak";
      break;
    case RelativeTo::torque_highest:
      scale = " x highest torque";
      break;
    case RelativeTo::torque_lowest:
      scale = " x lowest torque, as a magnitude";
      break;
    case RelativeTo::torque_inverse2:
      scale = " / torque rms^2";
      break;
    case RelativeTo::coulomb:
      scale = " x Coulomb level";
      break;
    case RelativeTo::coulomb_per_range:
      scale = " x Coulomb level / position range";
      break;
    case RelativeTo::coulomb_per_duration:
      scale = " x Coulomb level / duration";
      break;
    case RelativeTo::viscous:
      scale = " x viscous";
      break;
    case RelativeTo::viscous_per_duration:
      scale = " x viscous / duration";
      break;
    case RelativeTo::inertia:
      scale = " x inertia";
      break;
    case RelativeTo::bears_only_inertia:
      scale = " where the load is inertia alone, else 0";
      break;
    case RelativeTo::torque_per_duration:
      scale = " x torque rms / duration";
      break;
    case RelativeTo::torque_per_speed:
      scale = " x torque rms / peak speed";
      break;
    case RelativeTo::torque_per_speed2:
      scale = " x torque rms / peak speed^2";
      break;
    case RelativeTo::torque_per_speed3:
      scale = " x torque rms / peak speed^3";
      break;
    case RelativeTo::torque_per_range:
      scale = " x torque rms / position range";
      break;
    case RelativeTo::torque_per_range2:
      scale = " x torque rms / position range^2";
      break;
    case RelativeTo::torque_per_range3:
      scale = " x torque rms / position range^3";
      break;
  }
  return fmt::format("{:g}{}", bound.factor, scale);
}

}  // namespace torquescope
