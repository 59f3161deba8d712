#include "engine/job/job_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/job/job_nesting.hpp"

#define TOML_EXCEPTIONS 0
#define TOML_UNRELEASED_FEATURES 0
#define TOML_MAX_NESTED_VALUES 64  // above our own bound: first_too_deep() speaks first
// "[!" disproves what the parser asserts before it checks it: that must neither end a debug build nor, as an assumption
// (clang with NDEBUG), take the check away
#define TOML_ASSERT(condition) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace torquescope {

namespace {

constexpr int deepest_nesting = 32;
constexpr std::string_view map_key = "columns";

std::vector<std::string> split_lines(std::string const& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    std::size_t const end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
    begin = end + 1;
  }
  return lines;
}

std::string type_word(toml::node const& node) {
  if (node.is_string()) return "texts";
  if (node.is_integer() || node.is_floating_point()) return "numbers";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "lists";
  if (node.is_table()) return "tables";
  return "dates";
}

// walks the parsed tables once and turns them into sections; problems are collected with their places
class SectionReader {
 public:
  SectionReader(std::string const& text, std::string const& file) : file_(file), lines_(split_lines(text)) {}

  std::vector<Section> read(toml::table const& root) {
    for (auto const& [key, node] : root) {
      if (auto const* table = node.as_table()) {
        read_section(std::string(key.str()), *table, place(key.source()));
      } else if (node.is_array_of_tables() && !node.as_array()->empty()) {
        read_section_list(std::string(key.str()), *node.as_array());
      } else {
        refuse_loose_key(key);
      }
    }
    if (!problems_.empty()) {
      std::sort(problems_.begin(), problems_.end(),
                [](Problem const& a, Problem const& b) { return order(a) < order(b); });
      throw Error(std::move(problems_));
    }
    std::stable_sort(sections_.begin(), sections_.end(), [](Section const& a, Section const& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    return std::move(sections_);
  }

  SourcePlace place(toml::source_region const& region) const {
    SourcePlace place = at(static_cast<int>(region.begin.line), static_cast<int>(region.begin.column));
    bool const one_line = region.begin.line == region.end.line;
    place.length = one_line ? static_cast<int>(region.end.column) - place.column : 1;
    return place;
  }

  SourcePlace at(int line, int column) const {
    SourcePlace place{file_, line, column, 1, ""};
    if (line >= 1 && static_cast<std::size_t>(line) <= lines_.size())
      place.line_text = lines_[static_cast<std::size_t>(line) - 1];
    return place;
  }

 private:
  static std::tuple<int, int> order(Problem const& problem) { return {problem.place.line, problem.place.column}; }

  // key: where the name stands, for tables written without a header of their own
  void read_section(std::string const& name, toml::table const& table, SourcePlace const& key) {
    // [model.bounds] alone makes an empty "model" at the same place: the outer one comes first
    std::size_t const index = sections_.size();
    sections_.push_back({name, table.is_inline() ? key : place(table.source()), {}});
    std::vector<Setting> settings;
    for (auto const& [inner_key, node] : table) {
      std::string const inner_name(inner_key.str());
      auto const* inner = node.as_table();
      if (inner && inner_name != map_key) {
        read_section(name + "." + inner_name, *inner, place(inner_key.source()));
      } else if (node.is_array_of_tables() && !node.as_array()->empty()) {
        read_section_list(name + "." + inner_name, *node.as_array());
      } else if (auto value = read_value(name + "." + inner_name, node)) {
        SourcePlace const key_place = place(inner_key.source());
        // a table with a header spans many lines: point at its name
        settings.push_back({inner_name, std::move(*value), key_place,
                            inner && !inner->is_inline() ? key_place : place(node.source())});
      }
    }
    std::sort(settings.begin(), settings.end(), [](Setting const& a, Setting const& b) {
      return std::tie(a.key_place.line, a.key_place.column) < std::tie(b.key_place.line, b.key_place.column);
    });
    sections_[index].settings = std::move(settings);
  }

  void read_section_list(std::string const& name, toml::array const& tables) {
    if (name == "estimator") {
      for (auto const& table : tables) read_section(name, *table.as_table(), place(table.source()));
      return;
    }
    Problem problem;
    problem.what = fmt::format("[[{}]] is written as a list, but there is only one", name);
    problem.place = place(tables.front().source());
    problem.key = name;
    problem.help = fmt::format("write [{}]; only [[estimator]] may be repeated", name);
    problems_.push_back(problem);
  }

  void refuse_loose_key(toml::key const& key) {
    Problem problem;
    problem.what = fmt::format("\"{}\" stands outside of any section", key.str());
    problem.place = place(key.source());
    problem.key = std::string(key.str());
    problem.help = "put it below the [section] it belongs to      (torquescope describe experiment)";
    problems_.push_back(problem);
  }

  std::optional<OptionValue> refuse(std::string const& key, toml::node const& node, std::string what,
                                    std::string help) {
    Problem problem;
    problem.what = std::move(what);
    problem.place = place(node.source());
    problem.key = key;
    problem.help = std::move(help);
    problems_.push_back(std::move(problem));
    return std::nullopt;
  }

  std::optional<OptionValue> read_value(std::string const& key, toml::node const& node) {
    if (auto const* text = node.as_string()) return OptionValue(text->get());
    if (auto const* truth = node.as_boolean()) return OptionValue(truth->get());
    if (auto const* whole = node.as_integer()) return OptionValue(std::int64_t{whole->get()});
    if (auto const* number = node.as_floating_point()) {
      if (std::isfinite(number->get())) return OptionValue(number->get());
      return refuse(key, node, fmt::format("{} = {} is not a finite number", key, number->get()),
                    "write a finite number");
    }
    if (auto const* list = node.as_array()) return read_list(key, *list);
    if (auto const* map = node.as_table()) return read_map(key, *map);
    return refuse(key, node, fmt::format("{} is a date or a time, and no option takes one", key),
                  "put it in quotes if it is a text");
  }

  std::optional<OptionValue> read_list(std::string const& key, toml::array const& list) {
    if (list.empty()) return OptionValue(std::vector<std::string>{});
    std::string const first = type_word(list.front());
    for (auto const& item : list)
      if (type_word(item) != first)
        return refuse(key, item, fmt::format("{} mixes {} and {}", key, first, type_word(item)),
                      "write a list of numbers or a list of texts in quotes");
    if (first == "texts") {
      std::vector<std::string> texts;
      for (auto const& item : list) texts.push_back(item.as_string()->get());
      return OptionValue(std::move(texts));
    }
    if (first != "numbers")
      return refuse(key, list, fmt::format("{} is a list of {}", key, first),
                    "lists hold numbers, or texts in quotes, and nothing else");
    std::vector<double> numbers;
    for (auto const& item : list) {
      numbers.push_back(*item.value<double>());
      if (!std::isfinite(numbers.back()))
        return refuse(key, item, fmt::format("{} holds {}, which is not a finite number", key, numbers.back()),
                      "write finite numbers");
    }
    return OptionValue(std::move(numbers));
  }

  std::optional<OptionValue> read_map(std::string const& key, toml::table const& table) {
    std::map<std::string, std::string> map;
    for (auto const& [name, node] : table) {
      auto const* text = node.as_string();
      if (!text)
        return refuse(key + "." + std::string(name.str()), node, fmt::format("{}.{} is not a text", key, name.str()),
                      fmt::format("write the column's name in quotes: {} = \"...\"", name.str()));
      map[std::string(name.str())] = text->get();
    }
    return OptionValue(std::move(map));
  }

  std::string file_;
  std::vector<std::string> lines_;
  std::vector<Section> sections_;
  std::vector<Problem> problems_;
};

// toml++: "Error while parsing boolean: expected 'false', saw 'fo'"; for us: "expected 'false', saw 'fo'"
std::string plain_words(std::string text) {
  if (text.starts_with("Error while parsing ")) {
    std::size_t const colon = text.find(": ");
    if (colon != std::string::npos) text = text.substr(colon + 2);
  }
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// the first quoted piece of a message: "cannot redefine existing integer 'seed'"; "" when nothing is quoted
std::string quoted_piece(std::string const& words) {
  std::size_t const begin = words.find('\'');
  std::size_t const end = words.find('\'', begin + 1);
  return end == std::string::npos ? "" : words.substr(begin + 1, end - begin - 1);
}

std::string syntax_help(std::string const& message) {
  if (message.find("boolean") != std::string::npos)
    return "texts stand in quotes: key = \"text\"; true and false do not";
  if (message.find("utf-8") != std::string::npos) return "save the job file as UTF-8";
  if (message.find("64 bits") != std::string::npos) return "write a number that fits, or one with an exponent: 1e20";
  if (message.find("table header") != std::string::npos || message.find("bare key") != std::string::npos)
    return "a section is written [filter], an estimator [[estimator]]";
  if (message.find("string") != std::string::npos) return "close the quote on the same line";
  return "a job is TOML: key = 1.5, key = \"text\", key = [1, 2], [section]";
}

// the parser stops behind what it complains about: underline that instead, where the line has it
void point_at(std::string const& piece, SourcePlace& place) {
  std::size_t const found = piece.empty() ? std::string::npos : place.line_text.find(piece);
  if (found == std::string::npos) return;
  auto const letters = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; };
  place.column =
      1 + static_cast<int>(std::count_if(place.line_text.begin(),
                                         place.line_text.begin() + static_cast<std::ptrdiff_t>(found), letters));
  place.length = static_cast<int>(std::count_if(piece.begin(), piece.end(), letters));
}

Problem syntax_problem(toml::parse_error const& error, SectionReader const& reader) {
  std::string const message(error.description());
  std::string const words = plain_words(message);
  Problem problem;
  problem.place = reader.at(static_cast<int>(error.source().begin.line), static_cast<int>(error.source().begin.column));
  std::string const piece = quoted_piece(words);
  if (words.starts_with("cannot redefine existing ") && !piece.empty()) {
    problem.what = fmt::format("\"{}\" is written twice", piece);
    problem.help = "keep one of the two";
    point_at(piece.substr(piece.rfind('.') + 1), problem.place);
    return problem;
  }
  problem.what = "this is not TOML: " + words;
  problem.help = syntax_help(message);
  bool const is_number = words.find("be interpreted") != words.npos || words.find("representable") != words.npos;
  if (is_number) point_at(piece, problem.place);
  return problem;
}

Problem nesting_problem(std::string const& text, std::size_t offset, SectionReader const& reader) {
  std::size_t const line_begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 == 0
  int const line =
      1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
  Problem problem;
  problem.what = fmt::format("nested deeper than {} levels", deepest_nesting);
  problem.place = reader.at(line, static_cast<int>(offset - line_begin) + 1);
  problem.help = "no option needs more than 3 levels";
  return problem;
}

}  // namespace

std::vector<Section> parse_sections(std::string const& text, std::string const& file) {
  SectionReader reader(text, file);
  if (auto const offset = first_too_deep(text, deepest_nesting)) throw Error(nesting_problem(text, *offset, reader));
  toml::parse_result const result = toml::parse(text, file);
  if (!result) throw Error(syntax_problem(result.error(), reader));
  return reader.read(result.table());
}

}  // namespace torquescope
