#include "engine/data/filter_suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/data/butterworth.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/signal_facts.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {
namespace {

constexpr double grid_ratio = 1.15;
constexpr Eigen::Index most_samples = 200'000;  // enough of a long recording

// standard deviation of the position's white noise: its quantisation, or what its second differences show
double position_noise(Recording const& recording, Eigen::VectorXd const& position) {
  double const quantisation = recording.rows.encoder_step / std::sqrt(12.0);
  return std::max(quantisation, white_noise(position));
}

// the rate at which position and torque are known: a slow source holds less than the log
double known_rate_hz(Recording const& recording) {
  double rate_hz = recording.rate_hz;
  for (double const source_hz : {recording.rows.position_hz, recording.rows.torque_hz})
    if (source_hz > 0.0) rate_hz = std::min(rate_hz, source_hz);
  return rate_hz;
}

struct Band {
  double cutoff_hz;
  double position_energy;  // of the position low-passed there, about its mean
  double speed_energy;     // of the same, differentiated
  double acceleration_rms;
};

// the position's motion as low-pass filters of rising cut-off let it through
std::vector<Band> bands_of(Eigen::VectorXd const& position, double rate_hz, double known_hz) {
  std::vector<Band> bands;
  auto const n = position.size();
  double const lowest = std::max(2.0 * rate_hz / static_cast<double>(n), rate_hz * 1e-4);
  for (double cutoff_hz = highest_share_of_rate * known_hz; cutoff_hz > lowest; cutoff_hz /= grid_ratio) {
    auto const sections = butterworth_lowpass(4, cutoff_hz, rate_hz);
    if (padding_of(sections) >= n) continue;
    Eigen::VectorXd const smooth = zero_phase(sections, position);
    Eigen::ArrayXd const speed = (smooth.tail(n - 1) - smooth.head(n - 1)).array() * rate_hz;
    Eigen::ArrayXd const acceleration = (speed.tail(n - 2) - speed.head(n - 2)) * rate_hz;
    double const position_energy = (smooth.array() - smooth.mean()).square().sum();
    bands.push_back({cutoff_hz, position_energy, speed.square().sum(), std::sqrt(acceleration.square().mean())});
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

namespace {

// what a recording of one joint says of its filter
struct MotionFacts {
  std::vector<Band> bands{};
  Band widest{};          // below it noise is no fifth of the acceleration
  double noise_hz = 0.0;  // 0: no noise to see
  double reversals_per_second = 0.0;
};

MotionFacts motion_facts(Recording const& recording, double known_hz) {
  constexpr double share_of_noise = 0.2;
  double const rate_hz = recording.rate_hz;
  Eigen::VectorXd const position = recording.position.head(std::min(recording.position.size(), most_samples));
  MotionFacts facts;
  facts.bands = bands_of(position, rate_hz, known_hz);
  if (facts.bands.empty()) return facts;
  double const sigma = position_noise(recording, position);
  facts.widest = facts.bands.front();
  for (auto const& band : facts.bands)
    if (noise_of_acceleration(sigma, band.cutoff_hz, rate_hz) <= share_of_noise * band.acceleration_rms)
      facts.widest = band;
  if (facts.widest.cutoff_hz != facts.bands.back().cutoff_hz) facts.noise_hz = facts.widest.cutoff_hz;
  facts.reversals_per_second = reversals_per_second(position, facts.widest.cutoff_hz, rate_hz);
  return facts;
}

// what of a recording decides
struct Wanted {
  double rate_hz, known_hz, shortest_s, motion_hz, noise_hz, reversals_per_second;
  double least_hz;  // of a slow motion
};

FilterSuggestion suggestion_for(Wanted const& wanted) {
  using Limit = FilterSuggestion::Limit;
  constexpr double above_motion = 10.0;
  FilterSuggestion suggestion;
  suggestion.motion_hz = wanted.motion_hz;
  suggestion.noise_hz = wanted.noise_hz;
  bool const noise_matters = wanted.noise_hz > 0.0;
  double cutoff_hz = above_motion * wanted.motion_hz;
  auto const at_most = [&](double hz, Limit limit) {
    if (cutoff_hz > hz) suggestion.limit = limit;
    cutoff_hz = std::min(cutoff_hz, hz);
  };
  auto const at_least = [&](double hz, Limit limit) {
    if (cutoff_hz < hz) suggestion.limit = limit;
    cutoff_hz = std::max(cutoff_hz, hz);
  };
  if (noise_matters) at_most(wanted.noise_hz, Limit::noise);
  at_least(wanted.least_hz, Limit::slow_motion);
  // 1.6 periods of the parallel cut-off at each side of a reversal tell nothing: at most half of the time, where
  // the noise is not twice what it should be at most
  double const by_reversals = 2 * 6.4 * wanted.reversals_per_second;
  constexpr double bearable = 2.0;
  at_least(noise_matters ? std::min(by_reversals, bearable * wanted.noise_hz) : by_reversals, Limit::reversals);
  // three periods of the parallel cut-off go at each end: all together a fifth of the shortest recording
  at_least(2 * 30 / wanted.shortest_s, Limit::length);
  at_most(highest_share_of_rate * wanted.known_hz, Limit::rate);

  auto& options = suggestion.options;
  options.cutoff_hz = round_figure(cutoff_hz);
  options.parallel_cutoff_hz = options.cutoff_hz / 2;
  options.decimate_to_hz = suggested_kept_rate(wanted.rate_hz, options.parallel_cutoff_hz, wanted.shortest_s);
  return suggestion;
}

// the lowest band that holds `share` of an energy; of no energy the lowest
double band_of_share(std::vector<Band> const& bands, std::vector<double> const& energy, double whole, double share) {
  for (std::size_t k = 0; k < bands.size(); ++k)
    if (energy[k] >= share * whole) return bands[k].cutoff_hz;
  return bands.back().cutoff_hz;
}

}  // namespace

FilterSuggestion suggest_filter(Recording const& recording, double shortest_s) {
  constexpr double share_of_motion = 0.98, wide_enough_hz = 20.0;
  MotionFacts const facts = motion_facts(recording, known_rate_hz(recording));
  if (facts.bands.empty()) return {};
  std::vector<double> energy;
  for (auto const& band : facts.bands) energy.push_back(band.speed_energy);
  double const motion_hz = band_of_share(facts.bands, energy, facts.widest.speed_energy, share_of_motion);
  // friction at reversals is faster than a slow motion
  double const least_hz = std::min(recording.rate_hz / 12, wide_enough_hz);
  return suggestion_for({recording.rate_hz, known_rate_hz(recording), shortest_s, motion_hz, facts.noise_hz,
                         facts.reversals_per_second, least_hz});
}

FilterSuggestion suggest_arm_filter(std::span<Recording const> joints, double shortest_s) {
  constexpr double share_of_motion = 0.999;
  std::vector<double> energy;
  std::vector<Band> bands;
  double whole = 0.0, clearest_hz = 0.0, reversals = 0.0;
  bool sees_no_noise = false;
  double known_hz = std::numeric_limits<double>::infinity();
  for (auto const& joint : joints) known_hz = std::min(known_hz, known_rate_hz(joint));
  for (auto const& joint : joints) {
    MotionFacts const facts = motion_facts(joint, known_hz);
    if (facts.bands.empty()) return {};
    bands = facts.bands;  // joints of a recording have one rate and length: one grid
    energy.resize(bands.size(), 0.0);
    for (std::size_t k = 0; k < bands.size(); ++k) energy[k] += bands[k].position_energy;
    whole += facts.widest.position_energy;
    clearest_hz = std::max(clearest_hz, facts.noise_hz);
    sees_no_noise = sees_no_noise || facts.noise_hz == 0.0;
    reversals = std::max(reversals, facts.reversals_per_second);
  }
  if (bands.empty()) return {};
  double const motion_hz = band_of_share(bands, energy, whole, share_of_motion);
  return suggestion_for(
      {joints.front().rate_hz, known_hz, shortest_s, motion_hz, sees_no_noise ? 0.0 : clearest_hz, reversals, 0.0});
}

}  // namespace torquescope
