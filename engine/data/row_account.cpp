#include "engine/data/row_account.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace torquescope {
namespace {

RowAccount::Why why_of(LeftOutReason reason) {
  switch (reason) {
    case LeftOutReason::asked_for:
      return RowAccount::Why::asked_for;
    case LeftOutReason::no_rows:
      return RowAccount::Why::no_rows;
    case LeftOutReason::no_value:
      break;
  }
  return RowAccount::Why::no_value;
}

std::string why_words(RowAccount::Part const& part) {
  switch (part.why) {
    case RowAccount::Why::edge:
      return "at the filter's ends";
    case RowAccount::Why::asked_for:
      return "by leave_out of the job";
    case RowAccount::Why::no_rows:
      return "in gaps of the clock";
    case RowAccount::Why::no_value:
      return part.column.empty() ? "without a value" : fmt::format("without a value of \"{}\"", part.column);
    case RowAccount::Why::turns:
      return "near turns and rests";
  }
  return {};
}

void count(std::vector<RowAccount::Part>& parts, RowAccount::Part const& one) {
  auto const same = std::find_if(parts.begin(), parts.end(), [&](RowAccount::Part const& part) {
    return part.why == one.why && part.column == one.column;
  });
  if (same == parts.end())
    parts.push_back(one);
  else
    same->samples += one.samples;
}

}  // namespace

double RowAccount::left_out() const {
  double sum = 0.0;
  for (auto const& part : parts) sum += part.samples;
  return sum;
}

std::vector<int> stretch_of_samples(std::vector<LeftOutStretch> const& because, Eigen::Index n_samples, double rate_hz,
                                    ParallelFilter const& filter, double cutoff_hz) {
  Eigen::VectorXd number = Eigen::VectorXd::Constant(n_samples, -1.0);
  for (std::size_t k = because.size(); k-- > 0;) {
    auto const range = samples_left_out(because[k].where, n_samples, rate_hz, cutoff_hz);
    if (range.first < range.end)
      number.segment(range.first, range.end - range.first).setConstant(static_cast<double>(k));
  }
  std::vector<int> found;
  for (double const one : filter.pick(number)) found.push_back(static_cast<int>(one));
  return found;
}

RowAccount row_account(std::vector<LeftOutStretch> const& because, std::vector<int> const& stretch,
                       std::vector<bool> const& turns, Eigen::Index n_samples, ParallelFilter const& filter) {
  RowAccount account;
  account.read = static_cast<double>(n_samples);
  auto const each = static_cast<double>(filter.decimation());
  double const inside = std::min(account.read, each * static_cast<double>(stretch.size()));
  if (inside < account.read) account.parts.push_back({RowAccount::Why::edge, {}, account.read - inside});
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    if (stretch[i] >= 0) {
      auto const& because_of = because[static_cast<std::size_t>(stretch[i])];
      count(account.parts, {why_of(because_of.reason), because_of.column, each});
    } else if (i < turns.size() && turns[i]) {
      count(account.parts, {RowAccount::Why::turns, {}, each});
    }
  }
  return account;
}

std::string account_words(RowAccount const& account) {
  auto const share = [&](double samples) {
    return fmt::format("{:.0f} ({:.1f} %)", samples, account.read > 0.0 ? 100.0 * samples / account.read : 0.0);
  };
  std::string words = fmt::format("{}{:.0f} samples = {} used", account.joint.empty() ? "" : account.joint + ": ",
                                  account.read, share(account.used()));
  for (auto const& part : account.parts) words += fmt::format(" + {} {}", share(part.samples), why_words(part));
  return words;
}

}  // namespace torquescope
