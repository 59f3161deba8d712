#include "engine/data/time_stamp.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <optional>

namespace torquescope {
namespace {

constexpr double seconds_of_hour = 3600.0, seconds_of_minute = 60.0;

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

// reads from the front of a text and takes away what it read
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

  bool take(char letter) {
    bool const found = !rest_.empty() && rest_.front() == letter;
    if (found) rest_.remove_prefix(1);
    return found;
  }
  std::optional<char> take_one_of(std::string_view letters) {
    if (rest_.empty() || letters.find(rest_.front()) == std::string_view::npos) return std::nullopt;
    char const letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }
  bool take_word(std::string_view lower) {
    if (rest_.size() < lower.size()) return false;
    for (std::size_t i = 0; i < lower.size(); ++i)
      if ((rest_[i] | 0x20) != lower[i]) return false;
    rest_.remove_prefix(lower.size());
    return true;
  }
  void skip_blanks() {
    while (take(' ')) {
    }
  }
  // a whole number of `least` digits, and more of them up to `most`
  std::optional<int> number(std::size_t least, std::size_t most) {
    std::size_t n = 0;
    while (n < rest_.size() && n < most && is_digit(rest_[n])) ++n;
    if (n < least) return std::nullopt;
    int value = 0;
    std::from_chars(rest_.data(), rest_.data() + n, value);
    rest_.remove_prefix(n);
    return value;
  }
  // the digits behind a decimal mark as a number below one
  std::optional<double> fraction() {
    std::size_t n = 0;
    while (n < rest_.size() && is_digit(rest_[n])) ++n;
    if (n == 0 || n > 12) return std::nullopt;
    std::array<char, 16> digits{'0', '.'};
    for (std::size_t i = 0; i < n; ++i) digits[i + 2] = rest_[i];
    double value = 0.0;
    std::from_chars(digits.data(), digits.data() + n + 2, value);
    rest_.remove_prefix(n);
    return value;
  }

 private:
  std::string_view rest_;
};

std::optional<double> start_of_day(int year, int month, int day) {
  std::chrono::year_month_day const date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return seconds_of_day * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

std::optional<double> read_date(Scanner& in) {
  bool const year_first = in.rest().size() > 4 && !is_digit(in.rest()[4]) && is_digit(in.rest()[2]);
  auto const first = year_first ? in.number(4, 4) : in.number(1, 2);
  auto const mark = first ? in.take_one_of(year_first ? "-/" : "./") : std::nullopt;
  auto const second = mark ? in.number(1, 2) : std::nullopt;
  bool const marked_again = second && in.take(*mark);
  auto const third = marked_again ? (year_first ? in.number(1, 2) : in.number(4, 4)) : std::nullopt;
  if (!third) return std::nullopt;
  if (year_first) return start_of_day(*first, *second, *third);
  bool const day_first = *mark == '.' || *first > 12;
  return day_first ? start_of_day(*third, *second, *first) : start_of_day(*third, *first, *second);
}

std::optional<double> read_clock(Scanner& in) {
  auto hours = in.number(1, 2);
  bool const to_minutes = hours && in.take(':');
  auto const minutes = to_minutes ? in.number(2, 2) : std::nullopt;
  bool const to_seconds = minutes && in.take(':');
  auto const seconds = to_seconds ? in.number(2, 2) : std::nullopt;
  if (!seconds) return std::nullopt;
  std::optional<double> fraction = 0.0;
  if (in.take_one_of(".,:")) fraction = in.fraction();
  if (!fraction) return std::nullopt;
  in.skip_blanks();
  bool const afternoon = in.take_word("pm");
  if (afternoon || in.take_word("am")) {
    if (*hours < 1 || *hours > 12) return std::nullopt;
    hours = *hours % 12 + (afternoon ? 12 : 0);
  }
  if (*hours > 23 || *minutes > 59 || *seconds > 60) return std::nullopt;
  return *hours * seconds_of_hour + *minutes * seconds_of_minute + *seconds + *fraction;
}

// how far the clocks of the zone are ahead of UTC; nothing: what stands there is no zone
std::optional<double> read_zone(Scanner& in) {
  in.skip_blanks();
  if (in.done() || in.take_word("z") || in.take_word("utc")) return 0.0;
  auto const sign = in.take_one_of("+-");
  auto const hours = sign ? in.number(2, 2) : std::nullopt;
  if (!hours) return std::nullopt;
  in.take(':');
  auto const minutes = in.done() ? std::optional<int>(0) : in.number(2, 2);
  if (!minutes || *hours > 14 || *minutes > 59) return std::nullopt;
  return (*sign == '-' ? -1.0 : 1.0) * (*hours * seconds_of_hour + *minutes * seconds_of_minute);
}

}  // namespace

StampKind read_stamp(std::string_view cell, double& seconds) {
  if (cell.size() < 7 || cell.find(':') == std::string_view::npos) return StampKind::none;  // nearly all text
  Scanner whole_clock(cell);
  if (auto const clock = read_clock(whole_clock); clock && whole_clock.done()) {
    seconds = *clock;
    return StampKind::clock;
  }
  Scanner in(cell);
  auto const date = read_date(in);
  bool const separated = date && in.take_one_of("Tt ").has_value();
  if (separated) in.skip_blanks();
  auto const clock = separated ? read_clock(in) : std::nullopt;
  auto const zone = clock ? read_zone(in) : std::nullopt;
  if (!zone || !in.done()) return StampKind::none;
  seconds = *date + *clock - *zone;
  return StampKind::date;
}

}  // namespace torquescope
