#include "engine/search/trial_order.hpp"

#include <algorithm>

namespace torquescope {
namespace {

bool is_event(Trial const& trial) { return trial.refined.effect->is_event(); }

void prefer_what_repeats(std::vector<Trial>& trials) {
  constexpr double share_enough = 0.5;
  for (auto event = trials.begin(); event != trials.end(); ++event) {
    if (!is_event(*event)) continue;
    // a load that was picked up and kept is on all later blocks: there it can be checked as anything else
    double const enough = std::max(share_enough * event->refined.gain, event->cv.gain);
    std::stable_partition(event, trials.end(),
                          [&](Trial const& trial) { return !is_event(trial) && trial.cv.gain >= enough; });
  }
}

// of the simplest form that gives `enough`
std::size_t parameters_of(RefinedEffect const& refined, double enough) {
  bool const is_plain = refined.effect->has_plain_form() && refined.plain_gain >= enough;
  return is_plain ? refined.effect->n_linear() : refined.effect->parameters().size();
}

void prefer_the_simpler(std::vector<Trial>& trials) {
  constexpr double nearly_all = 0.97;
  if (trials.empty()) return;
  double const enough = nearly_all * trials.front().refined.gain;
  auto const last = std::find_if(trials.begin(), trials.end(), [&](Trial const& trial) {
    return trial.refined.gain < enough || is_event(trial) != is_event(trials.front());
  });
  std::stable_sort(trials.begin(), last, [enough](Trial const& a, Trial const& b) {
    if (a.is_named != b.is_named) return a.is_named;
    return parameters_of(a.refined, enough) < parameters_of(b.refined, enough);
  });
}

}  // namespace

std::vector<Trial> in_order_of_trial(std::vector<Trial> trials) {
  std::stable_sort(trials.begin(), trials.end(),
                   [](Trial const& a, Trial const& b) { return a.refined.gain > b.refined.gain; });
  prefer_what_repeats(trials);
  prefer_the_simpler(trials);
  return trials;
}

bool helps_elsewhere(BlockedGain const& cv, double gain) {
  constexpr double least_t = 2.0, most = 0.5;
  return cv.t >= least_t || cv.gain >= most * gain;
}

bool happens_once(Trial const& trial) {
  constexpr double mostly = 0.5;
  Effect const& effect = *trial.refined.effect;
  return effect.is_event() ||
         (effect.is_of_extremes() && trial.most_in_a_block > mostly && !helps_elsewhere(trial.cv, trial.refined.gain));
}

}  // namespace torquescope
