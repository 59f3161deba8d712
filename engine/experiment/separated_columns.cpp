#include "engine/experiment/separated_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/experiment/job_sections.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

struct EffectAtJoint {
  Effect const* effect;
  std::size_t joint;
};

JointScales scales_of(ChainJoint const& joint, ExciteOptions const& options) {
  JointScales scales;
  scales.joint = joint.kind;
  scales.duration_s = options.period_s;
  if (std::isfinite(joint.max_speed)) scales.peak_speed = options.speed_share * joint.max_speed;
  if (std::isfinite(joint.upper - joint.lower)) {
    scales.position_range = options.position_share * (joint.upper - joint.lower);
    scales.position_centre = 0.5 * (joint.upper + joint.lower);
  }
  return scales;
}

std::vector<double> middle_shape(Effect const& effect, JointScales const& scales) {
  std::vector<double> shape;
  for (auto const& range : effect.shape_bounds(scales))
    shape.push_back(range.spacing == Spacing::logarithmic ? std::sqrt(range.lower * range.upper)
                                                          : 0.5 * (range.lower + range.upper));
  return shape;
}

// "stribeck@3"; nothing where it is none
std::optional<EffectAtJoint> effect_at_joint(std::string const& name, SerialChain const& chain) {
  auto const at = name.find('@');
  if (at == std::string::npos) return {};
  Effect const* effect = find_effect(name.substr(0, at));
  std::size_t joint = 0;
  char const* const end = name.data() + name.size();
  auto const read = std::from_chars(name.data() + at + 1, end, joint);
  bool const is_there = effect != nullptr && read.ec == std::errc() && read.ptr == end && joint >= 1 &&
                        joint <= chain.joints.size() && effect->exists_on(chain.joints[joint - 1].kind);
  if (!is_there) return {};
  return EffectAtJoint{effect, joint - 1};
}

std::vector<Index> parameters_named(ArmModel const& model, std::vector<std::string> const& wanted) {
  std::vector<Index> found;
  auto const names = model.names();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::find(wanted.begin(), wanted.end(), names[k]) != wanted.end()) found.push_back(static_cast<Index>(k));
  return found;
}

std::vector<Index> parameters_of(EffectAtJoint const& one, ArmModel const& model) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < one.effect->n_linear(); ++k)
    names.push_back(fmt::format("{}_{}", one.effect->parameters()[k].name, one.joint + 1));
  auto found = parameters_named(model, names);
  return found.size() == names.size() ? found : std::vector<Index>();
}

// beside those of the model, at the right of the joint's rows
std::vector<Index> add_columns(EffectAtJoint const& one, ChainJoint const& joint, ExciteOptions const& options,
                               RowModel& rows) {
  std::vector<Index> added;
  for (std::size_t k = 0; k < one.effect->n_linear(); ++k) {
    added.push_back(rows.size++);
    rows.own[one.joint].push_back(added.back());
  }
  JointScales const scales = scales_of(joint, options);
  rows.rows = [before = rows.rows, one, scales, shape = middle_shape(*one.effect, scales)](MotionSamples const& at) {
    auto made = before(at);
    auto& mine = made[one.joint];
    Index const columns = mine.cols(), more = static_cast<Index>(one.effect->n_linear());
    mine.conservativeResize(Eigen::NoChange, columns + more);
    auto const motion = joint_motions(at);
    one.effect->columns({motion[one.joint], scales}, shape, mine.rightCols(more));
    return made;
  };
  return added;
}

Problem no_such_name(Section const& section, std::string const& name) {
  return problem_at(section, "separate", fmt::format("separate: nothing is called \"{}\"", name),
                    "write a parameter (torquescope describe ROBOT.toml lists them) or EFFECT@JOINT, as in "
                    "\"stribeck@3\" (torquescope list effects)");
}

}  // namespace

std::vector<Motion> joint_motions(MotionSamples const& samples) {
  std::vector<Motion> motion(static_cast<std::size_t>(samples.q.cols()));
  for (std::size_t j = 0; j < motion.size(); ++j) {
    auto const at = static_cast<Index>(j);
    motion[j].rate_hz = 1.0 / (samples.time_s[1] - samples.time_s[0]);
    motion[j].time_s = samples.time_s;
    motion[j].q = samples.q.col(at);
    motion[j].dq = samples.dq.col(at);
    motion[j].ddq = samples.ddq.col(at);
  }
  return motion;
}

RowModel with_separated(RowModel rows, ArmModel const& model, ExciteOptions const& options, Section const& section,
                        std::vector<Problem>& problems) {
  std::vector<std::vector<Index>> sets;
  for (auto const& name : options.separate) {
    auto const effect = effect_at_joint(name, model.chain());
    auto columns = effect ? parameters_of(*effect, model) : parameters_named(model, {name});
    bool const is_new = effect && columns.empty();
    if (is_new && (effect->effect->has_memory() || effect->effect->needs_baseline() ||
                   effect->effect->acts_on() != ActsOn::joint))
      problems.push_back(problem_at(section, "separate",
                                    fmt::format("separate: \"{}\" does not follow from the motion alone", name),
                                    "name an effect of position, velocity and acceleration"));
    else if (is_new)
      columns = add_columns(*effect, model.chain().joints[effect->joint], options, rows);
    else if (columns.empty())
      problems.push_back(no_such_name(section, name));
    sets.push_back(std::move(columns));
  }
  if (sets.size() != 2) return rows;
  for (auto const k : sets[0])
    if (std::find(sets[1].begin(), sets[1].end(), k) != sets[1].end()) {
      problems.push_back(problem_at(section, "separate", "separate names the same column twice", "name two things"));
      return rows;
    }
  rows.one = std::move(sets[0]);
  rows.other = std::move(sets[1]);
  return rows;
}

}  // namespace torquescope
