#include "engine/data/health/torque_signs.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// changes of direction of a position by more than a fiftieth of its range, so that an encoder's dither counts for
// nothing
std::size_t reversals_of(std::vector<double> const& position) {
  auto const rows = known_rows(position);
  if (rows.empty()) return 0;
  double least = position[rows.front()], most = least;
  for (std::size_t row : rows) {
    least = std::min(least, position[row]);
    most = std::max(most, position[row]);
  }
  double const enough = levels::way_of_reversal * (most - least);
  double extreme = position[rows.front()];
  int direction = 0;
  std::size_t reversals = 0;
  for (std::size_t row : rows) {
    double const way = position[row] - extreme;
    bool const further = (direction >= 0 && way > 0.0) || (direction <= 0 && way < 0.0);
    if (direction != 0 && further) {
      extreme = position[row];
    } else if (std::fabs(way) > enough && enough > 0.0) {
      reversals += direction != 0;
      direction = way > 0.0 ? 1 : -1;
      extreme = position[row];
    }
  }
  return reversals;
}

// how often the torque comes down to a twentieth of its largest and goes up again to a fifth
std::size_t touches_of_zero(std::vector<double> const& torque) {
  double most = 0.0;
  for (double value : torque)
    if (std::isfinite(value)) most = std::max(most, value);
  bool is_up = false;
  std::size_t touches = 0;
  for (double value : torque) {
    if (!std::isfinite(value)) continue;
    if (is_up && value <= levels::touch_of_zero * most) {
      ++touches;
      is_up = false;
    } else if (value >= levels::away_from_zero * most) {
      is_up = true;
    }
  }
  return touches;
}

// Mean torque forwards less backwards, over their sum. Friction makes that of a passive joint positive; a magnitude is
// the same both ways
double difference_of_ways(std::vector<double> const& position, std::vector<double> const& torque) {
  double forward = 0.0, backward = 0.0, n_forward = 0.0, n_backward = 0.0;
  for (std::size_t i = 1; i < torque.size(); ++i) {
    double const way = position[i] - position[i - 1];
    if (!std::isfinite(way) || !std::isfinite(torque[i])) continue;
    if (way > 0.0) forward += torque[i], ++n_forward;
    if (way < 0.0) backward += torque[i], ++n_backward;
  }
  if (n_forward == 0.0 || n_backward == 0.0) return 1.0;
  forward /= n_forward, backward /= n_backward;
  return forward + backward > 0.0 ? (forward - backward) / (forward + backward) : 1.0;
}

}  // namespace

void examine_torque_sign(Examination& exam) {
  if (!exam.has("torque")) return;
  auto const& torque = exam.values("torque");
  auto const rows = known_rows(torque);
  bool const never_negative =
      std::all_of(rows.begin(), rows.end(), [&](std::size_t row) { return torque[row] >= 0.0; });
  if (!never_negative) return;
  auto const reversals = reversals_of(exam.values("position"));
  // a signed torque that gravity holds above zero does not come down to it at every turn
  double const touches = static_cast<double>(touches_of_zero(torque));
  if (reversals >= levels::fewest_reversals &&
      touches >= levels::touches_of_reversals * static_cast<double>(reversals) &&
      std::fabs(difference_of_ways(exam.values("position"), torque)) < levels::same_both_ways)
    exam.add(FindingKind::torque_without_sign, Grade::fault, Repair::none, "torque", {},
             static_cast<double>(reversals));
}

// Nothing but its own noise for half a second and more, where the torque is otherwise far above it; abrupt at one end
// at least, for a torque that comes down by itself does so over many rows
void leave_out_switched_off(Examination& exam) {
  constexpr double shortest_s = 0.5, within_noise = 4.5, far_above = 10.0, most_of_the_time = 0.5, moves = 0.01;
  if (!exam.has("torque")) return;
  auto& torque = exam.values("torque");
  auto const known = known_rows(torque);
  if (known.size() < 64) return;
  Eigen::VectorXd signal(static_cast<Eigen::Index>(known.size()));
  for (std::size_t k = 0; k < known.size(); ++k) signal[static_cast<Eigen::Index>(k)] = torque[known[k]];
  double const noise = white_noise(signal), rms = std::sqrt(signal.squaredNorm() / static_cast<double>(signal.size()));
  if (rms < far_above * noise) return;
  double const quiet = within_noise * noise;
  auto const& position = exam.values("position");
  double const range = range_of(position);

  std::vector<std::size_t> off;
  for (std::size_t first = 0; first < known.size();) {
    std::size_t end = first;
    while (end < known.size() && std::fabs(torque[known[end]]) <= quiet) ++end;
    bool const is_long = end > first && exam.time_s[known[end - 1]] - exam.time_s[known[first]] >= shortest_s;
    double const before = first > 0 ? std::fabs(torque[known[first - 1]]) : 0.0;
    double const after = end < known.size() ? std::fabs(torque[known[end]]) : 0.0;
    if (is_long && std::max(before, after) >= far_above * noise + 0.2 * rms) {
      std::vector<double> path(position.begin() + static_cast<std::ptrdiff_t>(known[first]),
                               position.begin() + static_cast<std::ptrdiff_t>(known[end - 1]));
      if (range_of(path) >= moves * range)
        for (std::size_t k = first; k < end; ++k) off.push_back(known[k]);
    }
    first = std::max(end, first + 1);
  }
  if (off.empty() || static_cast<double>(off.size()) > most_of_the_time * static_cast<double>(known.size())) return;
  for (std::size_t row : off) torque[row] = missing;
  double const step = (exam.time_s.back() - exam.time_s.front()) / static_cast<double>(exam.time_s.size() - 1);
  exam.add(FindingKind::torque_switched_off, Grade::warning, Repair::left_out, "torque", off,
           step * static_cast<double>(off.size()));
}

}  // namespace torquescope
