#include "engine/infer/decision/loop_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/parallel.hpp"
#include "engine/infer/decision/chance.hpp"
#include "engine/infer/decision/loop_replicates.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// the model as a plane, the recording and its replicates beside it
class Scan {
 public:
  Scan(LoopQuestion const& question, LoopFit const& fit, std::uint32_t step)
      : q_(question),
        fit_(fit),
        model_(fit.point.model(question)),
        unknowns_(model_, question.fitted, question.counts, question.fits_starts),
        at_(unknowns_.begin_at(model_.start())) {
    if (fit.point.starts.size() == at_.starts.size()) at_.starts = fit.point.starts;
    plane_ = tangent_at(unknowns_, at_);
    rows_ =
        loop_replicates(unknowns_, at_, {static_cast<std::size_t>(q_.numbers.replicates), q_.seed, step, q_.threads});
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      Eigen::MatrixXd& rows = rows_[channel];
      Eigen::MatrixXd const& own = plane_.residual[channel];
      if (own.size() == 0) continue;
      Index const replicates = rows.cols();
      rows.conservativeResize(own.rows(), replicates + 1);
      rows.col(replicates) = own.col(0);
      double const squares = own.squaredNorm();
      weights_[channel] = squares > 0.0 ? fit.fit.effective[channel] / squares : 0.0;
    }
    before_ = left_after_step(plane_, plane_, rows_, weights_);
  }

  // replicates, then the recording
  Index columns() const { return before_.step.cols(); }

  // D of every start: [starts][columns]
  Eigen::MatrixXd gains(std::size_t move) const {
    auto const& starts = q_.moves[move].starts;
    Eigen::MatrixXd gains(static_cast<Index>(starts.size()), columns());
    auto const planes = planes_of(move);
    for (std::size_t i = 0; i < starts.size(); ++i)
      gains.row(static_cast<Index>(i)) = gains_on(planes[i], move).transpose();
    return gains;
  }

 private:
  FitPoint begun(RolloutModel const& model, FitUnknowns const& unknowns) const {
    FitPoint at = unknowns.begin_at(model.start());
    if (at_.starts.size() == at.starts.size()) at.starts = at_.starts;
    return at;
  }

  std::vector<LoopTangent> planes_of(std::size_t move) const {
    LoopSubject const& subject = q_.moves[move].subject;
    std::vector<LoopTangent> planes;
    std::vector<FitPoint> points;
    LoopPoint const first = with_move(q_, fit_.point, move, q_.moves[move].starts.front());
    RolloutModel const one = first.model(q_);
    FitUnknowns const unknowns(one, q_.fitted, q_.counts, q_.fits_starts);
    for (auto const& start : q_.moves[move].starts)
      points.push_back(begun(with_move(q_, fit_.point, move, start).model(q_), unknowns));
    DriveEffect const* const drive = subject.is_of_command() ? &drive_effect_of(subject.key) : nullptr;
    if (drive != nullptr && !drive->adds) {
      for (auto const& point : points) planes.push_back(tangent_at(unknowns, point));
      return planes;
    }
    // an effect that is nothing yet leaves the others' columns as they are
    std::vector<Index> own;
    if (drive != nullptr) {
      own.push_back(static_cast<Index>(one.size() - (first.loop.free.size() - fit_.point.loop.free.size())));
    } else {
      Index const at = static_cast<Index>(one.size() - first.loop.free.size() - subject.effect->parameters().size());
      for (std::size_t k = 0; k < subject.effect->n_linear(); ++k) own.push_back(at + static_cast<Index>(k));
    }
    for (auto const& columns : columns_at(unknowns, points, own)) planes.push_back(beside(plane_, columns));
    return planes;
  }

  Eigen::VectorXd gains_on(LoopTangent const& plane, std::size_t move) const {
    StepLeft const after = left_after_step(plane, plane_, rows_, weights_);
    Eigen::VectorXd gains = Eigen::VectorXd::Zero(columns());
    for (std::size_t channel = 0; channel < n_channels; ++channel) {
      if (weights_[channel] == 0.0 || after.squares[channel].size() == 0) continue;
      for (Index k = 0; k < columns(); ++k) {
        double const left = std::max(after.squares[channel][k], 1e-12 * before_.squares[channel][k]);
        if (left > 0.0) gains[k] += fit_.fit.effective[channel] * std::log(before_.squares[channel][k] / left);
      }
    }
    LoopSubject const& subject = q_.moves[move].subject;
    bool const has_sign =
        subject.is_of_command()
            ? drive_effect_of(subject.key).adds && facts_of(subject.key).least == 0.0
            : subject.effect->n_linear() == 1 && subject.effect->parameters()[0].sign() == Sign::non_negative;
    for (Index k = 0; k < columns(); ++k)
      if (!std::isfinite(gains[k]) || gains[k] < 0.0 || (has_sign && after.step(after.step.rows() - 1, k) < 0.0))
        gains[k] = 0.0;
    return gains;
  }

  LoopQuestion const& q_;
  LoopFit const& fit_;
  RolloutModel model_;
  FitUnknowns unknowns_;
  FitPoint at_;
  LoopTangent plane_{};
  ChannelRows rows_{};
  ChannelNumbers weights_{};
  StepLeft before_{};
};

}  // namespace

LoopScan scan_moves(LoopQuestion const& question, LoopFit const& model, std::vector<std::size_t> const& moves,
                    std::uint32_t step) {
  LoopScan result;
  if (moves.empty()) return result;
  Scan const scan(question, model, step);
  result.replicates = static_cast<std::size_t>(scan.columns()) - 1;
  auto const replicates = static_cast<Index>(result.replicates);
  result.moves.resize(moves.size());
  Chance chance{Eigen::MatrixXd::Zero(static_cast<Index>(moves.size()), replicates)};
  Eigen::VectorXd own(static_cast<Index>(moves.size()));
  parallel_for(moves.size(), question.threads, [&](std::size_t i, int) {
    auto const at = static_cast<Index>(i);
    Eigen::MatrixXd const gains = scan.gains(moves[i]);
    chance.gains.row(at) = gains.leftCols(replicates).colwise().maxCoeff();
    Eigen::VectorXd const here = gains.col(replicates);
    own[at] = here.maxCoeff();
    std::vector<std::size_t> order(static_cast<std::size_t>(here.size()));
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return here[static_cast<Index>(a)] > here[static_cast<Index>(b)];
    });
    result.moves[i] = {moves[i], own[at], 1.0, 0.0, std::move(order)};
  });
  if (result.replicates >= 2) {
    Eigen::VectorXd const p = chance.p(own), level = chance.level(question.numbers.alpha);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      result.moves[i].p = p[static_cast<Index>(i)];
      result.moves[i].level = level[static_cast<Index>(i)];
    }
  }
  std::stable_sort(result.moves.begin(), result.moves.end(),
                   [](ScannedMove const& a, ScannedMove const& b) { return a.gain > b.gain; });
  return result;
}

}  // namespace torquescope
