#include "engine/health/torque_signs.hpp"

#include <algorithm>

namespace torquescope {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// changes of direction of a position by more than a fiftieth of its range, so that an encoder's dither counts for
// nothing
std::size_t reversals_of(std::vector<double> const& position) {
  constexpr double share = 0.02;
  auto const rows = known_rows(position);
  if (rows.empty()) return 0;
  double least = position[rows.front()], most = least;
  for (std::size_t row : rows) {
    least = std::min(least, position[row]);
    most = std::max(most, position[row]);
  }
  double const enough = share * (most - least);
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

// how often the torque comes down to a fiftieth of its largest and goes up again to a fifth
std::size_t touches_of_zero(std::vector<double> const& torque) {
  double most = 0.0;
  for (double value : torque)
    if (std::isfinite(value)) most = std::max(most, value);
  bool is_up = false;
  std::size_t touches = 0;
  for (double value : torque) {
    if (!std::isfinite(value)) continue;
    if (is_up && value <= 0.02 * most) {
      ++touches;
      is_up = false;
    } else if (value >= 0.2 * most) {
      is_up = true;
    }
  }
  return touches;
}

}  // namespace

void examine_torque_sign(Examination& exam) {
  constexpr std::size_t fewest_reversals = 4;
  auto const& torque = exam.values("torque");
  auto const rows = known_rows(torque);
  bool const never_negative =
      std::all_of(rows.begin(), rows.end(), [&](std::size_t row) { return torque[row] >= 0.0; });
  if (!never_negative) return;
  auto const reversals = reversals_of(exam.values("position"));
  // a signed torque that gravity holds above zero does not come down to it at every turn
  if (reversals >= fewest_reversals && 2 * touches_of_zero(torque) >= reversals)
    exam.add(FindingKind::torque_without_sign, Grade::fault, Repair::none, "torque", {},
             static_cast<double>(reversals));
}

void leave_out_switched_off(Examination& exam) {
  constexpr double shortest_s = 0.1, seldom_still = 0.02;
  constexpr std::size_t fewest_rows = 10;
  auto& torque = exam.values("torque");
  auto const& position = exam.values("position");
  std::vector<std::size_t> off;
  std::size_t still_elsewhere = 0, rows_elsewhere = 0;
  for (std::size_t i = 0; i < torque.size();) {
    std::size_t end = i;
    while (end < torque.size() && torque[end] == 0.0) ++end;
    bool const is_long = end >= i + fewest_rows && exam.time_s[end - 1] - exam.time_s[i] >= shortest_s;
    if (is_long) {
      std::size_t moves = 0;
      for (std::size_t k = i + 1; k < end; ++k) moves += position[k] != position[k - 1];
      if (moves > (end - i) / 10)
        for (std::size_t k = i; k < end; ++k) off.push_back(k);
      i = end;
      continue;
    }
    ++rows_elsewhere;
    still_elsewhere += i > 0 && torque[i] == torque[i - 1];
    i = std::max(end, i + 1);
  }
  if (off.empty() || static_cast<double>(still_elsewhere) > seldom_still * static_cast<double>(rows_elsewhere)) return;
  for (std::size_t row : off) torque[row] = missing;
  double const step = (exam.time_s.back() - exam.time_s.front()) / static_cast<double>(exam.time_s.size() - 1);
  exam.add(FindingKind::torque_switched_off, Grade::warning, Repair::left_out, "torque", off,
           step * static_cast<double>(off.size()));
}

}  // namespace torquescope
