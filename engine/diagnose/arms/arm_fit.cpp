#include "engine/diagnose/arms/arm_fit.hpp"

#include <utility>

#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/problem/filtered_grams.hpp"
#include "engine/fit/problem/least_squares.hpp"
#include "engine/fit/problem/recorded_rows.hpp"
#include "engine/fit/problem/regressor_health.hpp"
#include "engine/fit/problem/shortest_fit.hpp"

namespace torquescope {
namespace {

// of the rows of all recordings; `whole` where they tell all parameters apart
struct RowFit {
  std::vector<FilteredGram> grams{};
  std::optional<RegressionData> whole{};
  Eigen::VectorXd noise{};
};

RowFit rows_to_fit(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter,
                   std::optional<Eigen::VectorXd> const& deviation) {
  std::vector<RecordedRows> rows;
  for (auto const& recording : recordings)
    rows.push_back(rows_of(model, recording, motion_of(recording, filter), filter));
  RowFit fit;
  fit.grams = filtered_grams(rows, model);
  fit.noise = deviation ? *deviation : noise_levels(fit.grams, static_cast<Eigen::Index>(model.size())).deviation;
  RegressionData stacked = stack_rows(rows, ArmRowChoice::moving, model, fit.noise, filter.section);
  // a joint that stands still leaves parameters that nothing tells: the others are searched all the same
  if (!too_few_rows(stacked) && regressor_health(stacked).identifiable) fit.whole = std::move(stacked);
  return fit;
}

Eigen::VectorXd shortest(ArmModel const& model, RowFit const& fit) {
  return shortest_fit(fit.grams, static_cast<Eigen::Index>(model.size()), fit.noise);
}

}  // namespace

PlainArmFit fit_parameters(ArmModel const& model, std::span<RecordedArm const> recordings, ArmFilter const& filter,
                           std::optional<Eigen::VectorXd> const& deviation) {
  RowFit const rows = rows_to_fit(model, recordings, filter, deviation);
  PlainArmFit fit;
  fit.noise = rows.noise;
  fit.parameters = rows.whole ? solve_weighted(*rows.whole, {}) : shortest(model, rows);
  for (auto const& gram : rows.grams)
    fit.energies.push_back({gram.torque_energy(), gram.residual_energy(fit.parameters)});
  return fit;
}

std::vector<Eigen::VectorXd> needed_torques(ArmModel const& model, Eigen::VectorXd const& parameters,
                                            RecordedArm const& recording, ArmFilter const& filter) {
  auto const rows = model.rows(motion_of(recording, filter), recording.payload);
  std::vector<Eigen::VectorXd> torques;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    torques.emplace_back(rows[j] * parameters(model.parameters_of(j)));
    if (recording.payload) torques.back() += model.known_torque(j, rows[j], *recording.payload);
  }
  return torques;
}

}  // namespace torquescope
