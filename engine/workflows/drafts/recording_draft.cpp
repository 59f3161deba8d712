#include "engine/workflows/drafts/recording_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/data/recording_reader.hpp"
#include "engine/workflows/drafts/column_remarks.hpp"

namespace torquescope {

namespace {

std::string listed(std::vector<std::string> const& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

// what a torque column is in when its unit tells no N m
std::string drive_words(ColumnName const& name) {
  if (!name.unit) return "in an unknown unit";
  switch (name.unit->quantity) {
    case Quantity::current:
      return "a current in " + name.unit->word;
    case Quantity::voltage:
      return "a voltage in " + name.unit->word;
    case Quantity::ratio:
      return name.unit->word + " of a rated value";
    default:
      return "in " + name.unit->word;
  }
}

class RecordingDraft {
 public:
  RecordingDraft(RecordingGuess const& train, std::vector<RecordingGuess> const& others,
                 std::filesystem::path const& job_file, DraftText& text, std::vector<std::string>& warnings)
      : train_(train),
        others_(others),
        job_file_(job_file),
        prismatic_(is_prismatic(train.columns)),
        text_(text),
        warnings_(warnings) {}

  void write() {
    write_options();
    write_columns();
  }

 private:
  bool has_torque() const { return train_.torque == TorqueColumn::required; }
  char const* torque_unit() const { return prismatic_ ? "N" : "N m"; }
  char const* position_unit() const { return prismatic_ ? "m" : "rad"; }

  void warn(std::string text) { warnings_.push_back(std::move(text)); }

  void write_options() {
    text_.section("[recording]");
    if (!has_torque()) return write_units();
    text_.setting("train", toml_text(path_from(job_file_, train_.file)), "the parameters are fitted to it");
    write_validation();
    write_units();
    write_torque_unit();
  }

  void write_units() {
    write_rate();
    write_position_unit();
  }

  void write_validation() {
    std::vector<std::string> usable;
    for (auto const& other : others_) {
      auto const path = path_from(job_file_, other.file);
      auto const why = why_not(other);
      if (why.empty()) {
        usable.push_back(path);
        continue;
      }
      text_.comment(fmt::format("left out: {}: {}", path, why));
      warn(fmt::format("{} is left out: {}", other.file.string(), why));
    }
    if (!usable.empty()) {
      text_.setting("validate", toml_list(usable), "no fit sees it: it judges the result");
      return;
    }
    text_.comment(
        "One recording: nothing says how good the model is on data it was not fitted to. Record a second one:");
    text_.to_edit("validate", "\"ANOTHER.csv\"", "no fit sees it: it judges the result");
  }

  std::string why_not(RecordingGuess const& other) const {
    if (!other.refusal.empty()) return other.refusal;
    if (!train_.recording || !other.recording) return {};
    if (other.recording->sha256 == train_.recording->sha256) return "it is the same recording as train";
    // a job has one rate: a much lower one would cost the others what lies above half of it
    constexpr double about_the_same = 0.1;
    double const rate_hz = train_.recording->rate_hz, its_rate_hz = other.recording->rate_hz;
    bool const fits = std::fabs(its_rate_hz - rate_hz) <= about_the_same * std::min(its_rate_hz, rate_hz);
    return fits ? std::string() : fmt::format("it has {:.6g} Hz, train {:.6g} Hz", its_rate_hz, rate_hz);
  }

  void write_rate() {
    if (!train_.stamps) {
      std::string why = "no column has time stamps that run forwards";
      if (auto const text = text_column("time"); !text.empty()) why = text;
      text_.to_edit("rate_hz", "<samples per second>", "EDIT: " + why);
      warn(fmt::format("the sampling rate is unknown ({}): write recording.rate_hz", why));
      return;
    }
    auto const& stamps = *train_.stamps;
    bool const odd_unit = stamps.unit == Certainty::by_values && stamps.per_unit != 1.0;
    if (stamps.unit == Certainty::doubtful || odd_unit)
      warn(fmt::format("time stamps \"{}\": {}", stamps.column, stamps.why));
    if (stamps.per_unit != 1.0) text_.setting("time_per_unit", toml_number(stamps.per_unit), stamps.why);
  }

  void write_position_unit() {
    auto const& position = train_.columns.position;
    if (train_.is_speed_alone) return write_velocity_unit();
    if (position.column.empty()) return;
    if (position.counts) {
      text_.to_edit("position_per_unit", fmt::format("<{} per count>", position_unit()),
                    "EDIT: 2 pi / (counts per turn of the joint); 1 until then");
      warn(fmt::format("position \"{}\" is in counts: write recording.position_per_unit, {} per count", position.column,
                       position_unit()));
      return;
    }
    if (position.name.unit) {
      if (train_.position_per_unit != 1.0)
        text_.setting("position_per_unit", toml_number(train_.position_per_unit),
                      fmt::format("the name says {}", position.name.unit->word));
      return;
    }
    constexpr double many_turns = 30.0;
    if (prismatic_ || position.most - position.least < many_turns) return;
    text_.to_edit(
        "position_per_unit", "0.0174532925",
        fmt::format("EDIT if these are degrees: {:.4g} to {:.4g} are many turns", position.least, position.most));
    warn(fmt::format("position \"{}\" goes from {:.4g} to {:.4g}: taken as rad, though it may be degrees",
                     position.column, position.least, position.most));
  }

  void write_velocity_unit() {
    auto const& velocity = train_.columns.velocity;
    if (velocity.name.unit && tells_si(*velocity.name.unit)) {
      if (train_.velocity_per_unit != 1.0)
        text_.setting("velocity_per_unit", toml_number(train_.velocity_per_unit),
                      fmt::format("the name says {}", velocity.name.unit->word));
      return;
    }
    text_.to_edit("velocity_per_unit", "0.104719755",
                  fmt::format("EDIT if it is rpm: taken as {}/s, {:.4g} to {:.4g}", position_unit(), velocity.least,
                              velocity.most));
    warn(fmt::format("velocity \"{}\" has no unit: taken as {}/s", velocity.column, position_unit()));
  }

  void write_torque_unit() {
    auto const& torque = train_.columns.torque;
    if (torque.column.empty()) return;
    if (torque_unit_is_known(torque)) {
      if (train_.torque_per_unit != 1.0)
        text_.setting("torque_per_unit", toml_number(train_.torque_per_unit),
                      fmt::format("the name says {}", torque.name.unit->word));
      return;
    }
    std::string const unit = torque.name.unit_text.empty() ? "unit" : torque.name.unit_text;
    text_.to_edit("torque_per_unit", fmt::format("<{} per {}>", torque_unit(), unit),
                  fmt::format("EDIT: 1 until then, and every parameter is in {} for {}",
                              unit == "unit" ? "units of the column" : unit, torque_unit()));
    warn(fmt::format("torque \"{}\" is {}: write recording.torque_per_unit, {} per {}", torque.column,
                     drive_words(torque.name), torque_unit(), unit));
  }

  void write_columns() {
    text_.section("[recording.columns]");
    auto const& joints = train_.columns;
    if (joints.joints > 1) {
      if (joints.joint_that_moves != joints.joint)
        warn(fmt::format("joint {} hardly moves beside joint {}: --joint {} takes that one", joints.joint,
                         joints.joint_that_moves, joints.joint_that_moves));
      text_.comment(fmt::format("The file has {} joints; this is joint {} (torquescope init --joint N takes another).",
                                joints.joints, joints.joint));
      if (joints.passes_over_others) text_.comment(fmt::format("It is {}.", passed_over_words(joints)));
      if (joints.moving_joints > 1)
        text_.comment(fmt::format("{} of them move: what they do to this joint's torque is no part of this model.",
                                  joints.moving_joints));
      for (auto const& shift : joints.shifts) text_.comment(shift_words(shift) + ".");
    }
    for (auto const& look : train_.looks) text_.comment(look_words(look));
    if (!train_.looks.empty())
      text_.comment("torquescope init FILE --position COLUMN --torque COLUMN drafts it with the columns you name.");
    if (train_.stamps) text_.setting("time", toml_text(train_.stamps->column), time_comment());
    if (train_.is_speed_alone)
      write_channel("velocity", train_.columns.velocity,
                    "no position: its integral serves, from zero; where the joint stood stays unknown");
    else
      write_channel("position", train_.columns.position, position_comment());
    if (has_torque()) write_channel("torque", train_.columns.torque, torque_comment());
    if (!has_torque() || reference_serves(train_.columns))
      write_channel("reference", reference_fits(train_.columns) ? train_.columns.reference : ChannelGuess{},
                    "guessed from the name: the commanded position");
    if (auto const why = unused_reference_words(train_); !why.empty()) text_.comment(why);
    if (auto const& enabled = train_.columns.enabled; !enabled.column.empty() && !(has_torque() && enabled.is_constant))
      text_.setting("enabled", toml_text(enabled.column), "0 and 1, and the name: whether the drive is on");
    if (auto const& velocity = train_.columns.velocity; !train_.is_speed_alone && !velocity.column.empty())
      text_.comment(
          fmt::format("\"{}\" is not used: the derivative of the position serves, and lags nothing", velocity.column));
    write_clocks();
  }

  // of the channels that were written
  void write_clocks() {
    std::vector<std::pair<std::string, std::string>> written;
    for (auto const& [channel, clock] : train_.clocks) {
      bool const is_left_out = (channel == "torque" && !has_torque()) ||
                               (channel == "reference" && has_torque() && !reference_serves(train_.columns)) ||
                               (channel == "enabled" && has_torque() && train_.columns.enabled.is_constant);
      if (!is_left_out) written.emplace_back(channel, clock);
    }
    if (written.empty()) return;
    text_.section("[recording.clocks]");
    text_.comment("These channels have time columns of their own; they are put on the position's clock.");
    for (auto const& [channel, clock] : written)
      text_.setting(channel, toml_text(clock), "the time column before it in the file");
  }

  std::string time_comment() const {
    auto const& stamps = *train_.stamps;
    if (!train_.recording) return "guessed from the name";
    double const rate_hz = train_.recording->rate_hz;
    constexpr double visible = 0.005;
    std::string const unevenness =
        train_.jitter > visible ? fmt::format(", uneven by {:.1g} % of a step", 100 * train_.jitter) : std::string();
    return fmt::format("sure: stamps run forwards, {:.4g} ms apart ({:.6g} Hz){}{}", 1e3 / rate_hz, rate_hz, unevenness,
                       stamps.unit == Certainty::by_name ? "" : ", " + stamps.why);
  }

  std::string position_comment() const {
    auto const& position = train_.columns.position;
    if (train_.named.contains("position") && !position.name.unit)
      return position.counts ? "as you said; whole numbers, so counts"
                             : fmt::format("as you said; no unit there, taken as {}", position_unit());
    if (position.name.unit) return fmt::format("guessed from the name and its unit, {}", position.name.unit->word);
    return position.counts ? "guessed from the name; whole numbers, so counts"
                           : fmt::format("guessed from the name; no unit there, taken as {}", position_unit());
  }

  std::string torque_comment() const {
    auto const& torque = train_.columns.torque;
    if (train_.named.contains("torque") && !torque.name.unit)
      return torque_unit_is_known(torque) ? fmt::format("as you said; no unit there, taken as {}", torque_unit())
                                          : "as you said; its unit is unknown";
    if (torque.name.unit) return fmt::format("guessed from the name and its unit, {}", torque.name.unit->word);
    return torque_unit_is_known(torque)
               ? fmt::format("guessed from the name; no unit there, taken as {}", torque_unit())
               : "guessed from the name; its unit is unknown";
  }

  // why the column that looks like the channel cannot serve, or ""
  std::string text_column(std::string const& channel) const {
    std::vector<std::string> names;
    for (auto const& column : train_.unusable) names.push_back(column.name);
    auto const likely = likely_column(channel, names);
    for (auto const& column : train_.unusable)
      if (column.name == likely) return fmt::format("column \"{}\" {}", column.name, column.reason);
    return {};
  }

  void write_channel(std::string const& channel, ChannelGuess const& guess, std::string const& comment) {
    if (guess.column.empty()) {
      auto const text = text_column(channel);
      text_.to_edit(channel, "\"<column>\"", "EDIT: the file has " + listed(train_.names));
      warn(text.empty() ? fmt::format("no column looks like the {}: write recording.columns.{}; the file has {}",
                                      channel, channel, listed(train_.names))
                        : text + ": correct the file, or name another column for the " + channel);
      return;
    }
    text_.setting(channel, toml_text(guess.column), comment);
    if (guess.is_constant && has_torque()) warn(fmt::format("{} \"{}\" never changes", channel, guess.column));
    if (!guess.others.empty()) text_.comment(fmt::format("{} could also be: {}", channel, listed(guess.others)));
  }

  RecordingGuess const& train_;
  std::vector<RecordingGuess> const& others_;
  std::filesystem::path const& job_file_;
  bool prismatic_;
  DraftText& text_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::string path_from(std::filesystem::path const& job_file, std::filesystem::path const& recording) {
  if (recording.is_absolute()) return recording.string();
  auto const folder = std::filesystem::absolute(job_file).parent_path();
  return std::filesystem::absolute(recording).lexically_normal().lexically_relative(folder.lexically_normal()).string();
}

void draft_recording_sections(RecordingGuess const& train, std::vector<RecordingGuess> const& others,
                              std::filesystem::path const& job_file, DraftText& text,
                              std::vector<std::string>& warnings) {
  RecordingDraft(train, others, job_file, text, warnings).write();
}

void draft_shared_recording(RecordingGuess const& one, std::filesystem::path const& job_file, DraftText& text,
                            std::vector<std::string>& warnings) {
  std::vector<RecordingGuess> const none;
  RecordingDraft(one, none, job_file, text, warnings).write();
}

}  // namespace torquescope
