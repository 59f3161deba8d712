#include "concealed/truth_region.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace concealed {
namespace {

constexpr std::size_t n_bins = 100;
constexpr double held_energy = 0.8;

TruthRegion region_along(std::string axis, std::vector<double> const& place, std::vector<double> const& added,
                         bool logarithmic) {
  auto scale = [&](double x) { return logarithmic ? std::log(x) : x; };
  auto back = [&](double x) { return logarithmic ? std::exp(x) : x; };
  auto const [lowest, highest] = std::minmax_element(place.begin(), place.end());
  double const low = scale(*lowest), width = (scale(*highest) - low) / n_bins;

  TruthRegion region{std::move(axis), {}, std::vector<double>(n_bins, 0.0), std::vector<bool>(n_bins, false)};
  for (std::size_t i = 0; i <= n_bins; ++i) region.edges.push_back(back(low + width * static_cast<double>(i)));
  std::vector<double> energy(n_bins, 0.0);
  double all = 0.0;
  for (std::size_t k = 0; k < place.size(); ++k) {
    auto const bin = std::min(n_bins - 1, static_cast<std::size_t>((scale(place[k]) - low) / width));
    region.occupancy[bin] += 1.0 / static_cast<double>(place.size());
    energy[bin] += added[k] * added[k];
    all += added[k] * added[k];
  }

  std::vector<std::size_t> order(n_bins);
  std::iota(order.begin(), order.end(), 0);
  auto density = [&](std::size_t i) { return region.occupancy[i] > 0.0 ? energy[i] / region.occupancy[i] : 0.0; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return density(i) > density(j); });
  double held = 0.0;
  for (std::size_t i : order) {
    if (held >= held_energy * all) break;
    region.inside[i] = true;
    held += energy[i];
  }
  return region;
}

std::vector<double> distance_since_reversal(Truth const& truth, double shortest) {
  std::vector<double> distance;
  double turned_at = truth.q.front(), direction = 0.0;
  for (std::size_t k = 0; k < truth.q.size(); ++k) {
    if (truth.v[k] * direction < 0.0) turned_at = truth.q[k];
    if (truth.v[k] != 0.0) direction = truth.v[k];
    distance.push_back(std::max(shortest, std::abs(truth.q[k] - turned_at)));
  }
  return distance;
}

}  // namespace

std::vector<std::pair<double, double>> TruthRegion::intervals() const {
  std::vector<std::pair<double, double>> joined;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) continue;
    if (i > 0 && inside[i - 1]) {
      joined.back().second = edges[i + 1];
    } else {
      joined.emplace_back(edges[i], edges[i + 1]);
    }
  }
  return joined;
}

std::vector<TruthRegion> truth_regions(Truth const& truth, std::vector<double> const& added, Baseline const& baseline) {
  std::vector<double> speed, load;
  for (std::size_t k = 0; k < truth.t.size(); ++k) {
    speed.push_back(std::abs(truth.v[k]));
    load.push_back(baseline.inertia * truth.a[k] + baseline.gravity_sin * std::sin(truth.q[k]) +
                   baseline.gravity_cos * std::cos(truth.q[k]));
  }
  auto const [lowest, highest] = std::minmax_element(truth.q.begin(), truth.q.end());
  auto const distance = distance_since_reversal(truth, 1e-5 * (*highest - *lowest));
  return {region_along("time", truth.t, added, false),
          region_along("position", truth.q, added, false),
          region_along("velocity", truth.v, added, false),
          region_along("speed", speed, added, false),
          region_along("acceleration", truth.a, added, false),
          region_along("load", load, added, false),
          region_along("distance_since_reversal", distance, added, true)};
}

}  // namespace concealed
