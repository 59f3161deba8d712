#include "engine/experiment/recording_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "engine/experiment/file_pattern.hpp"
#include "engine/experiment/known_product.hpp"
#include "engine/experiment/quantity_unit.hpp"
#include "engine/experiment/recording_manifest.hpp"

namespace torquescope {
namespace {

std::vector<std::string> const own_keys{"files", "manifest", "role"};

// keys of [[recordings]] that are quantities of all its recordings
struct SectionQuantities {
  std::map<std::string, double> numbers{};
  std::map<std::string, std::string> words{};
};

// one [[recordings]] to its entries
class SetSection {
 public:
  SetSection(Job const& job, Section const& section, std::vector<Problem>& problems)
      : job_(job), section_(section), problems_(problems) {}

  std::vector<SetEntry> read() {
    read_quantities();
    std::vector<std::string> foreign;
    for (auto const& setting : section_.settings)
      if (std::find(own_keys.begin(), own_keys.end(), setting.key) == own_keys.end()) foreign.push_back(setting.key);
    std::size_t const before = problems_.size();
    RecordingsOptions::table().apply(section_, options_, problems_, foreign);
    bool const has_files = section_.find("files") != nullptr, has_manifest = section_.find("manifest") != nullptr;
    if (has_files && has_manifest)
      add("manifest", "a [[recordings]] has both files and manifest",
          "write two [[recordings]], or remove one of them");
    if (!has_files && !has_manifest)
      add("", "a [[recordings]] has neither files nor manifest",
          "write files = \"train/*.csv\", or manifest = \"records.csv\"");
    if (problems_.size() > before) return {};
    return has_files ? entries_of_pattern() : entries_of_manifest();
  }

 private:
  void read_quantities() {
    for (auto const& setting : section_.settings) {
      if (std::find(own_keys.begin(), own_keys.end(), setting.key) != own_keys.end()) continue;
      auto const* word = std::get_if<std::string>(&setting.value);
      auto const number = converted(setting.value, 0.0);
      std::string const close = closest_name(setting.key, own_keys);
      if (word != nullptr && !close.empty()) {
        problems_.push_back(unknown_key(section_, setting, own_keys));
        problems_.back().help += "; every other key is a quantity of these recordings: mass_kg = 0.5";
      } else if (word != nullptr) {
        quantities_.words[setting.key] = *word;
      } else if (number) {
        quantities_.numbers[setting.key] = std::get<double>(*number);
      } else {
        add(setting.key, fmt::format("{} = {} is a {}", setting.key, to_text(setting.value), type_name(setting.value)),
            fmt::format("a quantity is a number or a text: {} = 0.5", setting.key));
      }
    }
  }

  SetEntry entry_of(std::filesystem::path const& path, std::string const& role) const {
    SetEntry entry;
    entry.path = path;
    entry.name = path.filename().string();
    entry.is_validation = (role.empty() ? options_.role : role) == "validate";
    entry.numbers = quantities_.numbers;
    entry.words = quantities_.words;
    return entry;
  }

  // a quantity has one source
  void refuse_twice(std::vector<std::string> const& names, char const* where, SourcePlace const& place) {
    for (auto const& name : names)
      if (section_.find(name) != nullptr && std::find(own_keys.begin(), own_keys.end(), name) == own_keys.end()) {
        add(name, fmt::format("{} stands in [[recordings]] and {}", name, where), "remove one of the two");
        problems_.back().notes.push_back(fmt::format("the other one: {}:{}", place.file, place.line));
      }
  }

  std::vector<SetEntry> entries_of_pattern() {
    std::string const fault = fault_of_pattern(options_.files);
    if (!fault.empty()) {
      add("files", fmt::format("files = \"{}\" is no pattern: {}", options_.files, fault),
          "write \"train/servo_m{mass_kg}_{motion}.csv\", or \"train/*.csv\"");
      return {};
    }
    auto const names = names_in_pattern(options_.files);
    refuse_twice(names, "in its pattern", section_.where("files"));
    auto const matches = files_matching(job_.path.parent_path(), options_.files);
    if (matches.empty()) refuse_no_match();
    std::map<std::string, bool> is_number;
    for (auto const& name : names)
      is_number[name] = std::all_of(matches.begin(), matches.end(), [&](PatternMatch const& match) {
        double ignored = 0.0;
        return read_number(match.texts.at(name), ignored);
      });
    std::vector<SetEntry> entries;
    for (auto const& match : matches) {
      entries.push_back(entry_of(job_.resolve(match.file), ""));
      entries.back().place = section_.where("files");
      for (auto const& [name, text] : match.texts) {
        if (is_number[name])
          read_number(text, entries.back().numbers[name]);
        else
          entries.back().words[name] = text;
      }
    }
    return entries;
  }

  void refuse_no_match() {
    add("files", fmt::format("files = \"{}\" matches no file", options_.files),
        "{name} and * match any letters but '/'; paths are relative to the job");
    problems_.back().code = ExitCode::no_input;
    problems_.back().notes = what_is_there(job_.path.parent_path(), options_.files);
  }

  std::vector<SetEntry> entries_of_manifest() {
    auto const path = job_.resolve(options_.manifest);
    std::size_t const before = problems_.size();
    auto manifest = read_manifest(path, problems_);
    for (std::size_t k = before; k < problems_.size(); ++k) {
      if (problems_[k].place.file.empty()) problems_[k].place = section_.where("manifest");
      if (problems_[k].key.empty()) problems_[k].key = "recordings.manifest";
    }
    refuse_twice(manifest.quantities, "in its manifest", manifest.header);
    if (problems_.size() > before) return {};
    std::vector<SetEntry> entries;
    for (auto& row : manifest.rows) {
      entries.push_back(entry_of(path.parent_path() / row.file, row.role));
      entries.back().place = row.place;
      entries.back().numbers.merge(row.numbers);
      entries.back().words.merge(row.words);
    }
    refuse_missing_files(entries, manifest);
    return entries;
  }

  void refuse_missing_files(std::vector<SetEntry> const& entries, RecordingManifest const& manifest) {
    constexpr int most_shown = 5;
    int n_missing = 0;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      std::error_code ignored;
      auto const& path = entries[k].path;
      if (std::filesystem::is_regular_file(path, ignored) || ++n_missing > most_shown) continue;
      Problem problem;
      problem.code = ExitCode::no_input;
      problem.what = fmt::format("no such file: {}", path.string());
      problem.place = entries[k].place;
      problem.key = "recordings.manifest";
      problem.notes = what_is_there(path.parent_path(), path.filename().string());
      problem.help =
          fmt::format("correct \"{}\", or delete its line; names are relative to the manifest", manifest.rows[k].file);
      problems_.push_back(std::move(problem));
    }
    if (n_missing > most_shown)
      problems_.back().notes.push_back(fmt::format("so are {} more of {}", n_missing - most_shown, entries.size()));
  }

  void add(std::string const& key, std::string what, std::string help) {
    problems_.push_back(problem_at(section_, key, std::move(what), std::move(help)));
  }

  Job const& job_;
  Section const& section_;
  std::vector<Problem>& problems_;
  RecordingsOptions options_{};
  SectionQuantities quantities_{};
};

// what [recording] says of files, a set says itself
void refuse_keys_of_one(Job const& job, std::vector<Problem>& problems) {
  Section const* recording = job.find("recording");
  if (recording == nullptr) return;
  for (char const* key : {"train", "validate", "train_share"})
    if (recording->find(key) != nullptr)
      problems.push_back(problem_at(*recording, key,
                                    fmt::format("the job has both recording.{} and [[recordings]]", key),
                                    "name all recordings in [[recordings]], each with its role, and remove this key"));
}

// once for each pair of places: a pattern that takes all files of another one would say it of each
void refuse_files_twice(std::vector<SetEntry> const& entries, std::vector<Problem>& problems) {
  std::map<std::string, SetEntry const*> first;
  std::map<std::pair<std::string, std::string>, std::vector<SetEntry const*>> twice;
  auto const place_text = [](SetEntry const& entry) {
    return fmt::format("{}:{}", entry.place.file, entry.place.line);
  };
  for (auto const& entry : entries) {
    std::error_code error;
    auto const whole = std::filesystem::weakly_canonical(entry.path, error);
    auto const [found, is_new] = first.emplace(error ? entry.path.string() : whole.string(), &entry);
    if (!is_new) twice[{place_text(*found->second), place_text(entry)}].push_back(&entry);
  }
  for (auto const& [places, files] : twice) {
    Problem problem;
    problem.what = files.size() == 1 ? fmt::format("{} is in the set twice", files.front()->name)
                                     : fmt::format("{} files are in the set twice, {} one of them", files.size(),
                                                   files.front()->name);
    problem.place = files.front()->place;
    problem.key = "recordings";
    problem.notes.push_back("already named by " + places.first);
    problem.help = "narrow one of the patterns, or delete one of the lines";
    problems.push_back(std::move(problem));
  }
}

// length_m beside length_mm
void refuse_two_units(std::vector<SetEntry> const& entries, std::vector<Problem>& problems) {
  std::map<std::string, SetEntry const*> first;
  for (auto const& entry : entries)
    for (auto const& [name, value] : entry.numbers) first.emplace(name, &entry);
  for (auto a = first.begin(); a != first.end(); ++a)
    for (auto b = std::next(a); b != first.end(); ++b) {
      auto const factor = factor_between(a->first, b->first);
      if (!factor) continue;
      Problem problem;
      problem.what = fmt::format("{} and {} are one quantity in two units", a->first, b->first);
      problem.place = b->second->place;
      problem.key = "recordings." + b->first;
      problem.notes.push_back(
          fmt::format("{} is of {}, {} of {}", a->first, a->second->name, b->first, b->second->name));
      problem.help = fmt::format("use one of them for all recordings: {} = {:g} * {}", a->first, *factor, b->first);
      problems.push_back(std::move(problem));
    }
}

void name_apart(Job const& job, std::vector<SetEntry>& entries) {
  std::map<std::string, int> times;
  for (auto const& entry : entries) ++times[entry.name];
  for (auto& entry : entries)
    if (times[entry.name] > 1) entry.name = entry.path.lexically_relative(job.path.parent_path()).string();
}

}  // namespace

OptionTable<RecordingsOptions> const& RecordingsOptions::table() {
  using Options = RecordingsOptions;
  static OptionTable<Options> const table(
      "recordings", "many recordings in one job; written [[recordings]], as often as there are kinds of files",
      {{"files", &Options::files,
        "pattern over file names, relative to the job: {name} matches as little as it can and becomes a quantity of "
        "the recording, * any letters, ? one; none of them matches '/'"},
       {"manifest", &Options::manifest,
        "in place of files: a CSV with the columns file (relative to it), role where it differs, and quantities"},
       {"role", &Options::role, {"train", "validate"}, "what the recordings are for"}});
  return table;
}

bool has_recording_set(Job const& job) { return job.find("recordings") != nullptr; }

std::vector<SetEntry> read_recording_set(Job const& job, std::vector<Problem>& problems) {
  auto const sections = job.all("recordings");
  if (sections.empty()) return {};
  std::size_t const before = problems.size();
  refuse_keys_of_one(job, problems);
  std::vector<SetEntry> entries;
  for (auto const* section : sections) {
    auto more = SetSection(job, *section, problems).read();
    entries.insert(entries.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  name_apart(job, entries);
  refuse_files_twice(entries, problems);
  refuse_two_units(entries, problems);
  bool const has_training =
      std::any_of(entries.begin(), entries.end(), [](SetEntry const& entry) { return !entry.is_validation; });
  if (!has_training && problems.size() == before)
    problems.push_back(
        problem_at(*sections.front(), "role", fmt::format("none of the {} recordings is for training", entries.size()),
                   "write role = \"train\" in a [[recordings]], or train in the manifest's role column"));
  // of a part of the set one would miss quantities that the other part has
  std::vector<SetEntry> none;
  evaluate_known(job, problems.size() == before ? entries : none, problems);
  return entries;
}

}  // namespace torquescope
