#include "engine/infer/locate/wave_spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"

namespace torquescope {
namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double rounding = 1e-9;  // a range that is read back from its cells must give the same waves

// waves between `lowest` and `highest`, step: distance of the points in units of 1 / wave
void set_waves(WaveGrid& grid, double step, double lowest, double highest) {
  grid.highest = highest;
  grid.length = static_cast<Eigen::Index>(std::bit_ceil(static_cast<std::size_t>(2 * grid.points)));
  grid.spacing = 1.0 / (step * static_cast<double>(grid.length));
  grid.first = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(lowest / grid.spacing - rounding)));
  grid.last = std::min(grid.length / 2 - 1, static_cast<Eigen::Index>(std::floor(highest / grid.spacing + rounding)));
}

// least squares at one wave: energy = cos_cos c^2 + 2 cos_sin c s + sin_sin s^2 with c, s the sums of x cos, x sin
struct WaveForm {
  double cos_cos = 0.0, cos_sin = 0.0, sin_sin = 0.0;
};

std::vector<WaveForm> wave_forms(WaveGrid const& grid) {
  std::vector<Complex> weights(static_cast<std::size_t>(grid.length)), sums;
  for (Eigen::Index at : grid.point) weights[static_cast<std::size_t>(at)] += 1.0;
  Eigen::FFT<double> fft;
  fft.fwd(sums, weights);
  double const n = static_cast<double>(grid.point.size());
  std::vector<WaveForm> forms;
  for (Eigen::Index wave = grid.first; wave <= grid.last; ++wave) {
    Complex const twice = sums[static_cast<std::size_t>((2 * wave) % grid.length)];
    double const cc = 0.5 * (n + twice.real()), ss = 0.5 * (n - twice.real()), cs = -0.5 * twice.imag();
    double const determinant = cc * ss - cs * cs;
    // rows so few or so bunched that cosine and sine are one column: the energy of that column
    constexpr double one_column = 1e-9;
    if (determinant > one_column * n * n)
      forms.push_back({ss / determinant, -cs / determinant, cc / determinant});
    else
      forms.push_back({1.0 / n, 0.0, 1.0 / n});
  }
  return forms;
}

double energy(WaveForm const& form, Complex sum) {
  double const c = sum.real(), s = -sum.imag();
  return form.cos_cos * c * c + 2.0 * form.cos_sin * c * s + form.sin_sin * s * s;
}

struct WaveWork {
  Eigen::FFT<double> fft{};
  std::vector<Complex> points{}, sums{};
};

// column of x: the recording, then the replicates
Eigen::VectorXd deviation(MismatchRows const& rows, Eigen::Index column) {
  if (column == 0) return rows.residual - rows.replicate_mean;
  double const m = static_cast<double>(rows.n_replicates());
  return std::sqrt((m + 1.0) / (m - 1.0)) * (rows.replicates.col(column - 1) - rows.replicate_mean);
}

}  // namespace

WaveGrid time_waves(MismatchRows const& rows, double highest_hz) {
  WaveGrid grid;
  if (rows.size() < 2) return grid;
  for (Eigen::Index at : rows.kept_rows) grid.point.push_back(at - rows.kept_rows.front());
  grid.points = grid.point.back() + 1;
  double const step = 1.0 / rows.rate_hz;
  set_waves(grid, step, 1.0 / (step * static_cast<double>(grid.points)), std::min(highest_hz, 0.5 * rows.rate_hz));
  return grid;
}

WaveGrid position_waves(MismatchRows const& rows, double highest) {
  constexpr double points_per_wave = 8.0;
  WaveGrid grid;
  if (rows.size() < 2) return grid;
  double const least = rows.q.minCoeff(), range = rows.q.maxCoeff() - least;
  if (!(range > 0.0) || !(highest > 0.0)) return grid;
  double const most_waves = 0.5 * static_cast<double>(rows.size());
  double const waves = std::min(highest * range / two_pi, most_waves);
  if (waves < 1.0) return grid;
  grid.points = static_cast<Eigen::Index>(std::ceil(points_per_wave * waves - rounding));
  double const step = range / static_cast<double>(grid.points);
  for (double q : rows.q)
    grid.point.push_back(std::min(grid.points - 1, static_cast<Eigen::Index>((q - least) / step)));
  set_waves(grid, step, 1.0 / range, waves / range);
  grid.spacing *= two_pi;
  grid.highest *= two_pi;
  return grid;
}

Eigen::MatrixXd band_energies(MismatchRows const& rows, WaveGrid const& grid, std::vector<WaveBand> const& bands,
                              int threads) {
  Eigen::Index const columns = rows.n_replicates() + 1;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(bands.size()), columns);
  if (grid.last < grid.first) return result;
  TORQUESCOPE_EXPECT(static_cast<Eigen::Index>(grid.point.size()) == rows.size());
  auto const forms = wave_forms(grid);
  std::vector<WaveWork> workspaces(static_cast<std::size_t>(std::max(1, threads)));
  // two real columns in one complex transform
  parallel_for(static_cast<std::size_t>((columns + 1) / 2), threads, [&](std::size_t pair, int thread) {
    auto const a = static_cast<Eigen::Index>(2 * pair), b = a + 1;
    WaveWork& work = workspaces[static_cast<std::size_t>(thread)];
    work.points.assign(static_cast<std::size_t>(grid.length), 0.0);
    Eigen::VectorXd const first = deviation(rows, a);
    Eigen::VectorXd const second = b < columns ? deviation(rows, b) : Eigen::VectorXd::Zero(rows.size());
    for (Eigen::Index i = 0; i < rows.size(); ++i)
      work.points[static_cast<std::size_t>(grid.point[static_cast<std::size_t>(i)])] += Complex(first[i], second[i]);
    work.fft.fwd(work.sums, work.points);

    for (std::size_t band = 0; band < bands.size(); ++band) {
      double of_first = 0.0, of_second = 0.0;
      for (Eigen::Index wave = bands[band].first; wave <= bands[band].last; ++wave) {
        WaveForm const& form = forms[static_cast<std::size_t>(wave - grid.first)];
        Complex const plus = work.sums[static_cast<std::size_t>(wave)];
        Complex const minus = std::conj(work.sums[static_cast<std::size_t>(grid.length - wave)]);
        of_first += energy(form, 0.5 * (plus + minus));
        of_second += energy(form, Complex(0.0, -0.5) * (plus - minus));
      }
      result(static_cast<Eigen::Index>(band), a) = of_first / grid.overlap();
      if (b < columns) result(static_cast<Eigen::Index>(band), b) = of_second / grid.overlap();
    }
  });
  return result;
}

}  // namespace torquescope
