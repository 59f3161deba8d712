#pragma once
// Decisions about the joints of an arm, fitted once more together: one set of shared parameters for all rows.
//
// Rows       of each joint as its own decision treats them: delay, quiet samples, sticking and effects stay as found.
//            The columns of the effect `instead_of` give way to those of the effect `shared`, which joints have in
//            common
// Weights    of a joint's rows: 1 / v (shared_columns.hpp)
// Errors     of each joint as ModelErrors, by the common fit: ||residual|| / ||torque|| over all rows of the filtered
//            torque. Held out: a tenth of every joint's rows at a time. Of other recordings the offset alone is fitted
// Judged     squares on judged rows of all joints, each over its v: what an effect must lower
// Shapes     R shared parameters
// Threads    pure functions
// Source     weighted least squares of all joints: Gautier 1997, doi:10.1109/ROBOT.1997.606794

#include <span>
#include <string>
#include <vector>

#include "engine/infer/decision/fitted_model.hpp"
#include "engine/infer/decision/shared_columns.hpp"

namespace torquescope {

struct SharedEffect {
  std::string shared{}, instead_of{};
  std::vector<Eigen::Index> places{};  // of its columns among the shared parameters
  Eigen::Index parameters = 0;         // R
};

// of the recordings that a model is fitted to; tangents of its nuisances are columns of its own
SharedRows shared_rows(FittedStrips const& fitted, SharedEffect const& effect);
// of a recording that is predicted by a fit, and what a constant would add there
struct OtherRows {
  SharedRows rows{};
  Eigen::VectorXd constant{};
};
OtherRows predicted_rows(FittedModel const& by, Strip const& strip, SharedEffect const& effect);

struct PooledRows {
  SharedRows training{};                 // without tangents
  std::vector<SharedRows> validation{};  // of each strip, less its mean
  Eigen::Index guard = 0;
  double training_energy = 0.0, validation_energy = 0.0;
};
PooledRows pooled_rows(JointStrips const& rows, FittedModel const& by, SharedEffect const& effect);

struct PooledErrors {
  std::vector<ModelErrors> of_joints{};
  double judged = 0.0;
};
// variances: of each joint
PooledErrors pooled_errors(std::span<PooledRows const* const> joints, std::vector<double> const& variances);

}  // namespace torquescope
