#include "engine/infer/locate/acting_region.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr double acting_share = 0.8;
constexpr double worth_two = 1.25;
constexpr std::size_t most_cells = 400;

struct Cell {
  double from = 0.0, to = 0.0, energy = 0.0, samples = 0.0;
  bool acts = false;
};

std::vector<Cell> equally_populated(Eigen::VectorXd const& at, Eigen::VectorXd const& energy) {
  auto const n = static_cast<std::size_t>(at.size());
  std::vector<Eigen::Index> order(n);
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return at[a] < at[b]; });
  std::vector<Cell> cells(std::min(n, most_cells));
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::size_t const first = n * c / cells.size(), end = n * (c + 1) / cells.size();
    cells[c].from = at[order[first]];
    cells[c].to = at[order[end - 1]];
    cells[c].samples = static_cast<double>(end - first);
    for (std::size_t k = first; k < end; ++k) cells[c].energy += energy[order[k]];
  }
  return cells;
}

void mark_acting(std::vector<Cell>& cells) {
  std::vector<Cell*> strongest;
  double whole = 0.0;
  for (Cell& cell : cells) {
    strongest.push_back(&cell);
    whole += cell.energy;
  }
  std::stable_sort(strongest.begin(), strongest.end(),
                   [](Cell const* a, Cell const* b) { return a->energy * b->samples > b->energy * a->samples; });
  double held = 0.0;
  for (Cell* cell : strongest) {
    if (cell != strongest.front() && held >= acting_share * whole) break;
    cell->acts = true;
    held += cell->energy;
  }
}

using Segment = std::pair<std::size_t, std::size_t>;  // first cell, one past the last

struct Cover {
  double sum = 0.0;
  std::vector<Segment> segments{};
};

// at most `most` segments of largest summed weight, by dynamic programming over the cells
Cover heaviest(std::vector<double> const& weight, std::size_t most) {
  std::vector<Cover> closed(most + 1), open(most + 1);  // with so many segments; `open`: the last one ends here
  for (std::size_t c = 0; c < weight.size(); ++c)
    for (std::size_t k = most; k >= 1; --k) {
      bool const goes_on = !open[k].segments.empty() && open[k].sum >= closed[k - 1].sum;
      if (goes_on) {
        open[k].segments.back().second = c + 1;
      } else {
        open[k] = closed[k - 1];
        open[k].segments.emplace_back(c, c + 1);
      }
      open[k].sum += weight[c];
      if (open[k].sum > closed[k].sum) closed[k] = open[k];
    }
  return *std::max_element(closed.begin(), closed.end(), [](auto const& a, auto const& b) { return a.sum < b.sum; });
}

struct Match {
  double jaccard = 0.0;
  std::vector<Segment> segments{};
};

double jaccard_of(std::vector<Cell> const& cells, std::vector<Segment> const& segments) {
  double both = 0.0, either = 0.0;
  for (Cell const& cell : cells) either += cell.acts ? cell.samples : 0.0;
  for (auto const& [first, end] : segments)
    for (std::size_t c = first; c < end; ++c) (cells[c].acts ? both : either) += cells[c].samples;
  return both / either;
}

// Dinkelbach: the ratio found so far is the price of a sample that either has; with it the best cover is a plain sum
Match best_match(std::vector<Cell> const& cells, std::size_t most) {
  Match best;
  std::vector<double> weight(cells.size());
  for (;;) {
    for (std::size_t c = 0; c < cells.size(); ++c) weight[c] = cells[c].samples * (cells[c].acts ? 1.0 : -best.jaccard);
    Cover cover = heaviest(weight, most);
    double const jaccard = jaccard_of(cells, cover.segments);
    if (jaccard <= best.jaccard) return best;
    best = {jaccard, std::move(cover.segments)};
  }
}

}  // namespace

ActingRegion acting_region(Eigen::VectorXd const& at, Eigen::VectorXd const& energy) {
  TORQUESCOPE_EXPECT(at.size() == energy.size() && at.size() > 0);
  std::vector<Cell> cells = equally_populated(at, energy);
  mark_acting(cells);
  Match const one = best_match(cells, 1), two = best_match(cells, 2);
  auto const interval = [&](Segment const& s) { return std::pair(cells[s.first].from, cells[s.second - 1].to); };
  ActingRegion region{interval(one.segments.front()), {}};
  for (Segment const& segment : two.jaccard > worth_two * one.jaccard ? two.segments : one.segments)
    region.intervals.push_back(interval(segment));
  return region;
}

}  // namespace torquescope
