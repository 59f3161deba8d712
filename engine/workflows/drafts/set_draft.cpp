#include "engine/workflows/drafts/set_draft.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "engine/data/delimited_text.hpp"
#include "engine/experiment/file_pattern.hpp"
#include "engine/experiment/known_product.hpp"
#include "engine/workflows/drafts/name_fields.hpp"
#include "engine/workflows/drafts/name_pattern.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_sections = 12;

using Files = std::vector<std::size_t>;  // of the list
using Texts = std::map<std::string, std::string>;

// "logs/" of "logs/a.csv"
std::string folder_of(std::string const& file) { return file.substr(0, file.rfind('/') + 1); }
std::string name_of(std::string const& file) { return file.substr(file.rfind('/') + 1); }

// "logs/unseen_load/": files that judge
bool is_for_judging(std::string const& folder) {
  static std::set<std::string> const words{"validate", "validation", "val", "test", "unseen", "holdout"};
  if (folder.empty()) return false;
  auto const fields = fields_of_name(lower_case(name_of(folder.substr(0, folder.size() - 1))));
  return std::any_of(fields.begin(), fields.end(), [](NameField const& field) { return words.contains(field.text); });
}

class SetDrafter {
 public:
  SetDrafter(std::vector<std::string> const& files, std::filesystem::path const& folder)
      : files_(files), folder_(folder) {
    std::vector<std::string> names;
    for (auto const& file : files_) names.push_back(name_of(file));
    if (auto parts = parts_of_names(names)) {
      parts_ = std::move(*parts);
    } else {
      parts_.values.resize(files_.size());
      has_pattern_ = false;
    }
  }

  SetDraft draft() {
    std::map<std::string, Files> by_folder;
    for (std::size_t k = 0; k < files_.size(); ++k) by_folder[folder_of(files_[k])].push_back(k);
    bool const folders_tell =
        std::any_of(by_folder.begin(), by_folder.end(), [](auto const& one) { return is_for_judging(one.first); }) &&
        !std::all_of(by_folder.begin(), by_folder.end(), [](auto const& one) { return is_for_judging(one.first); });
    for (auto const& [folder, files] : by_folder) {
      if (by_folder.size() == 1 && split_for_judging(files)) break;
      auto sections = sections_of(files);
      for (auto& section : sections) section.is_validation = folders_tell && is_for_judging(folder);
      std::move(sections.begin(), sections.end(), std::back_inserter(made_.sections));
    }
    // those that judge stand last
    std::stable_partition(made_.sections.begin(), made_.sections.end(),
                          [](DraftedSection const& section) { return !section.is_validation; });
    made_.quantities = parts_.quantities;
    made_.values = parts_.values;
    return std::move(made_);
  }

 private:
  // what all of them have in common
  Texts constants_of(Files const& files) const {
    Texts constants;
    for (auto const& quantity : parts_.quantities) {
      auto const& value = parts_.values[files.front()].at(quantity.name);
      if (std::all_of(files.begin(), files.end(),
                      [&](std::size_t k) { return parts_.values[k].at(quantity.name) == value; }))
        constants[quantity.name] = value;
    }
    return constants;
  }

  // none: a file is not matched, or is read otherwise
  std::optional<DraftedSection> section_with(Files const& files, Texts const& fixed) const {
    if (!has_pattern_) return {};
    DraftedSection section;
    section.files = plain_pattern(folder_of(files_[files.front()])) + pattern_of(parts_, fixed);
    section.fixed = fixed;
    if (!fault_of_pattern(section.files).empty()) return {};
    std::map<std::string, Texts> found;
    for (auto const& match : files_matching(folder_, section.files)) found[match.file] = match.texts;
    for (auto const k : files) {
      auto const match = found.find(files_[k]);
      if (match == found.end()) return {};
      Texts all = match->second;
      all.insert(fixed.begin(), fixed.end());
      if (all != parts_.values[k]) return {};
    }
    section.n_files = files.size();
    section.n_more = found.size() - files.size();
    return section;
  }

  std::optional<DraftedSection> exact_section(Files const& files, Texts fixed) const {
    auto section = section_with(files, fixed);
    if (section && section->n_more == 0) return section;
    fixed.merge(constants_of(files));
    section = section_with(files, fixed);
    return section && section->n_more == 0 ? section : std::nullopt;
  }

  // exactly these files: one section, else those of each value of one more quantity, as few as there can be;
  // empty: not exact, or too many. `deeper`: quantities that may be tried besides
  std::vector<DraftedSection> cover(Files const& files, Texts const& fixed, int deeper) const {
    if (auto section = exact_section(files, fixed)) return {std::move(*section)};
    std::vector<DraftedSection> best;
    for (std::size_t k = 0; deeper > 0 && k < parts_.quantities.size(); ++k) {
      auto const& quantity = parts_.quantities[k].name;
      if (fixed.contains(quantity)) continue;
      std::vector<DraftedSection> sections;
      for (auto& [value, some] : sections_by(quantity, files, fixed, deeper - 1))
        std::move(some.begin(), some.end(), std::back_inserter(sections));
      if (!sections.empty() && (best.empty() || sections.size() < best.size())) best = std::move(sections);
    }
    return best;
  }

  // by value; empty: not exact, or too many
  std::map<std::string, std::vector<DraftedSection>> sections_by(std::string const& quantity, Files const& files,
                                                                 Texts const& fixed, int deeper) const {
    std::map<std::string, Files> by_value;
    for (auto const k : files) by_value[parts_.values[k].at(quantity)].push_back(k);
    if (by_value.size() > most_sections) return {};
    std::map<std::string, std::vector<DraftedSection>> sections;
    std::size_t count = 0;
    for (auto const& [value, some] : by_value) {
      Texts with = fixed;
      with[quantity] = value;
      auto its = cover(some, with, deeper);
      count += its.size();
      if (its.empty() || count > most_sections) return {};
      sections[value] = std::move(its);
    }
    return sections;
  }

  DraftedSection literal_section(std::size_t file) const {
    return {plain_pattern(files_[file]), false, parts_.values[file], 1, 0};
  }

  std::vector<DraftedSection> sections_of(Files const& files) const {
    if (auto sections = cover(files, {}, 2); !sections.empty() && (sections.size() < files.size() || files.size() == 1))
      return sections;
    if (files.size() <= most_sections) {
      std::vector<DraftedSection> sections;
      for (auto const k : files) sections.push_back(literal_section(k));
      return sections;
    }
    if (auto section = section_with(files, {})) return {*section};
    return {star_section(files)};
  }

  // "servo_*.csv": the letters that all names begin and end with
  DraftedSection star_section(Files const& files) const {
    std::string const first = name_of(files_[files.front()]);
    std::size_t n_before = first.size(), n_behind = first.size();
    for (auto const k : files) {
      std::string const name = name_of(files_[k]);
      auto const before = std::mismatch(first.begin(), first.end(), name.begin(), name.end()).first;
      n_before = std::min(n_before, static_cast<std::size_t>(before - first.begin()));
      auto const behind = std::mismatch(first.rbegin(), first.rend(), name.rbegin(), name.rend()).first;
      n_behind = std::min({n_behind, static_cast<std::size_t>(behind - first.rbegin()), name.size() - n_before});
    }
    n_behind = std::min(n_behind, first.size() - n_before);
    DraftedSection section;
    section.files = plain_pattern(folder_of(files_[files.front()]) + first.substr(0, n_before)) + "*" +
                    plain_pattern(first.substr(first.size() - n_behind));
    section.n_files = files.size();
    std::size_t const n_found = files_matching(folder_, section.files).size();
    section.n_more = n_found - std::min(n_found, files.size());
    return section;
  }

  // numbers that have a name, words, then numbers that have none
  std::vector<NameQuantity> in_order_of_worth() const {
    auto quantities = parts_.quantities;
    std::stable_sort(quantities.begin(), quantities.end(), [](NameQuantity const& a, NameQuantity const& b) {
      auto const worth = [](NameQuantity const& one) {
        if (one.name == "mass_kg" || one.name == "mass_g") return 0;
        if (one.name.starts_with("length_")) return 1;
        return one.is_a_guess ? 4 : one.is_number ? 2 : 3;
      };
      return worth(a) < worth(b);
    });
    return quantities;
  }

  // the value that would leave about a fifth to judge; ends of a range of numbers train; "": none
  std::string value_to_judge(NameQuantity const& quantity, Files const& files) const {
    constexpr double wanted = 0.2, least_share = 0.1, most_share = 0.4;
    std::map<std::string, double> share;
    for (auto const k : files) share[parts_.values[k].at(quantity.name)] += 1.0 / static_cast<double>(files.size());
    std::vector<std::pair<double, std::string>> values;
    for (auto const& [text, ignored] : share) {
      double number = static_cast<double>(values.size());
      if (quantity.is_number) read_number(text, number);
      values.emplace_back(number, text);
    }
    std::sort(values.begin(), values.end());
    std::size_t const n_least = quantity.is_number ? 3 : 4;
    if (values.size() < n_least) return {};
    std::string best;
    for (std::size_t k = 1; k + 1 < values.size(); ++k) {
      double const its = share[values[k].second];
      if (its < least_share || its > most_share) continue;
      if (best.empty() || std::fabs(its - wanted) < std::fabs(share[best] - wanted)) best = values[k].second;
    }
    return best;
  }

  bool split_for_judging(Files const& files) {
    for (auto const& quantity : in_order_of_worth()) {
      std::string const value = value_to_judge(quantity, files);
      if (value.empty()) continue;
      auto by_value = sections_by(quantity.name, files, {}, 1);
      if (by_value.empty()) continue;
      for (auto& [its, sections] : by_value)
        for (auto& section : sections) {
          section.is_validation = its == value;
          made_.sections.push_back(std::move(section));
        }
      made_.judged_by = quantity.name;
      return true;
    }
    return false;
  }

  std::vector<std::string> const& files_;
  std::filesystem::path const& folder_;
  NameParts parts_{};
  bool has_pattern_ = true;
  SetDraft made_{};
};

}  // namespace

SetDraft draft_set(std::vector<std::string> const& files, std::filesystem::path const& folder) {
  return SetDrafter(files, folder).draft();
}

}  // namespace torquescope
