#pragma once
// The model as it stands in a diagnosis: the baseline's terms and every effect accepted so far, at a fixed shape.
//
// Equation   tau = [columns of the baseline | columns of each effect at its shape] * parameters
// Shapes     columns: n_samples x size(), full rate, before the parallel filter; effects in the order of acceptance
// Reference  the baseline's parameters that effects are given (Coulomb levels, load and model torque): fixed numbers,
//            so that the model stays linear in its parameters and is the same for the recording and its replicates
// Units      SI
// Threads    const object, any number of threads
// Source     engine/infer/decision/THEORY.md, The rules

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/effects/fitted_baseline.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/simulate/replicate_joint.hpp"

namespace torquescope {

struct ShapedEffect {
  Effect const* effect = nullptr;
  std::vector<double> shape{};
};

struct BaselineReference {
  JointScales scales{};
  Eigen::VectorXd parameters{};  // of the regressor
  // per sample: load that passes the gear beside the regressor's (Recording::gear_load); none
  std::shared_ptr<Eigen::VectorXd const> gear_load{};
  std::shared_ptr<GivenSignals const> given{};  // the recording's; none
  double rate_hz = 0.0;                         // of both
  BesideMotion beside_motion() const { return {given.get(), gear_load.get()}; }
};

class JointModel {
 public:
  // NOLINTNEXTLINE(google-explicit-constructor): a regressor is a model without effects; it outlives the model
  JointModel(Regressor const& regressor) : regressor_(&regressor) {}
  JointModel(Regressor const& regressor, BaselineReference reference, std::vector<ShapedEffect> effects);

  Regressor const& regressor() const { return *regressor_; }
  BaselineReference const& reference() const { return reference_; }
  // the same model on that recording: its gear load and what other joints do there, or none
  void load_as_in(Recording const& recording);
  std::vector<ShapedEffect> const& effects() const { return effects_; }
  std::size_t size() const;
  // index of the first parameter of effect i
  std::size_t first_parameter(std::size_t effect) const;
  std::vector<RegressorColumn> column_owners() const;
  // parameters of effects that physics allows no negative value; those of the baseline are free
  std::vector<bool> non_negative() const;

  // drive: the same motion with a wider band, for effects that have an inertia (record_pipeline.hpp)
  Eigen::MatrixXd columns(Motion const& motion, Motion const& drive) const;
  // linear parameters, then the shape: as Effect::runner takes them
  std::vector<double> effect_parameters(std::size_t effect, Eigen::VectorXd const& parameters) const;
  // Errors: Error 65 as make_replicate_joint
  ReplicateJoint replicate_joint(Eigen::VectorXd const& parameters) const;

 private:
  Regressor const* regressor_;
  BaselineReference reference_{};
  std::vector<ShapedEffect> effects_{};
};

// of the recording, for a reference; none
std::shared_ptr<Eigen::VectorXd const> gear_load_of(Recording const& recording);

// load and model torque of the reference on a motion, its scales as they are
FittedBaseline on_motion(Regressor const& regressor, BaselineReference const& reference, Motion const& motion);

}  // namespace torquescope
