#include "engine/infer/replicates/octave_energies.hpp"

#include <numbers>
#include <utility>

#include "engine/base/median.hpp"
#include "engine/fit/statistics/hat_functions.hpp"
#include "engine/infer/replicates/disturbance_level.hpp"

namespace torquescope {
namespace {

constexpr std::size_t steps_per_block = 8;

Eigen::MatrixXd smooth_of_motion(Motion const& motion, RecordPipeline const& pipeline) {
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

// means over 2 half + 1 rows about each, weighed by Hann's window; those at the ends stay as they are
Eigen::VectorXd smoothed(Eigen::VectorXd const& values, std::size_t half) {
  if (half == 0) return values;
  auto const reach = static_cast<Eigen::Index>(half), n = values.size();
  Eigen::ArrayXd const places = Eigen::ArrayXd::LinSpaced(2 * reach + 1, -1.0, 1.0);
  Eigen::VectorXd window =
      1.0 + (std::numbers::pi * static_cast<double>(reach) / static_cast<double>(reach + 1) * places).cos();
  window /= window.sum();
  Eigen::VectorXd means = values;
  for (Eigen::Index i = reach; i + reach < n; ++i) means[i] = window.dot(values.segment(i - reach, 2 * reach + 1));
  return means;
}

// squares of second differences of such means, where no row they use is missing
std::vector<double> bends(Eigen::VectorXd const& values, std::vector<Eigen::Index> const& rows, Octave const& octave) {
  std::size_t const lag = octave.lag, reach = lag + octave.half;
  Eigen::VectorXd const means = smoothed(values, octave.half);
  std::vector<double> squares;
  for (std::size_t i = reach; i + reach < rows.size(); ++i) {
    if (rows[i + reach] - rows[i - reach] != static_cast<Eigen::Index>(2 * reach)) continue;
    auto const at = static_cast<Eigen::Index>(i);
    auto const step = static_cast<Eigen::Index>(lag);
    double const bend = means[at - step] - 2.0 * means[at] + means[at + step];
    squares.push_back(bend * bend);
  }
  return squares;
}

double median_of_blocks(std::vector<double> const& squares, std::size_t block) {
  std::vector<double> energies;
  for (std::size_t from = 0; from + block <= squares.size(); from += block) {
    double sum = 0.0;
    for (std::size_t i = from; i < from + block; ++i) sum += squares[i];
    energies.push_back(sum / static_cast<double>(block));
  }
  return energies.empty() ? 0.0 : upper_median(std::move(energies));
}

}  // namespace

OctaveEnergies::OctaveEnergies(ProcessedRecord const& recording, RecordPipeline const& pipeline)
    : smooth_(smooth_of_motion(recording.motion, pipeline)), rate_hz_(pipeline.kept_rate_hz()) {
  constexpr std::size_t most_octaves = 8, blocks_of_octave = 8;
  Eigen::VectorXd const residual = recording.residual_itself();
  auto const is_long_enough = [&](Octave const& octave) {
    return bends(residual, recording.kept_rows, octave).size() >= blocks_of_octave * steps_per_block * octave.lag;
  };
  for (std::size_t lag = fast_lag(pipeline); octaves_.size() < most_octaves; lag *= 2) {
    // a motion of short strokes has no room for means: better an octave that hears all above it than none
    Octave const of_means{lag, lag / 2}, of_rows{lag, 0};
    if (!is_long_enough(of_rows)) break;
    octaves_.push_back(is_long_enough(of_means) ? of_means : of_rows);
  }
}

double OctaveEnergies::lowest_hz() const { return rate_hz_ / (2.0 * static_cast<double>(octaves_.back().lag)); }

Eigen::VectorXd OctaveEnergies::operator()(ProcessedRecord const& record) const {
  return of(record, record.residual_itself()).col(0);
}

Eigen::MatrixXd OctaveEnergies::of(ProcessedRecord const& record, Eigen::MatrixXd const& signals) const {
  Eigen::MatrixXd const& own = record.columns_themselves();
  Eigen::MatrixXd columns(own.rows(), own.cols() + smooth_.cols());
  columns << own, smooth_(record.kept_rows, Eigen::all);
  Eigen::MatrixXd const left = left_of(signals, columns);
  Eigen::MatrixXd energy(count(), signals.cols());
  for (Eigen::Index k = 0; k < signals.cols(); ++k)
    for (Eigen::Index octave = 0; octave < count(); ++octave) {
      Octave const& one = octaves_[static_cast<std::size_t>(octave)];
      energy(octave, k) = median_of_blocks(bends(left.col(k), record.kept_rows, one), steps_per_block * one.lag);
    }
  return energy;
}

}  // namespace torquescope
