#include "engine/simulate/controller_limits.hpp"

#include <algorithm>
#include <numeric>

namespace torquescope {
namespace {

// deviations by which a limit must explain better than the controller, and in how many rows
constexpr double z_clipped = 6.0;
constexpr std::size_t fewest_clipped = 3;

// The level at which the torque stops following the controller upwards: the rows where the controller asks for most, as
// many as are explained better by one common level than by the controller; infinite when six deviations do not tell the
// two apart. asked, torque: negated for the lower limit
double upper_limit(Eigen::VectorXd const& asked, Eigen::VectorXd const& torque, double deviation) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(asked.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return asked[a] > asked[b]; });
  double limit = std::numeric_limits<double>::infinity();
  double best = z_clipped * z_clipped * deviation * deviation;
  double sum = 0.0, by_controller = 0.0, squares = 0.0;
  double const origin = torque[order.front()];  // the torque's own size must not swallow its spread
  for (std::size_t i = 0; i < order.size() / 2; ++i) {
    double const u = torque[order[i]] - origin, excess = torque[order[i]] - asked[order[i]];
    sum += u;
    squares += u * u;
    by_controller += excess * excess;
    double const count = static_cast<double>(i + 1);
    double const gain = by_controller - (squares - sum * sum / count);
    if (i + 1 < fewest_clipped || gain <= best) continue;
    // a torque that was reached lies under the limit, or there is none
    if (torque.maxCoeff() > origin + sum / count + z_clipped * deviation) continue;
    best = gain;
    limit = origin + sum / count;
  }
  return limit;
}

}  // namespace

SampleRows inner_rows(LoopSignals const& s, SampleRows const& rows) {
  double const top = s.torque.maxCoeff(), bottom = s.torque.minCoeff();
  SampleRows inner;
  for (auto k : rows)
    if (s.torque[k] < 0.9 * top + 0.1 * bottom && s.torque[k] > 0.9 * bottom + 0.1 * top) inner.push_back(k);
  return inner.size() >= rows.size() / 10 ? inner : rows;
}

ControllerLimits find_limits(LoopSignals const& s, ControllerRegression const& fit, SampleRows const& rows) {
  double const deviation = std::sqrt(fit.sse / static_cast<double>(fit.residual.size()));
  Eigen::VectorXd const asked = asked_torque(s, fit, rows), torque = picked(s.torque, rows);
  return {-upper_limit(-asked, -torque, deviation), upper_limit(asked, torque, deviation)};
}

SampleRows unclipped_rows(LoopSignals const& s, ControllerRegression const& fit, ControllerLimits const& limits,
                          SampleRows const& rows) {
  Eigen::VectorXd const asked = asked_torque(s, fit, rows);
  SampleRows inside;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double const want = asked[static_cast<Eigen::Index>(i)];
    if (want < limits.most && want > limits.least) inside.push_back(rows[i]);
  }
  return inside;
}

}  // namespace torquescope
