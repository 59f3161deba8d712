#pragma once
// The [excite] section of a job: which motions are tried, and by what they are judged.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/options.hpp"

namespace torquescope {

struct ExciteOptions {
  std::string criterion = "d_optimal";
  std::vector<std::string> separate{};  // two: the criterion is the angle between them
  std::int64_t harmonics = 5;
  double period_s = 10.0;
  double position_share = 0.9, speed_share = 0.8, acceleration_share = 0.8;
  std::vector<double> torque_noise{};
  double floor_m = -std::numeric_limits<double>::infinity();
  double clearance_m = 0.0;
  std::string optimiser = "cmaes";
  std::int64_t evaluations = 10000;
  double rate_hz = 100.0;

  static OptionTable<ExciteOptions> const& table();
};

enum class ExciteCriterion { condition, d_optimal, angle };
ExciteCriterion criterion_of(ExciteOptions const& options);

// what would make the search senseless: steps too long for the harmonics, an unknown optimiser
void check_excite(ExciteOptions const& options, std::size_t joints, Section const& section,
                  std::vector<Problem>& problems);

}  // namespace torquescope
