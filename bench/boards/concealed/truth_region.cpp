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

// travelled since `turning` last changed its sign
std::vector<double> since_reversal(Truth const& truth, std::vector<double> const& turning, double shortest) {
  std::vector<double> distance;
  double direction = 0.0, travelled = 0.0, before = truth.q.front();
  for (std::size_t k = 0; k < truth.q.size(); ++k) {
    travelled += std::abs(truth.q[k] - before);
    before = truth.q[k];
    if (turning[k] * direction < 0.0) travelled = 0.0;
    if (turning[k] != 0.0) direction = turning[k];
    distance.push_back(std::max(shortest, travelled));
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

std::vector<std::string> const& truth_axes() {
  static std::vector<std::string> const axes = {
      "time", "position", "velocity", "acceleration", "load", "since_velocity_reversal", "since_torque_reversal"};
  return axes;
}

std::vector<TruthRegion> truth_regions(Truth const& truth, std::vector<double> const& added, Baseline const& baseline) {
  std::vector<double> load_along_motion, transmitted;
  for (std::size_t k = 0; k < truth.t.size(); ++k) {
    double const direction = truth.v[k] > 0.0 ? 1.0 : truth.v[k] < 0.0 ? -1.0 : 0.0;
    double const load = baseline.inertia * truth.a[k] + baseline.gravity_sin * std::sin(truth.q[k]) +
                        baseline.gravity_cos * std::cos(truth.q[k]);
    load_along_motion.push_back(truth.v[k] < 0.0 ? -load : load);
    transmitted.push_back(load + baseline.viscous * truth.v[k] + baseline.coulomb * direction);
  }
  auto const [lowest, highest] = std::minmax_element(truth.q.begin(), truth.q.end());
  double const shortest = 1e-5 * (*highest - *lowest);
  std::vector<std::vector<double>> const places = {truth.t,
                                                   truth.q,
                                                   truth.v,
                                                   truth.a,
                                                   load_along_motion,
                                                   since_reversal(truth, truth.v, shortest),
                                                   since_reversal(truth, transmitted, shortest)};
  std::vector<TruthRegion> regions;
  for (std::size_t i = 0; i < places.size(); ++i) {
    bool const is_distance = truth_axes()[i].starts_with("since");
    regions.push_back(region_along(truth_axes()[i], places[i], added, is_distance));
  }
  return regions;
}

}  // namespace concealed
