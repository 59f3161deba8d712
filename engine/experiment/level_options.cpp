#include "engine/experiment/level_options.hpp"

#include <algorithm>

namespace torquescope {

OptionTable<LevelOptions> const& LevelOptions::table() {
  static OptionTable<LevelOptions> const table(
      "diagnose.levels", "for ablations, not for use: numbers of a decision that [diagnose] does not have",
      {{"replicates", &LevelOptions::replicates, "1", 8.0, 10000.0, "replicates of a model"},
       {"exceedances", &LevelOptions::exceedances, "1", 1.0, 1000.0,
        "of them above the recording, after which no more are made"},
       {"sticking_odds", &LevelOptions::sticking_odds, "1", 1.0, 1000.0,
        "squares that a sticking of friction may leave, over those of the best: what replicates draw"},
       {"longest_delay", &LevelOptions::longest_delay_s, "s", 0.0, 10.0,
        "of the torque as a nuisance: beyond it, it is none"},
       {"most_of_it", &LevelOptions::most_of_it, "1", 0.0, 1.0,
        "of the mismatch: what an effect of several joints must explain"},
       {"whole_arm_share", &LevelOptions::whole_arm_share, "1", 0.0, 1.0,
        "of q, what effects of several joints may spend"},
       {"refined", &LevelOptions::refined, "1", 1.0, 100.0, "candidates of a step whose shapes are refined"},
       {"same_columns", &LevelOptions::same_columns, "1", 0.0, 1.0,
        "energy by which columns may change from the recording to a replicate and still be computed once"},
       {"beam", &LevelOptions::beam, "1", 1.0, 100.0, "models that simulations follow at once"},
       {"fitted_samples", &LevelOptions::fitted_samples, "1", 100.0, 1e9,
        "of training, which simulations fit; of more, stretches spread over the time"},
       {"computed_torque", &LevelOptions::computed_torque, "1", 0.0, 1.0,
        "of the torque: a controller that leaves less of it was computed with it"},
       {"largest_loop_error", &LevelOptions::largest_loop_error, "1", 0.0, 10.0,
        "of the torque: an identified controller that leaves more is none"}});
  return table;
}

std::vector<std::string> LevelOptions::changed() const {
  auto const usual = table().values({}), here = table().values(*this);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < here.size(); ++i)
    if (here[i].second != usual[i].second) found.push_back(here[i].first + " = " + to_text(here[i].second));
  return found;
}

DecisionNumbers decision_numbers(DiagnoseOptions const& options, LevelOptions const& levels) {
  DecisionNumbers numbers = levels;
  numbers.alpha = options.q;
  numbers.delta = options.delta;
  numbers.tolerance = options.tolerance;
  numbers.least_fall = options.least_fall;
  numbers.replicates = std::min(numbers.replicates, options.replicates);
  return numbers;
}

}  // namespace torquescope
