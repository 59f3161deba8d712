// How large a part of the torque is that the joint's own model cannot take over.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sticking/recording.hpp"

namespace sticking {
namespace {

double product(std::vector<double> const& a, std::vector<double> const& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

constexpr double slowest_share = 0.005;  // of the greatest speed: slower rows are at rest

std::vector<double> only_moving(Recording const& recording, std::vector<double> all) {
  double fastest = 0.0;
  for (Mean const& mean : recording.means) fastest = std::max(fastest, std::abs(mean.speed));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::abs(recording.means[i].speed) > slowest_share * fastest) all[kept++] = all[i];
  all.resize(kept);
  return all;
}

std::vector<double> column(Recording const& recording, double Mean::*part) {
  std::vector<double> found;
  found.reserve(recording.means.size());
  for (Mean const& mean : recording.means) found.push_back(mean.*part);
  return found;
}

void take_away(std::vector<double> const& direction, std::vector<double>& from) {
  double const share = product(direction, from);
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= share * direction[i];
}

double rms(std::vector<double> const& of) { return std::sqrt(product(of, of) / static_cast<double>(of.size())); }

}  // namespace

double torque_rms(Recording const& recording) { return rms(only_moving(recording, column(recording, &Mean::given))); }

std::vector<double> late_part(Recording const& recording, double delay_s, double log_hz) {
  auto const late = static_cast<std::size_t>(std::lround(delay_s / step_s));
  auto const period = static_cast<std::size_t>(std::lround(1.0 / (log_hz * step_s)));
  auto const& channel = recording.channel;
  std::vector<double> found;
  found.reserve(recording.means.size());
  for (std::size_t row = 0; row < recording.means.size(); ++row) {
    double sum = 0.0;
    for (std::size_t i = row * period; i < (row + 1) * period; ++i)
      sum += channel[i < late ? 0 : i - late] - channel[i];
    found.push_back(sum / static_cast<double>(period));
  }
  return found;
}

double relative_size(Recording const& recording, std::vector<double> part, bool has_gravity) {
  std::vector<std::vector<double>> basis;
  auto const add = [&](std::vector<double> const& all) {
    std::vector<double> next = only_moving(recording, all);
    double const before = rms(next);
    for (int round = 0; round < 2; ++round)  // Gram and Schmidt, twice: columns of a slow motion are alike
      for (auto const& known : basis) take_away(known, next);
    double const length = std::sqrt(product(next, next));
    if (rms(next) <= 1e-9 * before) return;
    for (double& x : next) x /= length;
    basis.push_back(std::move(next));
  };
  add(std::vector<double>(recording.means.size(), 1.0));
  for (auto const term : {&Mean::acceleration, &Mean::speed, &Mean::sliding}) add(column(recording, term));
  if (has_gravity)
    for (auto const term : {&Mean::sine, &Mean::cosine}) add(column(recording, term));
  part = only_moving(recording, std::move(part));
  for (int round = 0; round < 2; ++round)
    for (auto const& known : basis) take_away(known, part);
  return rms(part) / torque_rms(recording);
}

double relative_size(Recording const& recording, double Mean::*part, bool has_gravity) {
  return relative_size(recording, column(recording, part), has_gravity);
}

}  // namespace sticking
