#include "engine/data/health/standstill.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "engine/data/levels.hpp"
#include "engine/data/signal_facts.hpp"

namespace torquescope {

bool covers_few_steps(std::vector<double> const& position) {
  std::vector<double> values = position;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  double const steps = levels::range_over_noise(levels::least_motion_over_noise) * levels::rounding_noise();
  if (range_of(values) < steps * quantisation_step(values)) return true;
  // a step that is seldom met is not known, but then there are few levels as well
  std::sort(values.begin(), values.end());
  auto const distinct = std::unique(values.begin(), values.end()) - values.begin();
  return static_cast<double>(distinct) <= steps;
}

void find_standstill(Examination& exam) {
  std::vector<double> values = exam.values("position");
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 16) return;
  auto const [least, most] = std::minmax_element(values.begin(), values.end());
  double const range = *most - *least;
  double const noise =
      white_noise(Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size())));
  if (range < levels::range_over_noise(levels::least_motion_over_noise) * noise || covers_few_steps(values))
    exam.add(FindingKind::standstill, Grade::warning, Repair::none, "position", {},
             range * std::fabs(exam.options.position_per_unit));
}

}  // namespace torquescope
