#include "engine/infer/moving_rows/candidate_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/fit/statistics/twin_null.hpp"
#include "engine/infer/search/shape_grid.hpp"

namespace torquescope {
namespace {

// some points of one law
struct Slice {
  std::size_t law = 0, first = 0, last = 0;
};

// of a law over its grid so far
struct Best {
  Eigen::VectorXd gain{};             // 1 + M: of each signal at its own best shape
  Eigen::VectorXd first{}, unseen{};  // there
  LawGain recording{};                // at the recording's best shape
  std::size_t point = 0;
  bool is_testable = false;
};

void add(Best& best, LawGain&& gain, std::size_t point) {
  if (!gain.is_testable) return;
  Eigen::VectorXd const total = gain.total();
  if (!best.is_testable) {
    best = {total, gain.first, gain.unseen, std::move(gain), point, true};
    return;
  }
  bool const is_better = total[0] > best.gain[0];
  for (Eigen::Index t = 0; t < total.size(); ++t)
    if (total[t] > best.gain[t]) {
      best.gain[t] = total[t];
      best.first[t] = gain.first[t];
      best.unseen[t] = gain.unseen[t];
    }
  if (is_better) {
    best.recording = std::move(gain);
    best.point = point;
  }
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  auto const at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  return values[at];
}

void finish(CandidateEvidence& law, Best const& best) {
  law.scan.is_testable = best.is_testable;
  if (!best.is_testable) return;
  std::vector<double> const null(best.gain.data() + 1, best.gain.data() + best.gain.size());
  law.null_standard = standardised_twins(null);
  law.scan.z = twin_z(best.gain[0], null);
  Eigen::VectorXd const of_twins = best.first.tail(best.first.size() - 1);
  law.first_mean = of_twins.mean();
  law.first_spread =
      std::sqrt((of_twins.array() - law.first_mean).square().sum() / static_cast<double>(null.size() - 1));
  law.scan.gain = best.gain[0];
  law.scan.best_point = best.point;
  law.scan.shape = law.scan.grid.point(best.point);
  law.scan.parameters = best.recording.parameters;
  law.train = best.recording.train[0];
  law.first = best.recording.first[0];
  law.unseen = best.recording.unseen[0];
  law.least_unseen = quantile({best.unseen.data() + 1, best.unseen.data() + best.unseen.size()}, 0.05);
}

}  // namespace

CatalogueEvidence scan_catalogue(Evidence const& evidence, std::span<Effect const* const> effects, FoldKind kind,
                                 double alpha, int threads) {
  constexpr std::size_t points_at_once = 16;
  CatalogueEvidence result;
  std::vector<Slice> slices;
  CandidateColumns const& columns = evidence.columns();
  for (auto const* effect : effects) {
    if (!effect->exists_on(columns.joint())) continue;
    CandidateEvidence law;
    law.folds = kind;
    law.scan.effect = effect;
    law.scan.grid = shape_grid(*effect, columns.scales());
    for (std::size_t first = 0; first < law.scan.grid.size(); first += points_at_once)
      slices.push_back({result.laws.size(), first, std::min(law.scan.grid.size(), first + points_at_once)});
    result.laws.push_back(std::move(law));
  }
  std::vector<std::vector<LawGain>> gains(slices.size());
  parallel_for(slices.size(), threads, [&](std::size_t i, int) {
    auto const& law = result.laws[slices[i].law];
    std::vector<std::vector<double>> shapes;
    for (std::size_t k = slices[i].first; k < slices[i].last; ++k) shapes.push_back(law.scan.grid.point(k));
    gains[i] = evidence.gains(*law.scan.effect, shapes, kind, DrivenBy::twin, LawRate::scan);
  });
  std::vector<Best> best(result.laws.size());
  for (std::size_t i = 0; i < slices.size(); ++i)
    for (std::size_t k = 0; k < gains[i].size(); ++k)
      add(best[slices[i].law], std::move(gains[i][k]), slices[i].first + k);
  for (std::size_t i = 0; i < best.size(); ++i) finish(result.laws[i], best[i]);

  auto const m = static_cast<std::size_t>(evidence.stage().comparison.rows.n_twins());
  result.largest.assign(m, -std::numeric_limits<double>::infinity());
  for (auto const& law : result.laws)
    for (std::size_t t = 0; t < law.null_standard.size(); ++t)
      result.largest[t] = std::max(result.largest[t], law.null_standard[t]);
  result.chance = quantile(result.largest, 1.0 - alpha);
  for (auto& law : result.laws) {
    if (!law.scan.is_testable) continue;
    law.scan.p = empirical_p(law.scan.z, result.largest);
    law.scan.chance_z = result.chance;
    law.scan.p_is_bound = law.scan.z > *std::max_element(result.largest.begin(), result.largest.end());
  }
  return result;
}

}  // namespace torquescope
