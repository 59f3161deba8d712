#pragma once
// One least-squares fit to all samples of one or more recordings of a joint, at a delay of the torque.
//
// Quiet      at samples that do not show motion dry friction is the interval from backward to forward. Inside it torque
//            and columns count zero before the parallel filter; outside, friction stands at the nearer end. The set
//            is found by fitting again until it stays
// Sticking   a mixture of sides (sticking_shape.hpp), weights 0 to 1 fitted to all rows beside the parameters; then it
//            is the side of all dry friction
// Late       torque(t + late_s) stands beside the motion at t: cubic interpolation
// Parameters of the model, then an offset of each recording but the first
// Shapes     columns, torque, residual: the rows of all strips, one above the other
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Rows

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/decision/effect_columns.hpp"

namespace torquescope {

// columns of one model on several strips
class ModelOnStrips {
 public:
  // both outlive it; the model's reference is that of its scales and parameters
  ModelOnStrips(JointModel const& model, std::span<Strip const> strips);

  JointModel const& model() const { return *model_; }
  std::span<Strip const> strips() const { return strips_; }
  FittedBaseline const& baseline(std::size_t strip) const { return baselines_[strip]; }
  std::vector<EffectColumnsOnStrip> const& parts(std::size_t strip) const { return parts_[strip]; }
  Eigen::Index rows() const;
  Eigen::Index parameters() const;  // of the model and of further recordings' offsets

 private:
  JointModel const* model_;
  std::span<Strip const> strips_;
  std::vector<FittedBaseline> baselines_{};
  std::vector<std::vector<EffectColumnsOnStrip>> parts_{};  // of the regressor, then of each effect
};

// of one strip, before the filter: 0 or 1; the side of dry friction, -1 to 1
struct SampleTreatment {
  Eigen::VectorXd weight{}, side{};
};

struct TreatedFit {
  std::vector<SampleTreatment> samples{};
  Eigen::MatrixXd columns{};
  Eigen::VectorXd torque{};
  Eigen::VectorXd parameters{}, residual{};
  Eigen::VectorXd sticking{};  // weights of the strips' sides
  double energy() const { return residual.squaredNorm(); }
};

TreatedFit treated_fit(ModelOnStrips const& on, double late_s);

Eigen::VectorXd torque_on_rows(ModelOnStrips const& on, std::vector<SampleTreatment> const& samples, double late_s);
Eigen::MatrixXd columns_on_rows(std::span<Strip const> strips, std::vector<EffectColumnsOnStrip> const& columns,
                                std::vector<SampleTreatment> const& samples);
// every column of the model and the offsets of further strips
Eigen::MatrixXd model_on_rows(ModelOnStrips const& on, std::vector<SampleTreatment> const& samples);
// weight and side of all samples as these parameters and this sticking say; no parameters: quiet ones count nothing
std::vector<SampleTreatment> treated_samples(ModelOnStrips const& on, double late_s, Eigen::VectorXd const& parameters,
                                             Eigen::VectorXd const& sticking);
// torque of the model at the effects' rate
Eigen::VectorXd model_torque(ModelOnStrips const& on, std::size_t strip, SampleTreatment const& samples,
                             Eigen::VectorXd const& parameters);
// what the sticking changes of the friction's torque: how much of it there is, is a nuisance; one per row
Eigen::VectorXd sticking_on_rows(ModelOnStrips const& on, TreatedFit const& fit);

// signal(t + late_s)
Eigen::VectorXd earlier(Eigen::VectorXd const& signal, double late_s, double rate_hz);

}  // namespace torquescope
