#include "engine/infer/search/scan_motion.hpp"

#include <algorithm>

namespace torquescope {
namespace {

BaselineReference thinned(BaselineReference reference, Eigen::Index first, Eigen::Index step) {
  auto const every = [&](auto const& signals) {
    Eigen::Index const count = (signals.rows() - first + step - 1) / step;
    return signals(Eigen::seqN(first, count, step), Eigen::all).eval();
  };
  if (reference.gear_load) reference.gear_load = std::make_shared<Eigen::VectorXd const>(every(*reference.gear_load));
  if (reference.given) {
    GivenSignals given = *reference.given;
    for (auto& law : given.laws) law.columns = every(law.columns);
    reference.given = std::make_shared<GivenSignals const>(std::move(given));
  }
  reference.rate_hz /= static_cast<double>(step);
  return reference;
}

std::shared_ptr<ScanMotion const> scan_motion(RecordPipeline const& pipeline, Motion const& motion, double band_hz,
                                              BaselineReference const& reference, bool with_baseline) {
  if (motion.q.size() == 0) return nullptr;
  Eigen::Index const step = scan_step(pipeline, band_hz);
  if (step == 1) return nullptr;
  return std::make_shared<ScanMotion const>(pipeline, motion, step, reference, with_baseline);
}

}  // namespace

bool needs_every_sample(Effect const& effect) {
  auto const& families = effect.families();
  bool const is_of_reversals = std::find(families.begin(), families.end(), EffectFamily::reversal) != families.end();
  return !effect.has_inertia() && (is_of_reversals || effect.is_dry_friction() || effect.is_of_extremes());
}

Eigen::Index scan_step(RecordPipeline const& pipeline, double band_hz) {
  constexpr double per_band = 2.56, per_parallel_cutoff = 6.0;
  constexpr Eigen::Index fewest_samples = 100;  // short recordings cost nothing
  if (band_hz == 0.0 || pipeline.cutoff_hz() == 0.0) return 1;
  double const least_hz = std::max(per_band * band_hz, per_parallel_cutoff * pipeline.cutoff_hz());
  Eigen::Index const factor = pipeline.parallel_filter().decimation();
  for (Eigen::Index step = factor; step > 1; --step)
    if (factor % step == 0 && pipeline.rate_hz() / static_cast<double>(step) >= least_hz &&
        pipeline.samples() / step >= fewest_samples)
      return step;
  return 1;
}

ScanMotion::ScanMotion(RecordPipeline const& pipeline, Motion const& motion, Eigen::Index step,
                       BaselineReference const& reference, bool with_baseline)
    : filter_(pipeline.parallel_filter().of_every(step)),
      motion_(torquescope::thinned(motion, pipeline.parallel_filter().first_of(step), step)),
      reference_(thinned(reference, pipeline.parallel_filter().first_of(step), step)) {
  if (with_baseline) baseline_ = on_motion(pipeline.model().regressor(), reference_, motion_);
}

EffectInput ScanMotion::input() const {
  EffectInput input = baseline_ ? baseline_->input(motion_) : EffectInput{motion_, reference_.scales};
  input.given = reference_.given.get();
  return input;
}

Eigen::MatrixXd ScanMotion::filtered_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals,
                                             std::vector<Eigen::Index> const& kept_rows) const {
  return filter_.apply_columns(signals)(kept_rows, Eigen::all);
}

std::shared_ptr<ScanMotion const> scan_motion_of_joint(RecordPipeline const& pipeline, ProcessedRecord const& record,
                                                       BaselineReference const& reference) {
  return scan_motion(pipeline, record.motion, pipeline.motion_band_hz(), reference, true);
}

std::shared_ptr<ScanMotion const> scan_motion_of_drive(RecordPipeline const& pipeline, ProcessedRecord const& record,
                                                       BaselineReference const& reference) {
  return scan_motion(pipeline, record.drive, pipeline.drive_band_hz(), reference, false);
}

}  // namespace torquescope
