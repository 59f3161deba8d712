#include "engine/infer/locate/axis_blocks.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/base/contract.hpp"
#include "engine/infer/locate/map_axes.hpp"

namespace torquescope {
namespace {

std::optional<Eigen::VectorXd> levels_of(Effect const& effect, MotionAxes const& axes) {
  if (effect.signature().empty()) return std::nullopt;
  switch (SignatureAxis const axis = effect.signature().front(); axis) {
    case SignatureAxis::time:
    case SignatureAxis::frequency:
      return std::nullopt;
    case SignatureAxis::order:
      return axes.q;
    case SignatureAxis::velocity:
      return axes.dq.cwiseAbs();
    default:
      return values_on(axis, axes);
  }
}

std::vector<Eigen::Index> ascending(Eigen::VectorXd const& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

AxisBlocks axis_blocks(Effect const& effect, MotionAxes const& axes, Eigen::VectorXd const& torque,
                       Eigen::Index count) {
  TORQUESCOPE_EXPECT(count > 0 && torque.size() == axes.q.size());
  auto const levels = levels_of(effect, axes);
  double const energy = torque.squaredNorm();
  if (!levels || !(energy > 0.0)) return {};
  AxisBlocks result{ascending(*levels), {}};
  auto const n = torque.size();
  double const a_block = 2.0 / static_cast<double>(count);
  double held = 0.0;
  for (Eigen::Index row = 0, from = 0; row < n; ++row) {
    double const own = torque[result.order[static_cast<std::size_t>(row)]];
    held += own * own / energy + 1.0 / static_cast<double>(n);
    if (held < a_block * static_cast<double>(result.blocks.size() + 1) && row + 1 < n) continue;
    result.blocks.push_back({from, row + 1});
    from = row + 1;
  }
  return result;
}

}  // namespace torquescope
