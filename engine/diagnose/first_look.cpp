#include "engine/diagnose/first_look.hpp"

#include <algorithm>
#include <utility>

#include "engine/account/name_list.hpp"
#include "engine/data/excitation.hpp"
#include "engine/infer/pipeline/recording_checks.hpp"
#include "engine/infer/pipeline/shared_constants.hpp"
#include "engine/infer/pipeline/simulator_gap.hpp"
#include "engine/infer/pipeline/static_torque.hpp"

namespace torquescope {
namespace {

std::string merged_sentence(std::vector<std::string> const& dropped) {
  return "On this motion " + name_list(dropped, "and") + (dropped.size() == 1 ? " is" : " are") +
         " one number with a friction or offset that the model keeps, and left out.";
}

// the record without the torque of given terms, which may give work away
ProcessedRecord less_given(ProcessedRecord record, Recording const& recording, Regressor const& regressor) {
  Eigen::Index first = 0;
  Motion motion = record.motion;
  for (std::size_t term = 0; term < regressor.terms().size(); ++term) {
    auto const width = static_cast<Eigen::Index>(regressor.terms()[term]->n_linear());
    if (regressor.terms()[term]->is_given()) {
      Eigen::MatrixXd columns(motion.q.size(), width);
      regressor.columns_of_term(motion, term, columns, recording.given.get());
      motion.torque -= columns * record.parameters.segment(first, width);
    }
    first += width;
  }
  record.motion = std::move(motion);
  return record;
}

}  // namespace

std::optional<Hopeless> FirstLook::look(Recording& recording) {
  Motion const motion = differentiate(recording, input_.filter, input_.filter_section);
  excitation_ = measure_excitation(recording, motion, input_.filter);
  if (auto why = check_recording(excitation_)) return why;
  merge_constants(recording);
  RecordPipeline const pipeline = plain_pipeline(recording);
  // columns that the motion cannot tell apart
  auto why = verdict_of(Verdict::insufficient, [&] {
    ProcessedRecord const record = pipeline.process(recording);
    relerr_ = record.residual.norm() / record.whole_torque().norm();
    static_torque_ = check_static_torque(record, pipeline, limits_of(excitation_, relerr_));
    // a joint that its neighbours load may well give work away
    return recording.other_positions.cols() > 0 ? std::nullopt : check_sign(less_given(record, recording, regressor()));
  });
  limits_ = limits_of(excitation_, relerr_);
  if (auto sentences = closed_sentences(limits_, excitation_); !sentences.empty())
    remarks_.push_back(std::move(sentences));
  if (!why && recording.simulated_torque.size() > 0) {
    SimulatorGap gap = gap_to_simulator(recording, pipeline);
    parameter_share_ = gap.parameter_share;
    simulator_parameters_ = std::move(gap.simulator_parameters);
    recording = std::move(gap.recording);
  }
  return why;
}

// of the model without effects
RecordPipeline FirstLook::plain_pipeline(Recording const& recording) const {
  JointModel model(regressor());
  model.load_as_in(recording);
  return {std::move(model), input_.filter, recording.rate_hz, recording.position.size(), input_.filter_section};
}

void FirstLook::merge_constants(Recording const& recording) {
  auto const dropped = terms_to_drop(input_.regressor, plain_pipeline(recording).prepare(recording),
                                     limits_of(excitation_, 0.0).has_one_speed);
  if (dropped.empty()) return;
  std::vector<std::string> terms;
  for (auto const* term : input_.regressor.terms())
    if (!term->is_given() && std::find(dropped.begin(), dropped.end(), term->name()) == dropped.end())
      terms.push_back(term->name());
  merged_.emplace(terms, input_.regressor.joint(), input_.regressor.velocity_deadband());
  for (auto const* term : input_.regressor.terms())
    if (term->is_given()) merged_ = merged_->beside(*term);
  remarks_.push_back(merged_sentence(dropped));
}

Recording FirstLook::less_simulator(Recording recording) const {
  if (simulator_parameters_.size() == 0) return recording;
  RecordPipeline const pipeline = plain_pipeline(recording);
  return without_simulator(std::move(recording), pipeline, simulator_parameters_);
}

}  // namespace torquescope
