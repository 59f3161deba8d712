#include "engine/infer/decision/loop_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/simulate/rollout/drive_effect.hpp"
#include "engine/simulate/rollout/fit_slope.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

bool is_effect(LoopQuestion const& question, std::size_t move) { return !question.moves[move].subject.is_of_command(); }

std::vector<LoopKey> const& keys_of(LoopQuestion const& question, std::size_t move) {
  return drive_effect_of(question.moves[move].subject.key).keys;
}

// parameters of a move in the model's vector: terms, then effects in their order, then the loop's free numbers
std::vector<std::size_t> places_of(LoopQuestion const& question, LoopPoint const& point, std::size_t move) {
  std::size_t at = static_cast<std::size_t>(point.terms.size());
  std::vector<std::size_t> places;
  for (std::size_t const one : point.moves) {
    if (!is_effect(question, one)) continue;
    std::size_t const count = question.moves[one].subject.effect->parameters().size();
    for (std::size_t k = 0; one == move && k < count; ++k) places.push_back(at + k);
    at += count;
  }
  if (is_effect(question, move)) return places;
  auto const& free = point.loop.free;
  for (LoopKey const key : keys_of(question, move))
    places.push_back(at + static_cast<std::size_t>(std::find(free.begin(), free.end(), key) - free.begin()));
  return places;
}

// the same model with the numbers of a vector
LoopPoint moved_to(LoopPoint point, Eigen::VectorXd const& parameters) {
  Index at = point.terms.size();
  point.terms = parameters.head(at);
  for (auto& effect : point.effects)
    for (auto const& parameter : effect.effect->parameters()) effect.values[parameter.name] = parameters[at++];
  for (LoopKey const key : point.loop.free) point.loop.values[key] = parameters[at++];
  return point;
}

LmOptions options_of(LoopQuestion const& question, LoopSearch search) {
  LmOptions options;
  options.fits_starts = question.fits_starts;
  // a quarter of what one parameter gains by chance once in twenty: ridges of two effects alike are long
  options.least_gain = 1.0;
  // of many samples, a hundredth of the least fall of the error that makes a name
  constexpr double hundredth = 0.01;
  options.least_share = hundredth * -2.0 * std::log1p(-question.numbers.least_fall);
  constexpr std::int64_t a_look = 2, a_little = 8;
  if (search != LoopSearch::to_its_end) {
    options.iterations = search == LoopSearch::a_look ? a_look : a_little;
    options.passes = 1;
    options.widens = false;  // whoever follows it does
  }
  return options;
}

LoopErrors errors_of(RolloutModel const& model, std::vector<RolloutTrack> const& tracks, CountedChannels const& counts,
                     Eigen::VectorXd const& starts) {
  if (tracks.empty()) return {};
  FitUnknowns const unknowns(model, tracks, counts, starts.size() > 0);
  FitPoint at = unknowns.begin_at(model.start());
  if (starts.size() == at.starts.size()) at.starts = starts;
  // a whole recording begins elsewhere than its stretches; its offset is the same
  else if (starts.size() > 0 && unknowns.offsets() > 0)
    at.starts.tail(unknowns.offsets()) = starts.tail(unknowns.offsets());
  ChannelNumbers const left = sums_of(unknowns.residuals_at({at}, 1), 0);
  double position = 0.0, torque = 0.0;
  for (auto const& track : tracks) {
    Eigen::VectorXd const untold = untold_positions(track);
    for (auto const& segment : track.segments) {
      position += untold.segment(segment.first, segment.samples).squaredNorm();
      torque += track.torque.segment(segment.first, segment.samples).squaredNorm();
    }
  }
  LoopErrors errors;
  if (counts[0] && position > 0.0) errors.position = std::sqrt(left[0] / position);
  if (counts[1] && torque > 0.0) errors.torque = std::sqrt(left[1] / torque);
  return errors;
}

}  // namespace

RolloutModel LoopPoint::model(LoopQuestion const& question) const {
  return {question.regressor, terms, question.scales, effects, loop};
}

LoopPoint base_point(LoopQuestion const& question) { return {question.start, {}, question.loop, {}, {}}; }

LoopPoint with_move(LoopQuestion const& question, LoopPoint point, std::size_t move, std::vector<double> const& start) {
  LoopSubject const& subject = question.moves[move].subject;
  point.moves.push_back(move);
  if (subject.is_of_command()) {
    auto& free = point.loop.free;
    auto const& keys = keys_of(question, move);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      // effects may share a number, which then stands already
      if (std::find(free.begin(), free.end(), keys[k]) != free.end()) continue;
      free.push_back(keys[k]);
      point.loop.values[keys[k]] = start[k];
    }
    return point;
  }
  ModelEffect effect{subject.effect, {}};
  auto const& parameters = subject.effect->parameters();
  for (std::size_t k = 0; k < parameters.size(); ++k)
    effect.values[parameters[k].name] = k < subject.effect->n_linear() ? 0.0 : start[k - subject.effect->n_linear()];
  point.effects.push_back(std::move(effect));
  return point;
}

LoopPoint without_move(LoopQuestion const& question, LoopPoint const& point, std::size_t move) {
  LoopPoint less = point;
  LoopSubject const& subject = question.moves[move].subject;
  if (subject.is_of_command()) {
    for (LoopKey const key : keys_of(question, move)) {
      bool const is_shared = std::any_of(point.moves.begin(), point.moves.end(), [&](std::size_t one) {
        if (one == move || is_effect(question, one)) return false;
        auto const& others = keys_of(question, one);
        return std::find(others.begin(), others.end(), key) != others.end();
      });
      if (is_shared) continue;
      std::erase(less.loop.free, key);
      less.loop.values[key] = question.loop.values[key];
    }
  } else {
    std::ptrdiff_t effect = 0;
    for (std::size_t const one : point.moves) {
      if (one == move) break;
      effect += is_effect(question, one) ? 1 : 0;
    }
    less.effects.erase(less.effects.begin() + effect);
  }
  std::erase(less.moves, move);
  return less;
}

namespace {

LoopFit fitted_by(LmOptions const& options, LoopQuestion const& question, LoopPoint const& from, int threads) {
  RolloutModel const begun = from.model(question);
  LoopFit result{from, fit_rollouts_from(begun, question.fitted, question.counts, from.starts, options, threads)};
  if (result.fit.failed) return result;
  result.point = moved_to(from, result.fit.parameters);
  result.point.starts = result.fit.starts;
  return result;
}

LoopFit with_errors(LoopQuestion const& question, LoopFit result) {
  if (result.fit.failed) return result;
  RolloutModel const model = result.point.model(question);
  result.train = errors_of(model, question.fitted, question.counts, result.point.starts);
  result.validation = errors_of(model, question.validation, question.counts, {});
  return result;
}

}  // namespace

LoopErrors training_errors(LoopQuestion const& question, LoopFit const& fit) {
  return errors_of(fit.point.model(question), question.training, question.counts, fit.point.starts);
}

LoopFit fitted(LoopQuestion const& question, LoopPoint const& from, LoopSearch search, int threads) {
  LoopFit fit = fitted_by(options_of(question, search), question, from, threads);
  return search == LoopSearch::to_its_end ? with_errors(question, std::move(fit)) : fit;
}

LoopFit followed(LoopQuestion const& question, LoopFit const& fit, int threads) {
  LmOptions options = options_of(question, LoopSearch::to_its_end);
  if (fit.fit.is_at_rest) options.passes = 1;
  return with_errors(question, fitted_by(options, question, fit.point, threads));
}

LoopFit with_intervals(LoopQuestion const& question, LoopFit fit, int threads) {
  RolloutModel const model = fit.point.model(question);
  LmOptions const options = options_of(question, LoopSearch::to_its_end);
  fit.fit = with_intervals(std::move(fit.fit), model, question.fitted, question.counts, options, threads);
  return fit;
}

double gain_of(LoopFit const& smaller, LoopFit const& larger, CountedChannels const& counts) {
  if (larger.fit.failed || smaller.fit.failed) return 0.0;
  double gain = 0.0;
  for (std::size_t channel = 0; channel < n_channels; ++channel)
    if (counts[channel] && larger.fit.sums[channel] > 0.0)
      gain += larger.fit.effective[channel] * std::log(smaller.fit.sums[channel] / larger.fit.sums[channel]);
  return gain;
}

std::vector<LoopNumber> numbers_of(LoopQuestion const& question, LoopFit const& fit, std::optional<std::size_t> move) {
  RolloutModel const model = fit.point.model(question);
  std::vector<std::size_t> places(model.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (move) places = places_of(question, fit.point, *move);
  std::vector<LoopNumber> numbers;
  for (std::size_t const k : places) {
    auto const& one = model.parameters()[k];
    auto const at = static_cast<Index>(k);
    numbers.push_back({one.name, one.unit, fit.fit.parameters[at], fit.fit.lower[at], fit.fit.upper[at]});
  }
  return numbers;
}

namespace {

// Whether a move says what it says because one of its numbers is at the end of its range: with that number in the
// middle, and all others fitted again a little, more than least_fall of its D is gone. The rest of a spring that hardly
// hardens does not matter
bool hangs_on(LoopQuestion const& question, LoopFit const& without, LoopFit const& fit, RolloutModel const& model,
              std::size_t number) {
  auto const& range = model.parameters()[number];
  double const middle = range.is_logarithmic ? std::sqrt(range.lower * range.upper) : 0.5 * (range.lower + range.upper);
  double const least = (1.0 - question.numbers.least_fall) * gain_of(without, fit, question.counts);
  LoopFit inside = fit;
  for (LoopSearch const search : {LoopSearch::a_look, LoopSearch::a_little}) {
    RolloutModel const held = inside.point.model(question).with_held(number, middle);
    LmOptions options = options_of(question, search);
    options.widens = true;  // nothing follows
    inside.fit = fit_rollouts_from(held, question.fitted, question.counts, inside.point.starts, options, 1);
    if (inside.fit.failed) return true;
    inside.point = moved_to(inside.point, inside.fit.parameters);
    inside.point.starts = inside.fit.starts;
    // n_eff differs from fit to fit, and squares are compared here
    inside.fit.effective = fit.fit.effective;
    if (gain_of(without, inside, question.counts) >= least) return false;
    if (inside.fit.is_at_rest) return true;
  }
  return true;
}

}  // namespace

bool is_at_bound(LoopQuestion const& question, LoopFit const& without, LoopFit const& fit, std::size_t move) {
  RolloutModel const model = fit.point.model(question);
  auto const places = places_of(question, fit.point, move);
  LoopSubject const& subject = question.moves[move].subject;
  if (!subject.is_of_command()) {
    std::vector<double> shape;
    for (std::size_t k = subject.effect->n_linear(); k < places.size(); ++k)
      shape.push_back(fit.fit.parameters[static_cast<Index>(places[k])]);
    if (!subject.effect->is_plausible(shape, question.scales)) return true;
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    auto const& one = model.parameters()[places[k]];
    double const value = fit.fit.parameters[static_cast<Index>(places[k])];
    bool low = value <= one.lower, high = value >= one.upper;
    if (!subject.is_of_command()) {
      auto const& parameter = subject.effect->parameters()[k];
      // 0 of a shape that cannot be negative is a limit of physics (effect_shape.cpp)
      bool const is_zero = parameter.is_shape && parameter.lower.factor == 0.0;
      low = low && !is_zero && !parameter.effect_at_lower && !parameter.none_at_lower;
      high = high && !parameter.effect_at_upper;
    }
    if ((low || high) && hangs_on(question, without, fit, model, places[k])) return true;
  }
  return false;
}

}  // namespace torquescope
