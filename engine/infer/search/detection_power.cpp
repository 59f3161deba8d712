#include "engine/infer/search/detection_power.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/quantity_text.hpp"
#include "engine/infer/search/selection.hpp"

namespace torquescope {

namespace {

// energy beyond the replicates' mean that would be clear
double clear_energy(MismatchRows const& rows) {
  auto const m = static_cast<double>(rows.n_twins());
  Eigen::VectorXd const energy = (rows.twins.colwise() - rows.twin_mean).colwise().squaredNorm().transpose();
  double const std = std::sqrt((energy.array() - energy.mean()).square().sum() / (m - 1.0));
  double const by_floor = smallest_mismatch_share * smallest_mismatch_share * rows.torque.squaredNorm();
  return std::max(smallest_omnibus_z * std, by_floor);
}

}  // namespace

double smallest_visible_share(ModelStage const& stage) {
  auto const& rows = stage.comparison.rows;
  return std::sqrt(clear_energy(rows) / rows.torque.squaredNorm());
}

std::string power_sentence(ModelStage const& stage) {
  auto const& rows = stage.comparison.rows;
  BaselineReference const reference = stage.reference();
  double const coulomb = reference.scales.coulomb();
  if (!(coulomb > 0.0)) return {};
  double const needed = clear_energy(rows);
  CandidateColumns const columns(*stage.pipeline, stage.comparison, reference, stage.parameters());
  std::array<double, 2> const shape{0.05 * reference.scales.peak_speed, 1.0};
  OrthonormalGroup const group = columns.group(*find_effect("stribeck"), shape);
  double const per_unit = group.r.squaredNorm();
  if (!(per_unit > 0.0)) return {};
  double const share = std::sqrt(needed / per_unit) / coulomb;
  // of the rows' torque: any law whatever, as far as the model's own terms do not imitate it
  double const any = std::sqrt(needed / rows.torque.squaredNorm());
  std::string const others =
      fmt::format("Missing torque that the model's own terms do not imitate would have shown from {} of the torque on",
                  percent_text(any));
  if (share > 1.0) return others + "; Stribeck friction can hardly be seen on this motion.";
  return fmt::format("{}; Stribeck friction from {} of the Coulomb friction on.", others, percent_text(share));
}

}  // namespace torquescope
