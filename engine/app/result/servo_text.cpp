#include "engine/app/result/servo_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"
#include "engine/base/quantity_text.hpp"
#include "engine/workflows/servo_words.hpp"

namespace torquescope {
namespace {

using Align = TextTable::Align;

std::string mrad(double error) { return std::isfinite(error) ? fmt::format("{:.1f}", 1e3 * error) : "diverged"; }

std::string cell(ServoError const& error, double value) { return error.recordings > 0 ? mrad(value) : "-"; }

std::string interval_text(LoopNumber const& number) {
  if (!std::isfinite(number.lower) || !std::isfinite(number.upper)) return "";
  return fmt::format("[{}, {}]", short_number(number.lower), short_number(number.upper));
}

std::string names_text(ServoReport const& report) {
  TextTable table({Align::left, Align::left, Align::right, Align::left, Align::left, Align::left}, "  ");
  for (auto const& move : report.decision.facts.kept) {
    std::string rivals;
    for (auto const& rival : move.rivals) rivals += (rivals.empty() ? "or " : ", ") + name_of(rival);
    bool is_first = true;
    for (auto const& number : move.numbers) {
      table.row({is_first ? name_of(move.subject) : "", name_of_number(number), short_number(number.value),
                 number.unit == "1" ? "" : number.unit, interval_text(number), is_first ? rivals : ""});
      is_first = false;
    }
  }
  return table.text(200);
}

std::string table_text(ServoTable const& by) {
  TextTable table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::right},
                  "  ");
  table.row({printable(by.quantity), "train", "before", "after", "validation", "before", "after"});
  for (auto const& row : by.rows)
    table.row({printable(row.value), count_text(row.train.recordings), cell(row.train, row.train.before),
               cell(row.train, row.train.after), count_text(row.validate.recordings),
               cell(row.validate, row.validate.before), cell(row.validate, row.validate.after)});
  return table.text(200);
}

std::string left_out_text(ServoTable const& by) {
  TextTable table({Align::left, Align::right, Align::right, Align::right}, "  ");
  table.row({"without " + printable(by.quantity), "recordings", "before", "after"});
  double before = 0.0, after = 0.0;
  for (auto const& row : by.rows) {
    table.row({printable(row.value), count_text(row.train.recordings), mrad(row.train.before), mrad(row.train.after)});
    before += row.train.before / static_cast<double>(by.rows.size());
    after += row.train.after / static_cast<double>(by.rows.size());
  }
  table.row({"mean", "", mrad(before), mrad(after)});
  return table.text(200);
}

std::string recordings_text(ServoReport const& report) {
  TextTable table({Align::left, Align::left, Align::right, Align::right}, "  ");
  table.row({"recording", "role", "before", "after"});
  for (std::size_t k = 0; k < report.replay.recordings.size(); ++k) {
    auto const& errors = report.replay.recordings[k].channels[0].errors;
    table.row({printable(report.entries[k].name), report.entries[k].is_validation ? "validation" : "train",
               mrad(errors[report.replay.before].mae), mrad(errors[report.replay.after].mae)});
  }
  return table.text(200);
}

}  // namespace

std::string servo_verdict_text(ServoReport const& report, Ink const& ink) {
  std::string text = fmt::format("{}  {}\n", ink.name(printable(report.name)), printable(headline(report)));
  if (report.train.recordings == 0) return text;
  bool const has_names = !report.decision.facts.kept.empty();
  auto const change = [&](ServoError const& error) {
    return has_names ? fmt::format("{} -> {}", mrad(error.before), mrad(error.after)) : mrad(error.before);
  };
  text += fmt::format("mean absolute error of the position, all samples: {} mrad train ({} recordings)",
                      change(report.train), report.train.recordings);
  if (report.validate.recordings > 0)
    text += fmt::format(", {} mrad validation ({})", change(report.validate), report.validate.recordings);
  return text + "\n";
}

std::string servo_text(ServoReport const& report, bool all) {
  std::string text = "\n" + names_text(report);
  for (auto const& table : report.left_out) text += "\n" + left_out_text(table);
  for (auto const& table : report.tables) text += "\n" + table_text(table);
  if (!report.tables.empty()) text += "  errors in mrad\n";
  if (!report.left_out.empty())
    text += "  left out: the effects are those chosen on all, their numbers are fitted without these recordings\n";
  if (all) text += "\n" + recordings_text(report);
  for (auto const& remark : report.notes) text += "\n  " + sentence_of(remark) + "\n";
  return text;
}

}  // namespace torquescope
