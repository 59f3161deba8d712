#include "engine/infer/decision/strip.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/data/encoder_step.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/data/spline_motion.hpp"
#include "engine/infer/decision/sticking_shape.hpp"
#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"

namespace torquescope {
namespace {

constexpr double per_band = 2.56, per_cutoff = 6.0;  // samples a second for each Hz
constexpr double below_half_of_rate = 0.4;
constexpr double noise_span = 4.0;      // of white noise, in standard deviations
constexpr double reversal_steps = 1.5;  // of the encoder, before a direction counts
constexpr double quiet_periods = 0.25;  // of the motion's cut-off, to either side

FilterOptions driving_options(FilterOptions options, double rate_hz) {
  constexpr double most_of_rate = 0.4;
  double const wide_hz = std::min(per_cutoff * parallel_cutoff_of(options), most_of_rate * rate_hz);
  if (options.cutoff_hz > 0.0) options.cutoff_hz = std::max(options.cutoff_hz, wide_hz);
  return options;
}

// rows as far apart as effects are: a job that names no rate keeps every sample
FilterOptions thinning(FilterOptions options, double rate_hz, double cutoff_hz) {
  auto const factor = cutoff_hz > 0.0 ? std::floor(rate_hz / (per_cutoff * cutoff_hz)) : 1.0;
  if (options.decimate_to_hz > 0.0 || factor < 2.0) return options;
  options.parallel_cutoff_hz = cutoff_hz;
  options.decimate_to_hz = rate_hz / factor;
  return options;
}

// the largest step that divides the filter's own and is fast enough
Eigen::Index effect_step(ParallelFilter const& filter, double rate_hz, double band_hz, double cutoff_hz) {
  if (band_hz == 0.0 || cutoff_hz == 0.0) return 1;
  double const least_hz = std::max(per_band * band_hz, per_cutoff * cutoff_hz);
  Eigen::Index const factor = filter.decimation();
  for (Eigen::Index step = factor; step > 1; --step)
    if (factor % step == 0 && rate_hz / static_cast<double>(step) >= least_hz) return step;
  return 1;
}

Eigen::VectorXd thinned(Eigen::VectorXd const& signal, Eigen::Index first, Eigen::Index step) {
  return signal(Eigen::seqN(first, (signal.size() - first + step - 1) / step, step));
}

// largest minus smallest position within `reach` samples to either side
Eigen::VectorXd moving_range(Eigen::VectorXd const& q, Eigen::Index reach) {
  Eigen::Index const n = q.size();
  Eigen::VectorXd range(n);
  std::deque<Eigen::Index> high, low;
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    for (; next < std::min(n, k + reach + 1); ++next) {
      while (!high.empty() && q[high.back()] <= q[next]) high.pop_back();
      while (!low.empty() && q[low.back()] >= q[next]) low.pop_back();
      high.push_back(next);
      low.push_back(next);
    }
    while (high.front() < k - reach) high.pop_front();
    while (low.front() < k - reach) low.pop_front();
    range[k] = q[high.front()] - q[low.front()];
  }
  return range;
}

// those within any window of that half width in which the position stays within one step
std::vector<char> quiet_samples(Eigen::VectorXd const& q, Eigen::Index reach, double step) {
  Eigen::VectorXd const range = moving_range(q, reach);
  double const within = step * (1.0 + 1e-6);
  std::vector<char> quiet(static_cast<std::size_t>(q.size()), 0);
  Eigen::Index marked = 0;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (range[k] > within) continue;
    Eigen::Index const end = std::min(q.size(), k + reach + 1);
    for (Eigen::Index i = std::max(marked, k - reach); i < end; ++i) quiet[static_cast<std::size_t>(i)] = 1;
    marked = end;
  }
  return quiet;
}

// A direction counts once the position has come back by `far` from where it turned, and from there on
Eigen::VectorXd kept_direction(Eigen::VectorXd const& q, double far) {
  Eigen::Index const n = q.size();
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(n);
  double now = 0.0, highest = q[0], lowest = q[0];
  Eigen::Index at_highest = 0, at_lowest = 0;  // the last samples there
  for (Eigen::Index k = 0; k < n; ++k) {
    if (q[k] >= highest) highest = q[at_highest = k];
    if (q[k] <= lowest) lowest = q[at_lowest = k];
    double const turned = q[k] < highest - far && now >= 0.0 ? -1.0 : q[k] > lowest + far && now <= 0.0 ? 1.0 : 0.0;
    if (turned != 0.0) {
      Eigen::Index const from = now == 0.0 ? 0 : (turned > 0.0 ? at_lowest : at_highest) + 1;
      direction.segment(from, k - from).setConstant(turned);
      now = turned;
      highest = lowest = q[at_highest = at_lowest = k];
    }
    direction[k] = now;
  }
  return direction;
}

// more rows than the cut-off asks for say the same once more
Eigen::Index rows_apart_of(ParallelFilter const& full, double cutoff_hz) {
  if (cutoff_hz == 0.0) return 1;
  return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(full.kept_rate_hz() / (per_band * cutoff_hz)));
}

std::vector<Eigen::Index> rows_of(Recording const& recording, Motion const& motion, ParallelFilter const& full,
                                  double cutoff_hz) {
  auto const left_out = left_out_samples(motion, cutoff_hz), saturated = saturated_samples(recording, cutoff_hz);
  Eigen::VectorXd is_there(motion.q.size());
  for (Eigen::Index k = 0; k < is_there.size(); ++k) {
    auto const at = static_cast<std::size_t>(k);
    is_there[k] = left_out[at] || saturated[at] ? 0.0 : 1.0;
  }
  Eigen::VectorXd const kept = full.pick(is_there);
  Eigen::Index const apart = rows_apart_of(full, cutoff_hz);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < kept.size(); i += apart)
    if (kept[i] == 1.0) rows.push_back(i);
  return rows;
}

BaselineReference beside_at(Recording const& recording, Eigen::Index first, Eigen::Index step) {
  BaselineReference beside;
  if (recording.gear_load.size() > 0)
    beside.gear_load = std::make_shared<Eigen::VectorXd const>(thinned(recording.gear_load, first, step));
  if (recording.given) {
    GivenSignals given = *recording.given;
    for (auto& effect : given.effects) {
      Eigen::Index const count = (effect.columns.rows() - first + step - 1) / step;
      effect.columns = effect.columns(Eigen::seqN(first, count, step), Eigen::all).eval();
    }
    beside.given = std::make_shared<GivenSignals const>(std::move(given));
  }
  beside.rate_hz = recording.rate_hz / static_cast<double>(step);
  return beside;
}

// Signals with jumps, which picking every step-th sample would move and alias
Eigen::MatrixXd below_half_rate(Eigen::MatrixXd const& signals, StripFilters const& filters) {
  if (filters.step == 1) return signals;
  FilterOptions low;
  low.cutoff_hz = below_half_of_rate * filters.rate_hz / static_cast<double>(filters.step);
  return smooth_positions(signals, low, filters.rate_hz);
}

// Standard deviation of white noise, by fourth differences: what the motion bends is gone from them
double noise_of(Eigen::VectorXd const& q) {
  constexpr double of_differences = 8.366600265340756, median_of_normal = 0.6744897501960817;  // sqrt(70)
  if (q.size() < 5) return 0.0;
  std::vector<double> sizes;
  for (Eigen::Index k = 2; k + 2 < q.size(); ++k)
    sizes.push_back(std::abs(q[k - 2] - 4.0 * q[k - 1] + 6.0 * q[k] - 4.0 * q[k + 1] + q[k + 2]));
  auto const middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / (of_differences * median_of_normal);
}

}  // namespace

std::shared_ptr<StripFilters const> strip_filters(Recording const& recording, FilterOptions const& options,
                                                  Section const& section) {
  auto filters = std::make_shared<StripFilters>();
  filters->options = options;
  filters->rate_hz = recording.rate_hz;
  filters->samples = recording.position.size();
  filters->cutoff_hz = parallel_cutoff_of(options);
  filters->drive_options = driving_options(options, recording.rate_hz);
  auto const whole = std::make_shared<ParallelFilter const>(thinning(options, recording.rate_hz, filters->cutoff_hz),
                                                            recording.rate_hz, filters->samples, section);
  auto const of = [&](Eigen::Index step) {
    return step == 1 ? whole : std::make_shared<ParallelFilter const>(whole->of_every(step));
  };
  filters->step = effect_step(*whole, recording.rate_hz, options.cutoff_hz, filters->cutoff_hz);
  filters->drive_step = effect_step(*whole, recording.rate_hz, filters->drive_options.cutoff_hz, filters->cutoff_hz);
  filters->whole = whole;
  filters->effects = of(filters->step);
  filters->drive = of(filters->drive_step);
  return filters;
}

double position_resolution(Recording const& recording) {
  double const step = encoder_step(recording);
  return step > 0.0 ? step : noise_span * noise_of(recording.position);
}

Strip strip_of(Recording const& recording, std::shared_ptr<StripFilters const> const& filters, double resolution) {
  Strip strip;
  strip.filters = filters;
  Eigen::Index const step = filters->step, first = filters->whole->first_of(step);
  Motion const motion = differentiate(recording, filters->options, {});
  strip.rows = rows_of(recording, motion, *filters->whole, filters->cutoff_hz);
  strip.rows_apart = rows_apart_of(*filters->whole, filters->cutoff_hz);
  strip.motion = thinned(motion, first, step);
  strip.torque = thinned(below_half_rate(acting_torque(recording.torque), *filters).col(0), first, step);
  strip.motion.torque = strip.torque;
  strip.resolution = resolution > 0.0 ? resolution : position_resolution(recording);
  Eigen::VectorXd const direction = kept_direction(recording.position, reversal_steps * strip.resolution);
  strip.direction = thinned(below_half_rate(direction, *filters).col(0), first, step);
  // one after the other: of all at the full rate there are many
  each_sticking_side(motion.q, motion.dq, direction, sticking_bounds(strip.resolution), [&](auto const& side) {
    strip.sides.conservativeResize(strip.direction.size(), strip.sides.cols() + 1);
    strip.sides.rightCols(1) = thinned(below_half_rate(side, *filters).col(0), first, step);
  });
  // of a position that is not filtered, the torque's
  double const band_hz = filters->options.cutoff_hz > 0.0 ? filters->options.cutoff_hz : filters->cutoff_hz;
  double const cutoff_hz = band_hz > 0.0 ? band_hz : below_half_of_rate * filters->rate_hz;
  auto const reach = static_cast<Eigen::Index>(std::ceil(quiet_periods / cutoff_hz * filters->rate_hz));
  auto const quiet = quiet_samples(recording.position, reach, strip.resolution);
  for (Eigen::Index k = first; k < recording.position.size(); k += step)
    strip.is_quiet.push_back(quiet[static_cast<std::size_t>(k)]);
  Recording driving;
  driving.rate_hz = recording.rate_hz;
  driving.time_s = recording.time_s;
  driving.position = smooth_positions(recording.position, filters->drive_options, recording.rate_hz).col(0);
  driving.torque = recording.torque;
  Motion const drive = spline_motion(std::move(driving));
  strip.drive = torquescope::thinned(drive, filters->whole->first_of(filters->drive_step), filters->drive_step);
  strip.beside = beside_at(recording, first, step);
  return strip;
}

double Strip::quiet_share() const {
  return is_quiet.empty() ? 0.0
                          : static_cast<double>(std::count(is_quiet.begin(), is_quiet.end(), 1)) /
                                static_cast<double>(is_quiet.size());
}

double Strip::row_share() const {
  return static_cast<double>(rows.size() * static_cast<std::size_t>(rows_apart)) /
         static_cast<double>(filters->effects->kept_samples());
}

Eigen::Index Strip::memory() const {
  constexpr double periods = 3.0;
  double const cutoff_hz = filters->cutoff_hz,
               rate_hz = filters->effects->kept_rate_hz() / static_cast<double>(rows_apart);
  return static_cast<Eigen::Index>(std::ceil(cutoff_hz > 0.0 ? periods * rate_hz / cutoff_hz : periods));
}

namespace {

Eigen::MatrixXd weighed(Strip const& strip, Eigen::MatrixXd rows) {
  if (strip.row_weight.size() > 0) rows = strip.row_weight.asDiagonal() * rows;
  return rows;
}

}  // namespace

Eigen::MatrixXd on_rows(Strip const& strip, Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  return weighed(strip, strip.filters->effects->apply_columns(signals)(strip.rows, Eigen::all));
}

Eigen::MatrixXd drive_on_rows(Strip const& strip, Eigen::Ref<Eigen::MatrixXd const> const& signals) {
  return weighed(strip, strip.filters->drive->apply_columns(signals)(strip.rows, Eigen::all));
}

Eigen::VectorXd at_drive_rate(Strip const& strip, Eigen::VectorXd const& signal) {
  auto const& filters = *strip.filters;
  Eigen::Index const first = filters.whole->first_of(filters.step), drive = filters.whole->first_of(filters.drive_step);
  Eigen::VectorXd at(strip.drive.q.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::Index const sample = drive + k * filters.drive_step - first;
    at[k] = signal[std::clamp<Eigen::Index>((sample + filters.step / 2) / filters.step, 0, signal.size() - 1)];
  }
  return at;
}

}  // namespace torquescope
