#pragma once
// How a residual counts in the fitness of a search.
//
// Equation   squares: e^2; huber: e^2 if |e| <= delta, else delta (2 |e| - delta), so that delta = infinity is squares
// Units      (unit of tau)^2; delta in the unit of tau
// Threads    values

#include <limits>
#include <string>
#include <vector>

namespace torquescope {

enum class LossKind { squares, huber };

struct Loss {
  LossKind kind = LossKind::squares;
  double delta = std::numeric_limits<double>::infinity();  // huber only: > 0
};

// what `torquescope list losses` prints
struct LossChoice {
  LossKind kind;
  std::string name;
  std::string title;
  std::string equation;
  std::string source;
};

std::vector<LossChoice> const& loss_choices();
// nullptr when there is none of this name
LossChoice const* find_loss(std::string const& name);

}  // namespace torquescope
