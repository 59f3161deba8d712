#include "engine/diagnose/joint_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/data/excitation.hpp"
#include "engine/diagnose/abstention.hpp"
#include "engine/diagnose/blocked_cv.hpp"
#include "engine/diagnose/detection_power.hpp"
#include "engine/diagnose/effect_account.hpp"
#include "engine/diagnose/equivalent_effects.hpp"
#include "engine/diagnose/excitation_advice.hpp"
#include "engine/diagnose/mismatch_map.hpp"
#include "engine/diagnose/parameter_intervals.hpp"
#include "engine/diagnose/recording_checks.hpp"
#include "engine/diagnose/sentences.hpp"
#include "engine/diagnose/simulator_gap.hpp"
#include "engine/diagnose/unseen_record.hpp"

namespace torquescope {
namespace {

double relative_error(ProcessedRecord const& record) { return record.residual.norm() / record.torque.norm(); }

std::string source_word(LoopSource source) {
  switch (source) {
    case LoopSource::identified:
      return "identified";
    case LoopSource::approximated:
      return "approximated";
    case LoopSource::tracking:
      break;
  }
  return "tracking";
}

class JointWork {
 public:
  JointWork(DiagnosisInput const& input, StageSink const& progress) : input_(input), progress_(progress) {
    bool const revolute = input.regressor.joint() == JointKind::revolute;
    joint_.unit_position = revolute ? "rad" : "m";
    joint_.unit_torque = revolute ? "N m" : "N";
    diagnosis_.seed = input.seed;
    diagnosis_.q = input.selection.q;
  }

  Diagnosis run() {
    try {
      diagnose();
    } catch (Error const& error) {
      auto const& problem = error.problems().front();
      // a job that asks for the impossible is refused; a recording that cannot carry it is a verdict
      if (problem.code != ExitCode::bad_data) throw;
      hopeless({Verdict::data_fault, problem.what, problem.help});
    }
    diagnosis_.joints.push_back(std::move(joint_));
    diagnosis_.reason = reason_sentence(diagnosis_);
    return std::move(diagnosis_);
  }

 private:
  void tell(char const* stage, std::size_t done, std::size_t total) const {
    if (progress_) progress_(stage, done, total);
  }

  void hopeless(Hopeless const& why) {
    diagnosis_.verdict = why.verdict;
    diagnosis_.finding = why.finding;
    diagnosis_.way_out = why.way_out;
  }

  void diagnose() {
    Recording recording = from_zero(input_.train);
    if (auto const why = look_first(recording)) return hopeless(*why);
    StageSetting const setting{recording,    input_.regressor, input_.filter, input_.filter_section,
                               input_.twins, input_.seed,      input_.threads};
    selection_ = select_effects(setting, input_.selection, progress_);
    tell("verify", 0, selection_.accepted.size());
    describe_baseline();
    list_candidates();
    Remainder const remainder = judge_remainder(selection_, final_stage());
    joint_.map = mismatch_map(baseline().comparison.rows, baseline().reference().scales, input_.threads);
    if (!selection_.accepted.empty()) add_after(joint_.map, final_stage().comparison.rows, input_.threads);
    if (selection_.is_gate_open) account_for_effects();
    check_on_unseen(setting);
    budget(remainder);
    decide(remainder);
    tell("verify", selection_.accepted.size(), selection_.accepted.size());
  }

  // the recording by itself; may replace its torque by what the user's simulator cannot say
  std::optional<Hopeless> look_first(Recording& recording) {
    Motion const motion = differentiate(recording, input_.filter, input_.filter_section);
    auto const facts = measure_excitation(recording, motion, input_.filter);
    if (auto why = check_recording(facts, 0.0)) return why;
    RecordPipeline const pipeline(input_.regressor, input_.filter, recording.rate_hz, recording.position.size(),
                                  input_.filter_section);
    ProcessedRecord record;
    try {
      record = pipeline.process(recording);
    } catch (Error const& error) {
      auto const& problem = error.problems().front();
      if (problem.code != ExitCode::bad_data) throw;
      // columns that the motion cannot tell apart
      return Hopeless{Verdict::insufficient, problem.what, problem.help};
    }
    joint_.train_relerr = relative_error(record);
    auto why = check_recording(facts, joint_.train_relerr);
    if (!why && recording.simulated_torque.size() > 0) {
      SimulatorGap gap = gap_to_simulator(recording, pipeline);
      parameter_share_ = gap.parameter_share;
      recording = std::move(gap.recording);
    }
    return why;
  }

  ModelStage const& final_stage() const { return selection_.final; }
  ModelStage const& baseline() const { return selection_.accepted.empty() ? selection_.final : selection_.baseline; }

  void describe_baseline() {
    auto const& stage = baseline();
    auto const& rows = stage.comparison.rows;
    joint_.baseline = estimate_parameters(stage).baseline;
    joint_.train_relerr = relative_error(stage.comparison.recording);
    joint_.loop_source = source_word(stage.twin->loop.source);
    joint_.loop_remark = stage.twin->loop.remark;
    joint_.torque_noise = stage.twin->loop.loop.torque_noise.std;
    joint_.disturbance = stage.twin->disturbance.std;
    joint_.twins = static_cast<std::size_t>(rows.n_twins());
    joint_.omnibus_z = stage.energy.z;
    joint_.omnibus_p = stage.energy.p;
    joint_.mismatch_rms = stage.energy.excess_rms();
    joint_.left_rms = final_stage().energy.excess_rms();
    for (Eigen::Index t = 0; t < rows.n_twins(); ++t)
      joint_.twin_energy.push_back(rows.twins.col(t).squaredNorm() / stage.energy.residual);
    auto const floor_of = [](ModelStage const& of) {
      return std::sqrt(of.comparison.rows.twins.colwise().squaredNorm().mean()) / of.comparison.rows.torque.norm();
    };
    joint_.train_floor_relerr = floor_of(final_stage());
    joint_.floor_relerr = joint_.train_floor_relerr;
    joint_.augmented_train_relerr = relative_error(final_stage().comparison.recording);
    joint_.cv_relerr = cv_relerr(stage);
    joint_.augmented_cv_relerr = cv_relerr(final_stage());
    joint_.power_sentence = power_sentence(stage);
  }

  double cv_relerr(ModelStage const& stage) const {
    auto const& record = stage.comparison.recording;
    return std::sqrt(blocked_residual_energy(record.torque, record.columns, guard_rows(*stage.pipeline)) /
                     record.torque.squaredNorm());
  }

  bool is_named(Effect const* effect) const {
    return std::any_of(selection_.accepted.begin(), selection_.accepted.end(),
                       [&](AcceptedEffect const& one) { return one.effect == effect; });
  }

  void list_candidates() {
    double const excess = std::max(selection_.first_excess, std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < selection_.first_scan.size(); ++i) {
      auto const& scan = selection_.first_scan[i];
      Candidate candidate;
      candidate.name = scan.effect->name();
      candidate.family = word(scan.effect->family());
      candidate.decision = scan.is_testable ? Decision::rejected : Decision::not_tested;
      if (!scan.is_testable) candidate.reason = "the model's own columns explain it on this motion";
      candidate.z = scan.z;
      candidate.p = scan.p;
      candidate.q = selection_.first_q[i];
      candidate.chance_z = scan.chance_z;
      // without a mismatch there is nothing to have a share of
      candidate.gain = selection_.is_gate_open ? std::max(0.0, scan.gain / excess) : 0.0;
      if (selection_.is_gate_open) candidate.cv_gain = selection_.first_cv_gain[i] / excess;
      for (auto const& rejected : selection_.rejected)
        if (rejected.effect == scan.effect) candidate.reason = rejected.reason;
      if (is_named(scan.effect))
        candidate.decision = scan.effect->acts_on() == ActsOn::joint ? Decision::named : Decision::measurement;
      joint_.candidates.push_back(std::move(candidate));
    }
    std::stable_sort(joint_.candidates.begin(), joint_.candidates.end(), [&](auto const& a, auto const& b) {
      return selection_.is_gate_open ? a.gain > b.gain : a.z - a.chance_z > b.z - b.chance_z;
    });
  }

  void account_for_effects() {
    ModelEstimate const estimate = estimate_parameters(final_stage());
    joint_.augmented = estimate.baseline;
    ShapeSearch const search = shape_search(input_.selection.shape_optimiser, input_.seed);
    for (std::size_t i = 0; i < selection_.accepted.size(); ++i) {
      joint_.augmented.insert(joint_.augmented.end(), estimate.effects[i].begin(), estimate.effects[i].end());
      add_effect(i, estimate.effects[i], search);
    }
  }

  void add_effect(std::size_t i, std::vector<ParameterEstimate> const& parameters, ShapeSearch const& search) {
    auto const& accepted = selection_.accepted[i];
    auto const& effect = *accepted.effect;
    double const residual = selection_.first_energy.residual;
    NamedEffect named;
    named.name = effect.name();
    // a second wave of the same kind belongs to the first
    auto const same = std::find_if(joint_.effects.begin(), joint_.effects.end(),
                                   [&](NamedEffect const& one) { return one.name == named.name; });
    if (same != joint_.effects.end()) {
      same->parameters.insert(same->parameters.end(), parameters.begin(), parameters.end());
      same->gain.train += accepted.gain / residual;
      same->gain.cv += accepted.cv_gain / residual;
      place_.push_back(static_cast<std::size_t>(same - joint_.effects.begin()));
      return;
    }
    EffectAccount account = account_of(final_stage(), i);
    named.family = word(effect.family());
    named.title = effect.title();
    named.equation = effect.equation();
    named.acts_on = word(effect.acts_on());
    named.p = accepted.scan.p;
    named.q = accepted.q;
    named.z = accepted.scan.z;
    named.p_is_bound = accepted.scan.p_is_bound;
    named.gain.train = accepted.gain / residual;
    named.gain.cv = accepted.cv_gain / residual;
    named.region = account.region;
    named.curve = std::move(account.curve);
    named.rms = account.rms;
    named.peak = account.peak;
    named.parameters = parameters;
    for (auto const& rival : rivals_of(final_stage(), i, rivals_for(accepted), search, input_.threads))
      if (rival.is_equivalent) named.equivalent.push_back(rival.effect->name());
    place_.push_back(joint_.effects.size());
    joint_.effects.push_back(std::move(named));
  }

  // of the same families, or nearly as good when nothing was named yet
  std::vector<Effect const*> rivals_for(AcceptedEffect const& accepted) const {
    std::vector<Effect const*> rivals;
    auto const& own = accepted.effect->families();
    for (auto const& scan : selection_.first_scan) {
      if (!scan.is_testable || is_named(scan.effect)) continue;
      auto const& theirs = scan.effect->families();
      bool const is_family = std::any_of(theirs.begin(), theirs.end(), [&](EffectFamily one) {
        return std::find(own.begin(), own.end(), one) != own.end();
      });
      if (is_family || scan.gain > 0.5 * accepted.gain) rivals.push_back(scan.effect);
    }
    return rivals;
  }

  void check_on_unseen(StageSetting const& setting) {
    joint_.forward.push_back(simulate_forward(setting.recording, baseline(), final_stage()));
    double torque = 0.0, before = 0.0, after = 0.0, floor = 0.0;
    std::vector<double> without(final_stage().model().effects().size(), 0.0);
    for (auto const& recording : input_.validate) {
      UnseenResult result = check_unseen(recording, setting, baseline(), final_stage());
      torque += result.energy;
      before += result.before_energy;
      after += result.after_energy;
      floor += result.floor * result.floor * result.energy;
      for (std::size_t i = 0; i < without.size(); ++i) without[i] += result.without[i] - result.after_energy;
      joint_.forward.push_back(result.forward);
      joint_.traces.push_back(std::move(result.trace));
      joint_.nuisances.insert(joint_.nuisances.end(), result.nuisances.begin(), result.nuisances.end());
    }
    if (input_.validate.empty()) {
      auto const& record = baseline().comparison.recording;
      joint_.traces.push_back(
          torque_trace(setting.recording, *baseline().pipeline, record, record.residual, residual_after()));
      return;
    }
    joint_.validation_relerr = std::sqrt(before / torque);
    joint_.augmented_validation_relerr = std::sqrt(after / torque);
    if (std::isfinite(floor)) joint_.floor_relerr = std::sqrt(floor / torque);
    for (std::size_t i = 0; i < without.size(); ++i) {
      double& gain = joint_.effects[place_[i]].gain.validation;
      gain = (std::isfinite(gain) ? gain : 0.0) + without[i] / before;
    }
  }

  // of the final model, on the rows of the baseline: NaN where it keeps none
  Eigen::VectorXd residual_after() const {
    auto const& rows = baseline().comparison.recording.kept_rows;
    auto const& after = final_stage().comparison.recording;
    Eigen::VectorXd left = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(rows.size()), unknown);
    for (std::size_t i = 0, k = 0; i < rows.size(); ++i) {
      while (k < after.kept_rows.size() && after.kept_rows[k] < rows[i]) ++k;
      if (k < after.kept_rows.size() && after.kept_rows[k] == rows[i])
        left[static_cast<Eigen::Index>(i)] = after.residual[static_cast<Eigen::Index>(k)];
    }
    return left;
  }

  void budget(Remainder const& remainder) {
    double const residual = selection_.first_energy.residual;
    double const excess = std::max(0.0, selection_.first_excess);
    double const mismatch = std::min(1.0, excess / residual);
    double const left = selection_.is_gate_open ? std::min(1.0, remainder.share) : 1.0;
    double const of_model = 1.0 - parameter_share_;
    // what no gate passed is noise as far as anybody can tell
    joint_.budget.parameter_error = parameter_share_;
    joint_.budget.missing_physics = of_model * mismatch * (1.0 - left);
    joint_.budget.unexplained = selection_.is_gate_open ? of_model * mismatch * left : 0.0;
    joint_.budget.noise =
        1.0 - joint_.budget.parameter_error - joint_.budget.missing_physics - joint_.budget.unexplained;
  }

  void list_unexplained() {
    auto const left = mismatch_map(final_stage().comparison.rows, final_stage().reference().scales, input_.threads);
    std::vector<std::pair<double, UnexplainedPart>> parts;
    for (auto const& axis : left)
      for (auto const& region : axis.regions)
        parts.push_back({axis.energy_share * region.energy_share, {region.where, region.energy_share}});
    std::stable_sort(parts.begin(), parts.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
    constexpr std::size_t enough = 5;
    for (std::size_t i = 0; i < std::min(enough, parts.size()); ++i) joint_.unexplained.push_back(parts[i].second);
  }

  void decide(Remainder const& remainder) {
    if (!selection_.is_gate_open) {
      diagnosis_.verdict = Verdict::none;
      return;
    }
    if (remainder.is_significant || remainder.is_unexplained) list_unexplained();
    if (remainder.is_unexplained) {
      diagnosis_.verdict = Verdict::unexplained;
      withdraw();
      return;
    }
    for (auto& candidate : joint_.candidates)
      for (auto const& effect : joint_.effects)
        if (std::find(effect.equivalent.begin(), effect.equivalent.end(), candidate.name) != effect.equivalent.end())
          candidate.decision = Decision::equivalent;
    for (auto& effect : joint_.effects) effect.sentence = effect_sentence(joint_, effect);
    bool const is_class = std::any_of(joint_.effects.begin(), joint_.effects.end(),
                                      [](NamedEffect const& one) { return !one.equivalent.empty(); });
    bool const is_fault = std::all_of(joint_.effects.begin(), joint_.effects.end(),
                                      [](NamedEffect const& one) { return one.acts_on != word(ActsOn::joint); });
    diagnosis_.verdict = is_fault ? Verdict::data_fault : is_class ? Verdict::one_of_class : Verdict::named;
    if (is_fault) diagnosis_.way_out = "correct the channel, or record again; the model itself needs nothing more";
    joint_.excitation = advice_for(joint_.effects);
  }

  // nothing that was named stands
  void withdraw() {
    for (auto& candidate : joint_.candidates)
      if (candidate.decision == Decision::named || candidate.decision == Decision::measurement) {
        candidate.decision = Decision::rejected;
        candidate.reason = "withdrawn: it leaves too much that has a structure of its own";
      }
    joint_.budget.unexplained += joint_.budget.missing_physics;
    joint_.budget.missing_physics = 0.0;
    joint_.effects.clear();
    joint_.augmented.clear();
    joint_.augmented_train_relerr = joint_.augmented_validation_relerr = joint_.augmented_cv_relerr = unknown;
  }

  DiagnosisInput const& input_;
  StageSink const& progress_;
  Diagnosis diagnosis_;
  JointDiagnosis joint_;
  Selection selection_;
  std::vector<std::size_t> place_;  // of each accepted effect among the named ones
  double parameter_share_ = 0.0;
};

}  // namespace

Diagnosis diagnose_joint(DiagnosisInput const& input, StageSink const& progress) {
  return JointWork(input, progress).run();
}

}  // namespace torquescope
