#include "engine/health/standstill.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "engine/data/signal_facts.hpp"

namespace torquescope {

void find_standstill(Examination& exam) {
  constexpr double deviations = 30.0, encoder_steps = 20.0;
  std::vector<double> values = exam.values("position");
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 16) return;
  auto const [least, most] = std::minmax_element(values.begin(), values.end());
  double const range = *most - *least;
  double const noise =
      white_noise(Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size())));
  if (range < deviations * noise || range < encoder_steps * quantisation_step(values))
    exam.add(FindingKind::standstill, Grade::warning, Repair::none, "position", {},
             range * std::fabs(exam.options.position_per_unit));
}

}  // namespace torquescope
