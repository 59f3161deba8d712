#include "engine/data/delimited_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace torquescope {
namespace {

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string_view without_quotes(std::string_view cell) {
  bool const quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

// where the cell that begins at `from` ends; separators inside quotes do not count, nor those of a list: [0.1, 0.2]
std::size_t end_of_cell(std::string_view line, std::size_t from, char separator) {
  bool in_quotes = false;
  std::size_t const first = std::min(line.find_first_not_of(' ', from), line.size());
  std::size_t const end_of_list = first < line.size() && line[first] == '[' ? line.find(']', first) : first;
  for (std::size_t i = end_of_list == std::string_view::npos ? from : end_of_list; i < line.size(); ++i) {
    if (line[i] == '"') in_quotes = !in_quotes;
    bool const separates = separator == blanks ? line[i] == ' ' || line[i] == '\t' : line[i] == separator;
    if (separates && !in_quotes) return i;
  }
  return line.size();
}

// 1e-400 is as good as zero; 1e400 is not a number anyone can have measured
double beyond_double(std::string_view digits) {
  bool const tiny = digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
  return tiny ? 0.0 : std::numeric_limits<double>::infinity();
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// words that stand for a number; those of the C library of Microsoft have as many digits as were asked for
CellKind read_word(std::string_view word, double& value) {
  static constexpr std::array<std::string_view, 14> missing{"na",  "n/a",  "#n/a", "<na>", "null", "none", "nan",
                                                            "nat", "#nan", "#nv",  "-",    "--",   "---",  "n.a."};
  constexpr std::size_t longest = 12;
  if (word.size() > longest) return CellKind::text;
  std::array<char, longest> letters{};
  std::transform(word.begin(), word.end(), letters.begin(),
                 [](char letter) { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter; });
  std::string_view const lower(letters.data(), word.size());
  if (std::find(missing.begin(), missing.end(), lower) != missing.end()) return CellKind::missing;
  bool const negative = lower.front() == '-';
  std::string_view const rest = lower.substr(negative ? 1 : 0);
  if (rest.starts_with("1.#ind") || rest.starts_with("1.#qnan") || rest.starts_with("1.#snan"))
    return CellKind::missing;
  if (!rest.starts_with("1.#inf")) return CellKind::text;
  value = negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  return CellKind::number;
}

}  // namespace

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  auto const end = rest_.find_first_of("\r\n");
  line = rest_.substr(0, end);
  std::size_t used = end == std::string_view::npos ? rest_.size() : end + 1;
  if (end != std::string_view::npos && rest_[end] == '\r' && used < rest_.size() && rest_[used] == '\n') ++used;
  line_ended_ = end != std::string_view::npos;
  rest_.remove_prefix(used);
  ++line_number_;
  return true;
}

bool LineReader::at_end() const { return rest_.find_first_not_of(" \t\r\n") == std::string_view::npos; }

char separator_of(std::string_view header) {
  std::array<char, 3> const candidates{',', ';', '\t'};
  std::array<std::size_t, 3> counts{};
  bool in_quotes = false;
  for (char letter : header) {
    if (letter == '"') in_quotes = !in_quotes;
    for (std::size_t k = 0; k < candidates.size() && !in_quotes; ++k)
      if (letter == candidates[k]) ++counts[k];
  }
  auto const most = std::max_element(counts.begin(), counts.end());
  return *most == 0 ? blanks : candidates[static_cast<std::size_t>(most - counts.begin())];
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  if (separator == blanks) line = trimmed(line);
  for (std::size_t from = 0; from <= line.size();) {
    std::size_t const end = end_of_cell(line, from, separator);
    cells.push_back(trimmed(line.substr(from, end - from)));
    from = end + 1;
    if (separator == blanks) from = std::min(line.find_first_not_of(" \t", end), line.size() + 1);
  }
}

std::string unquoted(std::string_view cell) {
  std::string name;
  for (char letter : without_quotes(cell)) {
    bool const second_of_pair = letter == '"' && !name.empty() && name.back() == '"';
    if (!second_of_pair) name.push_back(letter);
  }
  return name;
}

CellKind read_cell(std::string_view cell, double& value) {
  value = no_number;
  std::string_view digits = without_quotes(cell);
  if (digits.empty()) return CellKind::missing;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double number = 0.0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return read_word(digits, value);
  value = error == std::errc::result_out_of_range ? beyond_double(digits) : number;
  return value != value ? CellKind::missing : CellKind::number;
}

CellKind read_comma_cell(std::string_view cell, double& value) {
  value = no_number;
  std::array<char, 40> digits{};
  std::string_view const given = without_quotes(cell);
  auto const comma = given.find(',');
  bool const one_mark =
      comma != std::string_view::npos && given.find_first_of(",.", comma + 1) == std::string_view::npos;
  if (!one_mark || given.size() > digits.size() || given.find('.') < comma) return CellKind::text;
  std::copy(given.begin(), given.end(), digits.begin());
  digits[comma] = '.';
  return read_cell({digits.data(), given.size()}, value);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char letter) { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32) : letter; });
  return lower;
}

std::string shown(std::string_view cell) {
  constexpr std::size_t most_letters = 40;
  std::string text;
  for (char letter : cell.substr(0, most_letters))
    text.push_back(static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? '?' : letter);
  return cell.size() > most_letters ? text + "..." : text;
}

}  // namespace torquescope
