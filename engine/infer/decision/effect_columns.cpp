#include "engine/infer/decision/effect_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {
namespace {

// the same places and accelerations, always this way
Motion one_way(Motion motion, double side, double least_speed) {
  motion.dq = side * motion.dq.cwiseAbs().cwiseMax(least_speed);
  return motion;
}

// with friction as s says at each sample, the samples weighed
Eigen::MatrixXd mixed(EffectColumnsOnStrip const& columns, Eigen::VectorXd const& sticking,
                      Eigen::VectorXd const& weight) {
  Eigen::MatrixXd all(columns.forward.rows(), columns.count());
  std::size_t dry = 0;
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    auto const forward = columns.forward.col(k).array();
    if (dry == columns.dry.size() || columns.dry[dry] != k) {
      all.col(k) = weight.array() * forward;
      continue;
    }
    auto const backward = columns.backward.col(static_cast<Eigen::Index>(dry++)).array();
    all.col(k) = weight.array() * (0.5 * ((1.0 + sticking.array()) * forward + (1.0 - sticking.array()) * backward));
  }
  return all;
}

double slowest(double deadband) { return std::max(2.0 * deadband, std::numeric_limits<double>::min()); }

}  // namespace

EffectColumnsOnStrip columns_of(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                Strip const& strip, FittedBaseline const& baseline) {
  EffectColumnsOnStrip result;
  auto const count = static_cast<Eigen::Index>(effect.n_linear() * shapes.size());
  result.is_driven = effect.has_inertia();
  Motion const& motion = result.is_driven ? strip.drive : strip.motion;
  auto const put = [&](Motion const& on, Eigen::MatrixXd& out) {
    EffectInput input = result.is_driven ? EffectInput{on, baseline.scales} : baseline.input(on);
    input.given = strip.beside.given.get();
    out.resize(on.q.size(), count);
    effect.columns_of_shapes(input, shapes, out);
  };
  bool const is_split = effect.is_dry_friction() && !effect.has_memory() && !result.is_driven;
  if (!is_split) {
    put(motion, result.forward);
    return result;
  }
  put(one_way(motion, 1.0, slowest(0.0)), result.forward);
  put(one_way(motion, -1.0, slowest(0.0)), result.backward);
  for (Eigen::Index k = 0; k < count; ++k) result.dry.push_back(k);
  return result;
}

EffectColumnsOnStrip columns_of(Regressor const& regressor, Strip const& strip) {
  GivenSignals const* const given = strip.beside.given.get();
  EffectColumnsOnStrip result;
  result.forward = regressor.columns(strip.motion, given);
  auto const& owners = regressor.column_owners();
  for (std::size_t k = 0; k < owners.size(); ++k)
    if (regressor.terms()[owners[k].term]->is_dry_friction()) result.dry.push_back(static_cast<Eigen::Index>(k));
  if (result.dry.empty()) return result;
  double const least = slowest(regressor.velocity_deadband());
  Eigen::MatrixXd const forward = regressor.columns(one_way(strip.motion, 1.0, least), given);
  result.backward = regressor.columns(one_way(strip.motion, -1.0, least), given)(Eigen::all, result.dry);
  for (Eigen::Index const k : result.dry) result.forward.col(k) = forward.col(k);
  return result;
}

Eigen::MatrixXd on_rows(Strip const& strip, EffectColumnsOnStrip const& columns, Eigen::VectorXd const& sticking,
                        Eigen::VectorXd const& weight) {
  if (columns.is_driven) return drive_on_rows(strip, at_drive_rate(strip, weight).asDiagonal() * columns.forward);
  return on_rows(strip, mixed(columns, sticking, weight));
}

}  // namespace torquescope
