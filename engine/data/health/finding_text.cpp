#include "engine/data/health/finding_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace torquescope {
namespace {

std::string rows_words(Finding const& finding) {
  if (finding.count == 0) return {};
  if (finding.lines.empty()) return fmt::format("{} rows", finding.count);
  std::string text = fmt::format("{} row{}", finding.count, finding.count == 1 ? "" : "s");
  text += finding.count == 1 ? " (line " : " (lines ";
  for (std::size_t k = 0; k < finding.lines.size(); ++k) text += (k ? ", " : "") + std::to_string(finding.lines[k]);
  return text + (finding.count > static_cast<std::int64_t>(finding.lines.size()) ? ", ...)" : ")");
}

std::string done_words(Finding const& finding) {
  bool const is_reference =
      finding.kind == FindingKind::reference_constant || finding.kind == FindingKind::reference_is_position;
  switch (finding.repair) {
    case Repair::corrected:
      return "; corrected";
    case Repair::filled:
      return "; treated as missing and filled over time";
    case Repair::left_out:
      return "; left out of every fit";
    case Repair::channel_unused:
      return is_reference ? "; the column is not used"
                          : "; the column is not used, the velocity is derived from the position";
    case Repair::none:
      break;
  }
  return {};
}

std::string what(Finding const& f) {
  std::string const rows = rows_words(f), column = "\"" + f.column + "\"";
  using enum FindingKind;
  switch (f.kind) {
    case time_unit:
      return fmt::format("the stamps of {} are taken as {}", column, f.detail);
    case time_unit_unknown:
      return fmt::format("the unit of {} is unknown (a step is {:.6g})", column, f.size);
    case rows_out_of_order:
      return fmt::format("rows are out of order: {} stand before an earlier stamp; sorted by time", rows);
    case clock_rolls_over:
      return fmt::format("the clock rolls over by {:.9g} s at {}", f.size, rows);
    case stamps_of_arrival:
      return fmt::format(
          "{} holds times of arrival: rows come in bursts; they are put evenly at {:g} Hz by their number", column,
          f.size);
    case clock_was_set:
      return fmt::format("the clock was set by {:.4g} s at {}: position and torque go on without a gap", f.size, rows);
    case rows_missing:
      return fmt::format("{:.4g} s have no rows", f.size);
    case position_wraps:
      return fmt::format("{} wraps at {:.10g} in {}; unwrapped", column, f.size, rows);
    case wraps_by_unknown:
      return fmt::format("{} wraps: it jumps by its whole range, about {:.6g}, in {}", column, f.size, rows);
    case position_jumps:
      return fmt::format(
          "{} jumps by up to {:.4g} in {} and goes on from there: the zero was set anew, recordings were "
          "pasted together, or the column changed to another joint",
          column, f.size, rows);
    case single_wrong_rows:
      return fmt::format("{} holds single wrong rows: {:g} in {}", column, f.size, rows);
    case rows_repeated:
      if (!f.detail.empty()) return fmt::format("rows were logged twice ({}): {}", f.detail, rows);
      return fmt::format("rows repeat while the joint moves (a lost packet, or a slower source): {} in {}", column,
                         rows);
    case sentinel:
      return fmt::format("{} holds {:.10g} in {}, far from the rows around them: no data", column, f.size, rows);
    case slow_source:
      return fmt::format(
          "{} is renewed at {:.4g} Hz, every {} rows, and repeats in between: one row of each run of equal "
          "values is taken, where it begins",
          column, f.size, f.detail);
    case rows_interleaved:
      return fmt::format("two sources write into one file: rows of {} alternate between two signals{}", column,
                         rows.empty() ? "" : " (" + rows + ")");
    case position_in_counts:
      return fmt::format("{} holds counts of an encoder, not rad or m", column);
    case unit_in_name:
      return fmt::format("the name of {} says {}, and the job gives no factor", column, f.detail);
    case unit_of_current:
      return fmt::format("{} is in {}, not N m: every parameter would be in units of that", column, f.detail);
    case speed_implausible:
      return fmt::format("the joint would turn at {:.3g} rad/s: is {} in rad?", f.size, column);
    case position_integrated:
      return fmt::format(
          "no position: the velocity {} was integrated, from zero at the first row (over {:.3g} {}). The true start is "
          "unknown: the phase of gravity and ripples, and where a spring rests, are told up to it",
          column, f.size, f.unit);
    case command_as_position:
      return fmt::format("the position column {} is called a command: the measured position is wanted{}", column,
                         f.detail.empty() ? "" : ", perhaps \"" + f.detail + "\"");
    case torque_spikes:
      return fmt::format("{} has spikes of up to {:.4g}, far beyond all other rows, in {}", column, f.size, rows);
    case unsigned_register:
      return fmt::format(
          "{} holds an unsigned register of {:.0f} bits: negative values were read as large ones in {} rows", column,
          f.size, f.count);
    case sign_magnitude:
      return fmt::format("{} holds its sign in bit {:.0f} (sign and magnitude) in {} rows", column, f.size, f.count);
    case torque_without_sign:
      return fmt::format(
          "{} never changes its sign over {:.0f} reversals and comes down to zero between them: a "
          "magnitude was logged, the sign is lost",
          column, f.size);
    case torque_switched_off:
      return fmt::format("{} holds nothing but noise for {:.3g} s while the joint moves, from {}: the drive was off",
                         column, f.size,
                         f.lines.empty() ? std::string("some row") : "line " + std::to_string(f.lines.front()));
    case command_beyond_limit:
      return fmt::format(
          "{} is a command, and the drive gives no {}: {:.2g} % of the rows ask for more. The motion explains it with "
          "an error of {:.2g} % beside that limit, {:.2g} % without{}",
          column, f.detail, 100 * f.size, 100 * f.error_after, 100 * f.error_before,
          is_fault(f) ? "" : "; those rows are taken as the limit");
    case torque_computed:
      if (f.detail.empty())
        return fmt::format("{} carries no noise at all, the position does: it was computed, or filtered afterwards",
                           column);
      return fmt::format(
          "{} is what a model gives for the commanded motion \"{}\", with an error of {:.2g} %; for the measured "
          "motion it is {:.2g} %: it was computed, not measured",
          column, f.detail, 100 * f.error_after, 100 * f.error_before);
    case torque_zero_steps:
      return fmt::format(
          "the zero of {} steps by {:.3g} {} at {}, whatever the motion: that explains {:.0f} % of what the motion "
          "does "
          "not (the sensor was zeroed anew?)",
          column, f.size, f.unit, f.detail, 100 * f.error_before);
    case torque_zero_drifts:
      return fmt::format(
          "the zero of {} drifts by {:.3g} {} over the recording, whatever the motion: that explains {:.0f} % of what "
          "the motion does not",
          column, f.size, f.unit, 100 * f.error_before);
    case velocity_contradicts:
      return fmt::format(
          "{} contradicts the derivative of the position (correlation {:.2f}): another signal, or without its sign",
          column, f.size);
    case velocity_factor:
      return fmt::format("{} is {:.3g} times the derivative of the position{}", column, f.size,
                         f.detail.empty() ? "" : ": " + f.detail + "?");
    case velocity_late:
      return fmt::format("{} is {:.3g} ms {} the derivative of the position (a filter of the drive?)", column,
                         1e3 * std::fabs(f.size), f.size > 0.0 ? "behind" : "ahead of");
    case velocity_constant:
      return fmt::format("{} never changes: {:g} in every row", column, f.size);
    case less_than_none:
      return fmt::format(
          "the fit makes negative what cannot be negative: {}; {} may hold another "
          "signal, another joint's torque, or come late",
          f.detail, column);
    case wrong_sign:
      return fmt::format("the torque takes work out of the joint ({}): {} has the wrong sign against the position",
                         f.detail, column);
    case position_factor:
      return fmt::format(
          "taken as {}, {} leaves an error of {:.2g} % instead of {:.3g} %: its unit is not rad",
          f.detail.empty() ? fmt::format("the angle of a motor behind a gear of {:.4g}", 1.0 / f.size) : f.detail,
          column, 100 * f.error_after, 100 * f.error_before);
    case reference_factor:
      return fmt::format("{} times {:.4g} is the position to {:.2g} %, as it stands to {:.3g} %{}", column, f.size,
                         100 * f.error_after, 100 * f.error_before, f.detail.empty() ? "" : ": " + f.detail);
    case reference_constant:
      if (!std::isfinite(f.size)) return fmt::format("{} holds no number in any row", column);
      return fmt::format(
          "the reference {} is {:.10g} in {} while the joint moves: a constant or a stop code, no command", column,
          f.size, f.count == 0 ? "every row" : rows);
    case reference_is_position:
      return fmt::format(
          "the reference {} is the position {:.0f} row{} {}, and no command", column, std::fabs(f.size),
          std::fabs(f.size) == 1.0 ? "" : "s",
          f.size > 0 ? "ahead (the next state, as data sets for imitation call it an action)" : "before");
    case one_row_decides:
      return fmt::format("one row of {}, line {} at {:.6g} s, is far from its neighbours and alone moves {}", column,
                         f.lines.empty() ? 0 : f.lines.front(), f.size, f.detail);
    case other_joints_move:
      return fmt::format(
          "other joints of the file move too ({}): one joint of a moving arm is another problem, for its "
          "neighbours load it",
          f.detail);
    case arm_setup:
      return f.detail;
    case arm_changes_at:
      return fmt::format("the torque changes at {:.3g} s as with another load ({}): split the recording there", f.size,
                         f.detail);
    case arm_touched:
      return fmt::format("from {:.3g} s {}", f.size, f.detail);
    case beyond_limits:
      return fmt::format("{:.3g} % of the samples are beyond {}", 100.0 * f.size, f.detail);
    case standstill:
      return fmt::format("the joint stands still: {} covers {:.3g} in all", column, f.size);
    case stretch_left_out:
      return fmt::format("{:.4g} s in {} stretch{} ({}{})", f.size, f.count, f.count == 1 ? "" : "es",
                         f.count == 1 ? "" : "the first ", f.detail);
    case reader_remark:
      return f.detail;
  }
  return {};
}

// "joint 5 (likewise joint 1, joint 2): "
std::string whose(Finding const& finding) {
  if (finding.joint.empty()) return {};
  if (finding.likewise.empty()) return finding.joint + ": ";
  return fmt::format("{} (likewise {}): ", finding.joint, fmt::join(finding.likewise, ", "));
}

}  // namespace

std::string grade_word(Grade grade) {
  return grade == Grade::fault ? "fault" : grade == Grade::warning ? "warning" : "note";
}

std::string sentence_of(Finding const& finding) {
  bool const says_so = finding.kind == FindingKind::position_wraps || finding.kind == FindingKind::rows_out_of_order ||
                       finding.kind == FindingKind::stamps_of_arrival || finding.kind == FindingKind::slow_source;
  return whose(finding) + what(finding) + (says_so ? "" : done_words(finding));
}

std::string cure_of(Finding const& f) {
  using enum FindingKind;
  switch (f.kind) {
    case time_unit:
      return fmt::format("time_per_unit = {:g}", f.size);
    case wraps_by_unknown:
      return fmt::format("wrap = {:.6g}      (the exact modulus of the column)", f.size);
    case position_wraps:
      return fmt::format("wrap = {:.10g}", f.size);
    case position_jumps:
      return f.lines.empty()
                 ? "cut the recording there"
                 : fmt::format("cut the file before line {} and name both pieces in train", f.lines.front());
    case rows_interleaved:
      return "export the topic of one publisher alone: half of the rows belong to another";
    case position_in_counts:
      return "position_per_unit = 6.283185307 / (counts per turn x gear ratio)      (rad per count, as a number)";
    case unit_in_name:
      if (!f.line_to_write.empty()) return f.line_to_write;
      return f.detail.starts_with("N") || f.detail.starts_with("mN")
                 ? fmt::format("torque_per_unit = {:.10g}", f.size)
                 : fmt::format("position_per_unit = {:.10g}      (write 1 if the name is wrong)", f.size);
    case unit_of_current:
      return f.detail == "per mille" || f.detail == "percent"
                 ? fmt::format("torque_per_unit = {} x rated torque in N m", f.detail == "percent" ? "0.01" : "0.001")
                 : fmt::format("torque_per_unit = N m per {} (torque constant x gear ratio); 1 to keep it as it is",
                               f.detail);
    case command_as_position:
      return "columns.position = the measured column; the command belongs to columns.reference";
    case unsigned_register:
      return fmt::format("encoding = {{{} = \"unsigned{:.0f}\"}}", f.detail, f.size);
    case sign_magnitude:
      return fmt::format("encoding = {{{} = \"sign_magnitude{:.0f}\"}}", f.detail, f.size + 1);
    case torque_without_sign:
      return "log the signed torque or current; a magnitude cannot be identified";
    case velocity_factor:
      if (f.detail == "rpm") return "velocity_per_unit = 0.1047197551";
      if (f.detail == "deg/s") return "velocity_per_unit = 0.01745329252";
      return "take velocity out of columns, or give velocity_per_unit";
    case velocity_contradicts:
    case velocity_late:
    case velocity_constant:
      return "take velocity out of columns";
    case standstill:
      return "record a motion";
    case wrong_sign:
      return fmt::format("torque_per_unit = {:g}", f.size);
    case position_factor:
      return fmt::format("position_per_unit = {:.10g}", f.size * f.written);
    case arm_setup:
    case arm_changes_at:
    case arm_touched:
      return f.line_to_write;
    case beyond_limits:
      return "check the unit and the zero of the column, and the limits of the robot file";
    case reference_constant:
    case reference_is_position:
      return "take reference out of columns, or name what the controller was given";
    case reference_factor:
      return "log the reference in the unit of the position";
    case torque_zero_steps:
    case torque_zero_drifts:
      return f.repair == Repair::none ? "correct the channel, or record again" : "";
    case torque_computed:
      if (f.detail.empty()) return "compare it with the current that the drive measures";
      return "compare it with the current that the drive measures, and log that; or position and reference are "
             "exchanged";
    case command_beyond_limit:
      return "log the torque or current that the drive measures";
    case one_row_decides:
      return fmt::format("look at it; if it is wrong, leave_out = [[from, until]] around {:.6g} s", f.size);
    case less_than_none:
      return "check columns.torque, its sign and delay_s";
    default:
      return {};
  }
}

std::string sentence_with_cure(Finding const& finding) {
  std::string const cure = cure_of(finding);
  return sentence_of(finding) + (cure.empty() ? "" : " -> " + cure);
}

Problem problem_of(Finding const& finding, std::string const& path) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = sentence_of(finding);
  problem.place.file = path;
  problem.place.line = finding.lines.empty() ? 0 : static_cast<int>(finding.lines.front());
  problem.key = code_of(finding.kind);
  problem.help = cure_of(finding);
  return problem;
}

bool is_fault(Finding const& finding) { return finding.grade == Grade::fault; }

}  // namespace torquescope
