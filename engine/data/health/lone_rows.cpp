#include "engine/data/health/lone_rows.hpp"

#include <algorithm>
#include <cmath>

#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

// e of the header
double distance_from_neighbours(std::vector<double> const& x, std::size_t i) {
  auto const [low, high] = std::minmax(x[i - 1], x[i + 1]);
  return std::max({0.0, x[i] - high, low - x[i]});
}

// the largest bend of other rows around, but of the two beside it, which bend as it does
double bend_around(std::vector<double> const& x, std::size_t place) {
  constexpr std::size_t nearby = levels::rows_around_lone_row;
  double largest = 0.0;
  for (std::size_t i = place > nearby ? place - nearby : 1; i + 1 < std::min(x.size(), place + nearby + 1); ++i)
    if (i + 1 < place || i > place + 1) largest = std::max(largest, std::fabs(x[i - 1] - 2 * x[i] + x[i + 1]));
  return largest;
}

}  // namespace

std::vector<std::size_t> lone_rows(std::vector<double> const& values) {
  auto const known = known_rows(values);
  std::vector<double> x;
  for (std::size_t row : known) x.push_back(values[row]);
  double const least = levels::steps_of_lone_row * quantisation_step(x);
  std::vector<std::size_t> rows;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    double const distance = distance_from_neighbours(x, i);
    if (distance > least && distance >= levels::bends_of_lone_row * bend_around(x, i)) rows.push_back(known[i]);
  }
  // as often as that it is how the signal is
  if (rows.size() > levels::most_lone_rows) rows.clear();
  return rows;
}

std::vector<LoneRow> find_lone_rows(Examination& exam) {
  std::vector<LoneRow> found;
  for (auto const* name : {"position", "torque"}) {
    if (!exam.has(name)) continue;
    for (std::size_t row : lone_rows(exam.values(name)))
      found.push_back({exam.time_s[row] + exam.first_stamp_s, exam.values(name)[row], exam.line(row),
                       exam.channels.at(name).column});
  }
  return found;
}

}  // namespace torquescope
