#include "engine/decision/replicate_gains.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/decision/delay_decision.hpp"
#include "engine/decision/row_noise.hpp"
#include "engine/decision/smooth_correction.hpp"
#include "engine/simulate/twin_lanes.hpp"
#include "engine/statistics/twin_null.hpp"

namespace torquescope {
namespace {

constexpr std::size_t draws_for_each = 3;
constexpr std::size_t fewest = 24;

class Replicates {
 public:
  Replicates(DecisionQuestion const& question, FittedModel const& model, AskedLaws const& asked, FoldKind kind,
             std::uint32_t step)
      : q_(question), model_(model), asked_(asked.first), doubted_(asked.doubted), kind_(kind), step_(step) {
    ReplicateSetting const setting{
        q_.training, q_.filter, plausible_sticking(recording().on(), recording().chosen(), q_.numbers.sticking_odds),
        q_.seed,     step,      q_.threads};
    for (std::size_t i = 0; i < q_.training.size(); ++i)
      makers_.emplace_back(setting, i, recording().on(), recording().chosen());
    result_.source = makers_.front().source();
    SmoothCorrection const found =
        best_correction(recording(), {recording().base(), recording().residual(), recording().guard()});
    double const energy = recording().chosen().fit.torque.squaredNorm() / static_cast<double>(recording().on().rows());
    if (found.rms * found.rms >= q_.numbers.delta * q_.numbers.delta * energy) correction_ = found.gain;
  }

  ReplicateGains run(std::vector<LawQuestion>& questions, Eigen::VectorXd const& gains) && {
    std::size_t const wanted = q_.numbers.replicates;
    for (std::size_t first = 0; first < draws_for_each * wanted && count() < wanted; first += twin_lanes) {
      tell(wanted);
      take(within(drawn(first)), questions);
      if (is_decided(gains)) break;
    }
    if (count() < fewest && !is_decided(gains)) {
      std::vector<FittedStrips> nearest = std::exchange(nearest_, {});
      keep_first(nearest, fewest - count());
      take(std::move(nearest), questions);
    }
    tell(count());
    return std::move(result_);
  }

 private:
  FittedStrips const& recording() const { return *model_.fitted; }
  std::size_t count() const { return result_.chance.replicates(); }

  void tell(std::size_t of) const {
    if (q_.progress) q_.progress("replicates", count(), of);
  }

  // p is at most alpha, or cannot be any more
  bool is_told(double p) const {
    double const all = static_cast<double>(count()) + 1.0;
    return p <= q_.numbers.alpha || p * all - 1.0 >= static_cast<double>(q_.numbers.exceedances);
  }

  // The laws in question cannot come out any more, or the first of them has come out and no replicate reached it;
  // without a name it must be told whether the model is adequate
  bool is_decided(Eigen::VectorXd const& gains) const {
    if (count() < 2) return false;
    Eigen::VectorXd const p = result_.chance.p(gains);
    if (!asked_.empty()) {
      double const all = static_cast<double>(count()) + 1.0;
      double const first = p[static_cast<Eigen::Index>(asked_.front())];
      if (first * all < 1.5 && first <= q_.numbers.alpha) return true;
    } else if (count() < fewest) {
      return false;
    }
    auto const told = [&](std::size_t law) { return is_told(p[static_cast<Eigen::Index>(law)]); };
    return std::all_of(asked_.begin(), asked_.end(), told) && std::all_of(doubted_.begin(), doubted_.end(), told) &&
           (!correction_ || is_told(empirical_p(*correction_, result_.corrections)));
  }

  std::vector<FittedStrips> drawn(std::size_t first) const {
    std::vector<std::vector<Strip>> strips(twin_lanes);
    for (auto const& maker : makers_) {
      std::vector<Strip> made = maker.strips(first, twin_lanes);
      for (std::size_t t = 0; t < twin_lanes; ++t) strips[t].push_back(std::move(made[t]));
    }
    std::vector<std::unique_ptr<FittedStrips>> each(twin_lanes);
    parallel_for(twin_lanes, q_.threads, [&](std::size_t t, int) {
      each[t] = std::make_unique<FittedStrips>(*model_.model, std::move(strips[t]),
                                               DelayChoice{DelaySearch::everywhere, q_.numbers.longest_delay_s});
    });
    std::vector<FittedStrips> fitted;
    for (auto& one : each) fitted.push_back(std::move(*one));
    return fitted;
  }

  static void keep_first(std::vector<FittedStrips>& all, std::size_t count) {
    if (all.size() > count) all.erase(all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
  }

  // those that leave no more than the recording; of the others the nearest are kept aside
  std::vector<FittedStrips> within(std::vector<FittedStrips> all) {
    double const most = recording().chosen().fit.energy();
    std::vector<FittedStrips> kept;
    std::erase_if(all, [](FittedStrips const& one) { return !std::isfinite(one.chosen().fit.energy()); });
    for (auto& one : all) (one.chosen().fit.energy() <= most ? kept : nearest_).push_back(std::move(one));
    std::stable_sort(nearest_.begin(), nearest_.end(), [](FittedStrips const& a, FittedStrips const& b) {
      return a.chosen().fit.energy() < b.chosen().fit.energy();
    });
    keep_first(nearest_, fewest);
    return kept;
  }

  void take(std::vector<FittedStrips> fitted, std::vector<LawQuestion>& questions) {
    if (fitted.empty()) return;
    if (noise_.empty()) {
      noise_ = noise_beside(fitted);
      compare_columns(questions, recording(), fitted.front(), q_.numbers.same_columns);
    }
    std::size_t const before = count();
    result_.delays.resize(before + fitted.size());
    parallel_for(fitted.size(), q_.threads, [&](std::size_t t, int) {
      Eigen::VectorXd const noise = noise_of(before + t);
      FittedStrips at_allowed(*model_.model, {fitted[t].strips().begin(), fitted[t].strips().end()},
                              DelayChoice{DelaySearch::given, 0.0, allowed_delay(fitted[t])});
      at_allowed.add_noise(noise);
      fitted[t].add_noise(noise);
      result_.delays[before + t] = delay_gain(fitted[t], at_allowed);
    });
    result_.chance.add(gains_of_replicates(questions, recording(), fitted, kind_, q_.threads));
    result_.corrections.resize(before + fitted.size());
    parallel_for(fitted.size(), q_.threads, [&](std::size_t t, int) {
      Score const score(fitted[t].base(), fitted[t].residual(), fitted[t].guard());
      result_.corrections[before + t] = best_correction(fitted[t], score).gain;
    });
  }

  // what the recording leaves beyond replicates without noise; of each recording
  std::vector<OctavePowers> noise_beside(std::vector<FittedStrips> const& replicates) const {
    std::vector<OctavePowers> noise;
    Eigen::Index row = 0;
    for (auto const& strip : recording().strips()) {
      auto const rows = static_cast<Eigen::Index>(strip.rows.size());
      std::vector<OctavePowers> without;
      for (auto const& one : replicates) without.push_back(octave_powers(one.residual().segment(row, rows)));
      noise.push_back(less(octave_powers(recording().residual().segment(row, rows)), mean_of(without)));
      row += rows;
    }
    return noise;
  }

  Eigen::VectorXd noise_of(std::size_t replicate) const {
    Eigen::VectorXd all(recording().on().rows());
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < noise_.size(); ++i) {
      auto const rows = static_cast<Eigen::Index>(recording().strips()[i].rows.size());
      auto const address = static_cast<std::uint32_t>(replicate * noise_.size() + i);
      all.segment(row, rows) = drawn_noise(noise_[i], rows, {q_.seed, step_, address});
      row += rows;
    }
    return all;
  }

  DecisionQuestion const& q_;
  FittedModel const& model_;
  std::vector<std::size_t> const &asked_, &doubted_;
  FoldKind kind_;
  std::uint32_t step_;
  std::vector<ReplicateMaker> makers_{};
  std::vector<FittedStrips> nearest_{};  // of those that leave more than the recording
  std::vector<OctavePowers> noise_{};
  std::optional<double> correction_{};  // D of smooth functions, of the recording; none: too small to matter
  ReplicateGains result_{};
};

}  // namespace

ReplicateGains replicate_gains(DecisionQuestion const& question, FittedModel const& model,
                               std::vector<LawQuestion>& questions, Eigen::VectorXd const& gains,
                               AskedLaws const& asked, FoldKind kind, std::uint32_t step) {
  return Replicates(question, model, asked, kind, step).run(questions, gains);
}

}  // namespace torquescope
