#include "engine/workflows/drafts/arm_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "engine/data/arm_recording.hpp"
#include "engine/data/filter_suggestion.hpp"
#include "engine/experiment/experiment.hpp"
#include "engine/experiment/foreign_file.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/experiment/robot_description.hpp"
#include "engine/workflows/drafts/draft_notes.hpp"
#include "engine/workflows/drafts/draft_text.hpp"
#include "engine/workflows/drafts/recording_draft.hpp"
#include "engine/workflows/drafts/recording_guess.hpp"

namespace torquescope {

namespace {

bool is_part_of_word(std::string const& text, std::size_t at) {
  return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
}
bool is_digit_at(std::string const& text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

// `value` where it is a word, or a number, of its own becomes `mark`
std::string marked(std::string text, std::string const& value, std::string const& mark) {
  bool const is_number = std::isdigit(static_cast<unsigned char>(value.front())) != 0;
  auto const goes_on = [&](std::size_t at) { return is_number ? is_digit_at(text, at) : is_part_of_word(text, at); };
  for (std::size_t at = text.find(value); at != std::string::npos;) {
    bool const alone = (at == 0 || !goes_on(at - 1)) && !goes_on(at + value.size());
    if (alone) text.replace(at, value.size(), mark);
    at = text.find(value, at + (alone ? mark.size() : 1));
  }
  return text;
}

bool holds(std::vector<std::string> const& columns, std::string const& column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

// the pattern of the file's positions, from whichever of them is the first joint's
std::string position_pattern(ColumnGuess const& guess, std::vector<std::string> const& joint_names) {
  for (auto const& column : guess.positions)
    if (auto const pattern = column_pattern(column, joint_names, guess.positions)) return *pattern;
  return {};
}

class ArmDrafter {
 public:
  ArmDrafter(std::vector<std::filesystem::path> const& recordings, std::filesystem::path const& robot,
             std::filesystem::path const& job_file, RobotPart const& part)
      : recordings_(recordings), robot_(robot), job_file_(job_file), part_(part) {
    for (auto const& joint : describe_robot(robot, part).joints) joint_names_.push_back(joint.name);
  }

  JobDraft draft() {
    guess_joints();
    write_head();
    write_recording();
    write_columns();
    write_filter();
    write_model();
    draft_.text = text_.text();
    if (!joints_.empty()) check();
    return std::move(draft_);
  }

 private:
  void warn(std::string text) { draft_.warnings.push_back(std::move(text)); }

  // the file's guess of each joint of the robot; none without a pattern
  void guess_joints() {
    any_ = guess_recording(recordings_.front(), 0);
    auto const pattern = position_pattern(any_.columns, joint_names_);
    if (pattern.empty()) return;
    auto const& positions = any_.columns.positions;
    RecordingOptions options;
    options.columns = {{"position", pattern}};
    for (auto const& joint : joint_options(options, joint_names_, {"recording", {}, {}})) {
      auto const at = std::find(positions.begin(), positions.end(), joint.columns.at("position")) - positions.begin();
      joints_.push_back(guess_recording(recordings_.front(), static_cast<std::size_t>(at) + 1));
    }
  }

  RecordingGuess const& first() const { return joints_.empty() ? any_ : joints_.front(); }

  void write_head() {
    text_.comment(fmt::format(
        "Drafted by `torquescope init --robot` from {}. The comments say what was guessed; correct what is wrong.",
        recordings_.front().filename().string()));
    auto const name = job_file_.filename().string();
    text_.comment(
        fmt::format("torquescope check {0} looks at everything, torquescope run {0} fits all joints "
                    "together, torquescope diagnose {0} says what each lacks.",
                    name));
    text_.section("[experiment]");
    text_.setting("name", toml_text(draft_name(recordings_.front())), "of the result file as well");
    text_.setting("seed", "1", "of every random number");
  }

  void write_recording() {
    text_.section("[recording]");
    text_.setting("train", toml_text(path_from(job_file_, recordings_.front())), "the parameters are fitted to it");
    std::vector<std::string> usable;
    for (std::size_t k = 1; k < recordings_.size(); ++k) {
      auto const other = guess_like(recordings_[k], first());
      if (other.refusal.empty())
        usable.push_back(path_from(job_file_, recordings_[k]));
      else
        warn(fmt::format("{} is left out: {}", recordings_[k].string(), other.refusal));
    }
    if (usable.empty())
      text_.to_edit("validate", "\"ANOTHER.csv\"", "no fit sees it: it judges the result");
    else
      text_.setting("validate", toml_list(usable), "no fit sees it: it judges the result");
    write_units();
  }

  void write_units() {
    auto const& guess = first();
    if (!guess.stamps) {
      text_.to_edit("rate_hz", "<samples per second>", "EDIT: no column has time stamps that run forwards");
      does_not_run(draft_, ExitCode::bad_job, what_to_edit);
    } else if (guess.stamps->per_unit != 1.0) {
      text_.setting("time_per_unit", toml_number(guess.stamps->per_unit), guess.stamps->why);
    }
    if (guess.position_per_unit != 1.0) text_.setting("position_per_unit", toml_number(guess.position_per_unit));
    if (guess.columns.torque.column.empty()) return;
    if (!torque_unit_is_known(guess.columns.torque)) {
      text_.to_edit("torque_per_unit", "[<N m per unit>, ...]", "EDIT: one number for each joint; 1 until then");
      warn(fmt::format("torque \"{}\" is in an unknown unit: write recording.torque_per_unit",
                       guess.columns.torque.column));
    } else if (guess.torque_per_unit != 1.0) {
      text_.setting("torque_per_unit", toml_number(guess.torque_per_unit));
    }
  }

  void write_columns() {
    text_.section("[recording.columns]");
    text_.comment(fmt::format("The robot's joints: {}.", fmt::join(joint_names_, ", ")));
    if (any_.stamps) text_.setting("time", toml_text(any_.stamps->column));
    if (joints_.empty())
      warn(fmt::format("no column name has a mark for all joints of the robot ({}); the file has positions {}",
                       fmt::join(joint_names_, ", "), fmt::join(any_.columns.positions, ", ")));
    write_channel("position", first().columns.position.column, true);
    write_channel("torque", first().columns.torque.column, true);
    if (joints_.empty() || !reference_fits(first().columns))
      warn("no column looks like the commanded positions: without them small effects are not found");
    else
      write_channel("reference", first().columns.reference.column, false);
  }

  void write_channel(std::string const& channel, std::string const& column, bool needed) {
    auto const pattern = joints_.empty() || column.empty() ? std::optional<std::string>()
                                                           : column_pattern(column, joint_names_, any_.names);
    if (pattern) {
      text_.setting(channel, toml_text(*pattern), channel == "reference" ? "the commanded position" : "");
      draft_.guesses.push_back(fmt::format("{} {}", channel, *pattern));
    } else if (needed) {
      text_.to_edit(channel, "\"<column with {name}, {j} or {i}>\"",
                    fmt::format("EDIT: the file has {}", fmt::join(any_.names, ", ")));
      does_not_run(draft_, ExitCode::bad_job, what_to_edit);
    } else {
      warn(fmt::format("{} \"{}\" is not there for every joint, and is left out", channel, column));
    }
  }

  void write_filter() {
    text_.section("[filter]");
    std::vector<Recording> recordings;
    for (auto const& joint : joints_)
      if (joint.recording) recordings.push_back(*joint.recording);
    if (recordings.empty() || recordings.size() != joints_.size()) {
      text_.to_edit("cutoff_hz", "<Hz>", "EDIT: of the position, ten times the fastest motion");
      text_.to_edit("parallel_cutoff_hz", "<Hz>", "EDIT: half of it, of the torque and every column");
      return;
    }
    auto const& one = recordings.front();
    auto const filter = suggest_arm_filter(recordings, static_cast<double>(one.position.size()) / one.rate_hz).options;
    text_.setting("cutoff_hz", toml_number(filter.cutoff_hz), "guessed from the motion of all joints");
    text_.setting("parallel_cutoff_hz", toml_number(filter.parallel_cutoff_hz), "half of it, a convention");
    if (filter.decimate_to_hz > 0) text_.setting("decimate_to_hz", toml_number(filter.decimate_to_hz));
  }

  void write_model() {
    text_.section("[model]");
    text_.setting("robot", toml_text(path_from(job_file_, robot_)));
    if (!part_.root.empty()) text_.setting("root", toml_text(part_.root), "the link that stands still");
    if (!part_.tip.empty()) text_.setting("tip", toml_text(part_.tip), "the link where the arm ends");
    text_.setting("friction", R"(["viscous", "coulomb", "offset"])", "of every joint");
    text_.setting("drive_inertia", "true", "of motor and gear; false where the robot's file has them in the links");
    text_.section("[[estimator]]");
    text_.setting("name", "\"wls\"", "weighted least squares: each joint by its own noise");
  }

  // what `torquescope check` will say of the draft, said now
  void check() {
    if (draft_.code != ExitCode::ok) return;
    try {
      auto const experiment = Experiment::load(parse_job(draft_.text, job_file_), Experiment::Purpose::check);
      for (auto const& line : experiment.check(1))
        if (line.level == CheckLine::Level::fault)
          does_not_run(draft_, ExitCode::bad_data, fmt::format("{}: {}", line.topic, line.text));
    } catch (Error const& refused) {
      does_not_run(draft_, refused);
    }
  }

  std::vector<std::filesystem::path> const& recordings_;
  std::filesystem::path const& robot_;
  std::filesystem::path const& job_file_;
  RobotPart const& part_;
  std::vector<std::string> joint_names_{};
  RecordingGuess any_{};
  std::vector<RecordingGuess> joints_{};  // in the robot's order
  DraftText text_{};
  JobDraft draft_{};
};

}  // namespace

std::optional<std::string> column_pattern(std::string const& column, std::vector<std::string> const& joint_names,
                                          std::vector<std::string> const& columns) {
  if (joint_names.empty()) return std::nullopt;
  std::array<std::pair<std::string, std::string>, 3> const marks{
      {{joint_names.front(), "{name}"}, {"1", "{j}"}, {"0", "{i}"}}};
  for (auto const& [value, mark] : marks) {
    if (value.empty()) continue;
    std::string const pattern = marked(column, value, mark);
    if (pattern == column) continue;
    RecordingOptions options;
    options.columns = {{"position", pattern}};
    auto const joints = joint_options(options, joint_names, {"recording", {}, {}});
    if (std::all_of(joints.begin(), joints.end(),
                    [&](auto const& joint) { return holds(columns, joint.columns.at("position")); }))
      return pattern;
  }
  return std::nullopt;
}

JobDraft draft_arm_job(std::vector<std::filesystem::path> const& recordings, std::filesystem::path const& robot,
                       std::filesystem::path const& job_file, RobotPart const& part) {
  for (auto const& recording : recordings) refuse_no_recording(recording);
  return ArmDrafter(recordings, robot, job_file, part).draft();
}

}  // namespace torquescope
