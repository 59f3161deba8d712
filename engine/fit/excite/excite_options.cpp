#include "engine/fit/excite/excite_options.hpp"

#include <fmt/format.h>

#include "engine/fit/optim/optimiser.hpp"

namespace torquescope {

namespace {

std::vector<std::string> optimiser_names() {
  std::vector<std::string> names;
  for (auto const& choice : optimiser_choices()) names.push_back(choice.name);
  return names;
}

}  // namespace

OptionTable<ExciteOptions> const& ExciteOptions::table() {
  constexpr double unlimited = std::numeric_limits<double>::max();
  using O = ExciteOptions;
  static OptionTable<ExciteOptions> const options(
      "excite", "a motion of an arm from which its parameters can be told",
      {{"criterion",
        &O::criterion,
        {"d_optimal", "condition"},
        "d_optimal: the largest determinant of the information matrix; condition: the smallest condition number of the "
        "regressor with columns of length one"},
       {"separate", &O::separate,
        "two parameters (\"xxr2\") or effects at a joint (\"stribeck@3\"): the criterion is the angle between their "
        "columns beside all others"},
       {"harmonics", &O::harmonics, "1", 2.0, 50.0, "of the Fourier series of each joint"},
       {"period_s", &O::period_s, "s", 1e-2, 1e4, "length of the motion, which ends where and as it began: at rest"},
       {"position_share", &O::position_share, "1", 1e-3, 1.0, "of every joint's range, about its middle"},
       {"speed_share", &O::speed_share, "1", 1e-3, 1.0, "of every joint's max_speed"},
       {"acceleration_share", &O::acceleration_share, "1", 1e-3, 1.0, "of every joint's max_acceleration"},
       {"torque_noise", &O::torque_noise,
        "standard deviation of each joint's torque, N m or N; default: simulate.noise.torque_std, else a share of "
        "max_torque where every joint has one, else equal"},
       {"floor_m", &O::floor_m, "m", -unlimited, unlimited,
        "height of the table in the base frame: links from the second on stay above it"},
       {"clearance_m", &O::clearance_m, "m", 0.0, unlimited,
        "links, as lines between the origins of their frames, stay this far apart; 0: not looked at"},
       {"optimiser", &O::optimiser, optimiser_names(), "of this engine (torquescope list optimisers)"},
       {"evaluations", &O::evaluations, "1", 1.0, 1e9, "motions that are tried"},
       {"rate_hz", &O::rate_hz, "Hz", 1e-2, 1e6, "samples per second of the written motion"}});
  return options;
}

ExciteCriterion criterion_of(ExciteOptions const& options) {
  if (!options.separate.empty()) return ExciteCriterion::angle;
  return options.criterion == "condition" ? ExciteCriterion::condition : ExciteCriterion::d_optimal;
}

void check_excite(ExciteOptions const& options, std::size_t joints, Section const& section,
                  std::vector<Problem>& problems) {
  if (!options.separate.empty() && options.separate.size() != 2)
    problems.push_back(problem_at(section, "separate", "separate does not name two things",
                                  "write separate = [\"stribeck@3\", \"viscous@3\"]"));
  if (!options.separate.empty() && section.find("criterion") != nullptr)
    problems.push_back(
        problem_at(section, "separate", "separate stands beside criterion", "it is one itself: remove either"));
  double const highest_hz = static_cast<double>(options.harmonics) / options.period_s;
  if (options.rate_hz < 4.0 * highest_hz)
    problems.push_back(problem_at(section, "rate_hz",
                                  fmt::format("rate_hz = {} is too low for {} harmonics of {} s: {:.3g} Hz",
                                              options.rate_hz, options.harmonics, options.period_s, highest_hz),
                                  fmt::format("write rate_hz = {:.3g} or more", 4.0 * highest_hz)));
  if (!options.torque_noise.empty() && options.torque_noise.size() != joints)
    problems.push_back(problem_at(
        section, "torque_noise",
        fmt::format("torque_noise holds {} numbers, but the arm has {} joints", options.torque_noise.size(), joints),
        "write one number for each joint, or leave it out"));
  for (double const noise : options.torque_noise)
    if (!(noise > 0.0)) {
      problems.push_back(problem_at(section, "torque_noise", fmt::format("torque_noise = {} is not above 0", noise),
                                    "write standard deviations in N m"));
      break;
    }
}

}  // namespace torquescope
