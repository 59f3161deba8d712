#pragma once
// A joint in its loop as one vector of parameters: what a fit by simulation searches, and what a replay is given.
//
// Parameters those of the regressor, then of every effect (linear ones, then shapes), then the loop's free numbers,
//            named loop_kp, loop_kd, ...
// Scale      of a parameter: what changes the torque by a tenth of its rms, or its own size, whichever is larger
// Units      SI of the joint's kind
// Errors     Error 78: parameters of two effects with one name
// Threads    const object, any number of threads

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "engine/effects/regressor.hpp"
#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/rollout.hpp"

namespace torquescope {

struct RolloutParameter {
  std::string name, unit;
  double start = 0.0, lower = 0.0, upper = 0.0;
  double scale = 1.0;
  bool is_shape = false;        // of an effect
  bool is_logarithmic = false;  // spread over orders of magnitude between its bounds
  bool is_given = false;        // its start is the job's own
};

// an effect as a job gives it: parameters by name, those left out begin in the middle of their range
struct ModelEffect {
  Effect const* effect = nullptr;
  std::map<std::string, double> values{};
};

struct LoopSetting {
  LoopForm form = LoopForm::identified;
  LoopValues values{};          // fixed, or where the search begins
  std::vector<LoopKey> free{};  // those that are searched
  std::size_t hold_ticks = 1;
  std::size_t speed_samples = 1;  // 0: the controller sees the joint's own speed
  bool steps_by_ticks = false;    // one step of the integration a tick, however fast the joint
};

class RolloutModel {
 public:
  // start: of the regressor's parameters, by least squares or given; scales: of the first training recording with them
  RolloutModel(Regressor const& regressor, Eigen::VectorXd const& start, JointScales const& scales,
               std::vector<ModelEffect> const& effects, LoopSetting loop);

  std::vector<RolloutParameter> const& parameters() const { return parameters_; }
  std::size_t size() const { return parameters_.size(); }
  Eigen::VectorXd start() const;
  std::vector<std::string> names() const;
  // the same model with one number that no fit moves
  RolloutModel with_held(std::size_t parameter, double value) const;
  RolloutStructure const& structure() const { return structure_; }
  LoopSetting const& loop() const { return loop_; }
  // the step of the integration follows the start; of another vector where that is fixed
  RolloutStructure structure_for(Eigen::VectorXd const& parameters, double tick_s) const;

  RolloutTrial trial(Eigen::Ref<Eigen::VectorXd const> const& parameters) const;

 private:
  void add_effect_parameters(std::vector<ModelEffect> const& effects, JointScales const& scales);
  void add_loop_parameters(JointScales const& scales);

  std::vector<Effect const*> terms_;  // of the regressor
  JointKind joint_;
  LoopSetting loop_;
  RolloutStructure structure_;         // effects: terms with no place in the lanes, then those given
  std::vector<std::size_t> in_lanes_;  // of each term: 1 when it has a place there
  std::vector<RolloutParameter> parameters_;
};

}  // namespace torquescope
