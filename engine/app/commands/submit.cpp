#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/commands/slurm_scripts.hpp"
#include "engine/base/error.hpp"
#include "engine/store/temp_file.hpp"

namespace torquescope {

namespace {

struct SubmitArguments {
  std::string job;
  std::string out{};
  std::int64_t shards = 0;
  int threads = 0;
  std::string time{}, partition{};
  double save_every_s = 0.0;  // 0: not given
  bool dry_run = false;
};

std::string this_program() {
  std::error_code failed;
  auto const path = std::filesystem::read_symlink("/proc/self/exe", failed);
  return failed ? "torquescope" : path.string();
}

Error not_submitted(std::string const& what) {
  return Error(
      Problem{.code = ExitCode::no_input,
              .what = "sbatch did not take the job: " + what,
              .help = "run this where Slurm is, or --dry-run to see the scripts, or jobs/slurm/*.sbatch to edit"});
}

// the number of the job that sbatch made
std::string sbatch(std::string const& options, std::filesystem::path const& script) {
  std::string const command = "sbatch --parsable " + options + " " + shell_word(script.string()) + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw not_submitted("no process can be started");
  std::string said;
  char piece[256];
  while (std::fgets(piece, sizeof(piece), pipe)) said += piece;
  int const status = ::pclose(pipe);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  // "1234" or "1234;cluster"; Slurm may warn in lines before it
  std::string const last = said.substr(said.rfind('\n') + 1);
  std::string const number = last.substr(0, last.find(';'));
  bool const is_number = !number.empty() && std::all_of(number.begin(), number.end(),
                                                        [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !is_number) throw not_submitted(said);
  return number;
}

void write_script(std::filesystem::path const& name, std::string const& text) {
  TempFile file(name);
  file.write_at(0, text.data(), text.size());
  file.publish();
}

ExitCode submit_job(SubmitArguments const& arguments, Session const& session) {
  // everything that can be refused is refused here and not in the queue
  Experiment const experiment = Experiment::load(arguments.job);
  std::filesystem::path const result =
      arguments.out.empty() ? experiment.output_file() : std::filesystem::path(arguments.out);
  SlurmPlan plan;
  plan.program = this_program();
  plan.job = arguments.job;
  plan.result = result.string();
  plan.name = experiment.name();
  plan.shards = arguments.shards;
  plan.threads = std::max(1, arguments.threads);
  plan.time = arguments.time;
  plan.partition = arguments.partition;
  plan.save_every_s = arguments.save_every_s;
  std::string const array_name = result.string() + ".array.sbatch", merge_name = result.string() + ".merge.sbatch";
  if (arguments.dry_run) {
    session.result(fmt::format("# {}\n{}\n# {}\n{}", array_name, array_script(plan), merge_name, merge_script(plan)));
    return ExitCode::ok;
  }
  write_script(array_name, array_script(plan));
  write_script(merge_name, merge_script(plan));
  std::string const array = sbatch("", array_name);
  std::string const merge = sbatch("--dependency=afterok:" + array, merge_name);
  session.note(session.topic_line(
      "queued", fmt::format("{} shards as job {}, merge as job {} when all are done", plan.shards, array, merge)));
  session.note(session.topic_line("look", "torquescope status " + result.string()));
  return ExitCode::ok;
}

std::string no_shard_count(std::string const& text) {
  bool const fits = !text.empty() && text.size() <= 5 && text.front() != '0' &&
                    std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return fits ? "" : fmt::format("\"{}\" is no number of shards from 1 to 99999", text);
}

// a value must not end its line and begin a command
std::string no_plain_word(std::string const& text) {
  bool const fits = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ':' || c == '-' || c == '_' || c == ',' || c == '.';
  });
  return fits ? "" : fmt::format("\"{}\" holds letters that no Slurm option has", text);
}

}  // namespace

void add_submit(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<SubmitArguments>();
  CLI::App* command = app.add_subcommand(
      "submit", "Hands a job to Slurm: an array of shards that survives kills, and a merge when all are done.");
  command->footer(
      "  torquescope submit lab.toml --shards 8 --threads 4 --time 02:00:00\n"
      "  torquescope submit lab.toml --shards 8 --dry-run\n"
      "  torquescope status lab.h5\n");
  command->add_option("JOB.toml", arguments->job, "job file, TOML (torquescope list sections)")->required();
  add_result_option(*command, arguments->out);
  command
      ->add_option("--shards", arguments->shards, "tasks of the array; each does every Nth run, in minutes not seconds")
      ->type_name("N")
      ->required()
      ->check(no_shard_count)
      ->group("cluster");
  command->add_option("--time", arguments->time, "limit of one task; more is asked for by requeueing [02:00:00]")
      ->type_name("H:M:S")
      ->check(no_plain_word)
      ->group("cluster");
  command->add_option("--partition", arguments->partition, "where to run")
      ->type_name("NAME")
      ->check(no_plain_word)
      ->group("cluster");
  command->add_flag("--dry-run", arguments->dry_run, "print both scripts, submit nothing")->group("cluster");
  add_seconds_option(*command, "--save-every", arguments->save_every_s,
                     "seconds between two segments: what a kill may cost [20]");
  add_threads_option(*command, arguments->threads);
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return submit_job(*arguments, session); };
  });
}

}  // namespace torquescope
