#include "engine/diagnose/arms/effect_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/data/filter_checks.hpp"
#include "engine/effects/fitted_baseline.hpp"
#include "engine/fit/problem/arm_regression.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/decision/shape_grid.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// what the shapes are asked of: the arm without its effects
struct BareRecording {
  std::vector<Motion> motion{};
  std::vector<MatrixXd> rows{};  // [N] of the bare model at the full rate
};

class EffectWork {
 public:
  EffectWork(ArmModel const& model, std::span<RecordedArm const> train, ArmFilter const& filter)
      : bare_(model.with_effects({})), train_(train), filter_(filter), effects_(model.effects()) {
    PlainArmFit const fit = fit_parameters(bare_, train, filter);
    noise_ = fit.noise;
    for (auto const& recording : train) {
      BareRecording one{motion_of(recording, filter), {}};
      recorded_.push_back(rows_of(bare_, recording, one.motion, filter));
      one.rows = bare_.rows(one.motion, recording.payload);
      recordings_.push_back(std::move(one));
    }
    data_ = stack_rows(recorded_, ArmRowChoice::moving, bare_, noise_, filter.section);
    basis_ = orthonormal_basis(data_.phi);
    for (HeldEffect& held : effects_) set_out(held, fit.parameters);
  }

  std::vector<HeldEffect> run() {
    bool const feels_load = std::any_of(effects_.begin(), effects_.end(),
                                        [](HeldEffect const& held) { return held.effect->needs_baseline(); });
    constexpr int rounds_together = 3;  // each changes the next by a small part of its own error
    int const rounds = effects_.size() > 1 || feels_load ? rounds_together : 1;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < effects_.size(); ++i) refine(i);
      if (!feels_load) continue;
      VectorXd const values = fit_parameters(bare_.with_effects(effects_), train_, filter_, noise_).parameters;
      for (HeldEffect& held : effects_) held.baseline = values;
    }
    return effects_;
  }

 private:
  void set_out(HeldEffect& held, VectorXd const& parameters) const {
    ChainJoint const& joint = bare_.chain().joints[held.joint];
    Motion const motion = bare_.motor_motion(recordings_.front().motion, held.joint);
    held.scales =
        measure_scales(motion, joint.kind, torque_band_of(filter_.options, motion.rate_hz), joint.encoder_step);
    held.baseline = parameters;
  }

  // n x n_linear beside each other, of the stacked rows
  MatrixXd columns_of(HeldEffect const& held) const {
    MatrixXd columns = MatrixXd::Zero(data_.rows(), static_cast<Index>(held.effect->n_linear()));
    std::size_t block = 0;
    for (std::size_t k = 0; k < recordings_.size(); ++k) {
      auto const& one = recordings_[k];
      Motion const& first = one.motion.front();
      ParallelFilter const parallel(filter_.options, first.rate_hz, first.q.size(), filter_.section);
      auto const of_joints = bare_.effect_columns(held, one.motion, one.rows);
      for (std::size_t j = 0; j < of_joints.size(); ++j, ++block) {
        if (of_joints[j].size() == 0) continue;
        auto const& instants = recorded_[k].moving[j].instant;
        columns.middleRows(data_.first_row[block], std::ssize(instants)) =
            parallel.apply_columns(of_joints[j])(instants, Eigen::all) / noise_[static_cast<Index>(j)];
      }
    }
    return columns;
  }

  // what the columns explain of what stands beside a basis, and with which parameters
  struct Explained {
    double gain = 0.0;
    MatrixXd columns{};     // beside the basis
    VectorXd parameters{};  // none where a sign is wrong, or the basis imitates a column
  };

  // what an effect has beside the others, and what these leave
  struct Beside {
    HeldEffect held{};
    MatrixXd basis{};
    VectorXd left{};
  };

  Explained explained(Beside const& of, std::vector<double> const& shape) const {
    constexpr double imitated = 1e-6;  // of a column's length: what is left of it is rounding
    Effect const& effect = *of.held.effect;
    Explained made;
    if (!effect.is_plausible(shape, of.held.scales)) return made;
    HeldEffect tried = of.held;
    tried.shape = shape;
    made.columns = columns_of(tried);
    VectorXd const lengths = made.columns.colwise().norm();
    made.columns -= of.basis * (of.basis.transpose() * made.columns);
    for (Index k = 0; k < made.columns.cols(); ++k)
      if (!(made.columns.col(k).norm() > imitated * lengths[k])) return made;
    VectorXd const values = solve_scaled(made.columns, of.left);
    for (Index k = 0; k < values.size(); ++k)
      if (effect.parameters()[static_cast<std::size_t>(k)].sign() == Sign::non_negative && values[k] < 0.0) return made;
    made.parameters = values;
    made.gain = of.left.squaredNorm() - (of.left - made.columns * values).squaredNorm();
    return made;
  }

  Beside beside_others(std::size_t which) const {
    Beside of{effects_[which], basis_, {}};
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      if (i == which || !effects_[i].effect->takes_shape(effects_[i].shape.size())) continue;
      MatrixXd columns = columns_of(effects_[i]);
      columns -= of.basis * (of.basis.transpose() * columns);
      MatrixXd const own = orthonormal_basis(columns);
      of.basis.conservativeResize(Eigen::NoChange, of.basis.cols() + own.cols());
      of.basis.rightCols(own.cols()) = own;
    }
    of.left = data_.tau - of.basis * (of.basis.transpose() * data_.tau);
    return of;
  }

  std::vector<double> best_of(ShapeGrid const& grid, Beside const& of) const {
    std::vector<double> best = grid.point(0);
    double most = 0.0;
    for (std::size_t p = 0; p < grid.size(); ++p) {
      double const gain = explained(of, grid.point(p)).gain;
      if (gain <= most) continue;
      most = gain;
      best = grid.point(p);
    }
    return best;
  }

  // steps of Levenberg and Marquardt on the columns and the tangents of the shapes, within the bounds
  std::vector<double> polished(Beside const& of, std::vector<ParameterRange> const& ranges,
                               std::vector<double> shape) const {
    constexpr int most_steps = 40;
    constexpr double nothing = 1e-9, least_damping = 1e-6, most_damping = 1e6;
    double damping = 1e-3;
    Explained at = explained(of, shape);
    for (int step = 0; step < most_steps && damping < most_damping && at.parameters.size() > 0; ++step) {
      auto const next = stepped(of, ranges, shape, at, damping);
      Explained const there = explained(of, next);
      bool const is_better = there.gain > at.gain;
      damping = is_better ? std::max(least_damping, 0.1 * damping) : 10.0 * damping;
      if (!is_better) continue;
      bool const is_done = there.gain - at.gain < nothing * of.left.squaredNorm();
      shape = next;
      at = there;
      if (is_done) break;
    }
    return shape;
  }

  std::vector<double> stepped(Beside const& of, std::vector<ParameterRange> const& ranges,
                              std::vector<double> const& shape, Explained const& at, double damping) const {
    constexpr double little = 1e-3;  // of the bounds, in the search's own scale
    auto const d = std::ssize(shape);
    auto const moved = [&](std::size_t k, double way) {
      auto next = shape;
      next[k] = from_unit(ranges[k], std::clamp(to_unit(ranges[k], shape[k]) + way, 0.0, 1.0));
      return next;
    };
    MatrixXd tangents = MatrixXd::Zero(of.left.size(), d);
    for (Index k = 0; k < d; ++k) {
      auto const place = static_cast<std::size_t>(k);
      double const unit = to_unit(ranges[place], shape[place]), way = unit > 0.5 ? -little : little;
      Explained const there = explained(of, moved(place, way));
      if (there.columns.cols() == at.columns.cols())
        tangents.col(k) = (there.columns - at.columns) * at.parameters / way;
    }
    MatrixXd const free = tangents - at.columns * solve_scaled(at.columns, tangents);
    MatrixXd normal = free.transpose() * free;
    normal.diagonal() += damping * normal.diagonal() + VectorXd::Constant(d, 1e-12 * normal.trace());
    VectorXd const by = solve_positive(normal, VectorXd(free.transpose() * (of.left - at.columns * at.parameters)));
    auto next = shape;
    for (std::size_t k = 0; k < next.size(); ++k) {
      double const unit = to_unit(ranges[k], shape[k]) + by[static_cast<Index>(k)];
      next[k] = from_unit(ranges[k], std::clamp(unit, 0.0, 1.0));
    }
    return next;
  }

  void refine(std::size_t which) {
    HeldEffect& held = effects_[which];
    if (held.effect->n_shape() == 0) return;
    Beside const of = beside_others(which);
    ShapeGrid const grid = shape_grid(*held.effect, held.scales);
    if (held.shape.empty()) held.shape = best_of(grid, of);
    // what a job gives may lie beyond what is plausible
    for (std::size_t k = 0; k < held.shape.size(); ++k)
      held.shape[k] = std::clamp(held.shape[k], grid.ranges[k].lower, grid.ranges[k].upper);
    held.shape = polished(of, grid.ranges, held.shape);
  }

  ArmModel bare_;
  std::span<RecordedArm const> train_;
  ArmFilter const& filter_;
  std::vector<HeldEffect> effects_;
  VectorXd noise_{};  // [N]
  std::vector<RecordedRows> recorded_{};
  std::vector<BareRecording> recordings_{};
  RegressionData data_{};
  MatrixXd basis_{};
};

}  // namespace

std::vector<HeldEffect> refined_effects(ArmModel const& model, std::span<RecordedArm const> train,
                                        ArmFilter const& filter) {
  return EffectWork(model, train, filter).run();
}

std::string shape_name(HeldEffect const& held, std::size_t shape) {
  return held.effect->parameters()[held.effect->n_linear() + shape].name + "_" + std::to_string(held.joint + 1);
}

std::vector<std::size_t> shapes_at_bounds(HeldEffect const& held) {
  constexpr double near = 1e-3;
  auto const ranges = held.effect->shape_bounds(held.scales);
  std::vector<std::size_t> at;
  for (std::size_t d = 0; d < held.shape.size(); ++d) {
    auto const& parameter = held.effect->parameters()[held.effect->n_linear() + d];
    double const unit = to_unit(ranges[d], held.shape[d]);
    if ((unit < near && !parameter.effect_at_lower) || (unit > 1.0 - near && !parameter.effect_at_upper))
      at.push_back(d);
  }
  return at;
}

}  // namespace torquescope
