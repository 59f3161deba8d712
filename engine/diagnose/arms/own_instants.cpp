#include "engine/diagnose/arms/own_instants.hpp"

#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/statistics/replicate_null.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::uint32_t window_replicates = 999;  // a level of a thousandth can be told

struct BestWindow {
  RowBlock rows{};
  double gain = 0.0;
};

// gains: n of single rows; begins: the first row of each instant, and n (Kadane: Bentley 1984)
BestWindow best_window(VectorXd const& gains, std::vector<Index> const& begins) {
  BestWindow best;
  Index from = 0;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
    if (sum <= 0.0) {
      sum = 0.0;
      from = begins[k];
    }
    sum += gains.segment(begins[k], begins[k + 1] - begins[k]).sum();
    if (sum > best.gain) best = {{from, begins[k + 1]}, sum};
  }
  return best;
}

std::vector<Index> first_rows_of_instants(WholeArmRows const& rows) {
  std::vector<Index> begins;
  auto const n = static_cast<Index>(rows.rows.size());
  auto const instant = [&](Index i) { return rows.rows[static_cast<std::size_t>(i)].instant; };
  for (Index i = 0; i < n; ++i)
    if (i == 0 || instant(i) != instant(i - 1)) begins.push_back(i);
  begins.push_back(n);
  return begins;
}

VectorXd gains_of(VectorXd const& left, VectorXd const& torque) {
  return torque.array() * (2.0 * left - torque).array();
}

}  // namespace

OwnInstants own_instants(WholeArmRows const& rows, std::size_t recording, VectorXd const& left, VectorXd const& torque,
                         double alpha, ScanSetting const& setting) {
  auto const begins = first_rows_of_instants(rows);
  OwnInstants found{{}, VectorXd::Zero(torque.size())};
  BestWindow const best = best_window(gains_of(left, torque), begins);
  if (best.rows.size() == 0) return found;
  VectorXd acting = VectorXd::Zero(torque.size());
  acting.segment(best.rows.from, best.rows.size()) = torque.segment(best.rows.from, best.rows.size());
  VectorXd const noise = left - acting;
  std::vector<double> chance;
  for (std::uint32_t r = 1; r <= window_replicates; ++r) {
    RandomStream random({setting.seed, 1, RandomDomain::resampling}, setting.step, r);
    VectorXd replicate = noise;
    for (ArmStretch const& stretch : rows.stretches)
      if (random.bits() >> 63) replicate.segment(stretch.rows.from, stretch.rows.size()) *= -1.0;
    chance.push_back(best_window(gains_of(replicate, torque), begins).gain);
  }
  if (empirical_p(best.gain, chance) > alpha) return found;
  auto const time = [&](Index row) { return rows.rows[static_cast<std::size_t>(row)].time_s; };
  found.time = ActingTime{recording};
  if (best.rows.from > 0) found.time->from_s = time(best.rows.from);
  if (best.rows.to < torque.size()) found.time->until_s = time(best.rows.to);
  found.torque = std::move(acting);
  return found;
}

}  // namespace torquescope
