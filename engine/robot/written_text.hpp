#pragma once
// Pieces of text that writers of robot files share.
//
// Threads    pure functions

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// all its digits, no more; a negative zero is a zero
std::string number_text(double value);
// numbers with `between`
std::string numbers_text(Eigen::Ref<Eigen::VectorXd const> const& values, char const* between);
// for an attribute of XML
std::string xml_text(std::string const& text);
// for a comment of XML, which may not hold two dashes
std::string xml_comment(std::string const& text);
// with its quotes, for TOML and JSON alike
std::string quoted_text(std::string const& text);

// xx, xy, xz, yy, yz, zz about the centre of mass, and the centre
struct CentredBody {
  double mass;
  Eigen::Vector3d centre;
  Eigen::Matrix<double, 6, 1> inertia;
};
CentredBody centred_body(LinkInertia const& link);

// an encoder step as counts per motor turn, or per m of a slide; 0: unknown
double encoder_counts(ChainJoint const& joint);

// what is known of a joint and has no place in a format, as a comment of XML; "" when it is nothing. keys: of those, as
// a TOML robot writes them
std::string lost_numbers(ChainJoint const& joint, std::span<std::string_view const> keys);

inline bool is_limited(ChainJoint const& joint) { return std::isfinite(joint.lower) && std::isfinite(joint.upper); }

}  // namespace torquescope
