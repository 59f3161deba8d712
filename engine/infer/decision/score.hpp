#pragma once
// What a model leaves on rows that its fit has not seen, and by how much an effect lowers it: the statistic of a
// decision.
//
// Equation   D = n_eff ln(S_0 / S_1): S_0 left without the effect, S_1 with it, on folds that the fits have not seen;
//            n_eff: independent squares of what the larger model leaves (rollout/effective_samples.hpp)
// Folds      ten with a guard as long as the filter's memory; effects of a clock on short ones (left_out.hpp)
// Sign       an effect counts nothing where the signs that physics gives its parameters leave it no torque
// Shapes     n rows, m signals, k columns of the base. Memory 32 n (k + m) bytes
// Threads    const object
// Source     engine/infer/decision/THEORY.md, The statistic

#include <Eigen/Core>
#include <vector>

#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/left_out.hpp"

namespace torquescope {

class Score {
 public:
  // base: columns of the model and its nuisances; signals: torques or residuals of it; guard: rows the filter couples
  Score(Eigen::MatrixXd const& base, Eigen::MatrixXd signals, Eigen::Index guard, FoldKind kind = FoldKind::whole);

  Eigen::MatrixXd const& basis() const { return basis_; }
  Eigen::MatrixXd const& signals() const { return signals_; }
  // squares left in all folds, of each signal
  Eigen::VectorXd const& left() const { return left_; }
  // with the group beside the model; what is left without it where its sign is wrong
  Eigen::VectorXd left_with(OrthonormalGroup const& group) const;
  // row by row, of one signal; an empty group: of the model
  Eigen::VectorXd left_on_rows_with(OrthonormalGroup const& group, Eigen::Index signal) const;
  // D of the group for one signal
  double gain(OrthonormalGroup const& group, Eigen::Index signal) const;

 private:
  // of the basis and a group beside it: with themselves, and with the signals
  struct Products {
    FoldProducts gram{}, signals{};
  };
  Products products_with(OrthonormalGroup const& group) const;
  bool has_wrong_sign(OrthonormalGroup const& group, Eigen::Index signal) const;

  Eigen::MatrixXd basis_, signals_;
  std::vector<Fold> folds_{};
  FoldedRows beside_{};  // the basis and the signals beside it
  FoldProducts gram_{}, products_{};
  Eigen::VectorXd own_{}, left_{};
};

}  // namespace torquescope
