#pragma once
// An MJCF file with what it includes, its <compiler> and its default classes: all that decides what a body says.
//
// Errors     Error 65 and 66 of the files; 78: a class that nobody defines, numbers that are none, each with its place
// Threads    values
// Source     MuJoCo documentation, XML reference and "Default settings"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/robot/link_inertia.hpp"
#include "engine/robot/xml_element.hpp"

namespace torquescope {

enum class GeomInertia { never, where_none_is_given, always };

struct MjcfCompiler {
  double radians = 0.017453292519943295;  // per unit of an angle: the format begins with degrees
  std::string euler_sequence = "xyz";     // small letters turn with the frame, capital ones stay
  bool are_ranges_limits = true;          // where "limited" is not written
  GeomInertia from_geoms = GeomInertia::where_none_is_given;
  double first_group = 0.0, last_group = 5.0;  // geoms that have inertia
};

class MjcfDocument {
 public:
  explicit MjcfDocument(RobotText const& text);

  XmlElement const& root() const { return root_; }
  MjcfCompiler const& compiler() const { return compiler_; }
  // the sections of a name, in their order: a file may have several
  std::vector<XmlElement const*> sections(std::string_view name) const;
  // the element with what its class, or else that of the bodies around it, adds; without its children
  XmlElement with_defaults(XmlElement const& element, std::string const& class_around) const;
  // its pos and one of quat, euler, axisangle, xyaxes, zaxis
  FramePose pose_of(XmlElement const& element) const;

 private:
  using Attributes = std::vector<XmlAttribute>;
  void read_compiler();
  void read_defaults(XmlElement const& section, std::string const& outer, bool is_outermost);

  XmlElement root_;
  MjcfCompiler compiler_;
  std::map<std::string, std::map<std::string, Attributes>> classes_;  // class, element
};

// least to most numbers of an attribute; nothing when it is not written
std::optional<std::vector<double>> numbers_of(XmlElement const& element, std::string_view attribute, std::size_t least,
                                              std::size_t most);
double number_of(XmlElement const& element, std::string_view attribute, double otherwise);
// an attribute that takes one of a few words
std::string word_of(XmlElement const& element, std::string_view attribute, std::vector<std::string> const& allowed,
                    std::string const& otherwise);
bool is_true(XmlElement const& element, std::string_view attribute, bool otherwise);
[[noreturn]] void refuse_mjcf(SourcePlace place, std::string what, std::string help);

}  // namespace torquescope
