#pragma once
// What the decision on all samples (engine/infer/decision) found, as it stands in a result: plain numbers and words.
//
// Errors     ||residual|| / ||torque|| over all rows of the filtered torque
// Units      SI; shares are fractions of 1; NaN: not measured
// Threads    plain records
// Source     engine/infer/decision/THEORY.md; as JSON: workflows/results/diagnosis_json.hpp

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace torquescope {

struct DecisionAccount {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  struct Errors {
    double train = none, held_out = none, validation = none;
  };
  struct Effect {
    std::string name{}, refusal{};
    std::vector<double> shape{};
    double gain = 0.0, level = 0.0, p = 1.0;  // D; D by chance; chance over the catalogue
    double size = none;                       // over the torque's rms
    double judged_before = none, judged_after = none;
    std::vector<std::string> rivals{};
  };
  struct Step {
    bool of_clock = false;
    std::size_t replicates = 0;
    std::string source{};  // of replicates
    double visible = none;
    std::string correction_axis{};
    double correction_gain = 0.0, correction_p = 1.0, correction_size = 0.0;
    std::vector<Effect> effects{};
  };
  struct Delay {
    double seconds = 0.0, deviation = 0.0, gain = 0.0, p = 1.0, size = 0.0;
    bool is_named = false;
  };

  // by simulation in the loop
  struct Number {
    std::string name{}, unit{};
    double value = none, lower = none, upper = none;
  };
  struct Move {
    std::string name{}, refusal{};
    double gain = 0.0, level = 0.0, p = 1.0;
    double before = none,
           after = none;            // geometric mean of the channels' errors, validation where there is such a record
    std::vector<Number> numbers{};  // of a move that was kept
    std::vector<std::string> rivals{};
  };
  struct Rung {
    std::vector<std::string> model{};
    std::size_t replicates = 0;
    std::vector<Move> moves{};
  };
  struct Simulated {
    double position = none, torque = none;
  };
  struct Loop {
    std::string reason{}, controller{};
    bool counts_torque = false, decides = false;
    double loop_error = none, fitted_share = 1.0;
    Simulated base_train{}, base_validation{}, final_train{}, final_validation{};
    std::vector<Rung> steps{};
    std::vector<Move> kept{};
    std::vector<Number> numbers{};
  };

  std::string verdict{};
  double quiet_share = 0.0, set_aside_share = 0.0;
  double smallest_named = none;   // torque of an effect over the torque's rms (decision_verdict.hpp)
  double sticking_length = none;  // rad or m: friction that turns round within less belongs to the model
  Errors baseline{}, final{};
  std::vector<Step> steps{};
  std::vector<Effect> accepted{};
  Delay delay{};
  Loop loop{};
};

}  // namespace torquescope
