#include "engine/diagnose/arms/whole_arm_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/diagnose/arms/own_instants.hpp"
#include "engine/diagnose/arms/whole_arm_energies.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

Eigen::MatrixXd beside(Eigen::MatrixXd const& basis, Eigen::MatrixXd const& more) {
  Eigen::MatrixXd both(basis.rows(), basis.cols() + more.cols());
  both << basis, more;
  return both;
}

class WholeArmWork {
 public:
  explicit WholeArmWork(WholeArmQuestion const& question)
      : question_(question),
        noise_(question.noise),
        rows_(question.train),
        validation_(question.validation),
        basis_(orthonormal_basis(rows_.model)),
        residual_(left_by(basis_)) {}

  WholeArmAnswer run() {
    WholeArmAnswer answer;
    for (std::uint32_t step = 0; !rows_.places.empty() && !rows_.stretches.empty(); ++step) {
      auto scanned = scan_whole_arm_effects(rows_, basis_, residual_, {question_.seed, step, question_.threads});
      if (scanned.empty()) break;
      sort_strongest_first(scanned);
      Eigen::VectorXd const left = left_out_of_stretches(rows_, basis_, residual_);
      Judged best = judged(scanned.front(), left);
      if (step == 0) {
        answer.tried.push_back(best.found);
        for (std::size_t i = 1; i < scanned.size(); ++i) answer.tried.push_back(judged(scanned[i], left).found);
      }
      if (best.found.reason != WholeArmReason::accepted) break;
      best.found.alike = alike_to(best, scanned, left);
      basis_ = beside(basis_, best.fit.directions);
      residual_ = left_by(basis_);
      accepted_.push_back(best.found);
    }
    answer.accepted = accepted_;
    return answer;
  }

 private:
  struct Judged {
    FoundWholeArmEffect found{};
    WholeArmFit fit{};
    Eigen::VectorXd left{};
  };

  Eigen::VectorXd left_by(Eigen::MatrixXd const& basis) const {
    return rows_.torque - basis * inner_products(basis, rows_.torque);
  }

  // stretches of the recordings it may act in
  std::vector<ArmStretch> concerned(std::optional<ActingTime> const& time) const {
    std::vector<ArmStretch> stretches;
    for (ArmStretch const& one : rows_.stretches)
      if (one.rows.size() > 0 && (!time || one.recording == time->recording)) stretches.push_back(one);
    return stretches;
  }

  // z tells an effect from chance, and what it gains tells effects apart: those beyond chance come by their gain
  void sort_strongest_first(std::vector<ScannedEffect>& scanned) const {
    std::stable_sort(scanned.begin(), scanned.end(), [](auto const& a, auto const& b) { return a.z > b.z; });
    auto const chance = std::stable_partition(
        scanned.begin(), scanned.end(), [&](ScannedEffect const& one) { return one.p <= question_.numbers.alpha; });
    std::stable_sort(scanned.begin(), chance, [](auto const& a, auto const& b) { return a.gain > b.gain; });
  }

  static HeldOutGain gain_of(std::vector<ArmStretch> const& stretches, Eigen::VectorXd const& before,
                             Eigen::VectorXd const& after, Blocks which) {
    std::vector<HeldOutBlock> blocks;
    for (ArmStretch const& one : stretches)
      blocks.push_back({energy_on(before, one.rows), energy_on(after, one.rows), energy_on(before - after, one.rows),
                        static_cast<double>(one.rows.size())});
    return held_out_gain(blocks, which);
  }

  Judged judged(ScannedEffect const& scanned, Eigen::VectorXd const& left) const {
    Judged one;
    one.fit = fit_whole_arm_effect(rows_, scanned, basis_, residual_);
    one.left = left_out_of_stretches(rows_, beside(basis_, one.fit.directions), residual_);
    FoundWholeArmEffect& found = one.found;
    found.effect = rows_.places[scanned.effect];
    found.time = one.fit.time;
    found.values = one.fit.values;
    found.errors = one.fit.errors;
    found.is_told = one.fit.is_told;
    found.z = scanned.z;
    found.p = scanned.p;
    auto const stretches = concerned(found.time);
    auto const joints = static_cast<std::size_t>(noise_.size());
    Eigen::VectorXd const before = energies_on(rows_, left, stretches, joints),
                          after = energies_on(rows_, one.left, stretches, joints);
    Eigen::VectorXd noise = Eigen::VectorXd::Zero(before.size());
    double plain_before = 0.0, plain_after = 0.0, plain_torque = 0.0;
    for (ArmStretch const& stretch : stretches) {
      noise += noise_energies(rows_, residual_, stretch, joints);
      plain_before += plain_energy(rows_, noise_, left, stretch.rows);
      plain_after += plain_energy(rows_, noise_, one.left, stretch.rows);
      plain_torque += plain_energy(rows_, noise_, rows_.torque, stretch.rows);
    }
    found.explained = explained_share(before.sum(), after.sum(), noise.sum());
    found.explained_at.resize(before.size());
    for (Eigen::Index j = 0; j < before.size(); ++j)
      found.explained_at[j] = explained_share(before[j], after[j], noise[j]);
    found.before = std::sqrt(plain_before / plain_torque);
    found.after = std::sqrt(plain_after / plain_torque);
    look_at_validation(found);
    Blocks const which = found.time ? Blocks::where_it_acts : Blocks::alike;
    found.reason = reason_of(found, gain_of(stretches, left, one.left, which), least_left_share(before, after));
    return one;
  }

  WholeArmReason reason_of(FoundWholeArmEffect const& found, HeldOutGain const& held_out, double left_share) const {
    if (found.p > question_.numbers.alpha) return WholeArmReason::chance;
    if (!is_within_bounds(found)) return WholeArmReason::out_of_bounds;
    if (held_out.change != HeldOutChange::lower) return WholeArmReason::not_held_out;
    if (left_share > 1.0 - question_.numbers.least_fall) return WholeArmReason::too_small;
    if (found.explained <= question_.numbers.most_of_it) return WholeArmReason::most_is_left;
    if (found.validation_after > found.validation_before) return WholeArmReason::validation;
    return WholeArmReason::accepted;
  }

  // bounds of such effects are plain numbers
  static bool is_within_bounds(FoundWholeArmEffect const& found) {
    auto const& parameters = found.effect.effect->parameters();
    for (Eigen::Index i = 0; i < found.values.size(); ++i) {
      EffectParameter const& one = parameters[static_cast<std::size_t>(i)];
      if (found.values[i] < one.lower.factor || found.values[i] > one.upper.factor) return false;
    }
    return true;
  }

  // torque of accepted effects and of one more, on the rows of a recording: divided by noise as these are
  static Eigen::VectorXd effect_torque(WholeArmRows const& rows, FoundWholeArmEffect const& found) {
    return rows.effects.middleCols(found.effect.first, found.effect.count) * found.values;
  }

  Eigen::VectorXd trained_torque(FoundWholeArmEffect const& found) const {
    Eigen::VectorXd torque = effect_torque(rows_, found);
    if (!found.time) return torque;
    for (ArmStretch const& stretch : rows_.stretches)
      for (Eigen::Index i = stretch.rows.from; i < stretch.rows.to; ++i)
        if (!found.time->holds(stretch.recording, rows_.rows[static_cast<std::size_t>(i)].time_s)) torque[i] = 0.0;
    return torque;
  }

  // what validation recordings leave, of all effects beside the model as fitted with them; the last effect is yet to be
  // placed
  Eigen::VectorXd validation_left(std::size_t which, std::vector<FoundWholeArmEffect> const& effects) const {
    Eigen::VectorXd torque = rows_.torque;
    for (auto const& effect : effects) torque -= trained_torque(effect);
    Eigen::VectorXd const parameters = solve_scaled(rows_.model, torque);
    WholeArmRows const& rows = validation_[which];
    Eigen::VectorXd left = rows.torque - rows.model * parameters;
    for (auto const& effect : effects)
      if (which < effect.validation_times.size()) left -= placed_torque(rows, effect, which);
    return left;
  }

  static Eigen::VectorXd placed_torque(WholeArmRows const& rows, FoundWholeArmEffect const& found, std::size_t which) {
    auto const& time = found.validation_times[which];
    Eigen::VectorXd torque = effect_torque(rows, found);
    for (Eigen::Index i = 0; i < torque.size(); ++i)
      if (!time || !time->holds(which, rows.rows[static_cast<std::size_t>(i)].time_s)) torque[i] = 0.0;
    return torque;
  }

  void look_at_validation(FoundWholeArmEffect& found) const {
    double before = 0.0, after = 0.0, torque = 0.0;
    std::vector<FoundWholeArmEffect> with = accepted_;
    with.push_back(found);
    for (std::size_t k = 0; k < validation_.size(); ++k) {
      found.validation_times.emplace_back();
      if (validation_[k].stretches.empty()) continue;
      RowBlock const all{0, validation_[k].torque.size()};
      Eigen::VectorXd left = validation_left(k, with), acting = effect_torque(validation_[k], found);
      found.validation_times.back() = ActingTime{k};
      if (found.time) {
        auto own = own_instants(validation_[k], k, left, acting, question_.numbers.alpha,
                                {question_.seed, static_cast<std::uint32_t>(k), question_.threads});
        found.validation_times.back() = own.time;
        acting = std::move(own.torque);
      }
      left -= acting;
      before += plain_energy(validation_[k], noise_, validation_left(k, accepted_), all);
      after += plain_energy(validation_[k], noise_, left, all);
      torque += validation_[k].torque_energy;
    }
    if (!(torque > 0.0)) return;
    found.validation_before = std::sqrt(before / torque);
    found.validation_after = std::sqrt(after / torque);
  }

  std::vector<Effect const*> alike_to(Judged const& best, std::vector<ScannedEffect> const& scanned,
                                      Eigen::VectorXd const& left) const {
    std::vector<Effect const*> alike;
    auto const stretches = concerned(best.found.time);
    for (ScannedEffect const& one : scanned) {
      Effect const* effect = rows_.places[one.effect].effect;
      bool const is_known =
          effect == best.found.effect.effect || std::find(alike.begin(), alike.end(), effect) != alike.end();
      if (is_known || one.p > question_.numbers.alpha) continue;
      Judged const rival = judged(one, left);
      bool const is_worse =
          gain_of(stretches, rival.left, best.left, Blocks::where_it_acts).change == HeldOutChange::lower;
      if (!is_worse) alike.push_back(effect);
    }
    return alike;
  }

  WholeArmQuestion const& question_;
  Eigen::VectorXd const& noise_;  // [N]
  WholeArmRows const& rows_;
  std::span<WholeArmRows const> validation_;
  Eigen::MatrixXd basis_{};     // of the model and of what was accepted
  Eigen::VectorXd residual_{};  // what it leaves
  std::vector<FoundWholeArmEffect> accepted_{};
};

}  // namespace

WholeArmAnswer search_whole_arm(WholeArmQuestion const& question) {
  if (question.train.places.empty() || question.train.rows.empty()) return {};
  return WholeArmWork(question).run();
}

std::vector<Eigen::VectorXd> whole_arm_torques(std::vector<FoundWholeArmEffect> const& accepted,
                                               OneRecording const& of) {
  std::vector<Eigen::VectorXd> torques;
  for (auto const& columns : of.effects.front().columns) torques.emplace_back(Eigen::VectorXd::Zero(columns.rows()));
  for (FoundWholeArmEffect const& found : accepted) {
    auto const effect = std::find_if(of.effects.begin(), of.effects.end(), [&](WholeArmEffect const& one) {
      return one.effect == found.effect.effect && one.joint == found.effect.joint;
    });
    auto const& time = of.is_validation ? found.validation_times[of.which] : found.time;
    if (of.is_validation && !time) continue;
    for (std::size_t j = 0; j < torques.size(); ++j) {
      Eigen::VectorXd torque = effect->columns[j] * found.values;
      for (Eigen::Index i = 0; i < torque.size() && time; ++i)
        if (!time->holds(of.which, of.time_s[i])) torque[i] = 0.0;
      torques[j] += torque;
    }
  }
  return torques;
}

}  // namespace torquescope
