#include "engine/data/column_name.hpp"

#include <algorithm>
#include <cctype>

#include "engine/data/compound_word.hpp"
#include "engine/data/plain_spelling.hpp"
#include "engine/data/repeated_names.hpp"

namespace torquescope {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
// bytes beyond ASCII belong to letters: micro, degree
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0; }

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c); });
  return text;
}

// takes "[Inc]" or "(N m)" out of the name when it holds a unit; other brackets stay ("position[0]")
std::string take_bracketed_unit(std::string& name) {
  for (auto const& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    auto const from = name.rfind(open);
    if (from == std::string::npos) continue;
    auto const to = name.find(close, from);
    if (to == std::string::npos) continue;
    std::string unit = name.substr(from + 1, to - from - 1);
    std::erase(unit, ' ');
    if (!known_unit(lowered(unit))) continue;
    name.erase(from, to - from + 1);
    return unit;
  }
  return {};
}

// "Axis2.ActPos" -> Axis, 2, Act, Pos; a known unit stays whole: "mA"
std::vector<std::string> pieces_of(std::string const& name) {
  std::vector<std::string> pieces;
  std::string piece;
  auto const flush = [&] {
    if (piece.empty()) return;
    if (known_unit(lowered(piece))) {
      pieces.push_back(piece);
    } else {
      std::string part;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        if (i > 0 && is_upper(piece[i]) && is_lower(piece[i - 1])) {
          pieces.push_back(part);
          part.clear();
        }
        part.push_back(piece[i]);
      }
      pieces.push_back(part);
    }
    piece.clear();
  };
  for (char c : name) {
    bool const same_sort = !piece.empty() && is_digit(piece.back()) == is_digit(c);
    if (!is_letter(c) && !is_digit(c)) {
      flush();
      if (c == '%' && !pieces.empty()) pieces.emplace_back("%");
      continue;
    }
    if (!same_sort) flush();
    piece.push_back(c);
  }
  flush();
  return pieces;
}

// "theta_m" is the angle of the motor, "q_m" a length
bool is_angle_word(std::string const& word) {
  return word == "theta" || word == "angle" || word == "winkel" || word == "phi";
}

// rad, s -> rad/s at the end of "qd_rad_s"; rad, s, 2 -> rad/s2
void join_rates(std::vector<std::string>& pieces) {
  auto const joined = [&](std::size_t at, std::string const& ending) {
    std::string const base = lowered(pieces[at]);
    if (base != "rad" && base != "deg" && base != "m" && base != "mm") return;
    if (!known_unit(base + ending)) return;
    pieces.resize(at);
    pieces.push_back(base + ending);
  };
  std::size_t const n = pieces.size();
  if (n >= 3 && lowered(pieces[n - 1]) == "s") joined(n - 2, "/s");
  if (n >= 4 && pieces[n - 1] == "2" && lowered(pieces[n - 2]) == "s") joined(n - 3, "/s2");
}

// takes the word that is a unit out of the pieces: never the first, "v" alone is a name
std::string take_unit_word(std::vector<std::string>& pieces) {
  join_rates(pieces);
  for (std::size_t i = pieces.size(); i-- > 1;) {
    std::string const word = lowered(pieces[i]);
    bool const is_last = i + 1 == pieces.size() || (i + 2 == pieces.size() && is_digit(pieces.back().front()));
    if (!known_unit(word) || (word.size() == 1 && !is_last)) continue;
    if (word == "raw" || word == "enc") continue;  // words, and no better units than others in the name
    if (word == "m" && is_angle_word(lowered(pieces.front()))) continue;
    std::string unit = pieces[i];
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
    return unit;
  }
  return {};
}

}  // namespace

namespace {

// two words that say one thing, as data sets for imitation name the position
bool is_observed_state(std::vector<std::string> const& pieces) {
  auto const state = std::find_if(pieces.begin(), pieces.end(), [](auto const& p) { return lowered(p) == "state"; });
  return state != pieces.begin() && state != pieces.end() && lowered(*std::prev(state)) == "observation";
}

// letters that count only behind a quantity: "q_d", "tau_J_d" are desired; "i_q", "u_q" of the axis that makes torque
bool says_letter(std::string const& word, bool is_last, std::vector<ColumnWord>& words) {
  auto const last = std::find_if(words.rbegin(), words.rend(), [](auto const& w) { return is_quantity(w.kind); });
  if (last == words.rend()) return false;
  if (word == "q" && last->kind == WordKind::drive) return true;
  if (word != "d" || !is_last) return false;
  words.push_back({WordKind::commanded, 0});
  return true;
}

}  // namespace

ColumnName parse_column_name(std::string const& name, std::string const& units) {
  ColumnName parsed;
  std::string text = with_plain_brackets(without_repeat(name));
  parsed.unit_text = take_bracketed_unit(text);
  auto pieces = pieces_of(text);
  if (parsed.unit_text.empty()) parsed.unit_text = take_unit_word(pieces);
  parsed.unit = known_unit(lowered(parsed.unit_text));
  if (auto const stated = unit_of_name("", units); stated) {
    parsed.unit = stated;
    parsed.unit_text = stated->word;
  }

  constexpr ColumnWord state{WordKind::position, 60};
  if (is_observed_state(pieces)) parsed.words.push_back(state);
  std::size_t n_words = pieces.size();
  while (n_words > 0 && is_digit(pieces[n_words - 1].front())) --n_words;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (is_digit(pieces[k].front())) {
      parsed.number = pieces[k];
      continue;
    }
    std::string const word = without_accents(lowered(pieces[k]));
    if (says_letter(word, k + 1 == n_words, parsed.words)) continue;
    auto const meaning = column_word(word);
    bool const is_said = meaning && meaning->kind != WordKind::filler;
    auto const all = is_said ? std::vector<ColumnWord>{*meaning} : compound_word(word);
    parsed.words.insert(parsed.words.end(), all.begin(), all.end());
    if (all.empty()) parsed.rest += (parsed.rest.empty() ? "" : " ") + word;
  }
  if (parsed.number.empty()) parsed.number = number_of_repeat(name);
  return parsed;
}

namespace {

// a unit says what the words left open, or said wrongly: "qd_rad" is no speed, "v_mps" no voltage
WordKind quantity_by_unit(ColumnName const& name, WordKind by_words) {
  if (!name.unit) return by_words;
  switch (name.unit->quantity) {
    case Quantity::time:
      return WordKind::time;
    case Quantity::angle:
    case Quantity::length:
      return WordKind::position;
    case Quantity::angular_speed:
    case Quantity::speed:
      return WordKind::velocity;
    case Quantity::acceleration:
      return WordKind::acceleration;
    case Quantity::torque:
    case Quantity::force:
      return WordKind::torque;
    case Quantity::current:  // "i_q_A"; of a word that says nothing as well: the only current of a file
      return by_words == WordKind::torque ? by_words : WordKind::drive;
    case Quantity::voltage:
      return by_words == WordKind::position || by_words == WordKind::velocity ? WordKind::drive : by_words;
    case Quantity::counts:  // "loop_count" counts as well
    case Quantity::ratio:
      return by_words;
  }
  return by_words;
}

}  // namespace

ColumnRole column_role(ColumnName const& name) {
  constexpr int by_unit_alone = 30, unit_fits = 5, measured_helps = 8, doubt = 40, of_raw = 20;
  ColumnRole role;
  bool doubtful = false, raw = false, measured = false, has_other_quantity = false;
  for (auto const& word : name.words) {
    doubtful = doubtful || word.kind == WordKind::doubtful;
    raw = raw || word.kind == WordKind::raw;
    measured = measured || word.kind == WordKind::measured;
    role.commanded = role.commanded || word.kind == WordKind::commanded;
    has_other_quantity = has_other_quantity || is_quantity(word.kind);
    if (is_quantity(word.kind) && word.weight >= role.score) {
      role.quantity = word.kind;
      role.score = word.weight;
    }
  }
  WordKind const by_words = role.quantity;
  role.quantity = quantity_by_unit(name, by_words);
  if (role.quantity == WordKind::velocity && by_words == WordKind::position) role.score -= doubt;
  // "qd_rad": the desired position
  if (role.quantity == WordKind::position && by_words == WordKind::velocity) role.commanded = true;
  if (role.score == 0 && role.quantity != WordKind::doubtful) role.score = by_unit_alone;
  // "goal" alone is the commanded position
  if (role.quantity == WordKind::doubtful && role.commanded && !has_other_quantity) {
    role.quantity = WordKind::position;
    role.score = by_unit_alone;
  }
  if (role.quantity == WordKind::doubtful) return role;
  if (name.unit) role.score += unit_fits;
  if (measured) role.score += measured_helps;
  if (doubtful) role.score -= doubt;
  if (raw) role.score -= of_raw;
  return role;
}

}  // namespace torquescope
