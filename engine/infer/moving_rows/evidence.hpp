#pragma once
// The evidence for and against one model: all recordings beside its replicates, and what any further law gains there.
//
// Score      D = sum over folds of all training recordings of what fits outside them leave inside, and over the rows of
//            validation recordings of what training's fit leaves there; whitened rows. Gain of a law: the fall of D
// Null       the same of every replicate, whose shapes are searched alike
// Shapes     everything is computed for 1 + M signals at once: the recording, then M replicates
// Memory     8 (M + 1) bytes for each row and signal
// Threads    const object after construction; looks into the stage, which outlives it
// Source     engine/infer/moving_rows/THEORY.md, The score

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/fit/statistics/left_out.hpp"
#include "engine/fit/statistics/left_out_gains.hpp"
#include "engine/infer/moving_rows/rows_left.hpp"
#include "engine/infer/moving_rows/training_rows.hpp"

namespace torquescope {

// of one joint, beside the one that stages are made of; their time from 0
struct OtherRecordings {
  std::span<Recording const> training{};  // that parameters are fitted to as well
  std::span<Recording const> unseen{};    // that they predict
};

// of one law at one shape; each 1 + M long: recording first
struct LawGain {
  Eigen::VectorXd train{}, unseen{};  // unseen: 0 where there is no such evidence
  Eigen::VectorXd first{};            // of train: in the recording that the stage was made of
  Eigen::VectorXd parameters{};       // linear ones, of the recording, with the signs that physics allows
  bool is_testable = false;           // false: the model's own columns explain it
  Eigen::VectorXd total() const { return train + unseen; }
};

class Evidence {
 public:
  Evidence(StageSetting const& setting, ModelStage const& stage, OtherRecordings const& others);
  // the same replicates where effect `without` of the model is a candidate again, not a part of it
  Evidence(Evidence const& of, std::size_t without);
  // the same, where each event of these (CarryOver::none) also happens in unseen recordings, at an instant of its own
  Evidence with_own_events(std::span<Effect const* const> laws) &&;

  ModelStage const& stage() const { return *stage_; }
  // of the recording that the stage was made of
  CandidateColumns const& columns(DrivenBy motion = DrivenBy::twin) const { return training_.columns(motion); }
  TrainingRows const& training() const { return training_; }
  std::size_t n_unseen() const { return unseen_.size(); }
  // one for each unseen recording; none where no replicates of it could be made
  std::vector<std::shared_ptr<NoiseWeights const>> const& weights_unseen() const { return weights_unseen_; }

  // what the model leaves: folds and blocks of unseen rows x (1 + M)
  Eigen::MatrixXd const& left_in_folds(FoldKind kind = FoldKind::whole) const { return folds_of(kind).left; }
  Eigen::MatrixXd const& left_unseen() const { return left_unseen_; }

  // energy that other forms of the model's laws would explain (law_forms.hpp): nuisances of every question
  Eigen::VectorXd const& by_forms() const { return training_.by_forms(); }
  // other recordings of which no replicates could be made
  std::vector<UnseenResidual> const& without_replicates() const { return without_replicates_; }
  // energies over all unseen rows: of the torque, and of the model's laws (whitened)
  double torque_energy_unseen() const;
  double law_energy_unseen() const;

  // of several shapes of one law
  std::vector<LawGain> gains(Effect const& effect, std::vector<std::vector<double>> const& shapes, FoldKind kind,
                             DrivenBy motion = DrivenBy::twin, LawRate rate = LawRate::full) const;
  // by the model alone, and with a law beside it
  RowsLeft rows_left(FoldKind kind) const;
  RowsLeft rows_left(Effect const& effect, std::vector<double> const& shape, FoldKind kind,
                     DrivenBy motion = DrivenBy::twin) const {
    return rows_left(effect, std::vector<std::vector<double>>{shape}, kind, motion);
  }
  // the same law several times, each at its own shape: waves
  RowsLeft rows_left(Effect const& effect, std::vector<std::vector<double>> const& shapes, FoldKind kind,
                     DrivenBy motion = DrivenBy::twin) const;

 private:
  // what the nuisance columns alone leave in folds of one kind
  struct InFolds {
    std::vector<Fold> folds{};
    FoldProducts gram{}, products{};  // of the basis with itself, and with the signals
    LeftOutGains gains{};             // of further columns
    Eigen::MatrixXd left{};           // folds x (1 + M)
  };
  void fill_folds();
  void add_unseen(UnseenEvidence one);
  InFolds in_folds(FoldKind kind) const;
  InFolds const& folds_of(FoldKind kind) const { return kind == FoldKind::whole ? whole_ : interleaved_; }
  // one shape of a law, or several times the law, as orthonormal columns beside the model
  struct Candidate {
    Effect const* effect;
    OrthonormalGroup const* group;
    Eigen::MatrixXd const* columns;
    Eigen::MatrixXd coefficients;  // of the group's columns, of each signal: r x (1 + M)
    BoundedGain bounded{};         // of the recording
  };
  // an unseen recording: training's nuisance columns there (n x k), and what their step leaves of its signals
  struct Unseen {
    UnseenEvidence evidence{};            // without its signals
    Eigen::MatrixXd nuisance_and_left{};  // n x (k + 1 + M)
    Eigen::MatrixXd nuisance_gram{}, nuisance_left{};
    auto left() const { return nuisance_and_left.rightCols(nuisance_left.cols()); }
  };
  // those in which that event happens, or all as they are
  std::vector<Unseen> const& unseen_beside(Effect const& effect) const;
  Unseen less(Unseen unseen, Eigen::MatrixXd const& columns) const;
  LawGain gain_in_training(Candidate const& candidate, Eigen::MatrixXd in_folds) const;
  // What a unit of the law's orthonormal columns changes on the rows of an unseen recording: the nuisances by so much
  // (k x r), with a minus sign, and the law itself (n x r), a share of which may belong to the recording
  struct UnseenStep {
    Eigen::MatrixXd nuisance{}, law{};
    bool by_share = false;
  };
  // inner products of the two changes, and with the first signals that are left there. law: of the law's own change
  // with nuisances and signals, r x (k + signals)
  struct UnseenProducts {
    Eigen::MatrixXd model_left{}, law_left{}, model_model{}, law_model{}, law_law{};
    UnseenProducts(UnseenStep const& step, Unseen const& unseen, Eigen::Ref<Eigen::MatrixXd const> const& law);
    Eigen::RowVectorXd shares(Eigen::MatrixXd const& coefficients) const;
  };
  // of each shape, on the rows of an unseen recording, less what is the recording's own
  static std::vector<Eigen::MatrixXd> columns_unseen(Effect const& effect,
                                                     std::vector<std::vector<double>> const& shapes, LawRate rate,
                                                     UnseenEvidence const& there);
  UnseenStep step_unseen(Candidate const& candidate, Eigen::MatrixXd const& law) const;
  // laws: of each candidate, on the rows of that recording
  void add_unseen(std::vector<Candidate> const& candidates, std::vector<Eigen::MatrixXd> const& laws,
                  Unseen const& there, std::vector<LawGain>& gains) const;
  // what is left of training, one part for each of its recordings
  std::vector<RowsLeft::Part> of_recordings(Eigen::VectorXd const& left) const;

  ModelStage const* stage_;
  TrainingRows training_;
  InFolds whole_{}, interleaved_{};
  Eigen::MatrixXd left_unseen_{};  // blocks x (1 + M)
  std::vector<Unseen> unseen_{};   // nuisance: of the basis of training
  std::map<Effect const*, std::vector<Unseen>> own_events_{};
  std::uint64_t seed_ = 0;
  std::vector<UnseenResidual> without_replicates_{};
  std::vector<std::shared_ptr<NoiseWeights const>> weights_unseen_{};
};

}  // namespace torquescope
