#include "engine/robot/mjcf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "engine/robot/mjcf_orientation.hpp"

namespace torquescope {

namespace {

constexpr int deepest_include = 16;
constexpr char const* outermost_class = "main";

// what MuJoCo calls by several names has one set of defaults
std::string default_name(std::string const& element) {
  constexpr std::array<std::string_view, 9> actuators{"general", "motor",  "position", "velocity", "intvelocity",
                                                      "damper",  "muscle", "adhesion", "cylinder"};
  return std::find(actuators.begin(), actuators.end(), element) != actuators.end() ? "general" : element;
}

bool is_orientation(std::string const& attribute) {
  constexpr std::array<std::string_view, 5> words{"quat", "euler", "axisangle", "xyaxes", "zaxis"};
  return std::find(words.begin(), words.end(), attribute) != words.end();
}

// Requires   attributes of one element
bool has_orientation(std::vector<XmlAttribute> const& attributes) {
  return std::any_of(attributes.begin(), attributes.end(), [](auto const& one) { return is_orientation(one.name); });
}

void add_missing(std::vector<XmlAttribute> const& from, std::vector<XmlAttribute>& to) {
  bool const is_turned = has_orientation(to);
  for (auto const& one : from) {
    bool const is_there = std::any_of(to.begin(), to.end(), [&](auto const& other) { return other.name == one.name; });
    if (!is_there && !(is_turned && is_orientation(one.name))) to.push_back(one);
  }
}

// a name is relative to the first file, or to the one that includes
std::filesystem::path included_path(std::filesystem::path const& first, XmlElement const& include,
                                    std::string const& name) {
  auto const beside_first = first.parent_path() / name;
  auto const beside_this = std::filesystem::path(include.text->file).parent_path() / name;
  return std::filesystem::is_regular_file(beside_first) ? beside_first : beside_this;
}

void resolve_includes(std::filesystem::path const& first, XmlElement& element, int depth) {
  std::vector<XmlElement> children;
  for (auto& child : element.children) {
    if (child.name != "include") {
      resolve_includes(first, child, depth);
      children.push_back(std::move(child));
      continue;
    }
    auto const* const name = child.find("file");
    if (name == nullptr) refuse_mjcf(child.place(), "<include> names no file", "write <include file=\"arm.xml\"/>");
    if (depth >= deepest_include)
      refuse_mjcf(child.place(), "files include one another without end", "take one of these lines out");
    auto const path = included_path(first, child, *name);
    if (!std::filesystem::is_regular_file(path))
      refuse_mjcf(child.place_of("file"), fmt::format("there is no file {}", path.string()),
                  "a name is relative to the first file");
    auto part = read_xml(std::make_shared<RobotText const>(RobotText::read(path)), "MJCF");
    resolve_includes(first, part, depth + 1);
    for (auto& one : part.children) children.push_back(std::move(one));
  }
  element.children = std::move(children);
}

}  // namespace

MjcfDocument::MjcfDocument(RobotText const& text) : root_(read_xml(std::make_shared<RobotText const>(text), "MJCF")) {
  resolve_includes(text.file, root_, 0);
  read_compiler();
  for (auto const* section : sections("default")) read_defaults(*section, "", true);
}

std::vector<XmlElement const*> MjcfDocument::sections(std::string_view name) const {
  std::vector<XmlElement const*> found;
  for (auto const& child : root_.children)
    if (child.name == name) found.push_back(&child);
  return found;
}

void MjcfDocument::read_compiler() {
  constexpr double degree = 0.017453292519943295;
  for (auto const* section : sections("compiler")) {
    compiler_.radians =
        word_of(*section, "angle", {"degree", "radian"}, compiler_.radians == 1.0 ? "radian" : "degree") == "degree"
            ? degree
            : 1.0;
    compiler_.are_ranges_limits = is_true(*section, "autolimits", compiler_.are_ranges_limits);
    if (word_of(*section, "coordinate", {"local", "global"}, "local") == "global")
      refuse_mjcf(section->place_of("coordinate"), "coordinates are global, which MuJoCo gave up in 2.3.4",
                  "have an older MuJoCo write the file anew");
    if (auto const* const sequence = section->find("eulerseq")) {
      bool const is_sequence = sequence->size() == 3 && sequence->find_first_not_of("xyzXYZ") == std::string::npos;
      if (!is_sequence)
        refuse_mjcf(section->place_of("eulerseq"), fmt::format("eulerseq = \"{}\"", *sequence),
                    "write three of x, y, z, X, Y, Z");
      compiler_.euler_sequence = *sequence;
    }
    auto const from_geoms = word_of(*section, "inertiafromgeom", {"auto", "true", "false"}, "auto");
    if (from_geoms != "auto") compiler_.from_geoms = from_geoms == "true" ? GeomInertia::always : GeomInertia::never;
    if (auto const range = numbers_of(*section, "inertiagrouprange", 2, 2)) {
      compiler_.first_group = (*range)[0];
      compiler_.last_group = (*range)[1];
    }
  }
}

void MjcfDocument::read_defaults(XmlElement const& section, std::string const& outer, bool is_outermost) {
  auto const* const written = section.find("class");
  if (written == nullptr && !is_outermost)
    refuse_mjcf(section.place(), "a <default> within another has no class", "write <default class=\"...\">");
  std::string const name = is_outermost ? outermost_class : *written;
  auto& own = classes_[name];
  for (auto const& child : section.children)
    if (child.name != "default") {
      auto attributes = child.attributes;
      auto& known = own[default_name(child.name)];
      add_missing(known, attributes);
      known = std::move(attributes);
    }
  if (!is_outermost)
    for (auto const& [element, attributes] : classes_[outer]) add_missing(attributes, own[element]);
  // the outermost class may be called by a name of its own
  if (is_outermost && written != nullptr) classes_[*written] = own;
  for (auto const& child : section.children)
    if (child.name == "default") read_defaults(child, name, false);
}

XmlElement MjcfDocument::with_defaults(XmlElement const& element, std::string const& class_around) const {
  XmlElement whole{element.name, element.attributes, {}, element.at, element.length, element.text};
  auto const* const own = element.find("class");
  std::string const name = own != nullptr ? *own : class_around.empty() ? outermost_class : class_around;
  auto const found = classes_.find(name);
  if (found == classes_.end()) {
    if (name == outermost_class) return whole;
    std::vector<std::string> names;
    for (auto const& [one, ignored] : classes_) names.push_back(one);
    auto const close = closest_name(name, names);
    refuse_mjcf(element.place_of("class"), fmt::format("no <default> has the class \"{}\"", name),
                close.empty() ? fmt::format("classes: {}", fmt::join(names, ", "))
                              : fmt::format("did you mean \"{}\"?", close));
  }
  auto const settings = found->second.find(default_name(element.name));
  if (settings == found->second.end()) return whole;
  auto added = settings->second;
  for (auto& one : added) one.at = element.at;  // a message shows the element
  add_missing(added, whole.attributes);
  return whole;
}

FramePose MjcfDocument::pose_of(XmlElement const& element) const {
  FramePose pose{mjcf_rotation(element, compiler_), Eigen::Vector3d::Zero()};
  if (auto const at = numbers_of(element, "pos", 3, 3)) pose.position = Eigen::Vector3d::Map(at->data());
  return pose;
}

std::optional<std::vector<double>> numbers_of(XmlElement const& element, std::string_view attribute, std::size_t least,
                                              std::size_t most) {
  auto const* const text = element.find(attribute);
  if (text == nullptr) return std::nullopt;
  std::vector<double> numbers;
  bool is_sound = true;
  char const* at = text->data();
  char const* const end = at + text->size();
  while (is_sound) {
    at = std::find_if(at, end, [](char c) { return std::string_view(" \t\r\n").find(c) == std::string_view::npos; });
    if (at == end) break;
    if (*at == '+') ++at;
    double number = 0.0;
    auto const [stop, failure] = std::from_chars(at, end, number);
    bool const is_apart = stop == end || std::string_view(" \t\r\n").find(*stop) != std::string_view::npos;
    is_sound = failure == std::errc() && is_apart && std::isfinite(number);
    numbers.push_back(number);
    at = stop;
  }
  std::string const wanted = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  if (!is_sound || numbers.size() < least || numbers.size() > most)
    refuse_mjcf(element.place_of(attribute),
                fmt::format("{} of <{}> is \"{}\", not {} numbers", attribute, element.name, *text, wanted),
                "write numbers with blanks between them, and a point, no comma");
  return numbers;
}

double number_of(XmlElement const& element, std::string_view attribute, double otherwise) {
  auto const numbers = numbers_of(element, attribute, 1, 1);
  return numbers ? numbers->front() : otherwise;
}

std::string word_of(XmlElement const& element, std::string_view attribute, std::vector<std::string> const& allowed,
                    std::string const& otherwise) {
  auto const* const word = element.find(attribute);
  if (word == nullptr) return otherwise;
  if (std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
    refuse_mjcf(element.place_of(attribute), fmt::format("{} of <{}> is \"{}\"", attribute, element.name, *word),
                fmt::format("write one of {}", fmt::join(allowed, ", ")));
  return *word;
}

bool is_true(XmlElement const& element, std::string_view attribute, bool otherwise) {
  return word_of(element, attribute, {"true", "false"}, otherwise ? "true" : "false") == "true";
}

void refuse_mjcf(SourcePlace place, std::string what, std::string help) {
  Problem problem;
  problem.what = std::move(what);
  problem.place = std::move(place);
  problem.help = std::move(help);
  throw Error(std::move(problem));
}

}  // namespace torquescope
