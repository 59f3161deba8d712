#include "engine/app/commands/slurm_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/base/contract.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

namespace {

constexpr char array_template[] =
#include "array.sbatch.inc"
    ;
constexpr char merge_template[] =
#include "merge.sbatch.inc"
    ;

// the line that begins with `key` becomes key + value
void fill_in(std::string& script, std::string const& key, std::string const& value) {
  std::size_t const begin = script.find("\n" + key);
  TORQUESCOPE_EXPECT(begin != std::string::npos);
  std::size_t const end = script.find('\n', begin + 1);
  script.replace(begin + 1, end - begin - 1, key + value);
}

void fill_in_what_both_have(std::string& script, SlurmPlan const& plan) {
  fill_in(script, "program=", shell_word(plan.program));
  fill_in(script, "job=", shell_word(plan.job));
  fill_in(script, "result=", shell_word(plan.result));
  if (!plan.partition.empty()) {
    std::size_t const behind = script.find("\n#SBATCH --requeue") + 1;
    script.insert(behind, fmt::format("#SBATCH --partition={}\n", plan.partition));
  }
}

}  // namespace

std::string shell_word(std::string const& text) {
  std::string word = "'";
  for (char const letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

std::string sbatch_word(std::string const& text) {
  std::string word = "\"";
  for (char const letter : text) {
    if (letter == '"' || letter == '\\') word += '\\';
    word += letter;
  }
  return word + "\"";
}

std::string sbatch_pattern(std::string const& name, std::string const& ending) {
  std::string pattern;
  for (char const letter : name) pattern += letter == '%' ? std::string("%%") : std::string(1, letter);
  return sbatch_word(pattern + ending);
}

void check_plan(SlurmPlan const& plan) {
  auto const refuse = [](std::string const& what, std::string const& help) {
    throw Error(Problem{.code = ExitCode::usage, .what = what, .help = help});
  };
  for (auto const* text : {&plan.program, &plan.job, &plan.result, &plan.name})
    if (std::any_of(text->begin(), text->end(), [](unsigned char letter) { return letter < ' ' || letter == 127; }))
      refuse(fmt::format("\"{}\" has a line break or another control character, which no batch script can carry",
                         printable(*text)),
             "rename it");
  if (plan.result.find('\\') != std::string::npos)
    refuse(fmt::format("\"{}\" has a backslash, after which Slurm does not fill in the number of a task", plan.result),
           "--out a name without one");
}

std::string array_script(SlurmPlan const& plan) {
  std::string script = array_template;
  fill_in_what_both_have(script, plan);
  fill_in(script, "#SBATCH --job-name=", sbatch_word(plan.name));
  fill_in(script, "#SBATCH --array=", fmt::format("0-{}", plan.shards - 1));
  if (plan.diagnoses) fill_in(script, "command=", "diagnose");
  fill_in(script, "shards=", std::to_string(plan.shards));
  if (plan.save_every_s > 0.0) fill_in(script, "save_every=", fmt::format("{:g}", plan.save_every_s));
  fill_in(script, "#SBATCH --cpus-per-task=", std::to_string(plan.threads));
  fill_in(script, "#SBATCH --output=", sbatch_pattern(plan.result, ".shard-%a.log"));
  if (!plan.time.empty()) fill_in(script, "#SBATCH --time=", plan.time);
  return script;
}

std::string merge_script(SlurmPlan const& plan) {
  std::string script = merge_template;
  fill_in_what_both_have(script, plan);
  fill_in(script, "#SBATCH --job-name=", sbatch_word(plan.name + "-merge"));
  fill_in(script, "#SBATCH --output=", sbatch_pattern(plan.result, ".merge.log"));
  if (auto const time = merge_time(plan.result_bytes); !time.empty()) fill_in(script, "#SBATCH --time=", time);
  return script;
}

std::string merge_time(std::uintmax_t result_bytes) {
  // a tenth of what was measured (bench/README.md, "Merging"): disks of clusters are shared
  constexpr double bytes_a_second = 30e6;
  constexpr int script_minutes = 30;  // as merge.sbatch says
  auto const minutes = static_cast<std::int64_t>(std::ceil(static_cast<double>(result_bytes) / bytes_a_second / 60.0));
  if (minutes <= script_minutes) return "";
  return fmt::format("{}-{:02}:{:02}:00", minutes / (24 * 60), minutes / 60 % 24, minutes % 60);
}

}  // namespace torquescope
