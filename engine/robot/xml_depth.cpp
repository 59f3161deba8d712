#include "engine/robot/xml_depth.hpp"

#include <fmt/format.h>

namespace torquescope {

namespace {

constexpr int deepest = 64;  // a URDF needs 6

// offset of the tag that is too deep, or npos. Comments count as nothing
std::size_t first_deep_tag(std::string const& text) {
  int depth = 0;
  std::size_t at = text.find('<');
  while (at != std::string::npos) {
    bool const comment = text.compare(at, 4, "<!--") == 0;
    std::size_t const end = comment ? text.find("-->", at) : text.find('>', at);
    if (end == std::string::npos) return std::string::npos;
    char const kind = at + 1 < text.size() ? text[at + 1] : ' ';
    if (kind == '/') {
      --depth;
    } else if (kind != '!' && kind != '?' && text[end - 1] != '/') {
      if (++depth > deepest) return at;
    }
    at = text.find('<', end);
  }
  return std::string::npos;
}

}  // namespace

void refuse_deep_xml(RobotText const& text) {
  auto const at = first_deep_tag(text.text);
  validate(at == std::string::npos, [&] {
    Problem problem;
    problem.code = ExitCode::bad_data;
    problem.what = fmt::format("nested deeper than {} levels", deepest);
    problem.place = text.place(at);
    problem.help = "no URDF needs more than 6 levels";
    return problem;
  });
}

}  // namespace torquescope
