#include "engine/fit/problem/computed_torque.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/base/median.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/motion.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Positions = std::vector<VectorXd>;

// convention: an error that falls to a third is worth a sentence
constexpr double error_falls_by = 3.0;
// derived: where the encoder's noise is all that is left, another one doubles its energy; convention: a quarter of that
constexpr double most_of_noise = 0.25;

// convention: below 100 dB no sensor is
constexpr double no_noise = 1e-5;

// Each order's standard deviation is an upper bound, because the motion bends: the least of them
double noise_of(VectorXd const& signal, double step) {
  constexpr Index orders = 8;
  double const quantisation = levels::rounding_noise() * step;
  VectorXd difference = signal;
  double least = white_noise(difference), variance = 1.0;  // of a difference of white noise: (2k over k)
  for (Index k = 1; k <= orders && difference.size() > 2; ++k) {
    difference = (difference.tail(difference.size() - 1) - difference.head(difference.size() - 1)).eval();
    variance *= static_cast<double>(2 * (2 * k - 1)) / static_cast<double>(k);
    VectorXd const sizes = difference.cwiseAbs();
    double const middle = upper_median(std::vector(sizes.begin(), sizes.end()));
    least = std::min(least, middle / median_of_normal / std::sqrt(variance));
  }
  return std::max(quantisation, least);
}

VectorXd with_noise(Recording const& joint, std::uint32_t which) {
  RandomStream random({0, 0, RandomDomain::resampling}, 0, which);
  double const sigma = noise_of(joint.position, joint.rows.encoder_step);
  VectorXd position = joint.position;
  for (double& value : position) value += sigma * random.normal();
  return position;
}

// by which the measured position is behind the commanded one, in samples: least squares, to first order
VectorXd without_lag(Recording const& joint) {
  VectorXd const speed = central_derivative(joint.reference, 1.0);
  double const lag =
      speed.squaredNorm() > 0.0 ? (joint.reference - joint.position).dot(speed) / speed.squaredNorm() : 0.0;
  Index const n = joint.position.size();
  VectorXd shifted(n);
  for (Index i = 0; i < n; ++i) {
    double const at = std::clamp(static_cast<double>(i) + lag, 0.0, static_cast<double>(n - 1));
    Index const before = std::min(static_cast<Index>(at), n - 2);
    double const share = at - static_cast<double>(before);
    shifted[i] = (1.0 - share) * joint.position[before] + share * joint.position[before + 1];
  }
  return shifted;
}

template <class PositionOf>
Positions positions_of(std::vector<Recording> const& joints, PositionOf const& position_of) {
  Positions positions;
  for (auto const& joint : joints) positions.push_back(position_of(joint));
  return positions;
}

bool is_worse(TorqueBesideMotion const& one, TorqueBesideMotion const& least) {
  double const a = one.error(), b = least.error();
  return a > error_falls_by * b &&
         levels::is_larger_beyond_chance(a, std::max(b, 1e-15 * a), levels::independent_rows(one.left()));
}

}  // namespace

bool carries_no_noise(Recording const& joint) {
  auto const rms = [](VectorXd const& signal) { return std::sqrt((signal.array() - signal.mean()).square().mean()); };
  auto const& torque = joint.torque;
  Index const n = torque.size();
  std::span<double const> const values(torque.data(), static_cast<std::size_t>(n));
  // what is held or filled is smooth for another reason
  bool const is_itself = joint.rows.resampled == 0 && joint.rows.torque_hz == 0.0 && joint.left_out.empty();
  if (n < 2 || !is_itself || held_rows(values) > 1) return false;
  if (2 * (torque.tail(n - 1).array() == torque.head(n - 1).array()).count() > n) return false;
  return noise_of(torque, quantisation_step(values)) < no_noise * rms(torque) &&
         noise_of(joint.position, joint.rows.encoder_step) > no_noise * rms(joint.position);
}

std::vector<ComputedTorque> computed_torques(std::vector<Recording> const& joints, BesideOfJoints const& measured,
                                             BesidePositions const& beside) {
  if (!std::all_of(joints.begin(), joints.end(), [](auto const& one) {
        return one.reference.size() == one.position.size() && one.reference.size() > 2 && one.reference.allFinite();
      }))
    return {};
  auto const along_reference = beside(positions_of(joints, [](auto const& one) { return one.reference; }));
  std::vector<std::size_t> suspects;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (measured[j] && along_reference[j] && is_worse(*measured[j], *along_reference[j])) suspects.push_back(j);
  if (suspects.empty()) return {};

  auto const derived = beside(positions_of(joints, [](auto const& one) { return one.position; }));
  auto const early = beside(positions_of(joints, without_lag));
  std::uint32_t count = 0;
  auto const noisy = beside(positions_of(joints, [&](auto const& one) { return with_noise(one, count++); }));
  std::vector<ComputedTorque> found;
  for (auto const j : suspects) {
    if (!derived[j] || !early[j] || !noisy[j]) continue;
    if (!is_worse(*derived[j], *along_reference[j]) || !is_worse(*early[j], *along_reference[j])) continue;
    double const left = derived[j]->left().squaredNorm(), more = noisy[j]->left().squaredNorm() - left;
    if (more > most_of_noise * left) continue;
    found.push_back({j, derived[j]->error(), along_reference[j]->error()});
  }
  return found;
}

}  // namespace torquescope
