#pragma once
// What one [[estimator]] of a job will do: a closed form, or runs of a population method. Names become objects here.
//
// Errors     problems are appended (78): unknown name, keys of another estimator, labels used twice
// Threads    plans are immutable once made

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/fit/optim/fuzzy_controller.hpp"
#include "engine/fit/optim/optimiser.hpp"
#include "engine/fit/optim/stop_rules.hpp"
#include "engine/fit/problem/estimator.hpp"
#include "engine/fit/problem/objective_options.hpp"
#include "engine/simulate/rollout/rollout_fit.hpp"

namespace torquescope {

// keys every [[estimator]] may have
struct EstimatorOptions {
  std::string name{};   // kind: ols, wls, irls, de, fade, ...
  std::string label{};  // name in results; default: the kind

  static OptionTable<EstimatorOptions> const& table();
};

// where a population method begins
struct StartOptions {
  std::string start_from{};  // a result; empty: anywhere in the box

  static OptionTable<StartOptions> const& table();
};

struct EstimatorPlan {
  std::string label;
  std::string kind;
  std::string title;
  std::vector<std::pair<std::string, OptionValue>> options{};  // every option with its value, for the result file

  // closed forms
  Estimate fit{};
  bool needs_instruments = false;

  // population methods
  std::function<std::unique_ptr<Optimiser>(Bounds const&, RandomKey)> make_optimiser{};
  std::shared_ptr<FuzzyController const> controller{};  // of methods that have one
  StopRules stop_rules{};
  ObjectiveOptions objective{};
  std::string start_from{};     // as the job says
  std::vector<double> start{};  // what that comes to (start_point.hpp): by parameter, NaN where unknown; else empty
  std::string start_words{};

  std::optional<LmOptions> lm{};  // Levenberg-Marquardt on rollouts: one run, as a closed form

  bool is_closed_form() const { return static_cast<bool>(fit) || lm; }
  // it simulates the recordings
  bool rolls_out() const { return lm || objective.fitness == "rollout"; }
};

// the estimator that fits simulations to recordings; it needs these, not rows, so it is in no registry of those that do
inline constexpr char lm_name[] = "lm", lm_title[] = "Levenberg-Marquardt on rollouts";

// one plan per section, in their order
std::vector<EstimatorPlan> plan_estimators(std::vector<Section const*> const& sections, std::vector<Problem>& problems);
}  // namespace torquescope
