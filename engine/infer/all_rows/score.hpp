#pragma once
// What a model leaves on rows that its fit has not seen, and by how much a law lowers it: the statistic of a decision.
//
// Equation   D = n_eff ln(S_0 / S_1): S_0 left without the law, S_1 with it, on folds that the fits have not seen;
//            n_eff: independent squares of what the larger model leaves (rollout/effective_samples.hpp)
// Folds      ten with a guard as long as the filter's memory; laws of a clock on short ones (left_out.hpp)
// Sign       a law counts nothing where the signs that physics gives its parameters leave it no torque
// Shapes     n rows, m signals. Memory 8 n (k + m) bytes
// Threads    const object
// Source     engine/infer/all_rows/THEORY.md, The statistic

#include <Eigen/Core>
#include <vector>

#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/left_out.hpp"

namespace torquescope {

class Score {
 public:
  // base: columns of the model and its nuisances; signals: torques or residuals of it; guard: rows the filter couples
  Score(Eigen::MatrixXd const& base, Eigen::MatrixXd signals, Eigen::Index guard);

  Eigen::MatrixXd const& basis() const { return basis_; }
  Eigen::MatrixXd const& signals() const { return signals_; }
  // squares left in all folds, of each signal
  Eigen::VectorXd left(FoldKind kind = FoldKind::whole) const { return of(kind).left; }
  // with the group beside the model; what is left without it where its sign is wrong
  Eigen::VectorXd left_with(OrthonormalGroup const& group, FoldKind kind = FoldKind::whole) const;
  // row by row, of one signal; an empty group: of the model
  Eigen::VectorXd left_on_rows_with(OrthonormalGroup const& group, Eigen::Index signal,
                                    FoldKind kind = FoldKind::whole) const;
  // D of the group for one signal
  double gain(OrthonormalGroup const& group, Eigen::Index signal, FoldKind kind = FoldKind::whole) const;

 private:
  struct Folded {
    std::vector<Fold> folds{};
    FoldProducts gram{}, products{};
    Eigen::VectorXd own{}, left{};
  };
  Folded const& of(FoldKind kind) const { return kind == FoldKind::whole ? whole_ : interleaved_; }
  Folded folded(Eigen::Index guard, FoldKind kind) const;
  bool has_wrong_sign(OrthonormalGroup const& group, Eigen::Index signal) const;

  Eigen::MatrixXd basis_, signals_;
  Folded whole_{}, interleaved_{};
};

}  // namespace torquescope
