#include "engine/search/rival_lines.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace torquescope {
namespace {

constexpr std::size_t most_lines = 2;
constexpr double clearly_less = 0.5;
constexpr double clear_deviance = 25.0;  // five standard deviations of one parameter

// a round's other choice, and the line before that round
struct Fork {
  std::shared_ptr<EffectSearch const> before;
  Trial trial;
};

std::vector<Fork> follow(EffectSearch& line) {
  std::vector<Fork> forks;
  for (;;) {
    Round round = line.next_round();
    if (round.began_again) forks.clear();
    for (Trial& trial : round.nearly_taken) forks.push_back({round.before, std::move(trial)});
    if (!round.is_taken) return forks;
  }
}

// of a row, were noise alike on all
double noise_of_row(ModelStage const& stage) {
  return stage.energy.noise / static_cast<double>(stage.comparison.rows.size());
}

bool is_better(EffectSearch const& line, EffectSearch const& than) {
  if (line.selection().accepted.size() > than.selection().accepted.size()) return false;
  double const gap = (than.left_share() - line.left_share()) * than.selection().whole();
  return line.left_share() < clearly_less * than.left_share() && gap > clear_deviance * noise_of_row(than.stage());
}

}  // namespace

EffectSearch best_line(EffectSearch search) {
  std::vector<Fork> const forks = follow(search);
  std::size_t tried = 0;
  for (Fork const& fork : forks) {
    auto const* displaced = search.selection().accepted[fork.before->selection().accepted.size()].effect;
    auto const* rival = fork.trial.refined.effect;
    if (search.selection().has_accepted(rival) || rival->family() == displaced->family()) continue;
    if (search.left_share() <= 0.0) break;
    if (++tried > most_lines) break;
    EffectSearch line = *fork.before;
    line.do_not_begin_again();
    if (!line.take(fork.trial)) continue;
    follow(line);
    if (!is_better(line, search)) continue;
    line.note_refusal(displaced,
                      "leaves more than twice as much as " + rival->name() + " when both are followed to their ends");
    return line;
  }
  return search;
}

}  // namespace torquescope
