#include "engine/experiment/quantity_unit.hpp"

#include "engine/data/delimited_text.hpp"

namespace torquescope {

std::optional<QuantityUnit> unit_of_quantity(std::string const& name) {
  auto const last = name.rfind('_');
  if (last == std::string::npos || last == 0) return {};
  QuantityUnit unit{name.substr(0, last), name.substr(last + 1), {}, 1.0};
  std::string const word = lower_case(unit.word);
  if (word == "kg") return unit;
  if (word == "g" || word == "mg") {
    unit.si = word == "g" ? 1e-3 : 1e-6;
    return unit;
  }
  auto const known = known_unit(word);
  if (!known || known->quantity == Quantity::ratio || known->quantity == Quantity::counts) return {};
  unit.quantity = known->quantity;
  unit.si = known->si;
  return unit;
}

std::optional<double> factor_between(std::string const& asked, std::string const& there) {
  auto const a = unit_of_quantity(asked), b = unit_of_quantity(there);
  if (!a || !b || asked == there || a->stem != b->stem || a->quantity != b->quantity) return {};
  return b->si / a->si;
}

}  // namespace torquescope
