#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "engine/app/commands/command.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/workflows/drafts/arm_draft.hpp"
#include "engine/workflows/drafts/job_draft.hpp"
#include "engine/workflows/drafts/joint_choice.hpp"

namespace torquescope {

namespace {

struct InitArguments {
  std::vector<std::string> recordings{};
  std::string out{};
  std::string joint{}, robot{};
  RobotPart part{};
  bool servo = false;
  std::string time{}, position{}, torque{}, reference{};

  ChosenColumns named() const {
    ChosenColumns all{{"time", time}, {"position", position}, {"torque", torque}, {"reference", reference}};
    std::erase_if(all, [](auto const& one) { return one.second.empty(); });
    return all;
  }
};

// only ever a new file: a job may hold a day's work
void write_new_file(std::string const& name, std::string const& text) {
  int const file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  validate(file >= 0, [&] {
    Problem problem;
    problem.code = errno == EEXIST ? ExitCode::exists : ExitCode::io;
    problem.what = errno == EEXIST ? fmt::format("{} exists", name)
                                   : fmt::format("cannot write {}: {}", name, std::strerror(errno));
    problem.help =
        errno == EEXIST ? fmt::format("--out another name, or delete {}", name) : "choose another place for --out";
    return problem;
  });
  ssize_t const written = ::write(file, text.data(), text.size());
  bool const closed = ::close(file) == 0;
  validate(written == static_cast<ssize_t>(text.size()) && closed, [&] {
    Problem problem;
    problem.code = ExitCode::io;
    problem.what = fmt::format("cannot write {}: {}", name, std::strerror(errno));
    problem.help = "free space or choose another place for --out";
    return problem;
  });
}

// `> arm.toml`: the job's paths are relative to that file, and messages name it; "job.toml" for a pipe or a terminal
std::string file_behind_stdout() {
  std::error_code none;
  auto const file = std::filesystem::read_symlink("/proc/self/fd/1", none);
  if (none || !std::filesystem::is_regular_file(file, none)) return "job.toml";
  return std::filesystem::proximate(file, none).string();
}

ExitCode init_job(InitArguments const& arguments, Session const& session) {
  std::string const job = arguments.out.empty() ? file_behind_stdout() : arguments.out;
  std::vector<std::filesystem::path> const recordings(arguments.recordings.begin(), arguments.recordings.end());
  JobDraft const draft =
      arguments.robot.empty()
          ? draft_job(recordings, job, joint_number(recordings.front(), arguments.joint),
                      arguments.servo ? DraftKind::servo : DraftKind::of_the_files, arguments.named())
          : draft_arm_job(recordings, arguments.robot, job, arguments.part);
  if (arguments.out.empty())
    session.verdict(draft.text);
  else
    write_new_file(arguments.out, draft.text);
  for (auto const& guess : draft.guesses) session.note(session.topic_line("guessed", guess));
  for (auto const& look : draft.looks) session.note(session.topic_line("column", look));
  for (auto const& warning : draft.warnings) session.note(session.topic_line("warning", warning));
  if (!arguments.out.empty()) session.note(session.topic_line("wrote", arguments.out));
  session.note(session.topic_line("next", fmt::format("torquescope check {0}, torquescope diagnose {0}", job)));
  return draft.code;
}

}  // namespace

void add_init(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<InitArguments>();
  CLI::App* command = app.add_subcommand(
      "init", "Drafts a job for your own recordings: guesses columns, units, filters; comments say how sure.");
  command->footer(
      "  torquescope init arm.csv > arm.toml\n"
      "  torquescope init --robot arm.urdf monday.h5 --out arm.toml\n"
      "  torquescope init --servo train/*.csv --out servo.toml\n");
  command
      ->add_option(
          "REC.csv", arguments->recordings,
          "recordings, CSV, HDF5 or MATLAB; the first trains the model, the others validate it. Of a servo with a "
          "commanded position and no torque: as many as there are")
      ->required()
      ->type_name("FILE");
  auto* const joint = command
                          ->add_option("--joint", arguments->joint,
                                       "of a file with several joints: its number in the file, from 1, or its name "
                                       "[the first that moves]")
                          ->type_name("N|NAME")
                          ->group("recording");
  auto* const robot =
      command
          ->add_option(
              "--robot", arguments->robot,
              "a job for a whole arm: its URDF or robot file, whose joints the columns are named or numbered after")
          ->type_name("ROBOT")
          ->excludes(joint)
          ->group("recording");
  command->add_option("--root", arguments->part.root, "link of the robot that stands still, with all before it")
      ->type_name("LINK")
      ->needs(robot)
      ->group("recording");
  command->add_option("--tip", arguments->part.tip, "link of the robot where the arm ends")
      ->type_name("LINK")
      ->needs(robot)
      ->group("recording");
  struct Channel {
    char const* option;
    std::string* column;
    char const* says;
  };
  for (auto const& channel : {Channel{"--position", &arguments->position, "the column of the measured position"},
                              Channel{"--torque", &arguments->torque, "of the torque, or the motor's current"},
                              Channel{"--reference", &arguments->reference, "of the commanded position"},
                              Channel{"--time", &arguments->time, "of the time stamps"}})
    command->add_option(channel.option, *channel.column, channel.says)->type_name("COLUMN")->group("recording");
  command
      ->add_flag("--servo", arguments->servo,
                 "a job of many recordings of a servo ([[recordings]]), even where a column may be a torque")
      ->group("recording");
  command
      ->add_option("-o,--out", arguments->out,
                   "the job, a file that does not exist yet; one that does not run as it stands is written as well, "
                   "with exit code 65 (its recording) or 78 (lines to edit) [standard output]")
      ->type_name("JOB.toml")
      ->group("results");
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return init_job(*arguments, session); };
  });
}

}  // namespace torquescope
