#include "engine/workflows/drafts/job_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/data/excitation.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/experiment/experiment.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/workflows/drafts/column_remarks.hpp"
#include "engine/workflows/drafts/draft_notes.hpp"
#include "engine/workflows/drafts/draft_text.hpp"
#include "engine/workflows/drafts/gravity_evidence.hpp"
#include "engine/workflows/drafts/joint_choice.hpp"
#include "engine/workflows/drafts/recording_draft.hpp"
#include "engine/workflows/drafts/recording_guess.hpp"
#include "engine/workflows/drafts/servo_draft.hpp"

namespace torquescope {

namespace {

class JobDrafter {
 public:
  JobDrafter(RecordingGuess const& train, std::vector<RecordingGuess> const& others,
             std::filesystem::path const& job_file)
      : train_(train), others_(others), job_file_(job_file), prismatic_(is_prismatic(train.columns)) {}

  JobDraft draft() {
    choose_filter();
    write_head();
    draft_recording_sections(train_, others_, job_file_, text_, draft_.warnings);
    write_filter();
    write_model();
    write_work();
    draft_.text = text_.text();
    return std::move(draft_);
  }

 private:
  void warn(std::string text) { draft_.warnings.push_back(std::move(text)); }

  void write_head() {
    auto const name = job_file_.filename().string();
    text_.comment(
        fmt::format("Drafted by `torquescope init` from {}. The comments say what was guessed and how sure "
                    "it is; correct what is wrong.",
                    train_.file.filename().string()));
    text_.comment(
        fmt::format("torquescope check {} looks at everything, torquescope diagnose {} says what the model "
                    "lacks.",
                    name, name));
    text_.section("[experiment]");
    text_.setting("name", toml_text(draft_name(train_.file)), "of the result file as well");
    text_.setting("seed", "1", "of every random number");
    if (reference_serves(train_.columns))
      text_.comment(
          "Many recordings of one servo under several loads and gains: torquescope init --servo FILES drafts "
          "that kind of job.");
    if (train_.columns.joints > 1)
      text_.comment("All joints of an arm together: torquescope init --robot ARM.urdf FILES drafts that kind of job.");
  }

  double seconds_of_shortest() const {
    double shortest = 0.0;
    auto const count = [&](RecordingGuess const& guess) {
      if (!guess.recording || !(guess.refusal.empty())) return;
      double const seconds = static_cast<double>(guess.recording->position.size()) / guess.recording->rate_hz;
      shortest = shortest > 0 ? std::min(shortest, seconds) : seconds;
    };
    count(train_);
    for (auto const& other : others_) count(other);
    return shortest;
  }

  void choose_filter() {
    if (!train_.recording) return;
    filter_ = suggest_filter(*train_.recording, seconds_of_shortest());
    try {
      auto const motion = differentiate(*train_.recording, filter_.options, {"filter", {}, {}});
      auto const facts = measure_excitation(*train_.recording, motion, filter_.options);
      constexpr double hardly = 0.01;
      both_ways_ = facts.forward_share > hardly && facts.forward_share < 1 - hardly;
      if (!prismatic_) gravity_ = measure_gravity(*train_.recording, filter_.options, terms());
    } catch (Error const& refused) {
      warn(refused.problems().front().what);
    }
  }

  void write_filter() {
    text_.section("[filter]");
    if (filter_.options.cutoff_hz == 0) {
      text_.comment("Not chosen, because the recording cannot be read yet. Ten times the fastest motion suits:");
      text_.to_edit("cutoff_hz", "<Hz>", "EDIT: of the position, before it is differentiated");
      text_.to_edit("parallel_cutoff_hz", "<Hz>", "EDIT: half of it, of the torque and every column");
      return;
    }
    using Limit = FilterSuggestion::Limit;
    auto const reason = [&]() -> std::string {
      switch (filter_.limit) {
        case Limit::motion:
          return fmt::format("ten times the motion, which lies below {:.2g} Hz", filter_.motion_hz);
        case Limit::noise:
          return "above it the acceleration drowns in the position's noise";
        case Limit::slow_motion:
          return fmt::format("the motion lies below {:.2g} Hz, friction at reversals above", filter_.motion_hz);
        case Limit::reversals:
          return "so high that what a filter smears round reversals is not most of the time";
        case Limit::length:
          return "the recording is too short for less: edges are dropped";
        case Limit::rate:
          return "a fifth of the sampling rate";
      }
      return {};
    };
    text_.setting("cutoff_hz", toml_number(filter_.options.cutoff_hz), "guessed from the motion: " + reason());
    text_.setting("parallel_cutoff_hz", toml_number(filter_.options.parallel_cutoff_hz), "half of it, a convention");
    if (filter_.options.decimate_to_hz > 0)
      text_.setting("decimate_to_hz", toml_number(filter_.options.decimate_to_hz),
                    "2.5 to 4 times that, or 1000 rows: more say nothing new");
  }

  std::vector<std::string> terms() const {
    std::vector<std::string> list{"inertia", "viscous", "coulomb"};
    if (both_ways_) list.emplace_back("offset");
    return list;
  }

  void write_model() {
    auto const& motion = train_.motion();
    text_.section("[model]");
    bool const by_unit = motion.name.unit && motion.name.unit->quantity != Quantity::counts;
    text_.setting("joint", prismatic_ ? "\"prismatic\"" : "\"revolute\"",
                  by_unit      ? fmt::format("guessed from the unit, {}", motion.name.unit->word)
                  : prismatic_ ? "guessed: the torque column is a force"
                               : "assumed: no unit says so");
    auto list = terms();
    if (gravity_.is_plain()) list.emplace_back("gravity");
    std::string texts;
    for (auto const& term : list) texts += (texts.empty() ? "" : ", ") + toml_text(term);
    text_.setting("terms", "[" + texts + "]", "what a joint has at least; a diagnosis finds the rest");
    if (gravity_.is_plain())
      text_.comment(fmt::format(
          "gravity: it takes away {:.0f} % of the squared residual over {:.2g} rad. Is the axis vertical? Then "
          "it is a spring: take gravity out",
          100 * gravity_.share, gravity_.range_rad));
    if (!both_ways_) text_.comment("no offset: the joint moves one way, and friction looks like one");
  }

  void write_work() {
    text_.section("[[estimator]]");
    text_.setting("name", "\"ols\"", "of torquescope run: least squares");
    text_.section("[diagnose]");
    text_.setting("effects", "\"all\"", "look for everything in the catalogue (torquescope list effects)");
    text_.setting("twins", "200", "replicates: simulated recordings that say what chance does");
  }

  RecordingGuess const& train_;
  std::vector<RecordingGuess> const& others_;
  std::filesystem::path const& job_file_;
  bool prismatic_;
  bool both_ways_ = true;
  FilterSuggestion filter_{};
  GravityEvidence gravity_{};
  DraftText text_{};
  JobDraft draft_{};
};

// a fault that the draft has a line to edit for is said already
bool is_line_to_edit(CheckLine const& fault, JobDraft const& draft) {
  return (fault.topic == "position_in_counts" && draft.text.find("\n# position_per_unit") != std::string::npos) ||
         (fault.topic == "unit_of_current" && draft.text.find("\n# torque_per_unit") != std::string::npos);
}

// what `torquescope check` will say of the draft, said now
void check_draft(JobDraft& draft, RecordingGuess const& train, std::filesystem::path const& job_file) {
  if (!train.stamps || train.motion().column.empty() || train.columns.torque.column.empty())
    return does_not_run(draft, ExitCode::bad_job, what_to_edit);
  if (!train.recording) return does_not_run(draft, ExitCode::bad_data, train.refusal);
  try {
    auto const experiment = Experiment::load(parse_job(draft.text, job_file), Experiment::Purpose::check);
    for (auto const& line : experiment.check(1))
      if (line.level == CheckLine::Level::fault) {
        bool const to_edit = is_line_to_edit(line, draft);
        does_not_run(draft, to_edit ? ExitCode::bad_job : ExitCode::bad_data,
                     to_edit ? what_to_edit : fmt::format("{}: {}", line.topic, line.text));
      }
  } catch (Error const& refused) {
    does_not_run(draft, refused);
  }
}

std::vector<std::string> names_of_joints(std::vector<std::string> const& positions) {
  std::vector<std::string> names;
  for (auto const& column : positions) names.push_back(joint_name(column));
  return names;
}

void list_guesses(JobDraft& draft, RecordingGuess const& train) {
  auto const& columns = train.columns;
  std::vector<std::string> channels;
  if (train.stamps) channels.push_back("time " + train.stamps->column);
  if (!train.motion().column.empty())
    channels.push_back((train.is_speed_alone ? "velocity " : "position ") + train.motion().column);
  if (!columns.torque.column.empty()) channels.push_back("torque " + columns.torque.column);
  bool const servo = train.torque == TorqueColumn::optional;
  if (servo ? reference_fits(columns) : reference_serves(columns))
    channels.push_back("reference " + columns.reference.column);
  if (!columns.enabled.column.empty() && (servo || !columns.enabled.is_constant))
    channels.push_back("enabled " + columns.enabled.column);
  if (!channels.empty()) draft.guesses.push_back(fmt::format("{}", fmt::join(channels, ", ")));
  if (columns.joints > 1)
    draft.guesses.push_back(fmt::format("joint {} of {}; --joint N takes another, by number or name ({})",
                                        columns.joint, columns.joints,
                                        fmt::join(names_of_joints(columns.positions), ", ")));
  if (columns.passes_over_others)
    draft.guesses.push_back(fmt::format("joint {} is {}", columns.joint, passed_over_words(columns)));
  if (auto const why = unused_reference_words(train); !why.empty()) draft.guesses.push_back(why);
  for (auto const& shift : columns.shifts) draft.guesses.push_back(shift_words(shift));
}

// a manifest may lie among them; `leading`: its index
RecordingGuess first_with_a_position(std::vector<std::filesystem::path> const& recordings, std::size_t joint,
                                     TorqueColumn torque, ChosenColumns const& named, std::size_t& leading) {
  RecordingGuess first = guess_recording(recordings.front(), joint, torque, named);
  bool const is_refused = first.columns.joint > first.columns.joints;
  if (!first.motion().column.empty() || is_refused) return first;
  for (std::size_t k = 1; k < recordings.size(); ++k)
    if (auto next = guess_recording(recordings[k], joint, torque, named); !next.motion().column.empty()) {
      leading = k;
      return next;
    }
  return first;
}

}  // namespace

JobDraft draft_job(std::vector<std::filesystem::path> const& recordings, std::filesystem::path const& job_file,
                   std::size_t joint, DraftKind kind, ChosenColumns const& named) {
  for (auto const& recording : recordings) refuse_no_recording(recording);
  auto const torque = kind == DraftKind::servo ? TorqueColumn::optional : TorqueColumn::required;
  std::size_t leading = 0;
  RecordingGuess train = first_with_a_position(recordings, joint, torque, named, leading);
  validate(train.columns.joint <= train.columns.joints, [&] {
    Problem problem;
    problem.code = ExitCode::usage;
    problem.what = fmt::format("{} has {} joint{}, no joint {}", recordings.front().string(), train.columns.joints,
                               train.columns.joints == 1 ? "" : "s", train.columns.joint);
    problem.help = "--joint counts from 1, in the order of the file's position columns, or takes a name";
    return problem;
  });
  bool const servo = torque == TorqueColumn::optional || is_servo(train.columns);
  // a torque that never changes may stand in the way of the servo's columns
  if (servo) train = guess_recording(recordings[leading], joint, TorqueColumn::optional, named);
  std::vector<RecordingGuess> others;
  for (std::size_t k = 0; k < recordings.size(); ++k)
    if (k != leading) others.push_back(guess_like(recordings[k], train));
  JobDraft draft = servo ? draft_servo_job(train, others, job_file) : JobDrafter(train, others, job_file).draft();
  list_guesses(draft, train);
  for (auto const& look : train.looks) draft.looks.push_back(look_words(look));
  if (!servo) check_draft(draft, train, job_file);
  return draft;
}

}  // namespace torquescope
