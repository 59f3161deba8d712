#include "engine/infer/moving_rows/confidence_set.hpp"

#include <algorithm>

#include "engine/effects/carry_over.hpp"
#include "engine/infer/moving_rows/decision_levels.hpp"

namespace torquescope {
namespace {

// laws that effect i may be another one of. Waves of one kind may be there several times, each for itself
std::vector<Effect const*> others(ModelStage const& stage, std::size_t i, std::span<Effect const* const> catalogue) {
  auto const& effects = stage.model().effects();
  std::vector<Effect const*> result;
  for (auto const* effect : catalogue) {
    bool const is_there =
        std::any_of(effects.begin(), effects.end(), [&](auto const& one) { return one.effect == effect; });
    if (!is_there || (effect->may_come_again() && effect != effects[i].effect)) result.push_back(effect);
  }
  return result;
}

std::size_t waves_of(Effect const& effect) {
  auto const& parameters = effect.parameters();
  return static_cast<std::size_t>(std::count_if(parameters.begin(), parameters.end(),
                                                [](auto const& one) { return one.is_order() || one.is_frequency(); }));
}

// What a rival leaves. Where the accepted law has several waves and the rival one, the rival is given as many: at one
// speed two waves in time are two over position
RowsLeft left_by(Evidence const& evidence, RefinedCandidate const& rival, std::size_t waves, FoldKind kind) {
  Effect const& effect = *rival.evidence.scan.effect;
  RowsLeft best = rival.left;
  std::vector<std::vector<double>> shapes{rival.shape};
  for (std::size_t more = waves_of(effect); more > 0 && shapes.size() * more < waves;) {
    auto const& grid = rival.evidence.scan.grid;
    std::vector<std::vector<double>> next;
    for (std::size_t point = 0; point < grid.size(); ++point) {
      std::vector<std::vector<double>> with = shapes;
      with.push_back(grid.point(point));
      RowsLeft left = evidence.rows_left(effect, with, kind, rival.driven_by);
      if (!(left.energy() < best.energy())) continue;
      best = std::move(left);
      next = std::move(with);
    }
    if (next.empty()) return best;
    shapes = std::move(next);
  }
  return best;
}

}  // namespace

bool may_be_a_rival(EffectScan const& law, double own_gain, double alpha) {
  return law.is_testable && law.gain > 0.0 && (law.p <= alpha || law.gain >= own_gain);
}

std::vector<RivalLaw> confidence_set(Evidence const& of, std::size_t i, std::span<Effect const* const> catalogue,
                                     DecisionLevels const& levels, RefinementSetting const& setting) {
  auto const rivals = others(of.stage(), i, catalogue);
  Evidence const evidence = Evidence(of, i).with_own_events(rivals);
  auto const& [effect, shape] = of.stage().model().effects()[i];
  FoldKind const kind = is_clock_bound(*effect) ? FoldKind::interleaved : FoldKind::whole;
  LawGain const own = evidence.gains(*effect, {shape}, kind).front();
  double const own_gain = own.total()[0];
  RowsLeft const own_left = evidence.rows_left(*effect, shape, kind), without_any = evidence.rows_left(kind);
  CatalogueEvidence const scanned = scan_catalogue(evidence, rivals, kind, levels.alpha, setting.threads);
  std::vector<CandidateEvidence const*> near;
  for (auto const& law : scanned.laws)
    if (may_be_a_rival(law.scan, own_gain, levels.alpha)) near.push_back(&law);
  std::stable_sort(near.begin(), near.end(), [](auto const* a, auto const* b) { return a->scan.gain > b->scan.gain; });
  near.resize(std::min(near.size(), n_refined));
  std::vector<RivalLaw> set;
  for (auto const* law : near) {
    RefinementSetting nearby = setting;
    nearby.everywhere = false;
    RefinedCandidate const refined = refined_candidate(evidence, *law, nearby);
    if (!law->scan.effect->is_plausible(refined.shape, evidence.columns().scales())) continue;
    bool const is_a_law =
        refined.evidence.scan.gain > 0.0 && !refined.bound && leaves_clearly_less(refined.left, without_any);
    if (!is_a_law) continue;
    RowsLeft const left = left_by(evidence, refined, waves_of(*effect), kind);
    if (leaves_clearly_more(left, own_left, {without_any, levels.tolerance})) continue;
    set.push_back({law->scan.effect, refined.shape, own_gain > 0.0 ? refined.evidence.scan.gain / own_gain : 0.0});
  }
  std::stable_sort(set.begin(), set.end(), [](auto const& a, auto const& b) { return a.gain_ratio > b.gain_ratio; });
  return set;
}

}  // namespace torquescope
