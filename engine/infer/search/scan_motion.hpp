#pragma once
// The motion that a catalogue is scanned on: every n-th sample, with a filter that keeps the same rows.
//
// Why        rows are some tens per second, and laws cost what their samples do. A scan compares gains of the recording
//            with gains of replicates through the same columns, so what thinning adds is the same for both. What is
//            found is fitted and judged at the full rate
// Rate       beyond 2.56 times the band of the motion (the custom of signal analysers: the filter still passes a little
//            beyond its cut-off) and six times the parallel filter's cut-off
// Threads    const object, any number of threads
// Source     sampling of band-limited signals: Shannon 1949, doi:10.1109/JRPROC.1949.232969

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

// A law of how the joint turns round has pulses there that are shorter than the samples of a scan: what the filter
// carries to the rows would be another one. What a mass passes on is as smooth as its own motion
bool needs_every_sample(Effect const& effect);

// samples from one that a scan looks at to the next; 1 where every sample is needed. band_hz 0: of any motion
Eigen::Index scan_step(RecordPipeline const& pipeline, double band_hz);

class ScanMotion {
 public:
  // motion, reference: of the full rate; with_baseline: laws ask for the torque of the baseline
  ScanMotion(RecordPipeline const& pipeline, Motion const& motion, Eigen::Index step,
             BaselineReference const& reference, bool with_baseline);

  Eigen::Index samples() const { return motion_.q.size(); }
  EffectInput input() const;
  // samples() x k, on those of the rows that the pipeline keeps
  Eigen::MatrixXd filtered_columns(Eigen::Ref<Eigen::MatrixXd const> const& signals,
                                   std::vector<Eigen::Index> const& kept_rows) const;

 private:
  ParallelFilter filter_;
  Motion motion_;
  BaselineReference reference_;
  std::optional<FittedBaseline> baseline_{};
};

// nothing where every sample is needed
std::shared_ptr<ScanMotion const> scan_motion_of_joint(RecordPipeline const& pipeline, ProcessedRecord const& record,
                                                       BaselineReference const& reference);
// of its drive: what parts with an inertia are driven by
std::shared_ptr<ScanMotion const> scan_motion_of_drive(RecordPipeline const& pipeline, ProcessedRecord const& record,
                                                       BaselineReference const& reference);

}  // namespace torquescope
