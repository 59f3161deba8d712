#include "engine/diagnose/torque_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/base/contract.hpp"
#include "engine/diagnose/disturbance_level.hpp"
#include "engine/diagnose/hat_functions.hpp"
#include "engine/simulate/lane_noise.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index fewest_blocks = 8;

Autoregression one_pole(double std, double corner_hz, double rate_hz) {
  double const memory = std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz);
  return {std, std * std::sqrt(1.0 - memory * memory), {memory}};
}

// what any record of this pipeline has in each octave, beside smooth functions of the recording's motion
class BandEnergies {
 public:
  BandEnergies(ProcessedRecord const& recording, RecordPipeline const& pipeline)
      : smooth_(beside(recording, pipeline)) {
    auto const rows = static_cast<Eigen::Index>(recording.kept_rows.size());
    constexpr std::size_t most_bands = 5;
    Eigen::VectorXd const residual = recording.residual_itself();
    for (std::size_t lag = fast_lag(pipeline); lags_.size() < most_bands; lag *= 2) {
      auto const used = static_cast<Eigen::Index>(bends(residual, recording.kept_rows, lag).size());
      if (used < fewest_blocks * static_cast<Eigen::Index>(steps_per_block * lag) || used > rows) break;
      lags_.push_back(lag);
    }
  }

  Eigen::Index count() const { return static_cast<Eigen::Index>(lags_.size()); }
  // where the lowest band is loudest, in samples of the kept rate
  double longest_period() const { return 2.0 * static_cast<double>(lags_.back()); }

  Eigen::VectorXd operator()(ProcessedRecord const& record) const {
    return of(record, record.residual_itself()).col(0);
  }
  // of signals on that record's rows: bands x signals
  Eigen::MatrixXd of(ProcessedRecord const& record, Eigen::MatrixXd const& signals) const {
    auto const& rows = record.kept_rows;
    Eigen::MatrixXd const& own = record.columns_themselves();
    Eigen::MatrixXd all(own.rows(), own.cols() + smooth_.cols());
    all << own, smooth_(rows, Eigen::all);
    Eigen::MatrixXd const left = left_of(signals, all);
    Eigen::MatrixXd energy(count(), signals.cols());
    for (Eigen::Index k = 0; k < signals.cols(); ++k)
      for (Eigen::Index band = 0; band < count(); ++band)
        energy(band, k) = median_of_blocks(bends(left.col(k), rows, lags_[static_cast<std::size_t>(band)]),
                                           lags_[static_cast<std::size_t>(band)]);
    return energy;
  }

 private:
  static constexpr std::size_t steps_per_block = 8;

  static Eigen::MatrixXd beside(ProcessedRecord const& recording, RecordPipeline const& pipeline) {
    Motion const& motion = recording.motion;
    Eigen::Index const n = motion.ddq.size();
    Eigen::VectorXd jerk = Eigen::VectorXd::Zero(n);
    jerk.segment(1, n - 2) = (motion.ddq.tail(n - 2) - motion.ddq.head(n - 2)) * (0.5 * motion.rate_hz);
    Eigen::VectorXd const dq = pipeline.picked(motion.dq), s = dq.array().sign();
    Eigen::VectorXd const t = Eigen::VectorXd::LinSpaced(s.size(), -1.0, 1.0);
    std::vector<Eigen::MatrixXd> parts{t, s.cwiseProduct(t), s.cwiseProduct(t.cwiseAbs2()), hats(dq, 12)};
    for (Eigen::VectorXd const& axis :
         {pipeline.picked(motion.q), pipeline.picked(motion.ddq), pipeline.filtered(jerk)}) {
      parts.push_back(hats(axis, 8));
      parts.push_back(s.asDiagonal() * parts.back());
    }
    return side_by_side(parts);
  }

  static std::vector<double> bends(Eigen::VectorXd const& values, std::vector<Eigen::Index> const& rows,
                                   std::size_t lag) {
    std::vector<double> squares;
    for (std::size_t i = lag; i + lag < rows.size(); ++i) {
      if (rows[i + lag] - rows[i - lag] != static_cast<Eigen::Index>(2 * lag)) continue;
      auto const at = static_cast<Eigen::Index>(i);
      auto const step = static_cast<Eigen::Index>(lag);
      double const bend = values[at - step] - 2.0 * values[at] + values[at + step];
      squares.push_back(bend * bend);
    }
    return squares;
  }

  static double median_of_blocks(std::vector<double> const& squares, std::size_t lag) {
    std::size_t const block = steps_per_block * lag;
    std::vector<double> energies;
    for (std::size_t from = 0; from + block <= squares.size(); from += block) {
      double sum = 0.0;
      for (std::size_t i = from; i < from + block; ++i) sum += squares[i];
      energies.push_back(sum / static_cast<double>(block));
    }
    if (energies.empty()) return 0.0;
    auto const middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
    std::nth_element(energies.begin(), middle, energies.end());
    return *middle;
  }

  Eigen::MatrixXd smooth_;  // kept samples x functions
  std::vector<std::size_t> lags_;
};

// of noise that is only logged, one standard deviation of it
struct UnitNoise {
  Eigen::VectorXd mean;      // energy in each band
  Eigen::VectorXd relative;  // its standard deviation, as a share of the mean
};

UnitNoise unit_noise(Autoregression const& model, BandEnergies const& energies, ProcessedRecord const& recording,
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

double deviance(Eigen::VectorXd const& wanted, Eigen::VectorXd const& model, Eigen::VectorXd const& relative) {
  Eigen::ArrayXd const ratio = wanted.array() / model.array();
  return (2.0 * (ratio - 1.0 - ratio.log()) / relative.array().square()).sum();
}

struct BandFit {
  double white = 0.0, slow = 0.0;  // variances
  double deviance = std::numeric_limits<double>::infinity();
};

// non-negative weighted least squares in one or two unknowns, reweighted to the gamma likelihood
BandFit fit_bands(Eigen::VectorXd const& wanted, Eigen::VectorXd const& none, UnitNoise const& white,
                  UnitNoise const* slow) {
  constexpr int rounds = 12;
  BandFit fit;
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
    // no band is quieter than a thousandth of what it has: a likelihood needs something to compare with
    model = model.cwiseMax(1e-3 * wanted);
  }
  fit.deviance = deviance(wanted, model, relative);
  return fit;
}

// energies of the recording, and of twins as they are
struct Bands {
  BandEnergies of;
  Eigen::VectorXd wanted{}, twins{};
  bool ran_away = false;

  bool can_tell() const {
    constexpr Eigen::Index fewest = 2;
    return !ran_away && of.count() >= fewest && wanted.minCoeff() > 0.0;
  }
};

Bands bands_of(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
               TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  Bands bands{BandEnergies(recording, pipeline)};
  if (bands.of.count() == 0) return bands;
  Eigen::MatrixXd all(bands.of.count(), static_cast<Eigen::Index>(twins));
  bands.ran_away =
      gather_twins(twin, pipeline, address, {0, twins}, workers, {column_each(all)}, [&](VisitedTwin const& visited) {
        all.col(static_cast<Eigen::Index>(visited.index)) = bands.of(visited.record);
      });
  bands.twins = all.rowwise().mean();
  bands.wanted = bands.of(recording);
  return bands;
}

// from the cut-off to an octave below the lowest band
std::vector<double> corners_to_try(Bands const& bands, RecordPipeline const& pipeline) {
  double const lowest = 0.5 * pipeline.kept_rate_hz() / bands.of.longest_period();
  double const top = pipeline.cutoff_hz() > 0.0 ? pipeline.cutoff_hz() : 0.25 * pipeline.kept_rate_hz();
  std::vector<double> corners;
  for (double corner = top; corner > 0.999 * lowest; corner /= std::numbers::sqrt2) corners.push_back(corner);
  return corners;
}

constexpr double of_two_parameters = 4.0;  // Akaike

}  // namespace

TorqueColour torque_colour(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                           TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  TORQUESCOPE_EXPECT(twins >= 8);
  TorqueColour result;
  result.white_std = twin.loop().torque_noise.std;
  // what a twin has without any torque noise: encoder, reversals, the loop
  TwinLoop loop = twin.loop();
  put_colour({}, pipeline.rate_hz(), loop);
  CleanTwin const quiet(twin.joint(), loop, twin.track(), twin.step_s());
  Bands const bands = bands_of(recording, quiet, pipeline, address, twins, workers);
  result.ran_away = bands.ran_away;
  if (!bands.can_tell()) return result;

  UnitNoise const white_noise = unit_noise(white(1.0), bands.of, recording, pipeline, address);
  BandFit best = fit_bands(bands.wanted, bands.twins, white_noise, nullptr);
  result.variance_error = white_noise.relative.maxCoeff();
  double corner_hz = 0.0;
  double least = best.deviance - of_two_parameters;
  for (double const corner : corners_to_try(bands, pipeline)) {
    UnitNoise const slow =
        unit_noise(one_pole(1.0, corner, pipeline.rate_hz()), bands.of, recording, pipeline, address);
    BandFit const tried = fit_bands(bands.wanted, bands.twins, white_noise, &slow);
    if (!(tried.deviance < least)) continue;
    least = tried.deviance;
    best = tried;
    corner_hz = corner;
    result.variance_error = slow.relative.maxCoeff();
  }
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
  std::string const white = fmt::format("the noise of the torque is read from what the model leaves: {:.2g} {} white",
                                        colour.white_std, unit);
  if (!(colour.slow_std > 0.0)) return white;
  return white + fmt::format(", {:.2g} {} below {:.2g} Hz", colour.slow_std, unit, colour.corner_hz);
}

}  // namespace torquescope
