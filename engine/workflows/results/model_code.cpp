#include "engine/workflows/results/model_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/torque_unit.hpp"
#include "engine/effects/instant_code.hpp"

namespace torquescope {
namespace {

using Json = nlohmann::ordered_json;
using Effects = std::vector<EstimatedEffect>;

// without what could end a comment, an attribute or a line
std::string plain(std::string const& text) {
  std::string kept;
  for (char const c : text) {
    bool const is_kept = std::isalnum(static_cast<unsigned char>(c)) || std::string(" _./^()+-").find(c) != text.npos;
    if (is_kept && !(c == '-' && kept.ends_with('-')) && !(c == '/' && kept.ends_with('*'))) kept += c;
  }
  return kept;
}

std::string number_in_c(double value) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INFINITY" : "-INFINITY";
  return fmt::format("{}", value);
}

std::string said(EstimatedEffect const& estimated) {
  if (estimated.effect) return estimated.effect->name();
  return plain(estimated.parameters.front().name);
}

JointKind kind_of(JointDiagnosis const& joint) {
  return joint.unit_position == "m" ? JointKind::prismatic : JointKind::revolute;
}

bool asks_for(Effects const& effects, std::string const& word) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](EstimatedEffect const& estimated) { return has_word(estimated.code, word); });
}

// what the numbers are, and what is not in them
std::string c_comment(Effects const& effects, ModelledJoint const& joint, std::vector<std::string> const& remarks) {
  std::string const angle = joint.kind == JointKind::prismatic ? "m" : "rad", unit = plain(joint.torque_unit);
  std::string text =
      fmt::format("/* {0} in {1} from q in {2}, dq in {2}/s, ddq in {2}/s2\n", effort_word(joint.kind), unit, angle);
  if (asks_for(effects, "load"))
    text += fmt::format(
        "   load in {}: what the gear carries, of weight, springs and inertia of everything behind it\n", unit);
  for (auto const& remark : remarks) text += "   " + plain(remark) + "\n";
  std::set<std::string> left_out;
  for (auto const& effect : effects)
    if (effect.code.empty())
      left_out.insert(fmt::format("   left out: {}, which {}\n", said(effect), effect.why_no_code));
  for (auto const& line : left_out) text += line;
  text.back() = ' ';
  return text + "*/\n";
}

std::string c_constants(Effects const& effects, EffectLevels const& levels) {
  std::string text;
  auto const constant = [&](std::string const& name, double value, std::string const& remark) {
    text += fmt::format("  const double {} = {};{}\n", name, number_in_c(value),
                        remark.empty() ? "" : "  /* " + plain(remark) + " */");
  };
  for (auto const& effect : effects) {
    if (effect.code.empty()) continue;
    for (auto const& one : effect.parameters) constant(one.name, one.value, one.unit == "1" ? "" : one.unit);
    for (auto const& one : effect.held) constant(one.name, one.value, "fixed by the joint");
  }
  if (asks_for(effects, "baseline_inertia")) constant("baseline_inertia", levels.inertia, "as load was taken with");
  if (asks_for(effects, "s")) text += "  const double s = (dq > 0) - (dq < 0);\n";
  if (asks_for(effects, "friction_sign"))
    text += fmt::format("  const double friction_sign = dq > 0 ? {} : dq < 0 ? {} : 0;  /* as Coulomb friction */\n",
                        number_in_c(levels.forward), number_in_c(levels.backward));
  return text;
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(std::vector<ParameterEstimate> const& parameters) {
  Json list = Json::array();
  for (auto const& one : parameters)
    list.push_back({{"name", one.name},
                    {"unit", one.unit},
                    {"value", finite(one.value)},
                    {"ci95", Json::array({finite(one.lower), finite(one.upper)})}});
  return list;
}

Json json_of(EstimatedEffect const& estimated) {
  Json made = {{"name", estimated.effect ? Json(estimated.effect->name()) : Json(nullptr)},
               {"title", estimated.effect ? estimated.effect->title() : ""},
               {"equation", estimated.effect ? estimated.effect->equation() : ""},
               {"code", estimated.code.empty() ? Json(nullptr) : Json(estimated.code)},
               {"why_no_code", estimated.why_no_code},
               {"parameters", json_of(estimated.parameters)}};
  made["held"] = Json::object();
  for (auto const& one : estimated.held) made["held"][one.name] = one.value;
  return made;
}

Json json_of(NamedEffect const& effect) {
  Effect const* known = find_effect(effect.name);
  return {{"name", effect.name},
          {"title", effect.title},
          {"equation", effect.equation},
          {"code", nullptr},
          {"why_no_code", known ? why_no_code(*known) : ""},
          {"parameters", json_of(effect.parameters)}};
}

Json json_of(JointDiagnosis const& joint) {
  Json effects = Json::array();
  for (auto const& effect : estimated_effects(joint)) effects.push_back(json_of(effect));
  return {{"joint", joint.joint},
          {"name", joint.name},
          {"kind", kind_of(joint) == JointKind::revolute ? "revolute" : "prismatic"},
          {"unit_position", joint.unit_position},
          {"unit_torque", joint.unit_torque},
          {"friction_sign", Json::array({finite(joint.effect_levels.forward), finite(joint.effect_levels.backward)})},
          {"baseline_inertia", finite(joint.effect_levels.inertia)},
          {"laws", std::move(effects)}};
}

// what MJCF has words for, by parameter
struct MjcfWord {
  char const *attribute, *parameter;
};
constexpr std::array mjcf_words{MjcfWord{"armature", "inertia"}, MjcfWord{"damping", "viscous"},
                                MjcfWord{"frictionloss", "coulomb"}};
constexpr char forwards[] = "coulomb_positive", backwards[] = "coulomb_negative";  // their mean is a frictionloss

std::string function_name(JointDiagnosis const& joint) {
  return fmt::format("joint_{}_{}", joint.joint, effort_word(kind_of(joint)));
}

std::string const function_head = "#include <math.h>\n\n";

std::string function_of(Diagnosis const& diagnosis, JointDiagnosis const& joint) {
  std::vector<std::string> remarks;
  if (!joint.name.empty()) remarks.push_back("joint of " + joint.name);
  if (diagnosis.arm) {
    remarks.emplace_back("of one joint of an arm: weight and inertia of the links come beside it");
    for (auto const& effect : diagnosis.arm->effects)
      if (Effect const* known = find_effect(effect.name))
        remarks.push_back(fmt::format("left out: {}, which {}", effect.name, why_no_code(*known)));
  }
  return c_function(estimated_effects(joint), joint.effect_levels,
                    {kind_of(joint), joint.unit_torque, function_name(joint)}, remarks);
}

}  // namespace

std::string effort_word(JointKind joint) { return joint == JointKind::prismatic ? "force" : "torque"; }

std::string c_function(Effects const& effects, EffectLevels const& levels, ModelledJoint const& joint,
                       std::vector<std::string> const& remarks) {
  std::vector<std::string> sum;
  for (auto const& effect : effects)
    if (!effect.code.empty()) sum.push_back(effect.code);
  if (sum.empty()) return "";
  std::string text = c_comment(effects, joint, remarks);
  bool const has_load = asks_for(effects, "load");
  text += fmt::format("double {}(double q, double dq, double ddq{}) {{\n", joint.name, has_load ? ", double load" : "");
  text += c_constants(effects, levels);
  for (auto const* word : {"q", "dq", "ddq"}) {
    bool const is_used = asks_for(effects, word) ||
                         (std::string(word) == "dq" && (asks_for(effects, "s") || asks_for(effects, "friction_sign")));
    if (!is_used) text += fmt::format("  (void){};\n", word);
  }
  return text + fmt::format("  return {};\n}}\n", fmt::join(sum, "\n       + "));
}

std::string mjcf_joint(Effects const& effects, ModelledJoint const& joint) {
  std::string attributes, both_levels;
  std::set<std::string> has_words, inside;
  std::vector<std::string> rest;
  auto const value = [&](std::string const& parameter) {
    for (auto const& effect : effects)
      for (auto const& one : effect.parameters)
        if (one.name == parameter) return one.value;
    return unknown;
  };
  auto const write = [&](char const* attribute, double number) {
    if (!(number >= 0.0)) return;
    attributes += fmt::format(" {}=\"{:.5g}\"", attribute, number);
    has_words.insert(attribute);
  };
  for (auto const& word : mjcf_words) {
    write(word.attribute, value(word.parameter));
    inside.insert(word.parameter);
  }
  if (!has_words.contains("frictionloss")) {
    double const level = (value(forwards) - value(backwards)) / 2.0;
    write("frictionloss", level);
    if (level >= 0.0) both_levels = "<!-- frictionloss is the mean of both directions -->\n";
    inside.insert({forwards, backwards});
  }
  if (!has_words.contains("damping") && !has_words.contains("frictionloss")) return "";
  for (auto const& effect : effects)
    if (!inside.contains(effect.parameters.front().name)) rest.push_back(said(effect));
  std::string const own = plain(joint.name);
  std::string text = fmt::format("<joint name=\"{}\" type=\"{}\"{}/>\n", own.empty() ? "joint" : own,
                                 joint.kind == JointKind::prismatic ? "slide" : "hinge", attributes);
  if (has_words.contains("armature"))
    text += "<!-- armature is all inertia of the joint: where the body has its own, take that off -->\n";
  text += both_levels;
  if (in_torque_unit("N m", joint.torque_unit) != "N m")
    text += fmt::format("<!-- numbers are of a torque in {}: multiply them by N m per {} -->\n",
                        plain(joint.torque_unit), plain(joint.torque_unit));
  if (!rest.empty()) text += fmt::format("<!-- a joint of MJCF has no words for: {} -->\n", fmt::join(rest, ", "));
  return text;
}

std::string c_text(Effects const& effects, EffectLevels const& levels, ModelledJoint const& joint) {
  std::string const text = c_function(effects, levels, joint);
  return text.empty() ? "" : function_head + text;
}

std::string c_of_joint(Diagnosis const& diagnosis, JointDiagnosis const& joint) {
  std::string const text = function_of(diagnosis, joint);
  return text.empty() ? "" : function_head + text;
}

std::string mjcf_of_joint(JointDiagnosis const& joint) {
  return mjcf_joint(estimated_effects(joint), {kind_of(joint), joint.unit_torque,
                                               joint.name.empty() ? fmt::format("joint_{}", joint.joint) : joint.name});
}

namespace {

std::string c_file(Diagnosis const& diagnosis) {
  std::string text = "/* Models of a diagnosis by Torquescope. */\n" + function_head;
  for (auto const& joint : diagnosis.joints) {
    std::string const own = function_of(diagnosis, joint);
    text += own.empty() ? fmt::format("/* joint {}: its model has no function */\n", joint.joint) : own;
    text += "\n";
  }
  text.pop_back();
  return text;
}

std::string mjcf_file(Diagnosis const& diagnosis) {
  std::string text = "<mujocoinclude>\n<!-- by Torquescope: each joint belongs into its own body -->\n";
  for (auto const& joint : diagnosis.joints) {
    std::string const own = mjcf_of_joint(joint);
    text += own.empty() ? fmt::format("<!-- joint {}: no friction that MJCF has words for -->\n", joint.joint) : own;
  }
  return text + "</mujocoinclude>\n";
}

std::string json_file(Diagnosis const& diagnosis) {
  Json joints = Json::array(), arm = Json::array();
  for (auto const& joint : diagnosis.joints) joints.push_back(json_of(joint));
  if (diagnosis.arm)
    for (auto const& effect : diagnosis.arm->effects) arm.push_back(json_of(effect));
  Json const document = {{"schema", 1}, {"joints", std::move(joints)}, {"of_the_whole_arm", std::move(arm)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::vector<ModelWriter> const& model_writers() {
  static std::vector<ModelWriter> const writers{{"c", "C functions of a diagnosis' joints", c_file},
                                                {"json", "parameters and effects of a diagnosis' joints", json_file},
                                                {"mjcf", "friction of a diagnosis' joints", mjcf_file}};
  return writers;
}

}  // namespace torquescope
