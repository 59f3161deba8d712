#include "engine/app/result/result_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/app/result/arm_tables.hpp"
#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"

namespace torquescope {

namespace {

// one column of numbers: its title and a cell per kind of row
struct Column {
  std::string title;
  std::function<std::string(std::size_t)> parameter;
  std::string mse{}, train{}, validation{}, gap{}, fitness{};
};

std::string percent(double share) { return std::isnan(share) ? "" : fmt::format("{:.3g}", 100.0 * share); }

std::string short_error(double value) { return std::isnan(value) ? "" : fmt::format("{:.2g}", value); }

// whose mean square is the least there can be: an arm's rows are weighted
std::string floor_kind(ResultSummary const& summary) { return summary.arm ? "wls" : "ols"; }

bool knows_truth(ResultSummary const& summary) {
  return std::any_of(summary.truth.begin(), summary.truth.end(), [](double value) { return !std::isnan(value); });
}

// of the errors in the table: of rollouts where all estimators have it
std::string error_unit(ResultSummary const& summary) {
  std::string const unit = !summary.torque_unit.empty()   ? summary.torque_unit
                           : summary.joint == "prismatic" ? "N"
                                                          : "N m";
  if (summary.estimators.empty()) return unit;
  std::string const first = summary.estimators.front().rollout_unit;
  bool const same = std::all_of(summary.estimators.begin(), summary.estimators.end(),
                                [&](EstimatorSummary const& one) { return one.rollout_unit == first; });
  return same && !first.empty() ? first : unit;
}

std::vector<Column> columns_of_result(ResultSummary const& summary) {
  std::vector<Column> columns;
  if (summary.arm && summary.arm->seen.size() == summary.names.size())
    columns.push_back({"seen", [&](std::size_t i) { return printable(summary.arm->seen[i]); }});
  if (knows_truth(summary))
    columns.push_back({"truth", [&](std::size_t i) { return short_number(summary.truth.at(i)); }});
  for (auto const& estimator : summary.estimators) {
    bool const is_floor = estimator.kind == floor_kind(summary), rolls_out = !estimator.rollout_unit.empty();
    std::string const gap = rough_number(estimator.gap_median);
    columns.push_back({column_title(estimator), [&](std::size_t i) { return short_number(estimator.parameters.at(i)); },
                       estimator.rollout_unit.empty() || estimator.rollout_unit == error_unit(summary)
                           ? short_number(estimator.mse_median)
                           : "",
                       percent(estimator.relerr_median), percent(estimator.validation_relerr_median),
                       is_floor || rolls_out ? "" : gap, rolls_out ? short_number(estimator.gap_median) : ""});
    // sixty lines of "name error, name error" are nobody's table
    if (summary.arm && !estimator.standard_error.empty())
      columns.push_back({page_width() < widest_page ? "std. err" : "std. error",
                         [&](std::size_t i) { return short_error(estimator.standard_error.at(i)); }});
  }
  return columns;
}

std::string squared_unit(ResultSummary const& summary) {
  if (summary.arm) return "noise2";
  return fmt::format("({})2", error_unit(summary));
}

std::string gap_title(ResultSummary const& summary) {
  std::int64_t runs = 1;
  for (auto const& estimator : summary.estimators) runs = std::max(runs, estimator.runs);
  std::string const gap = summary.arm ? "gap to WLS" : "gap to OLS";
  return runs > 1 ? fmt::format("{}, median of {}", gap, runs) : gap;
}

// lines of names, units and right-aligned cells; the first line is the heading
class TableBlock {
 public:
  TableBlock(int name_width, int unit_width, std::vector<int> widths)
      : name_width_(name_width), unit_width_(unit_width), widths_(std::move(widths)) {}

  std::string line(std::string const& name, std::string const& unit, std::vector<std::string> const& cells) const {
    // without a unit the name may reach into the unit's column
    std::string text = unit.empty() ? pad_right("  " + name, name_width_ + unit_width_)
                                    : pad_right("  " + name, name_width_) + pad_right(unit, unit_width_);
    for (std::size_t c = 0; c < cells.size(); ++c) text += pad_left(cells[c], widths_[c]);
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  }

 private:
  int name_width_, unit_width_;
  std::vector<int> widths_;
};

// of a column of numbers: a sign, four digits, an exponent and what parts it from its neighbour
int cell_width(Column const& column) {
  int const least = page_width() < widest_page ? 10 : 11;
  return std::max(least, columns_of(column.title) + 2);
}

// as many columns as fit beside the names, at least one
std::size_t fitting(std::vector<Column> const& columns, std::size_t begin, int room) {
  std::size_t count = 0;
  int used = 0;
  for (std::size_t c = begin; c < columns.size(); ++c, ++count) {
    used += cell_width(columns[c]);
    if (used > room && count > 0) break;
  }
  return count;
}

using Cells = std::vector<std::string>;

std::string block_text(ResultSummary const& summary, std::vector<Column> const& columns, int name_width, int unit_width,
                       Ink const& ink) {
  std::vector<int> widths;
  for (auto const& column : columns) widths.push_back(cell_width(column));
  TableBlock const block(name_width, unit_width, widths);
  auto const cells = [&](auto&& cell_of) {
    Cells row;
    for (auto const& column : columns) row.push_back(cell_of(column));
    return row;
  };
  auto const has = [&](std::string Column::*member) {
    return std::any_of(columns.begin(), columns.end(), [&](Column const& column) { return !(column.*member).empty(); });
  };

  // heading: the experiment at the left edge, the estimators above their numbers
  std::string heading = pad_right(printable(summary.name), name_width + unit_width);
  std::string titles;
  for (std::size_t c = 0; c < columns.size(); ++c) titles += pad_left(columns[c].title, widths[c]);
  if (columns_of(heading) + columns_of(titles) > page_width())
    heading = printable(summary.name) + "\n" + std::string(static_cast<std::size_t>(name_width + unit_width), ' ');
  std::string text = ink.bold(heading + titles) + "\n";

  for (std::size_t i = 0; i < summary.names.size(); ++i)
    text += block.line(printable(summary.names[i]), printable(summary.units[i]),
                       cells([i](Column const& column) { return column.parameter(i); }));
  text += block.line("MSE", squared_unit(summary), cells([](Column const& c) { return c.mse; }));
  if (summary.has_validation) {
    text += block.line("error, train", "%", cells([](Column const& c) { return c.train; }));
    text += block.line("error, validation", "%", cells([](Column const& c) { return c.validation; }));
  }
  if (has(&Column::gap)) text += block.line(gap_title(summary), "", cells([](Column const& c) { return c.gap; }));
  if (has(&Column::fitness)) text += block.line("fitness", "", cells([](Column const& c) { return c.fitness; }));
  return text;
}

std::string standard_error_lines(ResultSummary const& summary) {
  std::string text;
  if (summary.arm) return text;
  for (auto const& estimator : summary.estimators) {
    if (estimator.standard_error.empty()) continue;
    std::string list;
    for (std::size_t i = 0; i < summary.names.size(); ++i) {
      double const error = estimator.standard_error.at(i);
      if (std::isnan(error)) continue;  // of a parameter that was left out
      list += fmt::format("{}{} {:.2g}", list.empty() ? "" : ", ", printable(summary.names[i]), error);
    }
    text += hanging(fmt::format("  {} standard error: ", column_title(estimator)), list);
  }
  return text;
}

std::string remark_lines(ResultSummary const& summary) {
  std::string text;
  for (auto const& estimator : summary.estimators)
    if (!estimator.remark.empty())
      text += hanging(fmt::format("  {}: ", column_title(estimator)), printable(estimator.remark));
  return text;
}

std::string reasons_text(std::map<std::string, std::int64_t> const& reasons) {
  std::string text;
  for (auto const& [reason, count] : reasons)
    text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", count, printable(reason));
  return text;
}

std::string data_text(DataSummary const& data) {
  std::string names;
  for (auto const& name : data.recordings) names += (names.empty() ? "" : ", ") + printable(name);
  std::string text = fmt::format("{}; {} samples kept", names, count_text(data.samples));
  if (!std::isnan(data.duration_s)) text += fmt::format(", {:.4g} s", data.duration_s);
  if (!std::isnan(data.rate_hz)) text += fmt::format(" at {:.6g} Hz", data.rate_hz);
  if (data.cutoff_hz > 0.0) text += fmt::format("; cutoff {:.4g} Hz", data.cutoff_hz);
  return text;
}

}  // namespace

std::string column_title(EstimatorSummary const& estimator) {
  if (estimator.name != estimator.kind) return printable(estimator.name);
  std::string title = estimator.name;
  for (char& letter : title)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  return printable(title);
}

std::string result_table(ResultSummary const& summary, Ink const& ink) {
  int name_width = 20, unit_width = 9;
  for (auto const& name : summary.names) name_width = std::max(name_width, columns_of(name) + 4);
  for (auto const& unit : summary.units) unit_width = std::max(unit_width, columns_of(unit) + 1);
  name_width = std::max(name_width, columns_of(gap_title(summary)) + 3 - unit_width);

  auto const columns = columns_of_result(summary);
  std::string text;
  for (std::size_t begin = 0; begin < columns.size();) {
    std::size_t const count = fitting(columns, begin, page_width() - name_width - unit_width);
    auto const first = columns.begin() + static_cast<std::ptrdiff_t>(begin);
    std::vector<Column> const shown(first, first + static_cast<std::ptrdiff_t>(count));
    text += (begin ? "\n" : "") + block_text(summary, shown, name_width, unit_width, ink);
    begin += count;
  }
  text += standard_error_lines(summary) + remark_lines(summary);
  if (summary.arm) text += "\n" + joint_error_table(summary, ink) + "\n";
  text += fmt::format("{} runs, {} evaluations", count_text(summary.runs()), count_text(summary.evaluations()));
  if (!std::isnan(summary.provenance.seconds)) text += ", " + seconds_text(summary.provenance.seconds);
  return text + "\n";
}

std::string estimator_lines(ResultSummary const& summary, Ink const& ink) {
  using Align = TextTable::Align;
  TextTable table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::left},
                  "  ");
  table.row({summary.arm ? "MSE above the WLS floor" : "MSE above the OLS floor", "median", "quartile", "quartile",
             "best", "worst", ""});
  for (auto const& estimator : summary.estimators)
    table.row({column_title(estimator), rough_number(estimator.gap_median), rough_number(estimator.gap_lower_quartile),
               rough_number(estimator.gap_upper_quartile), rough_number(estimator.gap_best),
               rough_number(estimator.gap_worst), ""});
  std::string text = table.text(page_width());
  for (auto const& estimator : summary.estimators)
    text += hanging(fmt::format("  {} ended by ", column_title(estimator)), reasons_text(estimator.stop_reasons));
  return ink.bold("estimators") + "\n" + text;
}

std::string origin_lines(ResultSummary const& summary, Ink const& ink) {
  ProvenanceSummary const& made = summary.provenance;
  std::string text = ink.bold("made") + "\n";
  text += hanging("  job      ",
                  fmt::format("{}, seed {}, sha256 {:.16}", printable(summary.name), summary.seed, summary.job_sha256));
  text += hanging("  data     ", data_text(summary.train));
  if (summary.has_validation) text += hanging("  valid.   ", data_text(summary.validation));
  if (!summary.equation.empty()) text += hanging("  model    ", printable(summary.equation));
  bool const known = !made.host.empty();
  text += hanging("  machine  ", known ? fmt::format("{}; {} threads ({}), {}", printable(made.host), made.threads,
                                                     printable(made.threads_reason), printable(made.vector_target))
                                       : "not known: the file that ends in .made.json is not beside the result");
  text += hanging("  program  ", fmt::format("torquescope {}, {}, {}", printable(made.version),
                                             printable(made.compiler), printable(made.build_type)));
  if (known)
    text += hanging("  time     ", fmt::format("{} to {}, {}", printable(made.started), printable(made.finished),
                                               seconds_text(made.seconds)));
  text += hanging("  content  ", fmt::format("sha256 {:.16}, {}", summary.content_sha256, bytes_text(summary.bytes)));
  return text;
}

std::string warning_lines(ResultSummary const& summary, Ink const& ink) {
  std::string text;
  auto const add = [&](std::string const& warning) { text += hanging(ink.warning("warn") + "  ", printable(warning)); };
  for (auto const* data : {&summary.train, &summary.validation})
    for (auto const& warning : data->warnings) add(warning);
  if (!summary.health_words.empty()) add(summary.health_words);
  for (auto const& sentence : unexplained_joints(summary)) add(sentence);
  return text.empty() ? text : text + "\n";
}

}  // namespace torquescope
