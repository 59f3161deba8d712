#include "engine/data/health/repeated_rows.hpp"

#include <algorithm>

#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// an encoder's step, or at least the smallest step there is
double coarseness(std::vector<double> const& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] != x[i - 1]) smallest = std::min(smallest, std::fabs(x[i] - x[i - 1]));
  return std::isfinite(smallest) ? std::max(smallest, quantisation_step(x)) : 0.0;
}

// the typical step of up to three around a stretch on one side; 0 where they turn
double step_beside(std::vector<double> const& x, std::size_t from, std::size_t until) {
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = from; i < until; ++i) {
    sum += x[i] - x[i - 1];
    ++counted;
  }
  return counted > 0 ? sum / static_cast<double>(counted) : 0.0;
}

// A hold of several rows that ends in one step far longer than those after it, and no longer than the joint moves in
// that time elsewhere: it moved meanwhile, and perhaps turned
bool is_way_of_a_hold(std::vector<double> const& x, std::size_t first, std::size_t end, double encoder_step) {
  constexpr std::size_t nearby = levels::rows_around_hold;
  if (end - first < levels::shortest_hold) return false;
  double around = 0.0, fastest = 0.0;
  for (std::size_t i = first > nearby ? first - nearby : 1; i < std::min(x.size(), end + nearby); ++i) {
    if (i >= first && i <= end) continue;
    fastest = std::max(fastest, std::fabs(x[i] - x[i - 1]));
    if (i > end && i <= end + 2) around = std::max(around, std::fabs(x[i] - x[i - 1]));
  }
  double const way = std::fabs(x[end] - x[first - 1]);
  // either is known to a step
  return way - encoder_step > levels::way_after_hold * (around + encoder_step) &&
         way <= levels::faster_unnoticed * static_cast<double>(end - first + 1) * fastest;
}

// rows that repeat and are made up for by the row after them
std::vector<std::size_t> stale_rows(std::vector<double> const& x, double encoder_step) {
  constexpr std::size_t beside = 3;
  std::vector<std::size_t> stale;
  for (std::size_t i = beside + 1; i + 1 < x.size(); ++i) {
    if (x[i] != x[i - 1]) continue;
    std::size_t end = i;  // the first row that moves again
    while (end < x.size() && x[end] == x[i - 1]) ++end;
    if (end + beside >= x.size()) break;
    double const before = step_beside(x, i - beside, i), after = step_beside(x, end + 1, end + 1 + beside);
    auto const steps = static_cast<double>(end - i + 1);
    double const expected = steps * (before + after) / 2.0, way = x[end] - x[i - 1];
    bool const is_fast = std::min(std::fabs(before), std::fabs(after)) > levels::steps_that_never_repeat * encoder_step;
    bool const goes_on = before * after > 0.0 && way * expected > 0.0;
    bool const made_up_for =
        goes_on && is_fast && std::fabs(way) >= levels::made_up_share(end - i) * std::fabs(expected);
    if (made_up_for || is_way_of_a_hold(x, i, end, encoder_step))
      for (std::size_t k = i; k < end; ++k) stale.push_back(k);
    i = end;
  }
  return stale;
}

}  // namespace

void examine_repeated_rows(Examination& exam) {
  auto& position = exam.values("position");
  auto const known = known_rows(position);
  std::vector<double> x;
  for (std::size_t row : known) x.push_back(position[row]);
  auto const places = stale_rows(x, coarseness(x));
  double const fewest = levels::share_of_repeats_worth_saying * static_cast<double>(x.size());
  if (static_cast<double>(places.size()) < std::max(levels::repeats_worth_saying, fewest)) return;
  std::vector<std::size_t> rows;
  for (std::size_t place : places) rows.push_back(known[place]);
  // from the end, so that the row before is as it was
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    std::size_t const row = known[*place], before = known[*place - 1];
    position[row] = missing;
    // the other channels of a lost packet repeat as well; one that is logged by itself does not
    for (auto const* name : {"torque", "velocity", "acceleration"})
      if (exam.has(name) && exam.values(name)[row] == exam.values(name)[before]) exam.values(name)[row] = missing;
  }
  exam.add(FindingKind::rows_repeated, Grade::warning, Repair::filled, "position", rows);
}

}  // namespace torquescope
