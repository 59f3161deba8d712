#pragma once
// The evidence for and against one model: all recordings beside its replicates, and what any further law gains there.
//
// Score      D = sum over training folds of what fits outside them leave inside, and over the rows of validation
//            recordings of what training's fit leaves there; whitened rows. Gain of a law: the fall of D
// Null       the same of every replicate, whose shapes are searched alike
// Shapes     everything is computed for 1 + M signals at once: the recording, then M replicates
// Memory     8 (M + 1) bytes for each row and signal
// Threads    const object after construction; looks into the stage, which outlives it
// Source     engine/inference/THEORY.md, The score

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/inference/left_out.hpp"
#include "engine/inference/recording_evidence.hpp"
#include "engine/search/own_motion.hpp"
#include "engine/statistics/held_out_gain.hpp"

namespace torquescope {

// of one law at one shape; each 1 + M long: recording first
struct LawGain {
  Eigen::VectorXd train{}, unseen{};  // unseen: 0 where there is no such evidence
  Eigen::VectorXd parameters{};       // linear ones, of the recording, with the signs that physics allows
  bool is_testable = false;           // false: the model's own columns explain it
  Eigen::VectorXd total() const { return train + unseen; }
};

// of the recording: energies that are left in blocks as long as the filter's memory, training rows first, then those
// of unseen recordings: what paired tests compare
struct BlocksLeft {
  std::vector<HeldOutBlock> blocks{};  // `after` is what is left, `before` is not used
};

// whether `other` leaves clearly less than `one` (one-sided, level 5 %; held_out_gain.hpp)
bool leaves_clearly_less(BlocksLeft const& other, BlocksLeft const& one);

class Evidence {
 public:
  Evidence(StageSetting const& setting, ModelStage const& stage, std::span<Recording const> unseen);
  // the same replicates where effect `without` of the model is a candidate again, not a part of it
  Evidence(Evidence const& of, std::size_t without);

  ModelStage const& stage() const { return *stage_; }
  CandidateColumns const& columns(DrivenBy motion = DrivenBy::twin) const { return motions_.of(motion); }
  std::size_t n_unseen() const { return unseen_.size(); }

  // what the model leaves: folds and blocks of unseen rows x (1 + M)
  Eigen::MatrixXd const& left_in_folds() const { return whole_.left; }
  Eigen::MatrixXd const& left_unseen() const { return left_unseen_; }

  // energy that other forms of the model's laws would explain (law_forms.hpp): nuisances of every question
  Eigen::VectorXd const& by_forms() const { return by_forms_; }
  // unseen recordings of which no replicates could be made
  std::vector<UnseenResidual> const& without_replicates() const { return without_replicates_; }
  // energies over all unseen rows: of the torque, and of the model's laws (whitened)
  double torque_energy_unseen() const;
  double law_energy_unseen() const;

  // of several shapes of one law
  std::vector<LawGain> gains(Effect const& effect, std::vector<std::vector<double>> const& shapes, FoldKind kind,
                             DrivenBy motion = DrivenBy::twin) const;
  // by the model alone, and with a law beside it
  BlocksLeft blocks_left(FoldKind kind) const;
  BlocksLeft blocks_left(Effect const& effect, std::vector<double> const& shape, FoldKind kind,
                         DrivenBy motion = DrivenBy::twin) const;

 private:
  // what the nuisance columns alone leave in folds of one kind
  struct InFolds {
    std::vector<Fold> folds{};
    FoldProducts gram{}, products{};  // of the basis with itself, and with the signals
    Eigen::MatrixXd less_own{};       // folds x (1 + M): left, less the signals' own energy
    Eigen::MatrixXd left{};
  };
  void fill_training(std::size_t without);
  void add_unseen(UnseenEvidence one);
  InFolds in_folds(FoldKind kind) const;
  struct Candidate {
    Effect const* effect;
    std::vector<double> const* shape;
    OrthonormalGroup const* group;
    Eigen::MatrixXd const* columns;
    FoldProducts cross, products;  // with the basis, with the signals
  };
  LawGain gain_of(Candidate const& candidate, InFolds const& beside) const;
  // what a unit of the law's orthonormal columns changes on the rows of an unseen recording
  Eigen::MatrixXd change_unseen(Candidate const& candidate, UnseenEvidence const& one) const;
  void add_unseen(Candidate const& candidate, LawGain& gain) const;

  ModelStage const* stage_;
  BothMotions motions_;
  Eigen::MatrixXd basis_and_signals_{};  // n x (k + 1 + M)
  Eigen::VectorXd by_forms_{};           // 1 + M
  InFolds whole_{}, interleaved_{};
  Eigen::MatrixXd left_unseen_{};  // blocks x (1 + M)
  std::vector<UnseenEvidence> unseen_{};
  std::vector<UnseenResidual> without_replicates_{};
  std::vector<Eigen::MatrixXd> unseen_left_{};  // of each: n x (1 + M), less the step of training's nuisance columns
};

}  // namespace torquescope
