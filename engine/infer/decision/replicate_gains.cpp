#include "engine/infer/decision/replicate_gains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/infer/decision/delay_decision.hpp"
#include "engine/infer/decision/row_noise.hpp"
#include "engine/simulate/replicate_lanes.hpp"

namespace torquescope {
namespace {

constexpr std::size_t draws_for_each = 3;
constexpr std::size_t fewest = 24;
constexpr std::size_t at_once = 8;  // before it is asked whether they are enough: a divisor of `fewest`

// a replicate that leaves more than the recording
struct Beyond {
  double energy = 0.0;
  std::size_t replicate = 0;
};

class Replicates {
 public:
  Replicates(DecisionQuestion const& question, ReplicateTask const& task) : q_(question), task_(task) {
    ReplicateSetting const setting{
        q_.training, q_.filter, plausible_sticking(recording().on(), recording().chosen(), q_.numbers.sticking_odds),
        q_.seed,     task.step, q_.threads};
    for (std::size_t i = 0; i < q_.training.size(); ++i)
      makers_.emplace_back(setting, i, recording().on(), recording().chosen());
    result_.source = makers_.front().source();
    double const energy = recording().chosen().fit.torque.squaredNorm() / static_cast<double>(recording().on().rows());
    least_rms_ = q_.numbers.delta * std::sqrt(energy);
  }

  ReplicateGains run(std::vector<EffectQuestion>& questions) && {
    auto const wanted = static_cast<std::size_t>(q_.numbers.replicates);
    for (std::size_t first = 0; first < draws_for_each * wanted && count() < wanted; first += replicate_lanes) {
      tell(wanted);
      if (take(within(drawn(first), first), questions)) break;
    }
    if (count() < fewest && !is_decided()) take(nearest(fewest - count()), questions);
    tell(count());
    return std::move(result_);
  }

 private:
  FittedStrips const& recording() const { return *task_.model.fitted; }
  std::size_t count() const { return result_.chance.replicates(); }

  void tell(std::size_t of) const {
    if (q_.progress) q_.progress("replicates", count(), of);
  }

  // p is at most alpha, or cannot be any more
  bool is_told(double p, double alpha) const {
    double const all = static_cast<double>(count()) + 1.0;
    return p <= alpha || p * all - 1.0 >= static_cast<double>(q_.numbers.exceedances);
  }

  // An effect that can be named has come out and no replicate reached it; or it is told of all, and whether the
  // model is adequate
  bool is_decided() const {
    if (count() < 2) return false;
    Eigen::VectorXd const p = result_.chance.p(task_.gains);
    double least = std::numeric_limits<double>::infinity();
    Eigen::VectorXd const p_of_corrections = result_.corrections.p(task_.corrections.gains);
    bool are_told = true;
    for (Eigen::Index i = 0; i < p_of_corrections.size(); ++i)
      if (task_.corrections.rms[i] >= least_rms_)
        are_told = are_told && is_told(p_of_corrections[i], q_.numbers.correction_alpha());
    for (Eigen::Index effect = 0; effect < p.size(); ++effect) {
      auto const at = static_cast<std::size_t>(effect);
      if (task_.asked.nameable[at]) least = std::min(least, p[effect]);
      if (task_.asked.open[at]) are_told = are_told && is_told(p[effect], q_.numbers.alpha);
      if (task_.asked.doubted[at]) are_told = are_told && is_told(p[effect], q_.numbers.correction_alpha());
    }
    if (least * (static_cast<double>(count()) + 1.0) < 1.5 && least <= q_.numbers.alpha) return true;
    return count() >= fewest && are_told;
  }

  std::vector<FittedStrips> drawn(std::size_t first) const {
    std::vector<std::vector<Strip>> strips(replicate_lanes);
    for (auto const& maker : makers_) {
      std::vector<Strip> made = maker.strips(first, replicate_lanes);
      for (std::size_t t = 0; t < replicate_lanes; ++t) strips[t].push_back(std::move(made[t]));
    }
    std::vector<std::unique_ptr<FittedStrips>> each(replicate_lanes);
    parallel_for(replicate_lanes, q_.threads, [&](std::size_t t, int) {
      each[t] = std::make_unique<FittedStrips>(*task_.model.model, share(std::move(strips[t])), free_delay(q_.numbers));
    });
    std::vector<FittedStrips> fitted;
    for (auto& one : each) fitted.push_back(std::move(*one));
    return fitted;
  }

  // Those that leave no more than the recording. The others are noted, not held: of long recordings each is large, and
  // they are seldom asked for
  std::vector<FittedStrips> within(std::vector<FittedStrips> all, std::size_t first) {
    double const most = recording().chosen().fit.energy();
    std::vector<FittedStrips> kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double const energy = all[i].chosen().fit.energy();
      if (!std::isfinite(energy)) continue;
      if (energy <= most) {
        kept.push_back(std::move(all[i]));
      } else {
        beyond_.push_back({energy, first + i});
      }
    }
    return kept;
  }

  // of those that leave more than the recording, made again: the first leaves the least
  std::vector<FittedStrips> nearest(std::size_t wanted) {
    std::stable_sort(beyond_.begin(), beyond_.end(),
                     [](Beyond const& a, Beyond const& b) { return a.energy < b.energy; });
    if (beyond_.size() > wanted) beyond_.resize(wanted);
    std::map<std::size_t, std::vector<std::size_t>> places;  // by the first replicate of a group
    for (std::size_t i = 0; i < beyond_.size(); ++i)
      places[beyond_[i].replicate / replicate_lanes * replicate_lanes].push_back(i);
    std::vector<std::optional<FittedStrips>> made(beyond_.size());
    for (auto const& [first, of_group] : places) {
      std::vector<FittedStrips> group = drawn(first);
      for (std::size_t const i : of_group) made[i] = std::move(group[beyond_[i].replicate - first]);
    }
    std::vector<FittedStrips> all;
    for (auto& one : made) all.push_back(std::move(*one));
    return all;
  }

  // some of them, until it is decided; whether it is
  bool take(std::vector<FittedStrips> fitted, std::vector<EffectQuestion>& questions) {
    if (fitted.empty()) return false;
    if (noise_.empty()) {
      noise_ = noise_beside(fitted);
      compare_columns(questions, recording(), fitted.front(), q_.numbers.same_columns);
    }
    for (std::size_t first = 0; first < fitted.size(); first += at_once) {
      ask(std::span(fitted).subspan(first, std::min(at_once, fitted.size() - first)), questions);
      if (is_decided()) return true;
    }
    return false;
  }

  void ask(std::span<FittedStrips> fitted, std::vector<EffectQuestion> const& questions) {
    std::size_t const before = count();
    result_.delays.resize(before + fitted.size());
    parallel_for(fitted.size(), q_.threads, [&](std::size_t t, int) {
      Eigen::VectorXd const noise = noise_of(before + t);
      FittedStrips at_allowed(*task_.model.model, fitted[t].shared_strips(),
                              DelayChoice{DelaySearch::given, 0.0, allowed_delay(fitted[t])});
      at_allowed.add_noise(noise);
      fitted[t].add_noise(noise);
      result_.delays[before + t] = delay_gain(fitted[t], at_allowed);
    });
    result_.left.conservativeResize(static_cast<Eigen::Index>(recording().strips().front().rows.size()),
                                    static_cast<Eigen::Index>(before + fitted.size()));
    for (std::size_t t = 0; t < fitted.size(); ++t)
      result_.left.col(static_cast<Eigen::Index>(before + t)) = fitted[t].residual().head(result_.left.rows());
    result_.chance.add(gains_of_replicates(questions, recording(), fitted, task_.kind, q_.threads));
    Eigen::MatrixXd corrections(task_.corrections.gains.size(), static_cast<Eigen::Index>(fitted.size()));
    parallel_for(fitted.size(), q_.threads, [&](std::size_t t, int) {
      Score const score(fitted[t].base(), fitted[t].residual(), fitted[t].guard());
      corrections.col(static_cast<Eigen::Index>(t)) = smooth_corrections(fitted[t], score).gains;
    });
    result_.corrections.add(corrections);
  }

  // what the recording leaves beyond replicates without noise; of each recording
  std::vector<OctavePowers> noise_beside(std::vector<FittedStrips> const& replicates) const {
    std::vector<OctavePowers> noise;
    Eigen::Index row = 0;
    for (auto const& strip : recording().strips()) {
      auto const rows = static_cast<Eigen::Index>(strip.rows.size());
      std::vector<OctavePowers> without;
      for (auto const& one : replicates) without.push_back(octave_powers(one.residual().segment(row, rows)));
      noise.push_back(less(octave_powers(task_.noise.segment(row, rows)), mean_of(without)));
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
      Eigen::VectorXd noise = drawn_noise(noise_[i], rows, {q_.seed, task_.step, address});
      // as strong in all as the noise of the weighed rows
      if (Eigen::VectorXd const& weight = recording().strips()[i].row_weight; weight.size() > 0)
        noise = weight.cwiseProduct(noise) * std::sqrt(static_cast<double>(rows)) / weight.norm();
      all.segment(row, rows) = noise;
      row += rows;
    }
    return all;
  }

  DecisionQuestion const& q_;
  ReplicateTask const& task_;
  std::vector<ReplicateMaker> makers_{};
  std::vector<Beyond> beyond_{};
  std::vector<OctavePowers> noise_{};
  double least_rms_ = 0.0;  // of a smooth function that matters
  ReplicateGains result_{};
};

}  // namespace

ReplicateGains replicate_gains(DecisionQuestion const& question, ReplicateTask const& task,
                               std::vector<EffectQuestion>& effects) {
  return Replicates(question, task).run(effects);
}

}  // namespace torquescope
