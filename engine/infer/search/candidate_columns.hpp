#pragma once
// The columns of effects on the noise-free motion, as the fit would see them, and what is left of them beside the
// model.
//
// Motion     of the replicate without noise, as a rule: no noise of the recording gets into a statistic. On the
//            recorded one a law shows that shapes the motion itself (own_motion.hpp)
// Columns    Effect::columns at the full rate, through the parallel filter, on the common rows, whitened as those are
// Nuisance   columns of the model, and their derivatives by the shapes of the accepted effects: what a slightly wrong
//            shape leaves must not be accepted as another effect. More can be added: laws neither known nor asked for
// Shapes     n rows; L = effect.n_linear()
// Threads    const object, any number of threads; looks into the comparison and the pipeline, which outlive it

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/infer/replicates/mismatch_rows.hpp"
#include "engine/infer/search/scan_motion.hpp"

namespace torquescope {

enum class DrivenBy { twin, recording };
// of the samples that columns are made of: the recording's, or what a scan needs (scan_motion.hpp)
enum class LawRate { full, scan };

class CandidateColumns {
 public:
  // parameters: of the pipeline's model, for the tangents; reference: what candidates need to know of the baseline
  // without: this effect of the model is no nuisance, it is one of the candidates; none: all are
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  CandidateColumns(RecordPipeline const& pipeline, TwinComparison const& comparison, BaselineReference reference,
                   Eigen::VectorXd const& parameters, std::size_t without = none, DrivenBy driven_by = DrivenBy::twin);

  // candidates must explain something beside these as well: n samples x k, at the full rate
  void add_nuisance(Eigen::MatrixXd const& signals);

  JointScales const& scales() const { return reference_.scales; }
  JointKind joint() const { return reference_.scales.joint; }
  TwinComparison const& comparison() const { return *comparison_; }
  Eigen::MatrixXd const& nuisance() const { return nuisance_; }  // n x k, orthonormal
  // columns of the model, then tangents: what a shape's step is fitted with
  Eigen::MatrixXd const& model_columns() const { return model_columns_; }
  Eigen::MatrixXd const& tangents() const { return tangents_; }  // one per shape of the model, in its order
  Eigen::MatrixXd with_tangents() const;                         // both, side by side

  Eigen::MatrixXd columns(Effect const& effect, std::span<double const> shape) const;
  Eigen::MatrixXd plain_columns(Effect const& effect, std::span<double const> shape) const;  // before whitening
  // at the full rate of the common motion, not filtered: what the effect does at every instant, reversals and rests too
  Eigen::MatrixXd signals(Effect const& effect, std::span<double const> shape) const;
  OrthonormalGroup group(Effect const& effect, std::span<double const> shape) const;
  // of several shapes: their columns go through the filter side by side
  std::vector<OrthonormalGroup> groups(Effect const& effect, std::vector<std::vector<double>> const& shapes) const;
  // The same to the last digit as columns() and group() of one shape after the other, which the projection of groups()
  // is not
  std::vector<Eigen::MatrixXd> columns_of_each(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                               LawRate rate = LawRate::full) const;
  std::vector<OrthonormalGroup> group_of_each(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                              LawRate rate = LawRate::full) const;

 private:
  EffectInput input_of(Effect const& effect) const;
  Eigen::MatrixXd plain_columns_of(Effect const& effect, std::vector<std::vector<double>> const& shapes,
                                   LawRate rate = LawRate::full) const;
  Eigen::MatrixXd columns_of(Effect const& effect, std::vector<std::vector<double>> const& shapes) const;
  Eigen::MatrixXd fill_tangents(Eigen::VectorXd const& parameters, std::size_t without) const;

  RecordPipeline const* pipeline_;
  TwinComparison const* comparison_;
  ProcessedRecord const* record_;  // whose motion and rows the columns have
  BaselineReference reference_;
  FittedBaseline baseline_;
  std::shared_ptr<ScanMotion const> scan_{}, scan_drive_{};  // none: a scan takes every sample
  Motion row_motion_;  // the rows' own samples, for effects that a zero-phase filter only scales
  Eigen::MatrixXd model_columns_, tangents_, nuisance_;
};

// a step of a shape parameter for a difference quotient: small against its bounds, inside them; 0 where they leave one
// value
double shape_step(ParameterRange const& range, double value);

}  // namespace torquescope
