#include "engine/simulate/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/simulate/references/reference_choice.hpp"

namespace torquescope {

namespace {

constexpr double unlimited = std::numeric_limits<double>::max();

using MakeReference = std::unique_ptr<Reference const> (*)(ReferenceOptions const&, double, RandomKey const&);

MakeReference const makers[] = {
#define TORQUESCOPE_CHOICE(name) &make_##name,
#include "reference_choices.inc"
#undef TORQUESCOPE_CHOICE
};

void check_frequencies(ReferenceOptions const& options, double rate_hz, Section const& section,
                       std::vector<Problem>& problems) {
  std::string const key = !options.frequencies_hz.empty() ? "frequencies_hz"
                          : !options.harmonics.empty()    ? "harmonics"
                                                          : "band_hz";
  std::vector<double> const frequencies = reference_frequencies_hz(options);
  if (frequencies.empty()) {
    problems.push_back(problem_at(
        section, key,
        fmt::format("no multiple of base_hz = {} lies within band_hz = {}", options.base_hz, to_text(options.band_hz)),
        "lower base_hz or widen band_hz"));
    return;
  }
  double const highest = *std::max_element(frequencies.begin(), frequencies.end());
  if (highest >= 0.5 * rate_hz)
    problems.push_back(problem_at(section, key,
                                  fmt::format("the reference goes up to {} Hz, but rate_hz = {}", highest, rate_hz),
                                  fmt::format("keep frequencies below {} Hz", 0.5 * rate_hz)));
  for (double const harmonic : options.harmonics)
    if (harmonic != std::round(harmonic))
      problems.push_back(problem_at(section, "harmonics", fmt::format("harmonic {} is not a whole number", harmonic),
                                    "write whole numbers, or use frequencies_hz"));
}

void check_strokes(ReferenceOptions const& options, double duration_s, Section const& section,
                   std::vector<Problem>& problems) {
  if (options.speeds.empty()) {
    problems.push_back(problem_at(section, "speeds", "speeds = [] leaves the trapezoid without a speed",
                                  "write at least one, for example speeds = [0.3, 1.0]"));
    return;
  }
  double const fastest = *std::max_element(options.speeds.begin(), options.speeds.end());
  if (fastest > options.max_speed)
    problems.push_back(problem_at(section, "speeds",
                                  fmt::format("speed {} is above max_speed = {}", fastest, options.max_speed),
                                  "lower the speed or raise max_speed"));
  // forth and back at every speed once: else the recording lacks what was asked for
  double needed_s = 0.0;
  double const a = options.max_acceleration;
  auto const stroke_s = [&](double length, double speed) {
    double const v = std::min(speed, std::sqrt(length * a));
    return length / v + v / a + options.dwell_s;
  };
  needed_s += stroke_s(options.amplitude, options.speeds.front());
  for (double const speed : options.speeds) needed_s += 2.0 * stroke_s(2.0 * options.amplitude, speed);
  if (needed_s > duration_s)
    problems.push_back(
        problem_at(section, "speeds",
                   fmt::format("one stroke forth and back at each speed takes {:.3g} s, but duration_s = {}", needed_s,
                               duration_s),
                   "lengthen duration_s, drop the slowest speed, or lower amplitude"));
}

}  // namespace

std::vector<std::string> const& reference_kinds() {
  static std::vector<std::string> const kinds{
#define TORQUESCOPE_CHOICE(name) #name,
#include "reference_choices.inc"
#undef TORQUESCOPE_CHOICE
  };
  return kinds;
}

OptionTable<ReferenceOptions> const& ReferenceOptions::table() {
  using O = ReferenceOptions;
  static OptionTable<ReferenceOptions> const options(
      "simulate.reference", "the motion the simulated joint is asked to make",
      {{"kind", &O::kind, reference_kinds(),
        "multisine: sum of sines with random phases; trapezoid: strokes at several speeds; chirp: rising frequency; "
        "sine"},
       {"centre", &O::centre, "rad or m", -unlimited, unlimited, "position about which the motion goes"},
       {"amplitude", &O::amplitude, "rad or m", 1e-9, unlimited, "largest distance from the centre"},
       {"max_speed", &O::max_speed, "rad/s or m/s", 1e-9, unlimited, "limit of the speed"},
       {"max_acceleration", &O::max_acceleration, "rad/s^2 or m/s^2", 1e-9, unlimited,
        "limit of the acceleration; what the trapezoid accelerates with"},
       {"ramp_s", &O::ramp_s, "s", 0.0, unlimited,
        "multisine, chirp, sine: time in which the motion fades in from rest"},
       {"base_hz", &O::base_hz, "Hz", 1e-6, unlimited, "multisine, sine: one over the period"},
       {"harmonics", &O::harmonics, "1", 1.0, 1e6,
        "multisine, sine: multiples of base_hz to use; empty: all in band_hz"},
       {"frequencies_hz", &O::frequencies_hz, "Hz", 1e-6, unlimited,
        "multisine, sine: frequencies themselves, instead of base_hz and harmonics"},
       {"band_hz", &O::band_hz, "Hz", 0.0, unlimited,
        "lowest and highest frequency of the multisine; start and end of the chirp"},
       {"speeds", &O::speeds, "rad/s or m/s", 1e-9, unlimited,
        "trapezoid: cruising speeds, one stroke forth and back each"},
       {"dwell_s", &O::dwell_s, "s", 0.0, unlimited, "trapezoid: rest after each stroke"},
       {"file", &O::file,
        "of an arm: the motion in this file (torquescope excite writes one), again and again, in place of a kind"},
       {"validate_file", &O::validate_file, "of an arm: that of the second recording; default: the same"}});
  return options;
}

void Reference::at_each(std::span<double const> times_s, ReferenceColumns const& points) const {
  for (std::size_t i = 0; i < times_s.size(); ++i) points.set(i, at(times_s[i]));
}

std::vector<double> reference_frequencies_hz(ReferenceOptions const& options) {
  if (!options.frequencies_hz.empty()) return options.frequencies_hz;
  std::vector<double> frequencies;
  for (double const harmonic : options.harmonics) frequencies.push_back(harmonic * options.base_hz);
  if (!options.harmonics.empty()) return frequencies;
  // a hair of tolerance, so that 10 * 0.1 counts as 1.0
  double const first = std::max(1.0, std::ceil(options.band_hz[0] / options.base_hz * (1.0 - 1e-9)));
  double const last = std::floor(options.band_hz[1] / options.base_hz * (1.0 + 1e-9));
  for (double multiple = first; multiple <= last; ++multiple) frequencies.push_back(multiple * options.base_hz);
  return frequencies;
}

void check_reference(ReferenceOptions const& options, double duration_s, double rate_hz, Section const& section,
                     std::vector<Problem>& problems) {
  bool const uses_band = options.kind == "chirp" || (options.frequencies_hz.empty() && options.harmonics.empty());
  if (options.kind == "trapezoid") {
    check_strokes(options, duration_s, section, problems);
    return;
  }
  if (uses_band && (options.band_hz.size() != 2 || options.band_hz[1] <= 0.0 ||
                    (options.kind != "chirp" && options.band_hz[0] > options.band_hz[1]))) {
    problems.push_back(problem_at(section, "band_hz",
                                  fmt::format("band_hz = {} is not a band", to_text(options.band_hz)),
                                  "write the lower and the upper frequency, for example band_hz = [0.1, 1.0]"));
    return;
  }
  if (options.kind == "chirp") {
    double const highest = std::max(options.band_hz[0], options.band_hz[1]);
    if (highest >= 0.5 * rate_hz)
      problems.push_back(problem_at(section, "band_hz",
                                    fmt::format("the chirp goes up to {} Hz, but rate_hz = {}", highest, rate_hz),
                                    fmt::format("keep frequencies below {} Hz", 0.5 * rate_hz)));
  } else {
    check_frequencies(options, rate_hz, section, problems);
  }
  if (options.ramp_s >= duration_s)
    problems.push_back(problem_at(
        section, "ramp_s", fmt::format("ramp_s = {} is not shorter than duration_s = {}", options.ramp_s, duration_s),
        "shorten the ramp: the motion would never reach its size"));
}

std::unique_ptr<Reference const> make_reference(ReferenceOptions const& options, double duration_s,
                                                RandomKey const& key) {
  auto const& kinds = reference_kinds();
  auto const found = std::find(kinds.begin(), kinds.end(), options.kind);
  TORQUESCOPE_EXPECT(found != kinds.end());
  return makers[found - kinds.begin()](options, duration_s, key);
}

}  // namespace torquescope
