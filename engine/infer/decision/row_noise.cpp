#include "engine/infer/decision/row_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace {

constexpr double per_octave = 0.5;  // bands: of two octaves

// the next power of two: what a transform is fast for
Eigen::Index padded(Eigen::Index n) {
  Eigen::Index length = 1;
  while (length < n) length *= 2;
  return length;
}

// waves of the band, [first, last) of length / 2; bands reach from the first wave to half the rate
struct Band {
  Eigen::Index first = 1, last = 1;
  double middle() const { return 0.5 * (std::log(static_cast<double>(first)) + std::log(static_cast<double>(last))); }
};

std::vector<Band> bands_of(Eigen::Index length) {
  std::vector<Band> bands;
  auto const waves = length / 2;
  for (Eigen::Index first = 1; first < waves;) {
    auto const next = static_cast<Eigen::Index>(std::ceil(static_cast<double>(first) * std::exp2(1.0 / per_octave)));
    bands.push_back({first, std::min(std::max(next, first + 1), waves)});
    first = bands.back().last;
  }
  return bands;
}

}  // namespace

OctavePowers octave_powers(Eigen::VectorXd const& signal) {
  Eigen::Index const n = signal.size(), length = padded(n);
  std::vector<double> time(static_cast<std::size_t>(length), 0.0);
  std::copy(signal.begin(), signal.end(), time.begin());
  std::vector<std::complex<double>> waves;
  Eigen::FFT<double> fft;
  fft.fwd(waves, time);
  auto const bands = bands_of(length);
  OctavePowers powers{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bands.size()))};
  for (std::size_t b = 0; b < bands.size(); ++b) {
    double sum = 0.0;
    for (Eigen::Index k = bands[b].first; k < bands[b].last; ++k) sum += std::norm(waves[static_cast<std::size_t>(k)]);
    // zeros behind the signal take their share of every wave
    powers.per_wave[static_cast<Eigen::Index>(b)] = sum / static_cast<double>(bands[b].last - bands[b].first) /
                                                    static_cast<double>(n) / static_cast<double>(length);
  }
  return powers;
}

OctavePowers less(OctavePowers const& whole, OctavePowers const& part) {
  return {(whole.per_wave - part.per_wave).cwiseMax(0.0)};
}

OctavePowers mean_of(std::vector<OctavePowers> const& all) {
  OctavePowers mean{Eigen::VectorXd::Zero(all.front().per_wave.size())};
  for (auto const& one : all) mean.per_wave += one.per_wave / static_cast<double>(all.size());
  return mean;
}

Eigen::VectorXd drawn_noise(OctavePowers const& powers, Eigen::Index n, NoiseAddress const& address) {
  Eigen::Index const length = padded(n);
  auto const bands = bands_of(length);
  RandomStream random({address.seed, address.replicate, RandomDomain::resampling}, address.step, 0);
  std::vector<std::complex<double>> waves(static_cast<std::size_t>(length), 0.0);
  std::size_t band = 0;
  for (Eigen::Index k = 1; k < length / 2; ++k) {
    while (band + 1 < bands.size() && k >= bands[band].last) ++band;
    // straight between the middles of neighbouring bands, in logarithms
    double const here = powers.per_wave[static_cast<Eigen::Index>(band)], at = std::log(static_cast<double>(k) + 0.5);
    bool const is_above = at > bands[band].middle();
    std::size_t const other = is_above ? std::min(band + 1, bands.size() - 1) : (band > 0 ? band - 1 : 0);
    double const there = powers.per_wave[static_cast<Eigen::Index>(other)];
    double power = here;
    if (other != band && here > 0.0 && there > 0.0) {
      double const share = (at - bands[band].middle()) / (bands[other].middle() - bands[band].middle());
      power = std::exp((1.0 - share) * std::log(here) + share * std::log(there));
    }
    double const size = std::sqrt(0.5 * power) * static_cast<double>(length);
    std::complex<double> const wave(size * random.normal(), size * random.normal());
    waves[static_cast<std::size_t>(k)] = wave;
    waves[static_cast<std::size_t>(length - k)] = std::conj(wave);
  }
  std::vector<double> time;
  Eigen::FFT<double> fft;
  fft.inv(time, waves);
  return Eigen::Map<Eigen::VectorXd const>(time.data(), n);
}

}  // namespace torquescope
