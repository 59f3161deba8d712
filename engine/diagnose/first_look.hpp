#pragma once
// The training recording before the search: what its motion can tell, which terms it tells apart, and what the user's
// own simulator explains of it.
//
// Merged     terms that are one number on the rows are one in the model of the diagnosis (shared_constants.hpp)
// Closed     effects that the motion cannot tell (motion_limits.hpp)
// Simulator  recordings lose what a simulator holds beyond the terms (simulator_gap.hpp)
// Errors     look(): Error 78 for a filter that does not suit the recording, 65 as the pipeline
// Threads    one object per diagnosis, used by one thread

#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/diagnose/joint_diagnosis.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"

namespace torquescope {

// what work() says of the recording, or what stopped it when that is the recording's fault
template <typename Work>
std::optional<Hopeless> verdict_of(Verdict verdict, Work const& work) {
  try {
    return work();
  } catch (Error const& error) {
    auto const& problem = error.problems().front();
    if (problem.code != ExitCode::bad_data) throw;
    return Hopeless{verdict, problem.what, problem.help};
  }
}

class FirstLook {
 public:
  explicit FirstLook(DiagnosisInput const& input) : input_(input), parameter_share_(input.parameter_share) {}

  // may replace the torque by what the simulator cannot say; an answer: no diagnosis
  std::optional<Hopeless> look(Recording& recording);

  Regressor const& regressor() const { return merged_ ? *merged_ : input_.regressor; }
  MotionLimits const& limits() const { return limits_; }
  double relerr() const { return relerr_; }                    // of the model on the recording
  double parameter_share() const { return parameter_share_; }  // SimulatorGap
  std::vector<std::string> const& remarks() const { return remarks_; }
  // where nothing was found
  std::optional<Hopeless> blamed_for_silence() const {
    return torquescope::blamed_for_silence(limits_, excitation_, relerr_);
  }
  // where there is no other recording
  std::optional<Hopeless> place_is_time() const {
    return torquescope::place_is_time(limits_, excitation_, input_.regressor.joint());
  }
  // a torque without inertia and friction, where nothing else is missing
  std::optional<Hopeless> const& static_torque() const { return static_torque_; }
  // what the simulator cannot say of a validation recording, by the terms it has in training
  Recording less_simulator(Recording recording) const;

 private:
  RecordPipeline plain_pipeline(Recording const& recording) const;
  void merge_constants(Recording const& recording);

  DiagnosisInput const& input_;
  Excitation excitation_{};
  MotionLimits limits_{};
  std::optional<Regressor> merged_{};  // none: as given
  double relerr_ = unknown, parameter_share_;
  Eigen::VectorXd simulator_parameters_{};  // of the terms; empty: no simulator
  std::vector<std::string> remarks_{};
  std::optional<Hopeless> static_torque_{};
};

}  // namespace torquescope
