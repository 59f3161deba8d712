#include "engine/experiment/file_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"

namespace torquescope {
namespace {

enum class PieceKind { letter, one, any, named };

// a part of a pattern: a letter as it stands, '?', '*' or {name}
struct PatternPiece {
  PieceKind kind = PieceKind::letter;
  char letter = '\0';
  std::string name{};
};

std::vector<PatternPiece> pieces_of(std::string const& pattern) {
  std::vector<PatternPiece> pieces;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::size_t const end = pattern[i] == '{' ? pattern.find('}', i) : std::string::npos;
    if (end != std::string::npos) {
      pieces.push_back({PieceKind::named, '\0', pattern.substr(i + 1, end - i - 1)});
      i = end;
    } else if (pattern[i] == '*') {
      if (pieces.empty() || pieces.back().kind != PieceKind::any) pieces.push_back({PieceKind::any});
    } else if (pattern[i] == '?') {
      pieces.push_back({PieceKind::one});
    } else {
      pieces.push_back({PieceKind::letter, pattern[i]});
    }
  }
  return pieces;
}

bool is_open(PieceKind kind) { return kind == PieceKind::any || kind == PieceKind::named; }

// the shortest match of every open piece, from the left; a place that failed once is never tried again
class NameMatcher {
 public:
  NameMatcher(std::vector<PatternPiece> const& pieces, std::string const& name)
      : pieces_(pieces),
        name_(name),
        end_of_piece_(pieces.size(), 0),
        has_failed_((pieces.size() + 1) * (name.size() + 1), false) {}

  bool matches(std::size_t piece = 0, std::size_t from = 0) {
    if (piece == pieces_.size()) return from == name_.size();
    std::size_t const place = piece * (name_.size() + 1) + from;
    if (has_failed_[place]) return false;
    auto const& one = pieces_[piece];
    std::size_t least = from + (one.kind == PieceKind::any ? 0 : 1), most = is_open(one.kind) ? name_.size() : from + 1;
    if (one.kind == PieceKind::letter && (from >= name_.size() || name_[from] != one.letter)) most = 0;
    for (std::size_t end = least; end <= std::min(most, name_.size()); ++end) {
      end_of_piece_[piece] = end;
      if (matches(piece + 1, end)) return true;
    }
    has_failed_[place] = true;
    return false;
  }

  // Requires   matches() was true
  std::map<std::string, std::string> texts() const {
    std::map<std::string, std::string> found;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      std::size_t const from = k == 0 ? 0 : end_of_piece_[k - 1];
      if (pieces_[k].kind == PieceKind::named) found[pieces_[k].name] = name_.substr(from, end_of_piece_[k] - from);
    }
    return found;
  }

 private:
  std::vector<PatternPiece> const& pieces_;
  std::string const& name_;
  std::vector<std::size_t> end_of_piece_;
  std::vector<bool> has_failed_;
};

std::vector<std::string> parts_of(std::string const& pattern) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= pattern.size()) {
    std::size_t const end = std::min(pattern.find('/', begin), pattern.size());
    parts.push_back(pattern.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool is_wild(std::string const& part) { return part.find_first_of("{*?") != std::string::npos; }

std::vector<std::string> names_in_folder(std::filesystem::path const& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path folder_or_here(std::filesystem::path const& folder) { return folder.empty() ? "." : folder; }

// goes down the parts of a pattern, folder by folder
class FolderWalk {
 public:
  FolderWalk(std::filesystem::path folder, std::string const& pattern)
      : folder_(std::move(folder)), parts_(parts_of(pattern)) {}

  std::vector<PatternMatch> walk() {
    enter("", {}, 0);
    std::sort(found_.begin(), found_.end(), [](auto const& a, auto const& b) { return a.file < b.file; });
    return std::move(found_);
  }

 private:
  void enter(std::string const& before, std::map<std::string, std::string> const& texts, std::size_t part) {
    if (!is_wild(parts_[part])) return arrive(before + parts_[part], texts, part);
    for (auto const& name : names_in_folder(folder_or_here(folder_ / before))) {
      if (name.front() == '.' && parts_[part].front() != '.') continue;
      auto more = match_name(parts_[part], name);
      if (!more) continue;
      more->insert(texts.begin(), texts.end());
      arrive(before + name, *more, part);
    }
  }

  void arrive(std::string const& file, std::map<std::string, std::string> const& texts, std::size_t part) {
    std::error_code ignored;
    auto const path = folder_ / file;
    if (part + 1 < parts_.size())
      enter(file + "/", texts, part + 1);
    else if (std::filesystem::is_regular_file(path, ignored))
      found_.push_back({file, texts});
  }

  std::filesystem::path folder_;
  std::vector<std::string> parts_;
  std::vector<PatternMatch> found_;
};

bool is_identifier(std::string const& name) {
  auto const is_letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) == 0 &&
         std::all_of(name.begin(), name.end(), is_letter);
}

}  // namespace

std::string fault_of_pattern(std::string const& pattern) {
  if (pattern.empty()) return "it is empty";
  std::set<std::string> names;
  std::size_t after_last = std::string::npos;
  for (std::size_t open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1)) {
    std::size_t const close = pattern.find('}', open);
    if (close == std::string::npos) return "a { is never closed";
    std::string const name = pattern.substr(open + 1, close - open - 1);
    if (!is_identifier(name))
      return fmt::format("{{{}}} is no name: letters, digits and _, a letter first, as {{mass_kg}}", name);
    if (!names.insert(name).second) return fmt::format("{{{}}} stands there twice", name);
    if (open == after_last) return fmt::format("nothing stands before {{{}}} to tell it from the one before", name);
    after_last = close + 1;
  }
  return "";
}

std::vector<std::string> names_in_pattern(std::string const& pattern) {
  std::vector<std::string> names;
  for (auto const& piece : pieces_of(pattern))
    if (piece.kind == PieceKind::named) names.push_back(piece.name);
  return names;
}

std::optional<std::map<std::string, std::string>> match_name(std::string const& pattern, std::string const& name) {
  auto const pieces = pieces_of(pattern);
  NameMatcher matcher(pieces, name);
  if (!matcher.matches()) return {};
  return matcher.texts();
}

std::vector<PatternMatch> files_matching(std::filesystem::path const& folder, std::string const& pattern) {
  return FolderWalk(folder, pattern).walk();
}

std::vector<std::string> what_is_there(std::filesystem::path const& folder, std::string const& pattern) {
  constexpr std::size_t most_shown = 8;
  // the folder that the pattern names in plain letters
  auto const parts = parts_of(pattern);
  std::filesystem::path reached = folder;
  std::string plain;
  for (std::size_t k = 0; k + 1 < parts.size() && !is_wild(parts[k]); ++k) plain += parts[k] + "/";
  reached = folder_or_here(reached / plain);
  std::error_code ignored;
  if (!std::filesystem::is_directory(reached, ignored)) return {fmt::format("there is no folder {}", reached.string())};
  std::vector<std::string> names = names_in_folder(reached);
  std::erase_if(names, [](std::string const& name) { return name.front() == '.'; });
  if (names.empty()) return {fmt::format("the folder {} is empty", reached.string())};
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), most_shown); ++k) text += (k == 0 ? "" : ", ") + names[k];
  if (names.size() > most_shown) text += fmt::format(" and {} more", names.size() - most_shown);
  std::vector<std::string> facts{fmt::format("{} has: {}", reached.string(), text)};
  std::string const last = parts.back();
  std::string const packed = last.ends_with(".gz") ? last.substr(0, last.size() - 3) : last + ".gz";
  std::string const other = pattern.substr(0, pattern.size() - last.size()) + packed;
  if (auto const n = files_matching(folder, other).size(); n > 0)
    facts.push_back(fmt::format("\"{}\" matches {} file{}", other, n, n == 1 ? "" : "s"));
  return facts;
}

}  // namespace torquescope
