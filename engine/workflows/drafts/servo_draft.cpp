#include "engine/workflows/drafts/servo_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "engine/experiment/job/job.hpp"
#include "engine/experiment/known_product.hpp"
#include "engine/experiment/quantity_unit.hpp"
#include "engine/workflows/drafts/draft_notes.hpp"
#include "engine/workflows/drafts/draft_text.hpp"
#include "engine/workflows/drafts/recording_draft.hpp"
#include "engine/workflows/drafts/set_draft.hpp"
#include "engine/workflows/servo_workflow.hpp"

namespace torquescope {
namespace {

char const* files_word(std::size_t n) { return n == 1 ? "file" : "files"; }

class ServoDrafter {
 public:
  ServoDrafter(RecordingGuess const& first, std::vector<RecordingGuess> const& others,
               std::filesystem::path const& job_file)
      : first_(first), job_file_(job_file) {
    add_file(first);
    for (auto const& other : others) {
      if (other.refusal.empty())
        add_file(other);
      else
        left_out_.push_back(fmt::format("{} is left out: {}", other.file.string(), why_not(other)));
    }
    set_ = draft_set(files_, job_file.parent_path());
  }

  JobDraft draft() {
    write_head();
    write_sections();
    write_advice_on_sections();
    draft_shared_recording(first_, job_file_, text_, draft_.warnings);
    write_known();
    write_model();
    draft_.text = text_.text();
    check();
    return std::move(draft_);
  }

 private:
  void add_file(RecordingGuess const& guess) {
    auto const file = std::filesystem::absolute(guess.file).lexically_normal();
    if (folder_.empty()) folder_ = file.parent_path();
    // up to the folder that has all of them
    while (folder_.has_relative_path() && file.lexically_relative(folder_).string().starts_with(".."))
      folder_ = folder_.parent_path();
    auto path = path_from(job_file_, guess.file);
    if (std::find(files_.begin(), files_.end(), path) == files_.end()) files_.push_back(std::move(path));
  }

  // a table of the others may do better than their names
  std::string why_not(RecordingGuess const& other) const {
    bool const names_files = std::any_of(other.unusable.begin(), other.unusable.end(),
                                         [](UnusableColumn const& column) { return column.name == "file"; });
    if (!names_files) return other.refusal;
    return fmt::format("it looks like a table of recordings; one [[recordings]] with manifest = {} in place of files",
                       toml_text(path_from(job_file_, other.file)));
  }

  void warn(std::string text) { draft_.warnings.push_back(std::move(text)); }

  void write_head() {
    auto const name = job_file_.filename().string();
    text_.comment(
        fmt::format("Drafted by `torquescope init` from {} {} of a servo: command and position, no torque. The "
                    "comments say what was guessed and how sure it is; correct what is wrong.",
                    files_.size(), files_.size() == 1 ? "recording" : "recordings"));
    text_.comment(
        fmt::format("torquescope check {} looks at everything, torquescope diagnose {} says what the model "
                    "lacks.",
                    name, name));
    text_.section("[experiment]");
    text_.setting("name", toml_text(draft_name(files_.size() == 1 ? first_.file : folder_)),
                  "of the result file as well");
    text_.setting("seed", "1", "of every random number");
  }

  bool is_number(std::string const& quantity) const {
    return std::any_of(set_.quantities.begin(), set_.quantities.end(),
                       [&](NameQuantity const& one) { return one.name == quantity && one.is_number; });
  }

  void write_sections() {
    for (auto const& section : set_.sections) {
      text_.section("[[recordings]]");
      text_.setting("files", toml_text(section.files),
                    fmt::format("{} {}{}", section.n_files, files_word(section.n_files),
                                section.is_validation ? ": effects are chosen by these; no fit uses them" : ""));
      if (section.is_validation) text_.setting("role", "\"validate\"");
      for (auto const& [name, value] : section.fixed) {
        double number = 0.0;
        bool const as_number = is_number(name) && read_number(value, number);
        text_.setting(name, as_number ? toml_number(number) : toml_text(value));
      }
      if (section.n_more == 0) continue;
      text_.comment(
          fmt::format("EDIT: it matches {} {} more than were given. A manifest names exactly those that are "
                      "meant: manifest = \"records.csv\" in place of files, a table of",
                      section.n_more, files_word(section.n_more)));
      text_.comment("file,role,mass_kg,length_m");
      text_.comment(fmt::format("{},train,0.5,0.15", files_.front()));
      warn(fmt::format("files = \"{}\" matches {} {} more than were given", section.files, section.n_more,
                       files_word(section.n_more)));
    }
  }

  void write_advice_on_sections() {
    for (auto const& one : left_out_) {
      text_.comment(one);
      warn(one);
    }
    for (auto const& quantity : set_.quantities)
      if (quantity.is_a_guess) {
        text_.comment(fmt::format("EDIT: {0} is \"{1}\" of {2}: name it{3}, or write * in place of {{{0}}}.",
                                  quantity.name, quantity.written,
                                  std::filesystem::path(files_.front()).filename().string(),
                                  quantity.is_number ? " with its unit (mass_kg, kp)" : ""));
      }
    bool const any_judges = std::any_of(set_.sections.begin(), set_.sections.end(),
                                        [](DraftedSection const& section) { return section.is_validation; });
    if (any_judges) return;
    text_.comment(
        "No recording judges the result. EDIT: another [[recordings]] with role = \"validate\" and a pattern of its "
        "own, about a fifth of the files and whole values of one quantity (one mass of several), which the pattern "
        "above must not match.");
  }

  // the quantity in m or kg: "0.001 * length_mm"; "": the names do not tell
  std::string in_si(std::string const& stem) const {
    for (auto const& quantity : set_.quantities) {
      auto const unit = unit_of_quantity(quantity.name);
      if (!quantity.is_number || !unit || unit->stem != stem) continue;
      return unit->si == 1.0 ? quantity.name : fmt::format("{:g} * {}", unit->si, quantity.name);
    }
    return {};
  }

  bool has(std::string const& quantity) const { return is_number(quantity); }

  void write_known() {
    text_.section("[known]");
    auto const mass = in_si("mass"), length = in_si("length");
    bool const turns = !is_prismatic(first_.columns);
    bool const is_pendulum = turns && !mass.empty() && !length.empty();
    text_.comment("What is known of each recording, as products of its quantities (torquescope describe known).");
    if (turns) text_.comment("EDIT: is the axis horizontal, does position 0 hang down? Else leave gravity_moment out.");
    std::string const any_mass = mass.empty() ? "mass_kg" : mass, any_length = length.empty() ? "length_m" : length;
    auto const line = [&](char const* key, std::string const& value, char const* comment) {
      if (is_pendulum)
        text_.setting(key, toml_text(value), comment);
      else
        text_.to_edit(key, toml_text(value), std::string("EDIT: ") + comment);
    };
    if (turns) {
      line("gravity_moment", fmt::format("9.80665 * {} * {}", any_mass, any_length),
           "N m, of the load; it acts times sin(position)");
      line("inertia", fmt::format("{} * {} * {}", any_mass, any_length, any_length),
           "kg m2, of the load; the rest is searched");
      line("arm_length", any_length, "m, from the axis to the load");
      if (!is_pendulum)
        text_.comment("The names do not tell mass and length: write them in [[recordings]] (mass_kg = 0.5).");
    } else {
      text_.to_edit("inertia", toml_text(any_mass), "EDIT: kg, of the load; the rest is searched");
    }
    if (has("temperature_c")) text_.setting("temperature", "\"temperature_c\"", "deg C, of the drive");
    write_gain();
  }

  bool differs(std::string const& quantity) const {
    return has(quantity) && std::any_of(set_.values.begin(), set_.values.end(), [&](auto const& values) {
             return values.at(quantity) != set_.values.front().at(quantity);
           });
  }

  void write_gain() {
    text_.comment(
        "Without command_gain the drive answers its position error by an unknown gain, one for all recordings:");
    if (differs("kp")) {
      std::string const why = "kp differs between these recordings, and one gain would serve all of them";
      text_.comment(fmt::format("EDIT: {}: write command_gain.", why));
      warn(fmt::format("{}: write known.command_gain", why));
    }
    if (!has("kp") || !has("supply_v"))
      text_.comment("kp and supply_v are quantities of the recordings: supply_v = 12 in [[recordings]].");
    text_.to_edit("command_gain", "\"0.165 * kp * supply_v\"", "EDIT: volts per rad of error");
    text_.to_edit("command_limit", "\"0.97 * supply_v\"", "EDIT: largest volts");
  }

  void write_model() {
    text_.section("[model]");
    text_.setting("joint", is_prismatic(first_.columns) ? "\"prismatic\"" : "\"revolute\"",
                  first_.columns.position.name.unit ? "guessed from the unit" : "assumed: no unit says so");
    text_.setting("terms", "[\"inertia\", \"viscous\", \"coulomb\"]",
                  "what a servo has at least; a diagnosis finds the rest");
    text_.section("[loop]");
    text_.setting("drive", "\"position servo\"", "\"voltage\" with known.command_gain");
    text_.section("[diagnose]");
    text_.setting("effects", "\"all\"", "look for everything in the catalogue (torquescope list effects)");
  }

  // what `torquescope check` will say of it
  void check() {
    auto const& columns = first_.columns;
    if (!first_.stamps || columns.position.column.empty() || !reference_fits(columns))
      return does_not_run(draft_, ExitCode::bad_job, what_to_edit);
    if (!first_.recording) return does_not_run(draft_, ExitCode::bad_data, first_.refusal);
    try {
      auto const job = read_servo_job(parse_job(draft_.text, job_file_));
      for (auto const& line : check_servo(job))
        if (line.level == CheckLine::Level::fault)
          does_not_run(draft_, ExitCode::bad_data, fmt::format("{}: {}", line.topic, line.text));
    } catch (Error const& refused) {
      does_not_run(draft_, refused);
    }
  }

  RecordingGuess const& first_;
  std::filesystem::path const& job_file_;
  std::filesystem::path folder_{};
  std::vector<std::string> files_{}, left_out_{};
  SetDraft set_{};
  DraftText text_{};
  JobDraft draft_{};
};

}  // namespace

JobDraft draft_servo_job(RecordingGuess const& first, std::vector<RecordingGuess> const& others,
                         std::filesystem::path const& job_file) {
  return ServoDrafter(first, others, job_file).draft();
}

}  // namespace torquescope
