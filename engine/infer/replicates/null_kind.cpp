#include "engine/infer/replicates/null_kind.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/problem/hac.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

RandomStream stream_of(std::uint64_t seed, NullKind kind, Eigen::Index draw) {
  return {{seed, 0, RandomDomain::resampling}, static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(draw)};
}

Eigen::VectorXd white_noise(Eigen::Index n, RandomStream& random) {
  Eigen::VectorXd noise(n);
  for (double& one : noise) one = random.normal();
  return noise;
}

// mean of `span` neighbours of white noise, variance 1: correlation 1 - |lag| / span
Eigen::VectorXd bartlett_noise(Eigen::Index n, Eigen::Index span, RandomStream& random) {
  Eigen::VectorXd const white = white_noise(n + span - 1, random);
  Eigen::VectorXd noise(n);
  for (Eigen::Index i = 0; i < n; ++i) noise[i] = white.segment(i, span).sum();
  return noise / std::sqrt(static_cast<double>(span));
}

// the largest length up to n that a fast transform likes
Eigen::Index smooth_length(Eigen::Index n) {
  auto const is_smooth = [](Eigen::Index length) {
    for (Eigen::Index factor : {2, 3, 5})
      while (length % factor == 0) length /= factor;
    return length == 1;
  };
  while (!is_smooth(n)) --n;
  return n;
}

using Spectrum = std::vector<std::complex<double>>;

Spectrum spectrum_of(Eigen::VectorXd const& signal) {
  Spectrum const head(signal.data(), signal.data() + smooth_length(signal.size()));
  Spectrum result;
  Eigen::FFT<double> fft;
  fft.fwd(result, head);
  return result;
}

// a surrogate is periodic: the few rows beyond the transform's length go on with its beginning
Eigen::VectorXd surrogate(Spectrum spectrum, Eigen::Index n, RandomStream& random) {
  std::size_t const length = spectrum.size();
  for (std::size_t k = 1; 2 * k < length; ++k) {
    spectrum[k] = std::polar(std::abs(spectrum[k]), random.uniform(0.0, 2.0 * std::numbers::pi));
    spectrum[length - k] = std::conj(spectrum[k]);
  }
  Spectrum signal;
  Eigen::FFT<double> fft;
  fft.inv(signal, spectrum);
  Eigen::VectorXd result(n);
  for (Eigen::Index i = 0; i < n; ++i) result[i] = signal[static_cast<std::size_t>(i) % length].real();
  return result;
}

}  // namespace

std::vector<std::string> null_words() { return {"twins", "iid", "hac", "surrogate"}; }

NullKind null_of(std::string const& word) {
  auto const words = null_words();
  auto const at = std::find(words.begin(), words.end(), word);
  TORQUESCOPE_EXPECT(at != words.end());
  return static_cast<NullKind>(at - words.begin());
}

void replace_null(TwinComparison& comparison, NullKind kind, std::uint64_t seed, int threads) {
  TORQUESCOPE_EXPECT(!comparison.ran_away);
  if (kind == NullKind::twins) return;
  auto& rows = comparison.rows;
  auto const& columns = comparison.recording.columns;
  auto const& residual = comparison.recording.residual;
  Eigen::Index const n = residual.size();
  auto const free = static_cast<double>(n - columns.cols());
  // the fit took its share of the noise
  double const enlarged = std::sqrt(static_cast<double>(n) / free);
  std::vector<Eigen::Index> const whole{0, n};
  Eigen::Index const span = kind == NullKind::hac ? andrews_lags({columns, residual, whole}) + 1 : 1;
  Spectrum const spectrum = kind == NullKind::surrogate ? spectrum_of(residual) : Spectrum{};

  Eigen::MatrixXd draws(n, rows.n_twins());
  parallel_for(static_cast<std::size_t>(draws.cols()), threads, [&](std::size_t i, int) {
    auto const draw = static_cast<Eigen::Index>(i);
    RandomStream random = stream_of(seed, kind, draw);
    if (kind == NullKind::iid)
      draws.col(draw) = white_noise(n, random) * (residual.norm() / std::sqrt(free));
    else if (kind == NullKind::hac)
      draws.col(draw) = residual.cwiseProduct(bartlett_noise(n, span, random)) * enlarged;
    else
      draws.col(draw) = surrogate(spectrum, n, random) * enlarged;
  });
  Eigen::MatrixXd const fits = solve_scaled(columns, draws);
  rows.twins = draws - columns * fits;
  rows.twin_mean = rows.twins.rowwise().mean();
  comparison.twin_fits = fits.transpose().rowwise() + comparison.recording.parameters.transpose();
}

}  // namespace torquescope
