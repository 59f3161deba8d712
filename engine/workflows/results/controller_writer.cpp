// What Figures 3 and 4 draw: membership curves, decision surfaces and the path of every run on them.

#include <array>
#include <cmath>
#include <set>

#include "engine/fit/optim/fuzzy_curves.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/estimator_writer.hpp"

namespace torquescope {

namespace {

constexpr std::size_t curve_points = 201;
constexpr std::size_t surface_points = 41;

void write_curves(ResultWriter& writer, std::string const& group, FuzzyController const& controller) {
  write_names(writer, group, "curve", std::vector<std::string>{"small", "middle", "big"});
  std::set<std::string> written;
  for (auto const& curves : membership_curves(controller, curve_points)) {
    std::string const& name = curves.variable.name;
    if (!written.insert(name).second) continue;  // an input both controllers read
    writer.numbers(group + "/" + name + "_universe", {curve_points}, curves.x,
                   Note{"1", name}.over({name + "_universe"}));
    std::vector<double> rows;
    for (auto const& membership : curves.memberships) rows.insert(rows.end(), membership.begin(), membership.end());
    writer.numbers(group + "/" + name + "_membership", {3, curve_points}, rows,
                   Note{"1", "membership of " + name, "seed Table 1"}.over({"curve", name + "_universe"}));
  }
}

void write_surface(ResultWriter& writer, std::string const& group, std::string const& output,
                   DecisionSurface const& surface) {
  writer.numbers(group + "/" + output + "_first", {surface_points}, surface.first,
                 Note{"1", surface.first_name}.over({output + "_first"}));
  writer.numbers(group + "/" + output + "_second", {surface_points}, surface.second,
                 Note{"1", surface.second_name}.over({output + "_second"}));
  writer.numbers(group + "/" + output + "_surface", {surface_points, surface_points}, surface.output,
                 Note{"1", output, "seed Fig. 4"}.over({output + "_first", output + "_second"}));
  write_names(writer, group, output + "_input", std::vector<std::string>{surface.first_name, surface.second_name});
  writer.attribute(group, output + "_inputs", std::vector<std::string>{surface.first_name, surface.second_name});
}

}  // namespace

void write_controller(ResultWriter& writer, std::string const& label, FuzzyController const& controller,
                      std::size_t runs, std::vector<double> const& PC, std::vector<double> const& FC) {
  std::string const group = "/runs/" + label + "/controller";
  write_curves(writer, group, controller);
  write_surface(writer, group, "F", decision_surface(controller.F_system(), surface_points));
  write_surface(writer, group, "CR", decision_surface(controller.CR_system(), surface_points));

  std::vector<double> F_path, CR_path;
  for (std::size_t i = 0; i < PC.size(); ++i) {
    bool const moved = !std::isnan(PC[i]);  // the initial population has not, nor a generation that never was
    std::array<double, 2> const nowhere{std::nan(""), std::nan("")};
    auto const F_levels = moved ? controller.F_inputs(PC[i], FC[i]) : nowhere;
    auto const CR_levels = moved ? controller.CR_inputs(PC[i], FC[i]) : nowhere;
    F_path.insert(F_path.end(), F_levels.begin(), F_levels.end());
    CR_path.insert(CR_path.end(), CR_levels.begin(), CR_levels.end());
  }
  h5::Shape const path_shape{runs, PC.size() / runs, 2};
  writer.numbers(group + "/F_path", path_shape, F_path,
                 Note{"1", "where each run was on the surface of F"}.over({"run", "generation", "F_input"}));
  writer.numbers(group + "/CR_path", path_shape, CR_path,
                 Note{"1", "where each run was on the surface of CR"}.over({"run", "generation", "CR_input"}));
}

}  // namespace torquescope
