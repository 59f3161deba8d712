#pragma once
// Every effect of the catalogue beside one model: the shape at which it leaves the least on held-out rows, and its D.
//
// Replicates each is fitted and searched as the recording is, on its own columns. Effects whose columns a replicate's
//            motion hardly changes (of the place, of time) are computed once for all
// Kind       of the folds: one for all effects of a scan
// Threads    spreads effects and replicates over `threads`; same bits for any number
// Source     engine/infer/decision/THEORY.md, Chance

#include <memory>
#include <span>
#include <vector>

#include "engine/infer/decision/score.hpp"
#include "engine/infer/decision/shape_grid.hpp"
#include "engine/infer/decision/treatment_choice.hpp"

namespace torquescope {

// a recording, or a replicate of it, with one model fitted
class FittedStrips {
 public:
  // model outlives it
  FittedStrips(JointModel const& model, SharedStrips strips, DelayChoice const& delay);

  std::span<Strip const> strips() const { return *strips_; }
  SharedStrips const& shared_strips() const { return strips_; }
  ModelOnStrips const& on() const { return *on_; }
  ChosenTreatment const& chosen() const { return chosen_; }
  Eigen::VectorXd const& residual() const { return residual_; }  // with the noise, of the linear fit
  Eigen::VectorXd const& parameters() const { return parameters_; }
  Eigen::MatrixXd const& base() const { return base_; }  // columns of the fit, then tangents: delay, sticking, shapes
  Eigen::Index first_tangent() const { return on_->parameters(); }  // of base(): the delay's
  Eigen::Index guard() const;
  // further noise, the treatment as it is
  void add_noise(Eigen::VectorXd const& noise);

 private:
  SharedStrips strips_;
  std::unique_ptr<ModelOnStrips> on_;
  ChosenTreatment chosen_;
  Eigen::VectorXd residual_, parameters_;
  Eigen::MatrixXd base_;
};

// columns of an effect at several shapes, on all rows; n x (shapes * n_linear)
Eigen::MatrixXd effect_on_rows(FittedStrips const& fitted, Effect const& effect,
                               std::vector<std::vector<double>> const& shapes);
OrthonormalGroup effect_group(FittedStrips const& fitted, Eigen::MatrixXd const& basis, Effect const& effect,
                              std::vector<double> const& shape);

struct EffectQuestion {
  Effect const* effect = nullptr;
  ShapeGrid grid{};  // where the effect is what its name says
  JointScales scales{};
  bool is_same_for_all = false;  // columns are those of the recording in every replicate
};

// shorter ways than `shortest` are the sticking's own (sticking_shape.hpp): no effect is asked for them
std::vector<EffectQuestion> effect_questions(std::vector<Effect const*> const& effects, JointScales const& scales,
                                             double shortest);
// finds is_same_for_all, by one replicate
void compare_columns(std::vector<EffectQuestion>& questions, FittedStrips const& recording,
                     FittedStrips const& replicate, double most_change);

struct EffectFinding {
  std::size_t point = 0;  // of the grid
  double left = 0.0;      // squares on held-out rows
  double gain = 0.0;      // D
};

// of the recording, one for each question
std::vector<EffectFinding> scan_recording(std::vector<EffectQuestion> const& questions, FittedStrips const& recording,
                                          Score const& score, int threads);
// D of every effect in every replicate: effects x replicates
Eigen::MatrixXd gains_of_replicates(std::vector<EffectQuestion> const& questions, FittedStrips const& recording,
                                    std::span<FittedStrips const> replicates, FoldKind kind, int threads);

}  // namespace torquescope
