#include "engine/app/commands/slurm_scripts.hpp"

#include <fmt/format.h>

#include "engine/base/contract.hpp"

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

// what sbatch reads as a value without quotes
std::string plain(std::string text) {
  for (char& letter : text)
    if (letter <= ' ' || letter == '%' || letter == '"' || letter == '\'' || letter == '\\') letter = '_';
  return text;
}

}  // namespace

std::string shell_word(std::string const& text) {
  std::string word = "'";
  for (char const letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

std::string array_script(SlurmPlan const& plan) {
  std::string script = array_template;
  fill_in_what_both_have(script, plan);
  fill_in(script, "#SBATCH --job-name=", plain(plan.name));
  fill_in(script, "#SBATCH --array=", fmt::format("0-{}", plan.shards - 1));
  fill_in(script, "shards=", std::to_string(plan.shards));
  if (plan.save_every_s > 0.0) fill_in(script, "save_every=", fmt::format("{:g}", plan.save_every_s));
  fill_in(script, "#SBATCH --cpus-per-task=", std::to_string(plan.threads));
  fill_in(script, "#SBATCH --output=", plain(plan.result) + ".shard-%a.log");
  if (!plan.time.empty()) fill_in(script, "#SBATCH --time=", plan.time);
  return script;
}

std::string merge_script(SlurmPlan const& plan) {
  std::string script = merge_template;
  fill_in_what_both_have(script, plan);
  fill_in(script, "#SBATCH --job-name=", plain(plan.name) + "-merge");
  fill_in(script, "#SBATCH --output=", plain(plan.result) + ".merge.log");
  return script;
}

}  // namespace torquescope
