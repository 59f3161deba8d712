#include "engine/diagnose/arms/setup_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace torquescope {
namespace {

using Eigen::Index;

constexpr double right_angle = 0.5 * std::numbers::pi;

// a change and what it gives
struct Trial {
  SetupChange change;
  SetupFit fit;
  bool is_told_by_file = false;
};

class Search {
 public:
  Search(ArmSamples const& samples, SerialChain const& chain, std::optional<SerialChain> const& otherwise,
         SetupNumbers const& numbers)
      : samples_(samples),
        otherwise_(otherwise),
        numbers_(numbers),
        setup_(setup_as_read(chain)),
        base_(of(chain)),
        fit_(fit(setup_, base_)) {}

  // From each of the most promising first changes on: of two mistakes, the one that gains most alone may be neither
  SetupSearch run() const {
    Search best = *this;
    for (auto const& first : first_changes()) {
      Search other = *this;
      other.take(first);
      other.go_on();
      if (best.search_.steps.empty() ||
          (raises_none(fit_.error, other.fit_.error, numbers_) && other.is_better_than(best)))
        best.become(std::move(other));
    }
    best.search_.fit = best.fit_;
    best.search_.setup = best.setup_;
    return best.search_;
  }

 private:
  void become(Search&& other) {
    setup_ = std::move(other.setup_);
    base_ = std::move(other.base_);
    fit_ = std::move(other.fit_);
    search_ = std::move(other.search_);
  }

  void take(Trial const& trial) {
    auto const error = trial.is_told_by_file ? &SetupFit::file_error : &SetupFit::error;
    search_.steps.push_back({trial.change, trial.is_told_by_file, fit_.*error, trial.fit.*error});
    setup_ = with(trial.change);
    base_ = of(setup_.chain);
    fit_ = trial.fit;
  }

  void go_on() {
    while (search_.steps.size() < numbers_.most_changes) {
      auto const next = next_changes();
      if (next.empty()) return;
      take(next.front());
    }
  }

  // by what is left; a further change must be worth it
  bool is_better_than(Search const& other) const {
    auto const joints = static_cast<double>(samples_.q.cols());
    auto const cost = [&](Search const& of) {
      return of.fit_.score + of.fit_.file_score +
             std::log(1.0 / numbers_.halves) * static_cast<double>(of.search_.steps.size());
    };
    return cost(*this) < cost(other) - numbers_.alike * joints;
  }

  bool is_in_question() const {
    bool const by_file = fit_.file_error.size() > 0 && fit_.file_error.maxCoeff() > numbers_.file_slack;
    return by_file || fit_.error.maxCoeff() > numbers_.least_error;
  }

  static BaseParameters of(SerialChain const& chain) { return {chain, DriveInertias::included}; }

  SetupFit fit(ArmSetup const& setup, BaseParameters const& base) const { return fit_of(samples_, setup, base); }

  static bool is_of_chain(SetupKind kind) {
    return kind == SetupKind::dh_convention || kind == SetupKind::gravity || kind == SetupKind::no_gravity;
  }
  static bool is_small_tilt(SetupChange const& change) {
    return change.kind == SetupKind::gravity && std::abs(std::remainder(change.number, right_angle)) > 1e-6;
  }

  ArmSetup with(SetupChange const& change) const {
    return changed(setup_, change, otherwise_ ? *otherwise_ : SerialChain{});
  }

  Trial tried(SetupChange change) const {
    ArmSetup const other = with(change);
    return {change, is_of_chain(change.kind) ? fit(other, of(other.chain)) : fit(other, base_)};
  }

  // the factor follows from the other joints, whom the same links load, or from the robot file
  void add_factors(std::vector<Trial>& all) const {
    auto const n = samples_.q.cols();
    auto const add = [&](Index joint, double factor) {
      double const size = std::abs(std::log(std::abs(factor)));
      bool const is_a_unit = size > std::log(numbers_.least_factor) && size < std::log(numbers_.greatest_factor);
      if (is_a_unit) all.push_back(tried({SetupKind::torque_factor, joint, -1, factor}));
    };
    bool const has_gears = std::any_of(setup_.chain.joints.begin(), setup_.chain.joints.end(),
                                       [](ChainJoint const& joint) { return joint.gear_ratio != 1.0; });
    if (has_gears) all.push_back(tried({SetupKind::motor_side}));
    for (Index j = 0; j < n && n > 1; ++j) add(j, fit_of(samples_, setup_, base_, j).scale);
    if (fit_.file_scale.size() == 0) return;
    for (Index j = 0; j < n && n > 1; ++j) add(j, fit_.file_scale[j]);
    std::vector<double> sizes(fit_.file_scale.data(), fit_.file_scale.data() + n);
    auto const middle = sizes.begin() + n / 2;
    std::nth_element(sizes.begin(), middle, sizes.end());
    add(-1, *middle);
  }

  // of two zeros, to the last digit: by the recording, and by the file where that does not tell
  static bool better(SetupFit const& one, SetupFit const& other) {
    constexpr double exact = 1e-9;
    auto const sum = [=](Eigen::VectorXd const& error) { return error.array().max(exact).log().sum(); };
    return sum(one.error) + sum(one.file_error) < sum(other.error) + sum(other.file_error);
  }

  // about an angle that helps, by halves: the error has one minimum within a few degrees
  Trial refined(Trial start) const {
    double width = 0.5 * std::min(std::abs(start.change.number), right_angle / 6.0);
    for (int k = 0; k < 10; ++k) {
      Trial next = start;
      for (double const side : {-1.0, 1.0}) {
        SetupChange change = start.change;
        change.number += side * width;
        Trial trial = tried(change);
        if (better(trial.fit, next.fit)) next = std::move(trial);
      }
      start = std::move(next);
      width *= 0.5;
    }
    return start;
  }

  // this change by the angle that helps most, either way; nothing where none does
  void add_angle(std::vector<Trial>& all, SetupChange change, std::vector<double> const& sizes) const {
    change.number = 0.0;
    Trial best{change, fit_};
    for (double const size : sizes)
      for (double const side : {-1.0, 1.0}) {
        change.number = side * size;
        Trial trial = tried(change);
        if (better(trial.fit, best.fit)) best = std::move(trial);
      }
    if (best.change.number != 0.0) all.push_back(refined(std::move(best)));
  }

  // single changes that need no number of their own, the plainer first
  std::vector<SetupChange> plain_changes() const {
    using enum SetupKind;
    auto const n = samples_.q.cols();
    std::vector<SetupChange> changes;
    for (SetupKind const kind : {joint_sign, torque_sign, position_sign})
      for (Index j = 0; j < n; ++j) changes.push_back({kind, j});
    for (SetupKind const kind : {joints_exchanged, positions_exchanged, torques_exchanged})
      for (Index j = 0; j < n; ++j)
        for (Index i = j + 1; i < n; ++i) changes.push_back({kind, j, i});
    if (otherwise_ && !setup_.is_of_other_convention) changes.push_back({dh_convention});
    changes.push_back({no_gravity});
    constexpr double degree = std::numbers::pi / 180.0;
    for (double const factor : {degree, 1.0 / degree, 1e-3})
      for (Index j = n == 1 ? 0 : -1; j < n; ++j) changes.push_back({position_factor, j, -1, factor});
    for (double const turn : {right_angle, -right_angle, 2.0 * right_angle})
      for (Index const axis : axes_across_gravity()) changes.push_back({gravity, axis, -1, turn});
    for (double const turn : {right_angle, -right_angle, 2.0 * right_angle})
      for (Index j = 0; j < n; ++j)
        if (turns(j)) changes.push_back({zero, j, -1, turn});
    return changes;
  }

  std::vector<Index> axes_across_gravity() const {
    std::vector<Index> axes;
    Eigen::Vector3d const gravity = setup_.chain.base.rotation * setup_.chain.gravity;
    constexpr double along = 0.99;  // turning about it changes nothing
    for (Index axis = 0; axis < 3; ++axis)
      if (std::abs(gravity[axis]) < along * gravity.norm()) axes.push_back(axis);
    return axes;
  }

  bool turns(Index joint) const {
    return setup_.chain.joints[static_cast<std::size_t>(joint)].kind == JointKind::revolute;
  }

  bool mends(Eigen::VectorXd const& before, Eigen::VectorXd const& after, double least_error) const {
    return halves_one(before, before, after, least_error, numbers_);
  }

  std::vector<Trial> trials() const {
    std::vector<Trial> all;
    for (auto const& change : plain_changes()) all.push_back(tried(change));
    auto const n = samples_.q.cols();
    add_factors(all);
    for (Index const axis : axes_across_gravity()) add_angle(all, {SetupKind::gravity, axis}, {0.1, 0.3});
    for (Index j = 0; j < n; ++j)
      if (turns(j)) add_angle(all, {SetupKind::zero, j}, {0.1, 0.25, 0.5, 0.8});
    return all;
  }

  // Inertias of a file are seldom right to a tenth: either it was far off, or it comes as close as the fit itself
  bool is_told_by_file(SetupFit const& after) const {
    if (fit_.file_error.size() == 0 || after.file_error.size() == 0) return false;
    if (mends(fit_.file_error, after.file_error, numbers_.least_file_error)) return true;
    auto const nearly_fits = (after.file_error.array() <= 1.5 * after.error.array() + numbers_.file_slack).all();
    return nearly_fits && mends(fit_.file_error, after.file_error, numbers_.file_slack);
  }

  // those whose score is as good as the best one, the plainer first
  std::vector<Trial> best_of(std::vector<Trial> const& all, double SetupFit::*score) const {
    std::vector<Trial> best;
    double lowest = std::numeric_limits<double>::infinity();
    for (auto const& one : all) lowest = std::min(lowest, one.fit.*score);
    double const as_good = lowest + numbers_.alike * static_cast<double>(samples_.q.cols());
    for (auto const& one : all)
      if (one.fit.*score <= as_good) best.push_back(one);
    return best;
  }

  // what the recording says by itself, or what the robot file says where no fit gets worse by it; the best one first
  std::vector<Trial> next_changes() const {
    if (!is_in_question()) return {};
    std::vector<Trial> fitting, of_file;
    for (auto const& one : trials()) {
      if (halves_one(fit_.error, fit_.own_error, one.fit.error, numbers_.least_error, numbers_)) fitting.push_back(one);
      if (raises_none(fit_.error, one.fit.error, numbers_) && is_told_by_file(one.fit))
        of_file.push_back({one.change, one.fit, true});
    }
    auto& all = fitting.empty() ? of_file : fitting;
    auto const score = fitting.empty() ? &SetupFit::file_score : &SetupFit::score;
    auto next = best_of(all, score);
    // of changes that the motion cannot tell apart, the one that the robot file tells
    if (fit_.file_error.size() > 0) next = best_of(next, &SetupFit::file_score);
    // a tilt is physics of the base, told by others
    if (next.empty() || is_small_tilt(next.front().change)) return {};
    next.resize(1);
    return next;
  }

  // beside the best one: those that lower the errors altogether, though one of them may rise until a second mistake is
  // mended
  std::vector<Trial> first_changes() const {
    std::vector<Trial> first = next_changes();
    if (first.empty()) return first;
    std::vector<Trial> others = trials();
    auto const score = [](Trial const& one) { return one.fit.score + one.fit.file_score; };
    std::stable_sort(others.begin(), others.end(), [&](Trial const& a, Trial const& b) { return score(a) < score(b); });
    for (auto const& one : others)
      if (first.size() < numbers_.beginnings && !is_small_tilt(one.change))
        first.push_back({one.change, one.fit, first.front().is_told_by_file});
    return first;
  }

  ArmSamples const& samples_;
  std::optional<SerialChain> const& otherwise_;
  SetupNumbers const& numbers_;
  ArmSetup setup_;
  BaseParameters base_;
  SetupFit fit_;
  SetupSearch search_;
};

}  // namespace

bool raises_none(Eigen::VectorXd const& before, Eigen::VectorXd const& after, SetupNumbers const& numbers) {
  auto const in_bounds = [&](Eigen::VectorXd const& error) -> Eigen::ArrayXd {
    return error.array().max(SetupFit::floor).min(numbers.tells_nothing);
  };
  return (in_bounds(after) <= numbers.worse * in_bounds(before)).all();
}

bool halves_one(Eigen::VectorXd const& before, Eigen::VectorXd const& own, Eigen::VectorXd const& after,
                double least_error, SetupNumbers const& numbers) {
  Eigen::ArrayXd const was = own.array().min(numbers.tells_nothing), is = after.array().max(SetupFit::floor);
  return raises_none(before, after, numbers) && (was > least_error && is < numbers.halves * was).any();
}

SetupSearch search_setup(ArmSamples const& samples, SerialChain const& chain,
                         std::optional<SerialChain> const& otherwise, SetupNumbers const& numbers) {
  return Search(samples, chain, otherwise, numbers).run();
}

}  // namespace torquescope
