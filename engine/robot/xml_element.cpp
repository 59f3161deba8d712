#include "engine/robot/xml_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace torquescope {

namespace {

constexpr std::size_t deepest = 64;  // a URDF needs 6, a humanoid in MJCF 20
constexpr char const* blanks = " \t\r\n";

bool is_name_character(char c) {
  return std::string_view("<>/=\"' \t\r\n&?!").find(c) == std::string_view::npos && c != '\0';
}

void put_character(unsigned long number, std::string& text) {
  auto const byte = [&](unsigned long value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
  if (number < 0x80) {
    byte(number);
  } else if (number < 0x800) {
    byte(0xc0 | (number >> 6));
    byte(0x80 | (number & 0x3f));
  } else {
    byte(0xe0 | ((number >> 12) & 0x0f));
    byte(0x80 | ((number >> 6) & 0x3f));
    byte(0x80 | (number & 0x3f));
  }
}

// what an entity such as "amp" or "#233" stands for is added to the text; false: nobody knows it
bool put_entity(std::string_view entity, std::string& text) {
  constexpr std::pair<std::string_view, char> named[] = {
      {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
  for (auto const& [name, character] : named)
    if (entity == name) {
      text += character;
      return true;
    }
  if (!entity.starts_with('#')) return false;
  bool const is_hex = entity.size() > 1 && entity[1] == 'x';
  auto const digits = entity.substr(is_hex ? 2 : 1);
  unsigned long number = 0;
  auto const [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number, is_hex ? 16 : 10);
  if (failure != std::errc() || end != digits.data() + digits.size() || number == 0 || number > 0xffff) return false;
  put_character(number, text);
  return true;
}

class XmlReader {
 public:
  XmlReader(std::shared_ptr<RobotText const> const& text, std::string const& kind)
      : file_(text), text_(text->text), kind_(kind) {}

  XmlElement read() {
    std::vector<XmlElement> open;
    while (true) {
      pass_to_tag(open.empty());
      if (text_.compare(at_, 2, "</") == 0) {
        if (open.empty()) refuse(at_, 2, "a tag is closed that nobody opened");
        close(open.back());
        XmlElement done = std::move(open.back());
        open.pop_back();
        if (open.empty()) return done;
        open.back().children.push_back(std::move(done));
        continue;
      }
      if (open.size() >= deepest) refuse(at_, 1, fmt::format("nested deeper than {} levels", deepest));
      bool is_whole = false;
      XmlElement element = opening(is_whole);
      if (!is_whole) {
        open.push_back(std::move(element));
      } else if (open.empty()) {
        return element;
      } else {
        open.back().children.push_back(std::move(element));
      }
    }
  }

 private:
  [[noreturn]] void refuse(std::size_t at, std::size_t length, std::string const& what) const {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.what = fmt::format("this is no {}: {}", kind_, what);
    problem.place = file_->place(at, length);
    problem.help = "mend it there, or write the file out anew; editors of XML show the same place";
    throw Error(std::move(problem));
  }

  // past `end`, which must come
  void pass(std::size_t from, std::string_view end, char const* what) {
    auto const found = text_.find(end, from);
    if (found == std::string::npos) refuse(at_, 1, fmt::format("{} does not end", what));
    at_ = found + end.size();
  }

  // to the next tag of an element; what stands between is nobody's
  void pass_to_tag(bool is_outside) {
    while (true) {
      at_ = text_.find('<', at_);
      if (at_ == std::string::npos) {
        at_ = text_.size();
        refuse(at_, 1, is_outside ? "it has no element" : "it ends before its elements are closed");
      }
      if (text_.compare(at_, 4, "<!--") == 0) {
        pass(at_ + 4, "-->", "a comment");
      } else if (text_.compare(at_, 9, "<![CDATA[") == 0) {
        pass(at_ + 9, "]]>", "a CDATA section");
      } else if (text_.compare(at_, 2, "<?") == 0) {
        pass(at_ + 2, "?>", "a processing instruction");
      } else if (text_.compare(at_, 2, "<!") == 0) {
        pass(at_ + 2, ">", "a declaration");
      } else {
        return;
      }
    }
  }

  void close(XmlElement const& element) {
    std::size_t const begin = at_;
    at_ += 2;
    auto const name = word();
    if (name != element.name)
      refuse(begin, name.size() + 3,
             fmt::format("</{}> closes <{}> of line {}", name, element.name, element.place().line));
    pass_blanks();
    if (at_ >= text_.size() || text_[at_] != '>') refuse(begin, at_ - begin, "a closing tag does not end");
    ++at_;
  }

  XmlElement opening(bool& is_whole) {
    XmlElement element;
    element.text = file_;
    element.at = at_++;
    element.name = word();
    if (element.name.empty()) refuse(element.at, 1, "\"<\" begins no tag; in a value write &lt;");
    while (true) {
      bool const apart = pass_blanks();
      if (at_ >= text_.size()) refuse(element.at, 1, fmt::format("<{}> does not end", element.name));
      is_whole = text_.compare(at_, 2, "/>") == 0;
      if (is_whole || text_[at_] == '>') break;
      if (!apart) refuse(at_, 1, fmt::format("<{}> has something that is no attribute", element.name));
      element.attributes.push_back(attribute(element));
    }
    at_ += is_whole ? 2 : 1;
    element.length = at_ - element.at;
    return element;
  }

  XmlAttribute attribute(XmlElement const& element) {
    XmlAttribute one;
    one.at = at_;
    one.name = word();
    if (one.name.empty()) refuse(at_, 1, fmt::format("<{}> has something that is no attribute", element.name));
    if (element.find(one.name) != nullptr)
      refuse(one.at, one.name.size(), fmt::format("<{}> has the attribute {} twice", element.name, one.name));
    pass_blanks();
    if (at_ >= text_.size() || text_[at_] != '=')
      refuse(one.at, one.name.size(), fmt::format("the attribute {} has no value", one.name));
    ++at_;
    pass_blanks();
    char const quote = at_ < text_.size() ? text_[at_] : ' ';
    auto const end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string::npos;
    if (end == std::string::npos)
      refuse(one.at, one.name.size(), fmt::format("the value of {} is not in quotes", one.name));
    one.value = plain(at_ + 1, end);
    at_ = end + 1;
    return one;
  }

  // with entities resolved
  std::string plain(std::size_t from, std::size_t end) const {
    std::string value;
    for (std::size_t k = from; k < end; ++k) {
      if (text_[k] == '<') refuse(k, 1, "a value holds \"<\"; is a quotation mark missing before?");
      if (text_[k] != '&') {
        value += text_[k];
        continue;
      }
      auto const stop = text_.find(';', k);
      // names of files have it as it stands, and other readers bear that
      bool const is_entity = stop < end && put_entity(std::string_view(text_).substr(k + 1, stop - k - 1), value);
      if (is_entity)
        k = stop;
      else
        value += '&';
    }
    return value;
  }

  std::string word() {
    std::size_t const begin = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool pass_blanks() {
    std::size_t const begin = at_;
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    return at_ > begin;
  }

  std::shared_ptr<RobotText const> file_;
  std::string const& text_;
  std::string kind_;
  std::size_t at_ = 0;
};

}  // namespace

std::string const* XmlElement::find(std::string_view attribute) const {
  auto const found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](XmlAttribute const& one) { return one.name == attribute; });
  return found == attributes.end() ? nullptr : &found->value;
}

XmlElement const* XmlElement::child(std::string_view wanted) const {
  auto const found =
      std::find_if(children.begin(), children.end(), [&](XmlElement const& one) { return one.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

SourcePlace XmlElement::place() const { return text ? text->place(at, length) : SourcePlace{}; }

SourcePlace XmlElement::place_of(std::string_view attribute) const {
  for (auto const& one : attributes)
    if (one.name == attribute) return text->place(one.at, one.name.size());
  return place();
}

XmlElement read_xml(std::shared_ptr<RobotText const> const& text, std::string const& kind) {
  return XmlReader(text, kind).read();
}

std::string outermost_element(RobotText const& text) {
  auto const& all = text.text;
  auto at = all.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  while (at != std::string::npos && at < all.size() && all[at] == '<') {
    bool const is_comment = all.compare(at, 4, "<!--") == 0;
    bool const is_beside = all.compare(at, 2, "<?") == 0 || all.compare(at, 2, "<!") == 0;
    if (!is_beside) {
      auto const end =
          std::find_if_not(all.begin() + static_cast<std::ptrdiff_t>(at) + 1, all.end(), is_name_character);
      return {all.begin() + static_cast<std::ptrdiff_t>(at) + 1, end};
    }
    auto const end = all.find(is_comment ? "-->" : ">", at);
    if (end == std::string::npos) return {};
    at = all.find_first_not_of(blanks, end + (is_comment ? 3 : 1));
  }
  return {};
}

}  // namespace torquescope
