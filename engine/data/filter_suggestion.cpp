#include "engine/data/filter_suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/data/butterworth.hpp"
#include "engine/data/signal_facts.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {
namespace {

constexpr double highest_share_of_rate = 1.0 / 5, grid_ratio = 1.15;
constexpr Eigen::Index most_samples = 200'000;  // enough of a long recording

// standard deviation of the position's white noise: its quantisation, or what its second differences show
double position_noise(Recording const& recording, Eigen::VectorXd const& position) {
  double const quantisation = recording.rows.encoder_step / std::sqrt(12.0);
  return std::max(quantisation, white_noise(position));
}

struct Band {
  double cutoff_hz;
  double speed_energy;  // of the position low-passed there, differentiated
  double acceleration_rms;
};

// the position's motion as low-pass filters of rising cut-off let it through
std::vector<Band> bands_of(Eigen::VectorXd const& position, double rate_hz) {
  std::vector<Band> bands;
  auto const n = position.size();
  double const lowest = std::max(2.0 * rate_hz / static_cast<double>(n), rate_hz * 1e-4);
  for (double cutoff_hz = highest_share_of_rate * rate_hz; cutoff_hz > lowest; cutoff_hz /= grid_ratio) {
    auto const sections = butterworth_lowpass(4, cutoff_hz, rate_hz);
    if (padding_of(sections) >= n) continue;
    Eigen::VectorXd const smooth = zero_phase(sections, position);
    Eigen::ArrayXd const speed = (smooth.tail(n - 1) - smooth.head(n - 1)).array() * rate_hz;
    Eigen::ArrayXd const acceleration = (speed.tail(n - 2) - speed.head(n - 2)) * rate_hz;
    bands.push_back({cutoff_hz, speed.square().sum(), std::sqrt(acceleration.square().mean())});
  }
  std::reverse(bands.begin(), bands.end());
  return bands;
}

// changes of direction, each side faster than a fiftieth of the peak speed
double reversals_per_second(Eigen::VectorXd const& position, double cutoff_hz, double rate_hz) {
  constexpr double surely_moving = 0.02;
  Eigen::VectorXd const smooth = zero_phase(butterworth_lowpass(4, cutoff_hz, rate_hz), position);
  auto const n = smooth.size();
  Eigen::VectorXd const steps = smooth.tail(n - 1) - smooth.head(n - 1);
  double const least = surely_moving * steps.cwiseAbs().maxCoeff();
  double direction = 0.0;
  std::size_t reversals = 0;
  for (double step : steps) {
    if (std::fabs(step) <= least) continue;
    double const now = step > 0 ? 1.0 : -1.0;
    reversals += direction * now < 0;
    direction = now;
  }
  return static_cast<double>(reversals) * rate_hz / static_cast<double>(n);
}

double noise_of_acceleration(double sigma, double cutoff_hz, double rate_hz) {
  double const omega = 2 * std::numbers::pi * cutoff_hz;
  return sigma * omega * omega * std::sqrt(2 * cutoff_hz / (5 * rate_hz));
}

// the nearest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten
double round_figure(double value) {
  constexpr std::array steps{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
  double const power = std::pow(10.0, std::floor(std::log10(value)));
  auto const distance = [&](double step) { return std::fabs(std::log(value / (step * power))); };
  return power *
         *std::min_element(steps.begin(), steps.end(), [&](double a, double b) { return distance(a) < distance(b); });
}

int digits_of(double value) {
  int digits = 1;
  while (digits < 9 && std::fabs(value - std::stod(fmt::format("{:.{}e}", value, digits - 1))) > 1e-9 * value) ++digits;
  return digits;
}

}  // namespace

double suggested_kept_rate(double rate_hz, double parallel_cutoff_hz, double seconds) {
  constexpr double least_of_cutoff = 2.5, most_of_least = 1.6, rounding = 1e-9, rows_wanted = 1000;
  double const rows_hz = seconds > 0 ? rows_wanted / seconds : 0.0;
  double const least_hz = std::max(least_of_cutoff * parallel_cutoff_hz, rows_hz);
  double best = 0.0;
  for (double k = std::floor(rate_hz / least_hz * (1 + rounding)); k >= 2; --k) {
    double const kept_hz = rate_hz / k;
    if (best > 0 && kept_hz > most_of_least * least_hz * (1 + rounding)) break;
    if (best == 0 || digits_of(kept_hz) < digits_of(best)) best = kept_hz;
  }
  return best;
}

FilterSuggestion suggest_filter(Recording const& recording, double shortest_s) {
  using Limit = FilterSuggestion::Limit;
  constexpr double share_of_motion = 0.98, share_of_noise = 0.2, above_motion = 10.0, wide_enough_hz = 20.0;
  double const rate_hz = recording.rate_hz;
  Eigen::VectorXd const position = recording.position.head(std::min(recording.position.size(), most_samples));
  auto const bands = bands_of(position, rate_hz);
  FilterSuggestion suggestion;
  if (bands.empty()) return suggestion;

  double const sigma = position_noise(recording, position);
  Band const* widest = &bands.front();
  for (auto const& band : bands)
    if (noise_of_acceleration(sigma, band.cutoff_hz, rate_hz) <= share_of_noise * band.acceleration_rms) widest = &band;
  bool const noise_matters = widest != &bands.back();
  if (noise_matters) suggestion.noise_hz = widest->cutoff_hz;
  for (auto const& band : bands) {
    suggestion.motion_hz = band.cutoff_hz;
    if (band.speed_energy >= share_of_motion * widest->speed_energy) break;
  }

  double cutoff_hz = above_motion * suggestion.motion_hz;
  auto const at_most = [&](double hz, Limit limit) {
    if (cutoff_hz > hz) suggestion.limit = limit;
    cutoff_hz = std::min(cutoff_hz, hz);
  };
  auto const at_least = [&](double hz, Limit limit) {
    if (cutoff_hz < hz) suggestion.limit = limit;
    cutoff_hz = std::max(cutoff_hz, hz);
  };
  if (noise_matters) at_most(suggestion.noise_hz, Limit::noise);
  // friction at reversals is faster than a slow motion
  at_least(std::min(rate_hz / 12, wide_enough_hz), Limit::slow_motion);
  // 1.6 periods of the parallel cut-off at each side of a reversal tell nothing: at most half of the time, where
  // the noise is not twice what it should be at most
  double const by_reversals = 2 * 6.4 * reversals_per_second(position, widest->cutoff_hz, rate_hz);
  constexpr double bearable = 2.0;
  at_least(noise_matters ? std::min(by_reversals, bearable * suggestion.noise_hz) : by_reversals, Limit::reversals);
  // three periods of the parallel cut-off go at each end: all together a fifth of the shortest recording
  at_least(2 * 30 / shortest_s, Limit::length);
  at_most(highest_share_of_rate * rate_hz, Limit::rate);

  auto& options = suggestion.options;
  options.cutoff_hz = round_figure(cutoff_hz);
  options.parallel_cutoff_hz = options.cutoff_hz / 2;
  options.decimate_to_hz = suggested_kept_rate(rate_hz, options.parallel_cutoff_hz, shortest_s);
  return suggestion;
}

}  // namespace torquescope
