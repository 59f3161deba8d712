#include "engine/workflows/results/estimator_writer.hpp"

#include <algorithm>

#include "engine/base/torque_unit.hpp"
#include "engine/effects/joint_form.hpp"
#include "engine/store/scale_datasets.hpp"
#include "engine/workflows/results/model_code.hpp"

namespace torquescope {

namespace {

std::string group_of(std::string const& label) { return "/runs/" + label; }

// "N m" -> "(N m)2", "N" -> "N2", "1" -> "1"
std::string squared(std::string const& unit) {
  if (unit == "1") return unit;
  return unit.find(' ') == std::string::npos ? unit + "2" : "(" + unit + ")2";
}

struct HistoryDataset {
  char const* name;
  Note note;
};

std::vector<HistoryDataset> per_generation(std::string const& torque_unit) {
  return {
      {"F", {"1", "mutation factor"}},
      {"CR", {"1", "crossover rate"}},
      {"PC", {"1", "parameter change", "FADE eq. 8"}},
      {"FC", {"1", "function value change", "FADE eq. 8"}},
      {"best", {squared(torque_unit), "best fitness so far, as MSE"}},
      {"gap_history", {squared(torque_unit), "best MSE above the least-squares floor"}},
  };
}

// [run]
void write_per_run(ResultWriter& writer, std::string const& path, std::vector<double> const& values, Note const& note) {
  writer.numbers(path, {values.size()}, values, note.over({"run"}));
}

// [run][width], the width's labels being the scale `labels`
void write_vectors(ResultWriter& writer, std::string const& path, std::vector<Eigen::VectorXd> const& vectors,
                   Note const& note, std::string const& labels) {
  std::vector<double> rows;
  for (auto const& vector : vectors) rows.insert(rows.end(), vector.begin(), vector.end());
  writer.numbers(path, {vectors.size(), static_cast<std::size_t>(vectors.front().size())}, rows,
                 note.over({"run", labels}));
}

void write_summary(ResultWriter& writer, std::string const& group, RunResults const& all) {
  // of a partial merge: of the runs that are there (not one: NaN, as everything that is absent)
  auto const present = all.present();
  bool const whole = present.size() == all.runs() || present.empty();
  RunResults const some = whole ? RunResults() : all.only(present);
  RunResults const& results = whole ? all : some;
  if (present.size() < all.runs())
    writer.attribute(group, "missing_runs", static_cast<std::int64_t>(all.runs() - present.size()));
  auto const mse = RunResults::each(results.train, &PredictionMetrics::mse);
  writer.attribute(group, "runs", static_cast<std::int64_t>(all.runs()));
  writer.attribute(group, "mse_median", median(mse));
  writer.attribute(group, "mse_best", *std::min_element(mse.begin(), mse.end()));
  writer.attribute(group, "mse_worst", *std::max_element(mse.begin(), mse.end()));
  writer.attribute(group, "mse_std", standard_deviation(mse));
  writer.attribute(group, "gap_median", median(results.gap));
  writer.attribute(group, "relerr_median", median(RunResults::each(results.train, &PredictionMetrics::relerr)));
  writer.attribute(group, "residual_std_median",
                   median(RunResults::each(results.train, &PredictionMetrics::residual_std)));
  if (!results.validate.empty())
    writer.attribute(group, "validation_relerr_median",
                     median(RunResults::each(results.validate, &PredictionMetrics::relerr)));
  std::size_t const median_run = lower_median_index(results.gap);
  writer.attribute(group, "median_run", static_cast<std::int64_t>(whole ? median_run : present[median_run]));
  std::int64_t evaluations = 0, nonfinite = 0;
  for (std::size_t run = 0; run < results.runs(); ++run) {
    evaluations += results.evaluations[run];
    nonfinite += results.nonfinite[run];
  }
  writer.attribute(group, "evaluations_total", evaluations);
  writer.attribute(group, "nonfinite_total", nonfinite);
  Eigen::VectorXd const average = mean(results.parameters);
  writer.attribute(group, "parameters_mean", std::vector<double>(average.begin(), average.end()));
}

}  // namespace

void declare_histories(ResultWriter& writer, std::string const& label, HistoryShape const& shape,
                       StoredGenerations const& stored, std::string const& torque_unit) {
  std::string const group = group_of(label) + "/";
  std::size_t const generations = stored.count();
  if (shape.members > 0) {
    writer.declare_runs(group + "population", shape.runs, {generations, shape.members, shape.parameters},
                        Note{"SI", "population after selection"}.over({"run", "generation", "member", "parameter"}));
    writer.declare_runs(group + "fitness", shape.runs, {generations, shape.members},
                        Note{"1", "fitness of the population"}.over({"run", "generation", "member"}));
    write_index(writer, group_of(label), "member", shape.members);
  }
  std::vector<std::int64_t> numbers;
  for (std::size_t entry = 0; entry < generations; ++entry)
    numbers.push_back(static_cast<std::int64_t>(stored.number(entry)));
  write_numbers(writer, group_of(label), "generation", numbers);
  for (auto const& dataset : per_generation(torque_unit))
    writer.declare_runs(group + dataset.name, shape.runs, {generations}, dataset.note.over({"run", "generation"}));
  writer.declare_runs(group + "evaluations", shape.runs, {generations},
                      Note{"1", "evaluations so far"}.over({"run", "generation"}), RunValues::whole_number);
}

void write_history(ResultWriter& writer, std::string const& label, std::size_t run,
                   std::shared_ptr<RunHistory const> const& history) {
  std::string const group = group_of(label) + "/";
  for (auto const& list : history_lists)
    if (auto const& values = (*history).*list.values; !values.empty())
      writer.write_run(group + list.name, run, values, history);
  writer.write_run(group + "evaluations", run, history->evaluations);
}

void write_histories(ResultWriter& writer, std::string const& label, std::size_t first, StoredRuns const& runs) {
  std::string const group = group_of(label) + "/";
  std::vector<ResultWriter::RunsOfList> lists;
  for (std::size_t i = 0; i < history_lists.size(); ++i)
    if (auto const& list = runs.histories[i]; !list.values.empty())
      lists.push_back({group + history_lists[i].name, h5::Element::number, std::as_bytes(list.values), list.owner});
  lists.push_back({group + "evaluations", h5::Element::whole_number, std::as_bytes(runs.evaluations.values),
                   runs.evaluations.owner});
  writer.write_runs(first, runs.count, lists);
}

void write_ends(ResultWriter& writer, std::string const& label, std::vector<std::int64_t> const& last_generations) {
  writer.whole_numbers(group_of(label) + "/last_generation", {last_generations.size()}, last_generations,
                       Note{"1", "last generation of each run"}.over({"run"}));
}

void write_results(ResultWriter& writer, EstimatorPlan const& plan, RunResults const& results,
                   std::string const& torque_unit, std::vector<std::string> const& parameters) {
  std::string const group = group_of(plan.label);
  writer.attribute(group, "kind", plan.kind);
  writer.attribute(group, "title", plan.title);
  for (auto const& [key, value] : plan.options) writer.attribute(group, key, value);
  if (!plan.start.empty()) writer.attribute(group, "start", plan.start);
  write_index(writer, group, "run", results.runs());
  write_names(writer, group, "parameter", parameters);
  write_vectors(writer, group + "/parameters", results.parameters, {"SI", "estimated parameters"}, "parameter");
  auto const metric = [&](char const* name, double PredictionMetrics::*member, Note const& note) {
    write_per_run(writer, group + "/" + name, RunResults::each(results.train, member), note);
  };
  metric("mse", &PredictionMetrics::mse, {squared(torque_unit), "mean squared error"});
  metric("sse", &PredictionMetrics::sse, {squared(torque_unit), "sum of squared errors", "seed eq. 10"});
  metric("relerr", &PredictionMetrics::relerr, {"1", "relative error"});
  metric("residual_std", &PredictionMetrics::residual_std, {torque_unit, "standard deviation of the residual"});
  metric("residual_mean", &PredictionMetrics::residual_mean, {torque_unit, "mean residual"});
  if (!results.validate.empty())
    write_per_run(writer, group + "/validation_relerr", RunResults::each(results.validate, &PredictionMetrics::relerr),
                  {"1", "relative error on validation data"});
  Note const gap{squared(torque_unit), "MSE above the least-squares floor"}, fitness{"1", "fitness of the rollouts"};
  write_per_run(writer, group + "/gap", results.gap, plan.rolls_out() ? fitness : gap);
  writer.texts(group + "/stop_reason", results.stop_reason, Note{"1", "why each run ended"}.over({"run"}));
  write_summary(writer, group, results);
}

void write_model_code(ResultWriter& writer, std::string const& label, Regressor const& regressor,
                      std::string const& torque_unit, RunResults const& results) {
  if (results.runs() == 0 || results.present().size() < results.runs()) return;
  Eigen::VectorXd const& values = results.parameters[lower_median_index(results.gap)];
  std::vector<ParameterEstimate> parameters;
  auto const names = regressor.names(), units = regressor.units();
  for (std::size_t k = 0; k < names.size(); ++k)
    parameters.push_back({names[k], in_torque_unit(units[k], torque_unit), values[static_cast<Eigen::Index>(k)]});
  auto const effects = estimated_effects(parameters);
  JointKind const joint = regressor.joint();
  writer.attribute(group_of(label), "model_c",
                   c_text(effects, {}, {joint, torque_unit, "joint_" + effort_word(joint)}));
  writer.attribute(group_of(label), "model_mjcf", mjcf_joint(effects, {joint, torque_unit, "joint"}));
}

void write_fitness_choice(ResultWriter& writer, std::string const& label, FitnessChoice const& choice) {
  std::string const group = group_of(label);
  writer.attribute(group, "fitness_used",
                   std::string(choice.by_rollouts       ? "rollout"
                               : choice.from_statistics ? "gram"
                                                        : "direct"));
  writer.attribute(group, "fitness_reason", choice.words);
}

void write_least_squares(ResultWriter& writer, std::string const& label, LeastSquaresFit const& fit,
                         JointForm const* form) {
  std::string const group = group_of(label);
  if (!fit.remark.empty()) writer.attribute(group, "remark", fit.remark);
  write_vectors(writer, group + "/standard_error", {fit.standard_error}, {"SI", "standard error", "Newey-West"},
                "parameter");
  write_vectors(writer, group + "/standard_error_naive", {fit.standard_error_naive},
                {"SI", "standard error if residuals were white"}, "parameter");
  auto const n = static_cast<std::size_t>(fit.parameters.size());
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> const intervals = fit.ci95;
  writer.numbers(group + "/ci95", {1, n, 2}, {intervals.data(), 2 * n},
                 Note{"SI", "95 % interval"}.over({"run", "parameter", "bound"}));
  write_bounds(writer, group);
  if (!fit.standard.names.empty()) {
    write_names(writer, group, "standard", fit.standard.names);
    write_vectors(writer, group + "/standard_parameters", {fit.standard.values},
                  {"SI", "masses, first moments and inertias of every link, about its frame; drive inertias"},
                  "standard");
  }
  if (!form) return;
  write_names(writer, group, "form", form->names);
  write_vectors(writer, group + "/joint_form", {form->values(fit.parameters)}, {"SI", "equivalent form"}, "form");
  write_vectors(writer, group + "/joint_form_standard_error", {form->standard_errors(fit.covariance_hac)},
                {"SI", "standard error of the equivalent form"}, "form");
}

}  // namespace torquescope
