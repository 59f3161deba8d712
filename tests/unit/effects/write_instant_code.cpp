// Writes the code of every effect as a function of C: instant_code.cpp compares it, compiled, with the engine.
//
// Use        write_instant_code FILE.c

#include <cstdio>
#include <string>
#include <vector>

#include "engine/effects/instant_code.hpp"

namespace {

constexpr char inputs[] =
    "double q, double dq, double ddq, double s, double friction_sign, double load, double baseline_inertia";

// p: all parameters of the effect, linear ones first
void write_function(std::FILE* file, std::string const& name, torquescope::Effect const& effect,
                    std::string const& code) {
  std::fprintf(file, "static double %s(double const* p, %s) {\n", name.c_str(), inputs);
  for (std::size_t k = 0; k < effect.parameters().size(); ++k)
    if (torquescope::has_word(code, effect.parameters()[k].name))
      std::fprintf(file, "  const double %s = p[%zu];\n", effect.parameters()[k].name.c_str(), k);
  for (auto const* word : {"q", "dq", "ddq", "s", "friction_sign", "load", "baseline_inertia"})
    std::fprintf(file, "  (void)%s;\n", word);
  std::fprintf(file, "  return %s;\n}\n", code.c_str());
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 64;
  std::FILE* const file = std::fopen(arguments[1], "w");
  if (!file) return 74;
  std::fprintf(file, "#include <math.h>\n#include \"tests/unit/effects/instant_code.h\"\n");
  std::string rows;
  for (auto const* effect : torquescope::effect_choices()) {
    if (!effect->code().empty()) {
      write_function(file, "of_" + effect->name(), *effect, effect->code());
      rows += "  {\"" + effect->name() + "\", 0, of_" + effect->name() + "},\n";
    }
    if (!effect->plain_code().empty()) {
      write_function(file, "plain_" + effect->name(), *effect, effect->plain_code());
      rows += "  {\"" + effect->name() + "\", 1, plain_" + effect->name() + "},\n";
    }
  }
  std::fprintf(file, "struct CodedEffect const coded_effects[] = {\n%s  {0, 0, 0}};\n", rows.c_str());
  return std::fclose(file) == 0 ? 0 : 74;
}
