#pragma once
// The elements of an XML text with their places: what a reader of robot files needs to say where something is wrong.
//
// Reads      elements, attributes, the five entities and character numbers; comments, texts between tags, processing
//            instructions and document types are passed over
// Errors     Error 65 with the place: tags that do not match, attributes that are written twice or have no quotes, more
//            than 64 levels
// Threads    values; elements of a file share its text

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/robot/robot_text.hpp"

namespace torquescope {

struct XmlAttribute {
  std::string name, value;
  std::size_t at = 0;  // byte of its name in the text
};

struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes{};
  std::vector<XmlElement> children{};
  std::size_t at = 0, length = 0;  // bytes of its opening tag
  std::shared_ptr<RobotText const> text{};

  std::string const* find(std::string_view attribute) const;  // its value, or nullptr
  XmlElement const* child(std::string_view name) const;       // the first of the name, or nullptr
  SourcePlace place() const;
  SourcePlace place_of(std::string_view attribute) const;  // of the attribute, else of the element
};

// kind: what the file should be, "URDF"
XmlElement read_xml(std::shared_ptr<RobotText const> const& text, std::string const& kind);

// the name of the outermost element, "" when the text does not begin as XML does
std::string outermost_element(RobotText const& text);

}  // namespace torquescope
