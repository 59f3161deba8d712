#pragma once
// The levels at which checks of recordings speak, each with its meaning and where it comes from.
//
// Derived    from sampling, rounding or counting: the formula stands beside the number
// Convention what nobody can derive, and a person may set otherwise: called so
// Units      as named; shares of one
// Source     quantisation noise: Widrow, Kollar 2008, Quantization Noise; effective number of rows: Bayley, Hammersley,
//            Suppl. J. R. Stat. Soc. 8 (1946) 184-197
// Threads    functions of their arguments

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace torquescope::levels {

// ---- factors and chance

// convention: a factor (degrees, rpm, a gear) that divides the error by five is worth a sentence
inline constexpr double factor_worth_saying = 5.0;

// convention: one chance in a thousand; of chi squared with one degree of freedom
inline constexpr double chi_squared_beyond_chance = 10.828;

// convention: standard errors below zero at which a mass is negative for sure (3.2e-5 of normal errors), and where the
// torque takes work out of the joint besides, which no passive joint allows (2.3e-2 beside what is certain already)
inline constexpr double surely_negative = 4.0, negative_beside_negative_work = 2.0;

// rows of a residual that tell as much as independent ones: n (1 - r) / (1 + r), r the correlation from row to row
double independent_rows(Eigen::Ref<Eigen::VectorXd const> const& residual);

// likelihood ratio of one parameter: n ln(e1^2 / e0^2)
inline bool is_larger_beyond_chance(double error, double least_error, double rows) {
  return rows * 2.0 * std::log(error / least_error) > chi_squared_beyond_chance;
}

// convention: a parameter that one row moves by more than a standard error without it, and by a hundredth, is that
// row's: friction may well change its sign for a single row where a joint turns
inline constexpr double errors_of_one_row = 1.0, share_of_one_row = 0.01;

// ---- what a motion tells apart

// convention: columns whose correlation (about zero) is 0.99 are one number; the variance of either value is 50 times
// what it would be alone, 1 / (1 - r^2)
inline constexpr double one_number = 0.99;
// derived: share s of moving time in one direction at which sign(dq) and a constant are one number: 2 s - 1 = r
inline constexpr double one_direction = (1.0 + one_number) / 2.0;
// derived: spread over mean at which a column and a constant are one number: mean / rms = r
inline double spread_of_constant() { return std::sqrt(1.0 / (one_number * one_number) - 1.0); }
// derived: 95th over 10th percentile of evenly spread speeds with that spread over their mean: viscous and Coulomb
// friction are one number
inline double one_speed_ratio() {
  double const half = std::numbers::sqrt3 * spread_of_constant();  // of the way from slowest to fastest, over the mean
  return (1.0 - half + 0.95 * 2.0 * half) / (1.0 - half + 0.10 * 2.0 * half);
}

// convention: share of moving time at one speed that leaves nothing to be said of effects of the velocity
inline constexpr double mostly_one_speed = 0.75;
// convention: a model that leaves 90 % of the torque (80 % of its energy) explains nothing
inline constexpr double no_relation = 0.9;
// convention: share of rows at a torque limit that is left out of a fit, and that which is worth a sentence
inline constexpr double rows_at_limit = 0.05, rows_at_limit_worth_saying = 0.001;
// derived: what a low-pass of this cut-off mixes: samples of its output half a period apart are independent (Nyquist)
inline double independent_after_s(double cutoff_hz) { return 0.5 / cutoff_hz; }
// derived: values a held torque needs in a period of the cut-off; the hold keeps sinc(1/4) = 90 % there
inline constexpr double fewest_updates_in_period = 4.0;

// ---- rounding and noise

// derived: standard deviation of rounding, in steps
inline double rounding_noise() { return 1.0 / std::sqrt(12.0); }
// derived: range of a sine over the noise beside it, for a ratio of their rms
inline double range_over_noise(double ratio) { return 2.0 * std::numbers::sqrt2 * ratio; }
// convention: motion below ten times its noise (20 dB) is standstill
inline constexpr double least_motion_over_noise = 10.0;
// convention: range of a motion in encoder steps from which its speed is more than rounding (1.6 % of a sine's rms)
inline constexpr double fewest_encoder_steps = 50.0;
// derived: rows of a joint that moves two steps a row never repeat: rounding moves either by half a step, and noise as
// small as a step by no more
inline constexpr double steps_that_never_repeat = 2.0;

// ---- rows that do not belong to the motion

// derived: after `held` repeated rows a row that makes up for them goes (held + 1) steps, that of a joint that stood
// still goes one: nearer to the first
inline double made_up_share(std::size_t held) {
  auto const steps = static_cast<double>(held + 1);
  return 0.5 * (1.0 + 1.0 / steps);
}
// convention: holds of so many rows count without the speed before them; derived: the row after makes up for them
inline constexpr std::size_t shortest_hold = 2;
inline constexpr double way_after_hold = static_cast<double>(shortest_hold + 1);
// convention: rows around a hold that say how fast the joint goes, and how much faster it may have gone unnoticed
inline constexpr std::size_t rows_around_hold = 50;
inline constexpr double faster_unnoticed = 1.5;
// convention: repeated rows are worth saying from three of them, and one in a thousand
inline constexpr double repeats_worth_saying = 3.0, share_of_repeats_worth_saying = 1e-3;

// ---- values that are no data

// convention: met four times (fewer are spikes) and three ranges of all others away; or in three places of up to five
// rows (the longest gap that is filled), at five times the steps beside them and ten typical ones, and eight steps of
// an encoder
inline constexpr std::size_t far_value_repeats = 4, far_value_places = 3, far_value_rows = 5;
inline constexpr double ranges_beyond = 3.0, times_steps_around = 5.0, times_typical_step = 10.0;
inline constexpr double times_encoder_step = 8.0;
// convention: of the places that lie so, whatever their value; spikes of a coarse channel are spread over many values
inline constexpr double far_value_share = 0.25;
// convention: rows around a single one that say how far a row is from its neighbours; four steps are no flicker
inline constexpr std::size_t rows_around_lone_row = 25, most_lone_rows = 30;
inline constexpr double steps_of_lone_row = 4.0, bends_of_lone_row = 3.0;
// convention: of an excursion, how far apart the rows before and after it may be
inline constexpr double returned_share = 0.3;

// ---- a source slower than its log

// convention: a source is slow from 1.75 rows on (below that single rows repeat, and are filled one by one); 30 runs
// tell it; a tenth of them may be cut short by a late refresh
inline constexpr double slow_from_rows = 1.75, runs_cut_short = 0.1;
inline constexpr std::size_t fewest_runs = 30;
// derived: a run of one sample is nearer to one than to two; a change of one step is nearer to one than to two
inline constexpr double one_sample_at_most = 1.5, one_step_at_most = 1.5;
// convention: a refresh comes up to half a period late, and the log adds a row; a longer run is several samples
inline constexpr double late_sample_at_most = 1.75;

// ---- a torque without its sign

// convention: reversals are ways of a fiftieth of the range; the torque touches zero at a twentieth of its largest,
// after it was above a fifth; a magnitude does so on a quarter of the reversals, and four of them are enough to judge
inline constexpr double way_of_reversal = 0.02, touch_of_zero = 0.05, away_from_zero = 0.2, touches_of_reversals = 0.25;
// convention: forwards and backwards alike; a signed torque that comes down to zero on one way and never goes below
// differs by friction over weight, which is then no small part of one
inline constexpr double same_both_ways = 1.0 / 3.0;
inline constexpr std::size_t fewest_reversals = 4;

// ---- stamps of arrival

// convention: steps below a quarter of the mean are within a burst; half of all steps are; a rate is the same within
// 2 % over tenths of the recording; no pause is longer than three of the mean one; the rate is known to 0.2 %
inline constexpr double within_burst = 0.25, steps_within_bursts = 0.5, same_rate = 0.02, longest_pause = 3.0;
inline constexpr std::size_t pieces_of_same_rate = 10;
inline constexpr double rate_of_arrivals_known_to = 0.002;

}  // namespace torquescope::levels
