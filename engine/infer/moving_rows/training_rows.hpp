#pragma once
// The rows of all training recordings of a model, one above the other: what one fit to all of them sees.
//
// First      the recording that the stage was made of: residuals of its own fit, and of its replicates' own fits
// Further    recordings with replicates in their own loops, predicted by the fit of the first. The difference to a
//            common fit is a combination of nuisance columns, which every question fits anew
// Own        offset and shares of laws that run down belong to a recording: taken out of all that it has. Laws of a
//            clock, and those that run down, act in the first alone. Forms of laws may differ from one to the next
// Shapes     N rows of all, k nuisance columns (orthonormal), M replicates
// Threads    const object; looks into the stage, which outlives it
// Source     engine/infer/moving_rows/THEORY.md, Rows and replicates; Frisch, Waugh 1933,
//            doi:10.2307/1907330 (own nuisances)

#include <Eigen/Core>
#include <vector>

#include "engine/fit/statistics/left_out.hpp"
#include "engine/infer/moving_rows/recording_evidence.hpp"
#include "engine/infer/search/own_motion.hpp"

namespace torquescope {

class TrainingRows {
 public:
  // of the first alone, where effect `without` of the model is a candidate again (CandidateColumns::none: no effect)
  TrainingRows(ModelStage const& stage, std::size_t without);
  // further: as predicted by the first (columns() of the same rows)
  void add(std::vector<UnseenEvidence> further, std::size_t without);

  CandidateColumns const& columns(DrivenBy motion = DrivenBy::twin) const { return motions_.of(motion); }
  std::vector<UnseenEvidence> const& further() const { return further_; }
  struct Recording {
    RowBlock rows{};
    Eigen::Index memory_rows = 1;  // that repeat each other
  };
  std::vector<Recording> const& recordings() const { return recordings_; }

  Eigen::MatrixXd const& basis() const { return basis_; }                          // N x k
  Eigen::MatrixXd const& basis_and_signals() const { return basis_and_signals_; }  // N x (k + 1 + M)
  Eigen::Index nuisances() const { return basis_.cols(); }
  Eigen::Index signals() const { return basis_and_signals_.cols() - basis_.cols(); }
  // a step of training's columns elsewhere (n x the first's), as a step of the basis: n x k
  Eigen::MatrixXd in_basis(Eigen::MatrixXd const& nuisance) const;
  // energy of each signal that other forms of the model's laws would explain; 1 + M
  Eigen::VectorXd const& by_forms() const { return by_forms_; }

  // of each shape: N x L
  std::vector<Eigen::MatrixXd> columns_of_each(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                               DrivenBy motion, LawRate rate = LawRate::full) const;
  // folds of each recording, those of the first in front
  std::vector<Fold> folds(FoldKind kind) const;
  // energy of effect i of the model
  double law_energy(std::size_t i) const;
  double torque_energy() const;

 private:
  void stack(std::vector<Eigen::MatrixXd> const& forms);

  ModelStage const* stage_;
  BothMotions motions_;
  std::vector<UnseenEvidence> further_{};
  std::vector<Recording> recordings_{};
  Eigen::MatrixXd basis_{}, basis_and_signals_{};
  Eigen::MatrixXd to_basis_{};  // of the first's columns; empty: the basis is theirs
  Eigen::VectorXd by_forms_{};
};

}  // namespace torquescope
