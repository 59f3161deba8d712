#include "engine/workflows/drafts/name_parts.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "engine/experiment/known_product.hpp"
#include "engine/workflows/drafts/name_fields.hpp"
#include "engine/workflows/drafts/name_pattern.hpp"
#include "engine/workflows/drafts/name_quantity.hpp"

namespace torquescope {
namespace {

using Fields = std::vector<NameField>;

std::vector<double> numbers_of(std::vector<std::string> const& texts) {
  std::vector<double> numbers;
  for (auto const& text : texts) {
    double number = 0.0;
    read_number(text, number);
    numbers.push_back(number);
  }
  return numbers;
}

template <class Value>
bool all_same(std::vector<Value> const& values) {
  return std::all_of(values.begin(), values.end(), [&](Value const& value) { return value == values.front(); });
}

// from the fields of all names to parts, from the left
class PartsBuilder {
 public:
  // bare: numbers without letters or a unit are apart from the words beside them
  PartsBuilder(std::vector<Fields> names, bool bare) : names_(std::move(names)), bare_(bare) {
    made_.values.resize(names_.size());
  }

  // false: the names do not fit together
  bool build() {
    auto const keys = common_keys(names_);
    count_known_numbers(keys);
    std::vector<std::size_t> from(names_.size(), 0);
    for (auto const& key : keys) {
      std::vector<std::size_t> at;
      for (auto const& fields : names_) {
        auto const is_it = [&](NameField const& field) { return field.key() == key; };
        at.push_back(static_cast<std::size_t>(std::find_if(fields.begin(), fields.end(), is_it) - fields.begin()));
      }
      add_between(from, at);
      add_column(at);
      for (std::size_t k = 0; k < at.size(); ++k) from[k] = at[k] + 1;
    }
    std::vector<std::size_t> ends;
    for (auto const& fields : names_) ends.push_back(fields.size());
    add_between(from, ends);
    name_quantities();
    return fits_;
  }

  NameParts take() { return std::move(made_); }
  void add_text(std::string const& text) {
    if (text.empty()) return;
    if (!made_.parts.empty() && made_.parts.back().is_text)
      made_.parts.back().text += text;
    else
      made_.parts.push_back({text, {}, true});
  }

 private:
  using Places = std::vector<std::size_t>;

  std::vector<NameField const*> column(Places const& at) const {
    std::vector<NameField const*> fields;
    for (std::size_t k = 0; k < names_.size(); ++k) fields.push_back(&names_[k][at[k]]);
    return fields;
  }

  template <class Member>
  std::vector<std::string> texts(Places const& at, Member member) const {
    std::vector<std::string> list;
    for (auto const* field : column(at)) list.push_back(field->*member);
    return list;
  }

  bool are_numbers(Places const& at) const {
    auto const fields = column(at);
    return std::all_of(fields.begin(), fields.end(), [&](NameField const* field) {
      return field->kind == FieldKind::number && field->prefix == fields.front()->prefix &&
             field->unit == fields.front()->unit;
    });
  }

  bool are_dates(Places const& at) const {
    auto const fields = column(at);
    return std::all_of(fields.begin(), fields.end(),
                       [](NameField const* field) { return field->kind == FieldKind::date; });
  }

  void count_known_numbers(std::vector<std::string> const& keys) {
    for (auto const& key : keys) {
      std::vector<std::string> values;
      NameField const* one = nullptr;
      for (auto const& fields : names_)
        for (auto const& field : fields)
          if (field.key() == key) {
            one = &field;
            values.push_back(field.number);
          }
      if (one->kind == FieldKind::number)
        n_known_ += !quantity_of_number(one->prefix, one->unit, numbers_of(values)).empty();
    }
  }

  // what separates; where it differs, no pattern can be had
  void add_separator(Places const& at) {
    auto const separators = texts(at, &NameField::separator);
    fits_ = fits_ && all_same(separators);
    add_text(separators.front());
  }

  // `name`: "" where it gets one at the end
  void add_quantity(std::string const& name, bool is_number, std::string const& written,
                    std::vector<std::string> const& values) {
    bool const is_new = name.empty() || used_.insert(name).second;
    std::string const id = std::to_string(made_.quantities.size());
    made_.parts.push_back({{}, id, false});
    made_.quantities.push_back({is_new ? name : "", written, is_number, !is_new || name.empty()});
    for (std::size_t k = 0; k < values.size(); ++k) made_.values[k][id] = values[k];
  }

  // motion is the word with the most values, of two that have as many the last; letters in their order
  void name_quantities() {
    std::size_t most = 0, motion = made_.quantities.size();
    for (std::size_t i = 0; i < made_.quantities.size(); ++i) {
      std::set<std::string> values;
      for (auto const& texts : made_.values) values.insert(texts.at(std::to_string(i)));
      if (made_.quantities[i].is_number || values.size() < most) continue;
      most = values.size();
      motion = i;
    }
    char letter = 'a';
    for (std::size_t i = 0; i < made_.quantities.size(); ++i) {
      auto& quantity = made_.quantities[i];
      quantity.is_a_guess = quantity.is_a_guess && i != motion;
      if (i == motion) quantity.name = "motion";
      if (quantity.is_a_guess) quantity.name = std::string(1, letter++);
      fits_ = fits_ && letter <= 'z';
    }
    auto const name = [&](std::string const& id) { return made_.quantities[std::stoul(id)].name; };
    for (auto& part : made_.parts)
      if (!part.quantity.empty()) part.quantity = name(part.quantity);
    for (auto& texts : made_.values) {
      std::map<std::string, std::string> named;
      for (auto const& [id, text] : texts) named[name(id)] = text;
      texts = std::move(named);
    }
  }

  // one field of each name
  void add_column(Places const& at) {
    add_separator(at);
    auto const whole = texts(at, &NameField::text);
    auto const first = column(at).front();
    bool const differ = !all_same(whole);
    if (are_numbers(at)) {
      auto const numbers = texts(at, &NameField::number);
      std::string const name = quantity_of_number(first->prefix, first->unit, numbers_of(numbers));
      if (!differ && (name.empty() || n_known_ < 2)) return add_text(whole.front());
      add_text(first->prefix);
      add_quantity(name, true, first->text, numbers);
      return add_text(first->unit);
    }
    if (!differ) return add_text(whole.front());
    if (are_dates(at)) return add_date(whole);
    add_quantity("", false, first->text, whole);
  }

  // any letters; as many as there are where the words beside it could be taken for a part of it
  void add_date(std::vector<std::string> const& dates) {
    std::vector<std::string> shapes = dates;
    for (auto& shape : shapes)
      for (char& letter : shape)
        if (std::isdigit(static_cast<unsigned char>(letter)) != 0) letter = '?';
    bool const is_one_word = shapes.front().find_first_of("-_. ") == std::string::npos;
    made_.parts.push_back({all_same(shapes) && !is_one_word ? shapes.front() : "*", {}, false});
  }

  // words from `from` to before `to`, as they stand
  void add_words(Places const& from, Places const& to) {
    add_separator(from);
    std::vector<std::string> values;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      std::string text;
      for (std::size_t i = from[k]; i < to[k]; ++i)
        text += (i == from[k] ? "" : names_[k][i].separator) + names_[k][i].text;
      fits_ = fits_ && !text.empty();
      values.push_back(std::move(text));
    }
    add_quantity("", false, values.front(), values);
  }

  bool is_like(Places const& at) const {
    return all_same(texts(at, &NameField::separator)) &&
           (all_same(texts(at, &NameField::text)) || (bare_ && are_numbers(at)));
  }

  static Places moved(Places places, std::size_t by) {
    for (auto& place : places) place += by;
    return places;
  }

  // fields between two that all names have
  void add_between(Places from, Places to) {
    auto const count = [&](std::size_t k) { return to[k] - from[k]; };
    std::size_t least = count(0);
    for (std::size_t k = 0; k < to.size(); ++k) least = std::min(least, count(k));
    std::size_t n_before = 0, n_behind = 0;
    while (n_before < least && is_like(moved(from, n_before))) ++n_before;
    auto const from_end = [&](std::size_t n) {
      Places places = to;
      for (auto& place : places) place -= n;
      return places;
    };
    while (n_before + n_behind < least && is_like(from_end(n_behind + 1))) ++n_behind;
    for (std::size_t i = 0; i < n_before; ++i) add_column(moved(from, i));
    Places const first = moved(from, n_before), last = from_end(n_behind);
    if (first != last) add_middle(first, last);
    for (std::size_t i = n_behind; i > 0; --i) add_column(from_end(i));
  }

  // begins and ends with what differs: words, unless a number stands among them in every name
  void add_middle(Places const& from, Places const& to) {
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] == to[k]) {
        fits_ = false;
        return;
      }
    bool is_even = true;
    for (std::size_t k = 0; k < from.size(); ++k) is_even = is_even && to[k] - from[k] == to[0] - from[0];
    for (std::size_t i = 0; is_even && i < to[0] - from[0]; ++i) {
      Places const at = moved(from, i);
      bool const splits = (bare_ && are_numbers(at) && !all_same(texts(at, &NameField::text))) || are_dates(at);
      if (!splits || !all_same(texts(at, &NameField::separator))) continue;
      if (i > 0) add_words(from, at);
      add_column(at);
      if (i + 1 < to[0] - from[0]) add_between(moved(at, 1), to);
      return;
    }
    add_words(from, to);
  }

  std::vector<Fields> names_;
  bool bare_;
  NameParts made_{};
  std::set<std::string> used_{};
  int n_known_ = 0;
  bool fits_ = true;
};

}  // namespace

std::optional<NameParts> parts_of_names(std::vector<std::string> const& names) {
  std::vector<Fields> fields;
  std::vector<std::string> endings;
  for (auto const& name : names) {
    std::size_t const end = begin_of_ending(name);
    fields.push_back(fields_of_name(name.substr(0, end)));
    endings.push_back(name.substr(end));
    if (fields.back().empty()) return {};
  }
  if (names.empty() || !all_same(endings)) return {};
  std::optional<NameParts> first;
  for (bool const bare : {true, false}) {
    PartsBuilder builder(fields, bare);
    if (!builder.build()) continue;
    builder.add_text(endings.front());
    NameParts made = builder.take();
    if (gives_back(made, names)) return made;
    if (!first) first = std::move(made);
  }
  return first;
}

}  // namespace torquescope
