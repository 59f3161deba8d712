#include "engine/data/excitation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/base/contract.hpp"
#include "engine/base/order_statistic.hpp"
#include "engine/data/encoder_step.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

constexpr double moving_from = 0.01;  // of the largest speed
constexpr double visited = 0.01;      // of moving time: a quadrant counts

std::span<double const> numbers(Eigen::VectorXd const& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

// near the ends the filter answers to what it was continued with
struct BetweenEdges {
  using Signal = Eigen::VectorBlock<Eigen::VectorXd const>;
  BetweenEdges(Motion const& motion, Eigen::Index edge)
      : q(inner(motion.q, edge)),
        dq(inner(motion.dq, edge)),
        ddq(inner(motion.ddq, edge)),
        torque(inner(motion.torque, edge)) {}
  static Signal inner(Eigen::VectorXd const& signal, Eigen::Index edge) {
    TORQUESCOPE_EXPECT(signal.size() > 2 * edge);
    return signal.segment(edge, signal.size() - 2 * edge);
  }
  Signal q, dq, ddq, torque;
};

// Time spent at each speed above the threshold, in cells of equal ratio: a recording of any length in one pass
class TimeAtSpeeds {
 public:
  explicit TimeAtSpeeds(double slowest) : slowest_(slowest) {}

  void count(double speed) {
    double const cells = std::floor(std::log(speed / slowest_) / (same_speed / cells_of_one));
    ++time_[std::min(static_cast<std::size_t>(std::max(cells, 0.0)), time_.size() - 1)];
    ++total_;
  }

  double most_at_one() const {
    std::size_t most = 0;
    for (std::size_t from = 0; from + cells_of_one <= time_.size(); ++from)
      most = std::max(most, std::accumulate(time_.data() + from, time_.data() + from + cells_of_one, std::size_t{0}));
    return static_cast<double>(most) / static_cast<double>(total_);
  }

 private:
  static constexpr std::size_t cells_of_one = 8;
  static constexpr double same_speed = 0.18232155679395462;  // log 1.2
  // down to moving_from of the largest
  std::array<std::size_t, 204> time_{};
  double slowest_;
  std::size_t total_ = 0;
};

// direction, reversals, quadrants, speeds: everything that looks only at moving samples
void measure_movement(BetweenEdges const& motion, Excitation& facts) {
  double const threshold = moving_from * motion.dq.cwiseAbs().maxCoeff();
  int last_direction = 0;
  // samples with positive velocity, torque, both
  Eigen::Index forward = 0, positive = 0, both = 0;
  std::size_t n_moving = 0;
  for (Eigen::Index i = 0; i < motion.dq.size(); ++i) {
    if (std::fabs(motion.dq[i]) <= threshold) continue;
    int const direction = motion.dq[i] > 0 ? 1 : -1;
    facts.reversals += last_direction == -direction;
    last_direction = direction;
    forward += direction > 0;
    positive += motion.torque[i] > 0;
    both += direction > 0 && motion.torque[i] > 0;
    ++n_moving;
  }
  if (n_moving == 0) return;
  auto const moving = static_cast<double>(n_moving);
  facts.moving_share = moving / static_cast<double>(motion.dq.size());
  facts.forward_share = static_cast<double>(forward) / moving;
  Eigen::Index const neither = static_cast<Eigen::Index>(n_moving) - forward - positive + both;
  Eigen::Index const samples_in[] = {both, positive - both, neither, forward - both};
  for (std::size_t i = 0; i < 4; ++i) facts.quadrant_share[i] = static_cast<double>(samples_in[i]);
  for (double& share : facts.quadrant_share) {
    share /= moving;
    facts.quadrants += share >= visited;
  }
  auto const speed_percentile = [&](double share) {
    auto const for_each_speed = [&](auto const& visit) {
      for (double const velocity : motion.dq)
        if (!(std::fabs(velocity) <= threshold)) visit(std::fabs(velocity));
    };
    return kth_smallest(for_each_speed, static_cast<std::size_t>(share * static_cast<double>(n_moving - 1)));
  };
  facts.speed_spread = speed_percentile(0.95) / speed_percentile(0.10);
}

// nothing that moves: 0. A logarithm for each sample: not for those who only fit
double one_speed_share(BetweenEdges const& motion) {
  double const threshold = moving_from * motion.dq.cwiseAbs().maxCoeff();
  if (!(threshold > 0.0)) return 0.0;
  TimeAtSpeeds time(threshold);
  for (double const velocity : motion.dq)
    if (!(std::fabs(velocity) <= threshold)) time.count(std::fabs(velocity));
  return time.most_at_one();
}

}  // namespace

Excitation measure_channels(Recording const& recording) {
  Excitation facts;
  auto const& rows = recording.rows;
  facts.encoder_step = encoder_step(recording);
  facts.torque_limit_share =
      rows.torque_limit_share > 0 ? rows.torque_limit_share : limit_share(numbers(recording.torque));
  facts.torque_held_rows = held_rows(numbers(recording.torque));
  facts.torque_noise = white_noise(recording.torque);
  facts.jitter = rows.jitter;
  return facts;
}

void measure_motion(Motion const& whole, FilterOptions const& options, Excitation& facts) {
  BetweenEdges const motion(whole, edge_samples(options, whole.rate_hz));
  facts.duration_s = static_cast<double>(whole.q.size()) / whole.rate_hz;
  facts.position_least = motion.q.minCoeff();
  facts.position_most = motion.q.maxCoeff();
  facts.speed_least = motion.dq.minCoeff();
  facts.speed_most = motion.dq.maxCoeff();
  facts.acceleration_rms = std::sqrt(motion.ddq.squaredNorm() / static_cast<double>(motion.ddq.size()));
  facts.torque_least = motion.torque.minCoeff();
  facts.torque_most = motion.torque.maxCoeff();
  double const cutoff_hz = parallel_cutoff_of(options);
  if (facts.torque_held_rows > 1 && cutoff_hz > 0.0)
    facts.torque_updates = whole.rate_hz / static_cast<double>(facts.torque_held_rows) / cutoff_hz;
  measure_movement(motion, facts);
}

Excitation measure_excitation(Recording const& recording, Motion const& motion, FilterOptions const& options) {
  Excitation facts = measure_channels(recording);
  measure_motion(motion, options, facts);
  facts.one_speed_share = one_speed_share(BetweenEdges(motion, edge_samples(options, motion.rate_hz)));
  return facts;
}

std::vector<DataWarning> excitation_warnings(Excitation const& facts, char const* unit) {
  std::vector<DataWarning> warnings;
  auto const warn = [&](std::string text) { warnings.push_back({"excitation", std::move(text)}); };
  double const range = facts.position_most - facts.position_least;
  double const fastest = std::max(std::fabs(facts.speed_least), std::fabs(facts.speed_most));

  double const one_way = std::max(facts.forward_share, 1 - facts.forward_share);
  if (facts.moving_share > 0 && one_way > levels::one_direction)
    warn(
        fmt::format("only one direction of motion ({:.3g} % of the moving time): viscous, Coulomb friction and offset "
                    "cannot be separated; record both",
                    100 * one_way));
  if (facts.moving_share > 0 && facts.speed_spread < levels::one_speed_ratio())
    warn(fmt::format(
        "only one speed ({:.3g} {}/s): viscous and Coulomb friction cannot be told apart; record at least 4 speeds",
        fastest, unit));
  if (facts.encoder_step > 0 && range < levels::fewest_encoder_steps * facts.encoder_step)
    warn(fmt::format(
        "the whole motion spans {:.0f} encoder steps ({:.3g} {}): speed is mostly quantisation; record a larger motion",
        range / facts.encoder_step, range, unit));
  if (facts.moving_share > 0 && facts.reversals == 0 && one_way <= levels::one_direction)
    warn("the motion never reverses: friction at reversals cannot be seen");
  if (facts.torque_held_rows > 1)
    warn(fmt::format(
        "the torque changes on one row in {} only: it comes {:.2g} rows late on average; log it at its own rate",
        facts.torque_held_rows, 0.5 * static_cast<double>(facts.torque_held_rows - 1)));
  return warnings;
}

}  // namespace torquescope
