#include "engine/experiment/known_quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "engine/experiment/known_product.hpp"
#include "engine/experiment/quantity_unit.hpp"

namespace torquescope {
namespace {

constexpr double any = -std::numeric_limits<double>::infinity();

struct KnownKey {
  char const* key;
  double TrackKnown::*value;
  bool KnownKeys::*is_given;
  char const* unit;
  double least;           // included
  bool is_mechanical;     // in SI units of mass, length and torque
  char const* otherwise;  // where it is not given
  char const* meaning;
};

std::vector<KnownKey> const& known_key_table() {
  using Value = TrackKnown;
  using Given = KnownKeys;
  static std::vector<KnownKey> const table{
      {"gravity_moment", &Value::gravity_moment, &Given::gravity_moment, "N m", any, true, "0",
       "moment of the known load, which acts times sin(position): \"9.80665 * mass_kg * length_m\""},
      {"inertia", &Value::inertia, &Given::inertia, "kg m2", 0.0, true, "0",
       "inertia of the known load: \"mass_kg * length_m * length_m\""},
      {"command_gain", &Value::command_gain, &Given::command_gain, "command/rad", any, false, "1",
       "command of the drive per rad of position error: \"0.165 * kp * supply_v\""},
      {"command_limit", &Value::command_limit, &Given::command_limit, "command", std::numeric_limits<double>::min(),
       false, "none", "largest command of the drive: \"0.97 * supply_v\""},
      {"arm_length", &Value::arm_length, &Given::arm_length, "m", 0.0, true, "0",
       "from the axis to the load: \"length_m\""},
      {"temperature", &Value::temperature, &Given::temperature, "deg C", -273.15, false, "none",
       "of the drive while it was recorded: \"temperature_c\""},
  };
  return table;
}

// the first few of them, each with the line that names it
std::string some_of(std::vector<SetEntry const*> const& entries) {
  constexpr std::size_t most_shown = 3;
  std::string text;
  for (std::size_t k = 0; k < std::min(entries.size(), most_shown); ++k)
    text += fmt::format("{}{} ({}:{})", k == 0 ? "" : ", ", entries[k]->name,
                        std::filesystem::path(entries[k]->place.file).filename().string(), entries[k]->place.line);
  return entries.size() > most_shown ? fmt::format("{} and {} more", text, entries.size() - most_shown) : text;
}

// one key of [known] against the recordings
class KnownReader {
 public:
  KnownReader(Section const& section, std::vector<SetEntry>& entries, std::vector<Problem>& problems)
      : section_(section), entries_(entries), problems_(problems) {
    std::set<std::string> all;
    for (auto const& entry : entries_) {
      for (auto const& [name, value] : entry.numbers) all.insert(name);
      for (auto const& [name, word] : entry.words) all.insert(name);
    }
    quantities_.assign(all.begin(), all.end());
  }

  void read(KnownKey const& key, Setting const& setting) {
    auto const product = product_of(key, setting);
    if (!product || entries_.empty()) return;
    std::size_t const before = problems_.size();
    for (auto const& name : std::set<std::string>(product->names.begin(), product->names.end()))
      check_name(key, *product, name);
    if (problems_.size() > before) return;
    std::vector<SetEntry const*> refused;
    for (auto& entry : entries_) {
      double const value = value_of_product(*product, entry.numbers);
      if (!std::isfinite(value) || value < key.least) refused.push_back(&entry);
      entry.known.*key.value = value;
    }
    if (!refused.empty()) refuse_values(key, refused);
  }

 private:
  std::optional<KnownProduct> product_of(KnownKey const& key, Setting const& setting) {
    if (auto const number = converted(setting.value, 0.0)) {
      double const value = std::get<double>(*number);
      return KnownProduct{{fmt::format("{}", value)}, {value}, {}};
    }
    auto const* text = std::get_if<std::string>(&setting.value);
    std::string const example = fmt::format("write factors joined by *, as {}", key.meaning);
    KnownProduct product;
    std::string const fault = text == nullptr ? "a number or a text is wanted" : read_product(*text, product);
    if (fault.empty()) return product;
    add(key, fmt::format("{} = {} is no product: {}", key.key, to_text(setting.value), fault), example);
    return {};
  }

  void check_name(KnownKey const& key, KnownProduct const& product, std::string const& name) {
    if (std::find(quantities_.begin(), quantities_.end(), name) == quantities_.end())
      return refuse_unknown(key, product, name);
    std::vector<SetEntry const*> texts, missing_ones;
    for (auto const& entry : entries_) {
      if (entry.words.contains(name))
        texts.push_back(&entry);
      else if (!entry.numbers.contains(name))
        missing_ones.push_back(&entry);
    }
    if (!texts.empty())
      add(key,
          fmt::format("{} needs {}, which is text (\"{}\") of {}", key.key, name, texts.front()->words.at(name),
                      some_of(texts)),
          fmt::format("make {} a number of every recording, or leave it out of {}", name, key.key));
    if (!missing_ones.empty())
      add(key,
          fmt::format("{} needs {}, which {} of {} recordings do not have: {}", key.key, name, missing_ones.size(),
                      entries_.size(), some_of(missing_ones)),
          fmt::format("write {} in their [[recordings]], or in their manifest", name));
    if (texts.empty() && missing_ones.empty()) check_unit(key, product, name);
  }

  void refuse_unknown(KnownKey const& key, KnownProduct const& product, std::string const& name) {
    std::string help = fmt::format("write {} = <number> in [[recordings]], or as a column of the manifest", name);
    std::string close = closest_name(name, quantities_);
    for (auto const& there : quantities_) {
      auto const factor = factor_between(name, there);
      if (!factor) continue;
      help = fmt::format("write {} = \"{}\"", key.key,
                         product_with(product, name, fmt::format("{:g} * {}", *factor, there)));
      close = there;
    }
    add(key, fmt::format("{} names {}, and no recording has such a quantity", key.key, name), help);
    problems_.back().notes.push_back(quantities_.empty() ? std::string("the recordings have no quantities")
                                                         : fmt::format("quantities: {}", fmt::join(quantities_, ", ")));
    if (!close.empty()) problems_.back().caret_note = fmt::format("did you mean {}?", close);
  }

  // only where it is sure: no factor stands there that could be one between units
  void check_unit(KnownKey const& key, KnownProduct const& product, std::string const& name) {
    constexpr double least_gravity = 9.7, most_gravity = 9.9;
    auto const unit = unit_of_quantity(name);
    if (!key.is_mechanical || !unit || unit->si == 1.0) return;
    bool const is_about_mechanics =
        !unit->quantity || unit->quantity == Quantity::length || unit->quantity == Quantity::torque;
    bool const has_factor = std::any_of(product.numbers.begin(), product.numbers.end(),
                                        [&](double number) { return number < least_gravity || number > most_gravity; });
    if (!is_about_mechanics || has_factor) return;
    add(key, fmt::format("{} is in {}, and {} is in {}", key.key, key.unit, name, unit->word),
        fmt::format("write {} = \"{}\"", key.key,
                    product_with(product, name, fmt::format("{:g} * {}", unit->si, name))));
  }

  void refuse_values(KnownKey const& key, std::vector<SetEntry const*> const& refused) {
    double const value = refused.front()->known.*key.value;
    std::string const range = key.least == any  ? "a finite number"
                              : key.least > 0.0 ? "above 0"
                                                : fmt::format("at least {:g}", key.least);
    add(key, fmt::format("{} is {:g} {} of {}", key.key, value, key.unit, some_of(refused)),
        fmt::format("{} is {}: correct the quantities, or the product", key.key, range));
  }

  void add(KnownKey const& key, std::string what, std::string help) {
    problems_.push_back(problem_at(section_, key.key, std::move(what), std::move(help)));
  }

  Section const& section_;
  std::vector<SetEntry>& entries_;
  std::vector<Problem>& problems_;
  std::vector<std::string> quantities_;
};

}  // namespace

KnownKeys known_keys(Job const& job) {
  KnownKeys keys;
  Section const* section = job.find("known");
  for (auto const& key : known_key_table())
    keys.*key.is_given = section != nullptr && section->find(key.key) != nullptr;
  return keys;
}

void evaluate_known(Job const& job, std::vector<SetEntry>& entries, std::vector<Problem>& problems) {
  Section const* section = job.find("known");
  if (section == nullptr) return;
  std::vector<std::string> names;
  for (auto const& key : known_key_table()) names.emplace_back(key.key);
  KnownReader reader(*section, entries, problems);
  for (auto const& setting : section->settings) {
    auto const key = std::find(names.begin(), names.end(), setting.key);
    if (key == names.end())
      problems.push_back(unknown_key(*section, setting, names));
    else
      reader.read(known_key_table()[static_cast<std::size_t>(key - names.begin())], setting);
  }
}

std::vector<OptionDescription> describe_known() {
  std::vector<OptionDescription> descriptions;
  for (auto const& key : known_key_table()) {
    std::string const range = key.least == any  ? ""
                              : key.least > 0.0 ? "above 0"
                                                : fmt::format("at least {:g}", key.least);
    descriptions.push_back({key.key, "number", key.unit, range, key.otherwise, key.meaning});
  }
  return descriptions;
}

}  // namespace torquescope
