// The engine as the Python module torquescope._engine: jobs and arrays in, result files and plain values out.
//
// Arrays     float64, one dimension, copied on the way in
// Errors     Error becomes what torquescope.errors makes of the text and the JSON that the program would print
// Threads    the GIL is released wherever the engine reads, works or waits

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <exception>
#include <string_view>
#include <utility>

#include "engine/app/failure.hpp"
#include "engine/app/terminal/error_text.hpp"
#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"
#include "engine/base/version.hpp"
#include "engine/experiment/catalogue.hpp"
#include "engine/experiment/robot_description.hpp"
#include "engine/python/work.hpp"
#include "engine/workflows/drafts/job_draft.hpp"
#include "engine/workflows/drafts/joint_choice.hpp"
#include "engine/workflows/workflows.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace torquescope {
namespace {

using Column = nb::ndarray<double const, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Table = std::vector<std::pair<std::string, Column>>;

RecordedTables tables_of(std::map<std::string, Table> const& recordings) {
  RecordedTables tables;
  for (auto const& [name, table] : recordings) {
    NamedColumns columns;
    for (auto const& [column, values] : table)
      columns.emplace_back(column, std::vector<double>(values.data(), values.data() + values.size()));
    tables.emplace(name, table_in_memory(name, std::move(columns)));
  }
  return tables;
}

// owned by Python from here on
nb::object as_array(std::vector<double> values) {
  auto* const owned = new std::vector<double>(std::move(values));
  nb::capsule const owner(owned, [](void* data) noexcept { delete static_cast<std::vector<double>*>(data); });
  return nb::cast(nb::ndarray<nb::numpy, double, nb::ndim<1>>(owned->data(), {owned->size()}, owner));
}

nb::dict columns_of_file(std::filesystem::path const& path) {
  RawTable table;
  {
    nb::gil_scoped_release const released;
    table = read_table(path, {"recording", {}, {}});
  }
  nb::dict columns;
  for (std::size_t c = 0; c < table.names.size(); ++c)
    columns[table.names[c].c_str()] = as_array(std::move(table.columns[c]));
  return columns;
}

nb::dict robot_facts(std::filesystem::path const& path) {
  RobotDescription const robot = describe_robot(path);
  nb::list joints, parameters;
  for (auto const& joint : robot.joints) {
    nb::dict one;
    one["name"] = joint.name;
    one["kind"] = joint.kind;
    one["lower"] = joint.lower;
    one["upper"] = joint.upper;
    one["max_speed"] = joint.max_speed;
    one["max_acceleration"] = joint.max_acceleration;
    one["max_torque"] = joint.max_torque;
    one["gear_ratio"] = joint.gear_ratio;
    one["drive_inertia"] = joint.drive_inertia;
    joints.append(one);
  }
  for (auto const& parameter : robot.parameters)
    parameters.append(nb::make_tuple(parameter.name, parameter.sum, parameter.unit));
  nb::dict facts;
  facts["name"] = robot.name;
  facts["mass"] = robot.mass;
  facts["joints"] = joints;
  facts["parameters"] = parameters;
  facts["warnings"] = robot.warnings;
  facts["remarks"] = robot.remarks;
  return facts;
}

nb::list catalogue_entries() {
  nb::list entries;
  for (auto const& entry : catalogue()) {
    nb::list options;
    for (auto const& option : entry.options)
      options.append(
          nb::make_tuple(option.key, option.type, option.unit, option.range, option.default_value, option.meaning));
    entries.append(nb::make_tuple(entry.name, entry.kind, entry.title, entry.text, options));
  }
  return entries;
}

char const* level_word(CheckLine const& line) {
  constexpr char const* words[] = {"ok", "note", "warn", "fault"};
  return words[static_cast<int>(line.level)];
}

std::vector<std::tuple<std::string, std::string, std::string>> check_job(JobSource const& source,
                                                                         RecordedTables const& tables, int threads) {
  nb::gil_scoped_release const released;
  Experiment const experiment = Experiment::load(read_source(source), Experiment::Purpose::check, tables);
  std::vector<std::tuple<std::string, std::string, std::string>> lines;
  for (auto const& line : experiment.check(choose_threads(threads).count))
    lines.emplace_back(level_word(line), line.topic, line.text);
  return lines;
}

// the package writes the job of a call with arrays: its lines are no text of whoever called
void forget_unwritten_places(std::vector<Problem>& problems) {
  constexpr std::string_view unnamed_job = "<job>";  // scripts/report/torquescope/engine.py
  for (auto& problem : problems)
    if (problem.place.file == unnamed_job) problem.place = {};
}

void translate(std::exception_ptr const& thrown, void*) {
  std::vector<Problem> problems;
  try {
    std::rethrow_exception(thrown);
  } catch (Error const&) {
    problems = problems_of(thrown);
  } catch (BrokenPromise const&) {
    problems = problems_of(thrown);
  }
  forget_unwritten_places(problems);
  nb::object const error = nb::module_::import_("torquescope.errors")
                               .attr("from_engine")(error_text(problems, Ink(false)), error_json(problems));
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
}

bool wait_for(Work const& work, double seconds) {
  nb::gil_scoped_release const released;
  return work.wait(seconds);
}

nb::tuple progress_of(Work const& work) {
  ProgressUpdate const update = work.progress();
  return nb::make_tuple(update.stage, update.counted, update.runs_done, update.runs_total, update.seconds,
                        update.expected_seconds);
}

std::unique_ptr<Work> begin(bool diagnoses, std::filesystem::path const& path, std::optional<std::string> text,
                            std::map<std::string, Table> const& recordings, std::filesystem::path const& output,
                            int threads) {
  auto const kind = diagnoses ? WorkKind::diagnose : WorkKind::identify;
  return std::make_unique<Work>(WorkOrder{kind, {path, std::move(text)}, tables_of(recordings), output, threads});
}

}  // namespace
}  // namespace torquescope

NB_MODULE(_engine, module) {
  using namespace torquescope;
  module.attr("__version__") = torquescope::version;
  nb::register_exception_translator(translate);

  nb::class_<Work>(module, "Work", nb::is_weak_referenceable(), "A run or a diagnosis in a thread of its own.")
      .def("wait", &wait_for, "seconds"_a, "Whether it has ended.")
      .def("stop", &Work::stop, "Ask it to stop; it ends at its next step.")
      .def("progress", &progress_of, "(stage, what is counted, done, total, seconds, expected seconds)")
      .def("take_messages", &Work::take_messages, "(topic, text) of what was said since the last call.")
      .def("finish", &Work::finish, "Raise what ended it, if anything did.");
  module.def("begin", &begin, "diagnoses"_a, "path"_a, "text"_a.none(), "recordings"_a, "output"_a, "threads"_a,
             "Begin a diagnosis, or a run, of a job: of `text`, else of the file `path`.");
  module.def(
      "check",
      [](std::filesystem::path const& path, std::optional<std::string> text,
         std::map<std::string, Table> const& recordings, int threads) {
        return check_job({path, std::move(text)}, tables_of(recordings), threads);
      },
      "path"_a, "text"_a.none(), "recordings"_a, "threads"_a, "(level, topic, text) of everything `check` says.");
  module.def(
      "simulate",
      [](std::filesystem::path const& path, std::optional<std::string> text, std::filesystem::path const& output) {
        nb::gil_scoped_release const released;
        simulate_recording(read_source({path, std::move(text)}), output);
      },
      "path"_a, "text"_a.none(), "output"_a, "Write the recording that a job's [simulate] describes.");
  module.def("columns_of_file", &columns_of_file, "path"_a, "Columns of numbers of a recording, by name.");
  module.def(
      "draft_job",
      [](std::filesystem::path const& path, std::string const& joint) {
        JobDraft const draft = draft_job({path}, "job.toml", joint_number(path, joint));
        return std::make_tuple(draft.text, draft.guesses, draft.warnings);
      },
      "path"_a, "joint"_a, "(text, guesses, warnings) of what `torquescope init` says of a recording.");
  module.def("robot_facts", &robot_facts, "path"_a, "What a robot file says: joints, base parameters.");
  module.def("catalogue", &catalogue_entries, "(name, kind, title, text, options) of everything a job can name.");
}
