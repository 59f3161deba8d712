#include "engine/fit/optim/restart_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"
#include "engine/base/portable_math.hpp"

namespace torquescope {

namespace {

constexpr double most_doublings = 9.0;

double power_of_two(double whole) { return std::ldexp(1.0, static_cast<int>(whole)); }

}  // namespace

std::vector<std::string> const& restart_words() {
  static std::vector<std::string> const words{"ipop", "bipop", "same"};
  return words;
}

void RestartPlan::begin_next(RandomStream& random) {
  double const u = random.uniform(), v = random.uniform();
  double const spent = now_.spent;
  now_.spent = 0.0;
  if (kind_ == Restarts::same) return;
  if (now_.is_small != 0.0) {
    now_.small += spent;
  } else if (now_.doublings > 0.0) {
    now_.large += spent;
    now_.last_large = spent;
  }
  bool const is_small = kind_ == Restarts::bipop && now_.doublings > 0.0 && now_.small < now_.large;
  now_.is_small = is_small ? 1.0 : 0.0;
  if (is_small) {
    now_.samples = std::max(1.0, std::floor(portable_exp((now_.doublings - 1.0) * u * u * std::numbers::ln2)));
    now_.width = portable_exp(-2.0 * v * std::numbers::ln10);
    return;
  }
  now_.doublings = std::min(now_.doublings + 1.0, most_doublings);
  now_.samples = power_of_two(now_.doublings);
  now_.width = 1.0;
}

std::array<double, RestartPlan::n_numbers> RestartPlan::numbers() const {
  return {now_.samples, now_.width, now_.is_small, now_.doublings, now_.spent, now_.last_large, now_.large, now_.small};
}

bool RestartPlan::accepts(std::span<double const> numbers) {
  return numbers.size() == n_numbers && numbers[0] >= 1.0 && numbers[0] <= power_of_two(most_doublings);
}

void RestartPlan::restore(std::span<double const> numbers) {
  TORQUESCOPE_EXPECT(accepts(numbers));
  now_ = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7]};
}

}  // namespace torquescope
