#include "engine/data/filter_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/data/data_problem.hpp"
#include "engine/data/zero_phase.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index fewest_kept = 8;

char const* ordinal_ending(double n) {
  if (n == 2) return "nd";
  return n == 3 ? "rd" : "th";
}

}  // namespace

double parallel_cutoff_of(FilterOptions const& options) {
  return options.parallel_cutoff_hz > 0 ? options.parallel_cutoff_hz : 0.4 * options.decimate_to_hz;
}

double torque_band_of(FilterOptions const& options, double rate_hz) {
  double const cutoff_hz = parallel_cutoff_of(options);
  return cutoff_hz > 0.0 ? cutoff_hz : 0.4 * rate_hz;
}

void check_cutoff(char const* key, double cutoff_hz, double rate_hz, Section const& section) {
  validate(2 * cutoff_hz < rate_hz, [&] {
    auto const* where = 2 * cutoff_hz > rate_hz ? "above" : "at";
    return problem_at(
        section, key,
        fmt::format("{} = {:g} is {} half the sampling rate ({:g} Hz)", key, cutoff_hz, where, rate_hz / 2),
        fmt::format("{:.2g} to {:.2g} Hz suits a joint sampled at {:g} Hz", rate_hz / 50, rate_hz / 25, rate_hz));
  });
}

void check_source_rates(FilterOptions const& options, RowFacts const& rows, Section const& section) {
  auto const check = [&](char const* key, double cutoff_hz, char const* channel, double source_hz) {
    validate(source_hz == 0.0 || 2 * cutoff_hz < source_hz, [&] {
      return problem_at(
          section, key,
          fmt::format("{} = {:.4g} is above half the rate of the {}, which is renewed at {:.4g} Hz only", key,
                      cutoff_hz, channel, source_hz),
          fmt::format("{} = {:.2g}, or log the {} at a higher rate", key, highest_share_of_rate * source_hz, channel));
    });
  };
  check("cutoff_hz", options.cutoff_hz, "position", rows.position_hz);
  check("parallel_cutoff_hz", parallel_cutoff_of(options), "torque", rows.torque_hz);
}

void check_length(FilterOptions const& options, Eigen::Index n_samples, double rate_hz) {
  auto const any_cutoff = butterworth_lowpass(static_cast<int>(options.order), 0.1 * rate_hz, rate_hz);
  Eigen::Index const needed = std::max(padding_of(any_cutoff) + 1, 2 * edge_samples(options, rate_hz) + fewest_kept);
  validate(n_samples >= needed, [&] {
    return bad_data(
        fmt::format("a recording of {:.4g} s ({} samples) is shorter than the filter, which needs {} samples",
                    static_cast<double>(n_samples) / rate_hz, n_samples, needed),
        "", 0,
        "record longer, or raise the cut-offs of [filter]: edge_s drops three periods of the lowest at each end");
  });
}

Eigen::Index decimation_factor(FilterOptions const& options, double rate_hz, Section const& section) {
  double const wanted_hz = options.decimate_to_hz;
  if (wanted_hz == 0) return 1;
  constexpr double whole = 1e-4;  // relative: rates are written with some digits only
  validate(wanted_hz <= rate_hz * (1 + whole), [&] {
    return problem_at(section, "decimate_to_hz",
                      fmt::format("decimate_to_hz = {:g} is above the sampling rate ({:g} Hz)", wanted_hz, rate_hz),
                      "decimation only drops samples: leave it out to keep them all");
  });
  double const ratio = rate_hz / wanted_hz, factor = std::max(1.0, std::round(ratio));
  validate(std::fabs(ratio - factor) <= whole * ratio, [&] {
    return problem_at(section, "decimate_to_hz",
                      fmt::format("decimate_to_hz = {:g} does not divide the sampling rate ({:g} Hz) into whole steps",
                                  wanted_hz, rate_hz),
                      factor == 1 ? fmt::format("the nearest that does: decimate_to_hz = {:g} (every sample)", rate_hz)
                                  : fmt::format("the nearest that does: decimate_to_hz = {:g} (every {:g}{} sample)",
                                                rate_hz / factor, factor, ordinal_ending(factor)));
  });
  double const kept_hz = rate_hz / factor, cutoff_hz = parallel_cutoff_of(options);
  validate(2 * cutoff_hz < kept_hz, [&] {
    return problem_at(
        section, "parallel_cutoff_hz",
        fmt::format("parallel_cutoff_hz = {:g} is not below half of decimate_to_hz ({:g} Hz): what lies between "
                    "folds back",
                    cutoff_hz, kept_hz / 2),
        fmt::format("parallel_cutoff_hz = {:g}, or a higher decimate_to_hz", 0.4 * kept_hz));
  });
  return static_cast<Eigen::Index>(factor);
}

Eigen::Index edge_samples(FilterOptions const& options, double rate_hz) {
  constexpr double rounding = 1e-9;
  if (options.edge_s >= 0) return static_cast<Eigen::Index>(std::ceil(options.edge_s * rate_hz - rounding));
  double lowest_hz = 0.0;
  for (double cutoff_hz : {options.cutoff_hz, parallel_cutoff_of(options)})
    if (cutoff_hz > 0) lowest_hz = lowest_hz > 0 ? std::min(lowest_hz, cutoff_hz) : cutoff_hz;
  constexpr Eigen::Index one_sided = 2;  // differences at the ends look to one side only, twice
  return lowest_hz > 0 ? static_cast<Eigen::Index>(std::ceil(3 / lowest_hz * rate_hz - rounding)) : one_sided;
}

}  // namespace torquescope
