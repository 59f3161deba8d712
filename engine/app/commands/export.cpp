#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "engine/app/commands/command.hpp"
#include "engine/app/result/result_summary.hpp"
#include "engine/app/result/result_tables.hpp"
#include "engine/workflows/results/arm_export.hpp"
#include "engine/workflows/results/diagnosis_reader.hpp"
#include "engine/workflows/results/model_code.hpp"
#include "engine/workflows/results/servo_code.hpp"
#include "engine/workflows/results/servo_reader.hpp"

namespace torquescope {

namespace {

struct ExportArguments {
  std::string file, estimator;
  std::map<std::string, std::string> out;  // by format
  bool near_cad = false;
};

EstimatorSummary const& chosen_estimator(ResultSummary const& summary, std::string const& name) {
  for (auto const& estimator : summary.estimators)
    if (name.empty() || estimator.name == name) return estimator;
  Problem problem;
  problem.code = ExitCode::usage;
  problem.what = fmt::format("{} has no estimator \"{}\"", summary.file.string(), name);
  for (auto const& estimator : summary.estimators) problem.notes.push_back(estimator.name);
  problem.help = "name one of these with --estimator, or leave it out for the first";
  throw Error(std::move(problem));
}

void write_text(std::string const& file, std::string const& text, Session const& session) {
  if (file == "-") {
    session.verdict(text);
    return;
  }
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  validate(stream.good(), [&] {
    return Problem{
        .code = ExitCode::io, .what = file + " cannot be written", .help = "look at its folder and the disk"};
  });
}

// one that the kind of result has, or error 64 that says which it has
template <class Formats>
void check_formats(ExportArguments const& arguments, Formats const& formats, std::string const& what,
                   std::string const& help) {
  for (auto const& [name, file] : arguments.out) {
    bool const is_there =
        std::any_of(formats.begin(), formats.end(), [&](auto const& format) { return format.name == name; });
    validate(is_there, [&] {
      return Problem{.code = ExitCode::usage,
                     .what = fmt::format("{} is {}, which has no --{}", arguments.file, what, name),
                     .help = help};
    });
  }
}

ExitCode export_models(ExportArguments const& arguments, Diagnosis const& diagnosis, Session const& session) {
  check_formats(arguments, model_writers(), "a diagnosis of joints",
                "its models are written by --c, --json and --mjcf; a robot file needs the result of torquescope run of "
                "an arm");
  validate(arguments.estimator.empty() && !arguments.near_cad, [&] {
    return Problem{.code = ExitCode::usage,
                   .what = arguments.file + " is a diagnosis, which has neither estimators nor a robot file's bodies",
                   .help = "leave --estimator and --cad out"};
  });
  for (auto const& writer : model_writers()) {
    auto const out = arguments.out.find(writer.name);
    if (out == arguments.out.end()) continue;
    write_text(out->second, writer.write(diagnosis), session);
    if (out->second != "-") session.note(session.topic_line("wrote", out->second));
  }
  return ExitCode::ok;
}

struct ServoFormat {
  std::string name;
  std::string (*write)(std::string const& document);
};

ExitCode export_servo(ExportArguments const& arguments, Session const& session) {
  static std::vector<ServoFormat> const formats{{"c", servo_c}, {"toml", servo_toml}};
  check_formats(arguments, formats, "a diagnosis of a set of recordings",
                "its model is written by --c and --toml; torquescope show R.h5 --json - has its numbers");
  look_at_result(arguments.file, [](ResultReader const& there) { read_servo(there); });
  std::string const document = read_servo(ResultReader(arguments.file)).json;
  for (auto const& format : formats) {
    auto const out = arguments.out.find(format.name);
    if (out == arguments.out.end()) continue;
    write_text(out->second, format.write(document), session);
    if (out->second != "-") session.note(session.topic_line("wrote", out->second));
  }
  return ExitCode::ok;
}

ExitCode export_result(ExportArguments const& arguments, Session const& session) {
  validate(!arguments.out.empty(), [] {
    return Problem{.code = ExitCode::usage,
                   .what = "export needs a format",
                   .help =
                       "torquescope export arm.h5 --urdf arm.urdf; --toml, --json and --mjcf likewise. Of a "
                       "diagnosis: --c model.c; --json and --mjcf likewise"};
  });
  look_at_result(arguments.file, [](ResultReader const& there) { has_servo(there); });
  if (has_servo(ResultReader(arguments.file))) return export_servo(arguments, session);
  auto const summary = read_summary(arguments.file);
  if (summary.has_diagnosis) {
    look_at_result(summary.file, [](ResultReader const& there) { read_diagnosis(there); });
    return export_models(arguments, read_diagnosis(ResultReader(summary.file)), session);
  }
  look_at_result(summary.file, [](ResultReader const& there) { read_identified_arm(there); });
  auto const arm = read_identified_arm(ResultReader(summary.file));
  check_formats(arguments, export_formats(), "an identified arm",
                "its robot file is written by --urdf, --toml, --json and --mjcf; functions in C are of a diagnosis: "
                "torquescope diagnose JOB.toml --out told.h5");
  if (!arm.has_limits)
    session.note(session.topic_line("warning",
                                    "this result is of an earlier version, which kept neither limits nor "
                                    "gears: run its job again to have them in the exported file"));
  auto const& estimator = chosen_estimator(summary, arguments.estimator);
  ArmEstimate const estimate{
      summary.names,
      Eigen::VectorXd::Map(estimator.parameters.data(), static_cast<Eigen::Index>(estimator.parameters.size())),
      read_standard_parameters(ResultReader(arguments.file), estimator.name)};
  session.note(session.topic_line("values", "of " + column_title(estimator)));
  auto const near = arguments.near_cad ? NearBodies::robot_file : NearBodies::cubes;
  bool first = true;
  for (auto const& [format, file] : arguments.out) {
    auto const written = export_arm(arm, estimate, format, near);
    write_text(file, written.text, session);
    if (file != "-") session.note(session.topic_line("wrote", file));
    for (auto const& note : written.notes)
      if (first) session.note(session.topic_line("numbers", note));
    first = false;
  }
  return ExitCode::ok;
}

}  // namespace

void add_export(CLI::App& app, ChosenCommand& chosen) {
  auto const arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Writes the arm of a result as a robot file, the models of a diagnosis as C.");
  command->footer(
      "  torquescope export arm.h5 --urdf arm.urdf\n"
      "  torquescope export diagnosis.h5 --c model.c\n"
      "  torquescope export servos.h5 --c servo.c --toml servo.toml\n");
  command
      ->add_option("R.h5", arguments->file,
                   "result file of torquescope run of an arm, or of torquescope diagnose, HDF5")
      ->required();
  command->add_option("--estimator", arguments->estimator, "whose parameters; the first by default")->group("results");
  command
      ->add_flag("--cad", arguments->near_cad, "masses and inertias left open stay near those of the job's robot file")
      ->group("results");
  std::vector<ExportFormat> formats = export_formats();
  for (auto const& format : model_writers()) {
    auto const same = std::find_if(formats.begin(), formats.end(), [&](auto& one) { return one.name == format.name; });
    if (same == formats.end())
      formats.push_back({format.name, format.meaning});
    else
      same->meaning += ", or " + format.meaning;
  }
  for (auto const& format : formats)
    command
        ->add_option_function<std::string>(
            "--" + format.name,
            [arguments, name = format.name](std::string const& file) { arguments->out[name] = file; },
            "write " + format.meaning + "; - is stdout")
        ->type_name("FILE")
        ->group("results");
  add_quiet_option(*command, chosen);
  add_colour_option(*command, chosen);
  command->callback([arguments, &chosen] {
    chosen.work = [arguments](Session const& session) { return export_result(*arguments, session); };
  });
}

}  // namespace torquescope
