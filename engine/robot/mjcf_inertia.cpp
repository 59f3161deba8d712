#include "engine/robot/mjcf_inertia.hpp"

#include <fmt/format.h>

#include <numbers>

#include "engine/robot/mjcf_orientation.hpp"
#include "engine/robot/xml_words.hpp"

namespace torquescope {

namespace {

constexpr double density_of_water = 1000.0;  // kg/m^3, MuJoCo's own default

LinkInertia of_inertial(MjcfDocument const& document, XmlElement const& inertial) {
  if (inertial.find("mass") == nullptr || inertial.find("pos") == nullptr)
    refuse_mjcf(inertial.place(), "<inertial> needs mass and pos", "write <inertial pos=\"0 0 0.1\" mass=\"1.2\" ...>");
  double const mass = number_of(inertial, "mass", 0.0);
  auto const diagonal = numbers_of(inertial, "diaginertia", 3, 3);
  auto const full = numbers_of(inertial, "fullinertia", 6, 6);
  if (mass < 0.0 || diagonal.has_value() == full.has_value())
    refuse_mjcf(inertial.place(),
                mass < 0.0 ? fmt::format("mass = {} is negative", mass)
                           : "<inertial> has not one of diaginertia and fullinertia",
                "write its mass in kg and diaginertia=\"xx yy zz\" in kg m^2, or no <inertial> at all");
  Eigen::Matrix3d tensor;
  if (diagonal)
    tensor = Eigen::Vector3d::Map(diagonal->data()).asDiagonal();
  else
    tensor << (*full)[0], (*full)[3], (*full)[4], (*full)[3], (*full)[1], (*full)[5], (*full)[4], (*full)[5],
        (*full)[2];
  return LinkInertia::from_centre(mass, Eigen::Vector3d::Zero(), tensor).seen_from(document.pose_of(inertial));
}

struct Solid {
  double volume = 0.0;
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();  // per kilogram, about the centre
};

Solid cuboid(Eigen::Vector3d const& half, double volume_factor, double moment_factor) {
  Eigen::Vector3d const square = half.cwiseAbs2();
  return {volume_factor * half.prod(),
          moment_factor * Eigen::Vector3d(square.y() + square.z(), square.z() + square.x(), square.x() + square.y())};
}

Solid cylinder(double r, double half) {
  double const across = (3.0 * r * r + 4.0 * half * half) / 12.0;
  return {std::numbers::pi * r * r * 2.0 * half, {across, across, 0.5 * r * r}};
}

// a cylinder and two half spheres, whose centres lie 3/8 r behind its ends
Solid capsule(double r, double half) {
  Solid const middle = cylinder(r, half);
  double const ends = 4.0 / 3.0 * std::numbers::pi * r * r * r, volume = middle.volume + ends;
  double const ball = 0.4 * r * r, across = ball + half * half + 0.75 * half * r;
  Eigen::Vector3d const moments = (middle.volume * middle.moments + ends * Eigen::Vector3d(across, across, ball));
  return {volume, moments / volume};
}

struct Shape {
  std::string type;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  // as MuJoCo has it: radius, half length; or half axes
  FramePose pose{};
};

Shape shape_of(MjcfDocument const& document, XmlElement const& geom) {
  Shape shape;
  shape.type =
      word_of(geom, "type", {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"},
              geom.find("mesh") != nullptr ? "mesh" : "sphere");
  auto const sizes = numbers_of(geom, "size", 1, 3);
  for (std::size_t k = 0; sizes && k < sizes->size(); ++k) shape.size[static_cast<Eigen::Index>(k)] = (*sizes)[k];
  auto const ends = numbers_of(geom, "fromto", 6, 6);
  if (!ends) {
    shape.pose = document.pose_of(geom);
    return shape;
  }
  Eigen::Vector3d const from = Eigen::Vector3d::Map(ends->data()), to = Eigen::Vector3d::Map(ends->data() + 3);
  double const half = 0.5 * (from - to).norm();
  if (!(half > 0.0)) refuse_mjcf(geom.place_of("fromto"), "fromto has no length", "write two points that differ");
  shape.pose = {turn_of_z_onto(from - to), 0.5 * (from + to)};
  bool const is_round = shape.type == "capsule" || shape.type == "cylinder";
  shape.size =
      is_round ? Eigen::Vector3d(shape.size[0], half, 0.0) : Eigen::Vector3d(shape.size[0], shape.size[0], half);
  return shape;
}

std::optional<Solid> solid_of(Shape const& shape) {
  auto const& size = shape.size;
  if (shape.type == "sphere") return cuboid(Eigen::Vector3d::Constant(size[0]), 4.0 / 3.0 * std::numbers::pi, 0.2);
  if (shape.type == "ellipsoid") return cuboid(size, 4.0 / 3.0 * std::numbers::pi, 0.2);
  if (shape.type == "box") return cuboid(size, 8.0, 1.0 / 3.0);
  if (shape.type == "cylinder") return cylinder(size[0], size[1]);
  if (shape.type == "capsule") return capsule(size[0], size[1]);
  return std::nullopt;
}

bool is_weightless(std::string const& type) { return type == "plane" || type == "hfield"; }

bool counts(MjcfDocument const& document, XmlElement const& geom) {
  double const group = number_of(geom, "group", 0.0);
  if (group < document.compiler().first_group || group > document.compiler().last_group) return false;
  auto const* const mass = geom.find("mass");
  return number_of(geom, mass != nullptr ? "mass" : "density", density_of_water) > 0.0;
}

void add_geom(MjcfDocument const& document, XmlElement const& geom, std::string const& class_around,
              FramePose const& before, MjcfInertia& sum) {
  auto const whole = document.with_defaults(geom, class_around);
  if (!counts(document, whole)) return;
  Shape const shape = shape_of(document, whole);
  if (is_weightless(shape.type)) return;
  auto const solid = solid_of(shape);
  if (!solid || is_true(whole, "shellinertia", false)) {
    sum.unknown = fmt::format(
        "{}: the mass of a geom of type {}{} is not known here: all inertias of the file are left out (write "
        "<inertial> "
        "for its body)",
        place_text(geom.place()), shape.type, solid ? ", a shell," : "");
    return;
  }
  if (!(solid->volume > 0.0))
    refuse_mjcf(whole.place_of("size"), fmt::format("a geom of type {} has no volume", shape.type),
                "write its size: radius, radius and half length, or three half lengths");
  double const mass = number_of(whole, "mass", solid->volume * number_of(whole, "density", density_of_water));
  Eigen::Matrix3d const tensor = (mass * solid->moments).asDiagonal();
  auto const part = LinkInertia::from_centre(mass, Eigen::Vector3d::Zero(), tensor).seen_from(before * shape.pose);
  sum.body = sum.body.value_or(LinkInertia{}) + part;
}

void add_geoms(MjcfDocument const& document, XmlElement const& element, std::string const& class_around,
               FramePose const& before, MjcfInertia& sum) {
  for (auto const& child : element.children) {
    if (child.name == "geom") add_geom(document, child, class_around, before, sum);
    if (child.name != "frame") continue;
    auto const* const own = child.find("childclass");
    add_geoms(document, child, own == nullptr ? class_around : *own, before * document.pose_of(child), sum);
  }
}

}  // namespace

MjcfInertia mjcf_inertia(MjcfDocument const& document, XmlElement const& body, std::string const& class_around) {
  MjcfInertia inertia;
  auto const* const inertial = body.child("inertial");
  auto const from_geoms = document.compiler().from_geoms;
  if (inertial != nullptr && from_geoms != GeomInertia::always) {
    auto const given = of_inertial(document, *inertial);
    if (given.mass > 0.0 || !given.inertia.isZero()) inertia.body = given;
    return inertia;
  }
  if (from_geoms != GeomInertia::never) add_geoms(document, body, class_around, FramePose{}, inertia);
  return inertia;
}

}  // namespace torquescope
