#include "engine/infer/replicates/torque_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/fit/statistics/chi_squared.hpp"
#include "engine/infer/replicates/octave_energies.hpp"
#include "engine/simulate/lane_noise.hpp"

namespace torquescope {
namespace {

Autoregression one_pole(double std, double corner_hz, double rate_hz) {
  double const memory = std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz);
  return {std, std * std::sqrt(1.0 - memory * memory), {memory}};
}

// of noise that is only logged, one standard deviation of it
struct UnitNoise {
  Eigen::VectorXd mean;      // in each octave
  Eigen::VectorXd relative;  // its standard deviation, as a share of the mean
};

UnitNoise unit_noise(Autoregression const& model, OctaveEnergies const& energies, ProcessedRecord const& recording,
                     RecordPipeline const& pipeline, TwinAddress const& address) {
  constexpr std::uint32_t groups = 2;
  Eigen::MatrixXd draws(pipeline.samples(), static_cast<Eigen::Index>(twin_lanes));
  Eigen::MatrixXd all(energies.count(), static_cast<Eigen::Index>(groups * twin_lanes));
  for (std::uint32_t group = 0; group < groups; ++group) {
    LaneNoise noise(address, TwinStream::torque, group, model);
    alignas(64) double now[twin_lanes];
    for (Eigen::Index k = 0; k < draws.rows(); ++k) {
      noise.next(now);
      for (std::size_t lane = 0; lane < twin_lanes; ++lane) draws(k, static_cast<Eigen::Index>(lane)) = now[lane];
    }
    all.middleCols(static_cast<Eigen::Index>(group * twin_lanes), draws.cols()) =
        energies.of(recording, pipeline.filtered_columns(draws, recording));
  }
  UnitNoise result;
  result.mean = all.rowwise().mean();
  Eigen::VectorXd const variance =
      (all.colwise() - result.mean).rowwise().squaredNorm() / static_cast<double>(all.cols() - 1);
  result.relative = variance.cwiseSqrt().cwiseQuotient(result.mean);
  return result;
}

struct NoiseFit {
  double white = 0.0, slow = 0.0;  // variances
  double deviance = std::numeric_limits<double>::infinity();
};

// non-negative weighted least squares in one or two unknowns, reweighted to the gamma likelihood
NoiseFit fit_noise(Eigen::VectorXd const& wanted, Eigen::VectorXd const& none, UnitNoise const& white,
                   UnitNoise const* slow) {
  constexpr int rounds = 12;
  NoiseFit fit;
  Eigen::VectorXd model = wanted.cwiseMax(none);
  Eigen::VectorXd const relative = slow == nullptr ? white.relative : white.relative.cwiseMax(slow->relative);
  for (int round = 0; round < rounds; ++round) {
    Eigen::ArrayXd const weight = (relative.array() * model.array()).inverse();
    Eigen::VectorXd const y = (wanted - none).array() * weight, w = white.mean.array() * weight;
    fit.white = std::max(0.0, w.dot(y) / w.squaredNorm());
    fit.slow = 0.0;
    if (slow != nullptr) {
      Eigen::VectorXd const s = slow->mean.array() * weight;
      double const determinant = w.squaredNorm() * s.squaredNorm() - w.dot(s) * w.dot(s);
      double const both_white = (s.squaredNorm() * w.dot(y) - w.dot(s) * s.dot(y)) / determinant;
      double const both_slow = (w.squaredNorm() * s.dot(y) - w.dot(s) * w.dot(y)) / determinant;
      if (both_white >= 0.0 && both_slow >= 0.0) {
        fit.white = both_white;
        fit.slow = both_slow;
      } else if (both_slow > 0.0) {
        fit.white = 0.0;
        fit.slow = std::max(0.0, s.dot(y) / s.squaredNorm());
      }
    }
    model = none + fit.white * white.mean;
    if (slow != nullptr) model += fit.slow * slow->mean;
    // no octave is quieter than a thousandth of what it has: a likelihood needs something to compare with
    model = model.cwiseMax(1e-3 * wanted);
  }
  Eigen::ArrayXd const ratio = wanted.array() / model.array();
  fit.deviance = (2.0 * (ratio - 1.0 - ratio.log()) / relative.array().square()).sum();
  return fit;
}

}  // namespace

TorqueColour torque_colour(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  TORQUESCOPE_EXPECT(twins >= 8);
  TorqueColour result;
  result.white_std = twin.loop().torque_noise.std;
  OctaveEnergies const energies(recording, pipeline);
  constexpr Eigen::Index fewest_octaves = 2;
  if (energies.count() < fewest_octaves) return result;

  // what a twin has without any torque noise: encoder, reversals, the loop
  TwinLoop loop = twin.loop();
  put_colour({}, pipeline.rate_hz(), loop);
  CleanTwin const quiet(twin.joint(), loop, twin.track(), twin.step_s());
  Eigen::MatrixXd of_twins(energies.count(), static_cast<Eigen::Index>(twins));
  result.ran_away = gather_twins(quiet, pipeline, address, {0, twins}, workers, {column_each(of_twins)},
                                 [&](VisitedTwin const& visited) {
                                   of_twins.col(static_cast<Eigen::Index>(visited.index)) = energies(visited.record);
                                 });
  if (result.ran_away) return result;
  Eigen::VectorXd const none = of_twins.rowwise().mean();
  Eigen::VectorXd const wanted = energies(recording);
  if (wanted.minCoeff() <= 0.0) return result;

  // white alone, or with a slow part of whichever corner when that is worth its two parameters
  UnitNoise const white_noise = unit_noise(white(1.0), energies, recording, pipeline, address);
  NoiseFit best = fit_noise(wanted, none, white_noise, nullptr);
  result.variance_error = white_noise.relative.maxCoeff();
  constexpr double of_two_parameters = 4.0;  // Akaike
  double least = best.deviance - of_two_parameters;
  double corner_hz = 0.0;
  double const top = pipeline.cutoff_hz() > 0.0 ? pipeline.cutoff_hz() : 0.25 * pipeline.kept_rate_hz();
  double const bottom = 0.5 * energies.lowest_hz();
  for (double corner = top; corner > 0.999 * bottom; corner /= std::numbers::sqrt2) {
    UnitNoise const slow =
        unit_noise(one_pole(1.0, corner, pipeline.rate_hz()), energies, recording, pipeline, address);
    NoiseFit const tried = fit_noise(wanted, none, white_noise, &slow);
    if (!(tried.deviance < least)) continue;
    least = tried.deviance;
    best = tried;
    corner_hz = corner;
    result.variance_error = slow.relative.maxCoeff();
  }
  int const fitted = best.slow > 0.0 ? 3 : 1;
  // with no more octaves than parameters a colour that could be would leave nothing at all
  int const free = std::max(1, static_cast<int>(energies.count()) - fitted);
  result.misfit_p = chi_squared_tail(best.deviance, free);
  result.white_std = std::sqrt(best.white);
  result.slow_std = std::sqrt(best.slow);
  result.corner_hz = best.slow > 0.0 ? corner_hz : 0.0;
  return result;
}

void put_colour(TorqueColour const& colour, double rate_hz, TwinLoop& loop) {
  loop.torque_noise = white(colour.white_std);
  loop.torque_noise_variance_error = colour.variance_error;
  loop.slow_torque_noise = colour.slow_std > 0.0 ? one_pole(colour.slow_std, colour.corner_hz, rate_hz) : white(0.0);
}

std::string colour_remark(TorqueColour const& colour, std::string const& unit) {
  std::string white = fmt::format("the noise of the torque is read from what the model leaves: {:.2g} {} white",
                                  colour.white_std, unit);
  if (!(colour.slow_std > 0.0)) return white;
  return white + fmt::format(", {:.2g} {} below {:.2g} Hz", colour.slow_std, unit, colour.corner_hz);
}

}  // namespace torquescope
