#include "engine/infer/decision/loop_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/infer/decision/loop_scan.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {
namespace {

// of several fits with the same moves; both channels alike
bool leaves_less(LoopFit const& a, LoopFit const& b, CountedChannels const& counts) {
  if (a.fit.failed || b.fit.failed) return b.fit.failed && !a.fit.failed;
  double difference = 0.0;
  for (std::size_t channel = 0; channel < n_channels; ++channel)
    if (counts[channel]) difference += std::log(a.fit.sums[channel] / b.fit.sums[channel]);
  return difference < 0.0;
}

// a number of the loop that does not begin at nothing changes what all others do
bool bends(LoopMove const& move) { return move.subject.is_of_command() && !drive_effect_of(move.subject.key).adds; }

class Ladder {
 public:
  explicit Ladder(LoopQuestion const& question) : q_(question) {}

  LoopClimb run(std::vector<LoopPoint> const& starts) && {
    facts_.form = q_.loop.form;
    facts_.counts = q_.counts;
    facts_.has_validation = !q_.validation.empty();
    tell_progress(0);
    Member base{base_of(starts), {}};
    if (base.fit.fit.failed) {
      facts_.reason = LoopReason::diverges;
      return {std::move(facts_), {}, {}};
    }
    LoopFit const first = with_intervals(q_, base.fit, q_.threads);
    facts_.base_train = training_errors(q_, base.fit);
    facts_.fitted_share = share_fitted();
    facts_.base_validation = base.fit.validation;
    base_terms_ = base.fit.point.terms;
    Member best = base;
    std::vector<Member> beam{std::move(base)};
    for (std::size_t depth = 0; depth < q_.most_moves && !beam.empty(); ++depth) {
      beam = grown(beam, best);
      if (!beam.empty()) best = beam.front();
      tell_progress(depth + 1);
    }
    drop_useless(best);
    best.fit = with_intervals(q_, std::move(best.fit), q_.threads);
    tell(best);
    tell_progress(q_.most_moves + 1);
    return {std::move(facts_), first, best.fit};
  }

 private:
  struct Member {
    LoopFit fit;
    std::map<std::size_t, ScannedMove> taken{};  // as the step that took them saw them
  };

  double share_fitted() const {
    auto const samples = [](std::vector<RolloutTrack> const& tracks) {
      double sum = 0.0;
      for (auto const& track : tracks) sum += static_cast<double>(track.samples());
      return sum;
    };
    return samples(q_.fitted) / samples(q_.training);
  }

  // each start is followed a little, the best to its end
  LoopFit base_of(std::vector<LoopPoint> const& starts) const {
    if (starts.empty()) return fitted(q_, base_point(q_), LoopSearch::to_its_end, q_.threads);
    LoopFit const best = best_of(starts, q_.threads);
    return best.fit.failed ? best : followed(q_, best, q_.threads);
  }

  // gain over another, both by the noise that the other leaves
  double score(Member const& one, Member const& beside) const {
    double score = 0.0;
    for (std::size_t channel = 0; channel < n_channels; ++channel)
      if (q_.counts[channel])
        score += beside.fit.fit.effective[channel] * std::log(beside.fit.fit.sums[channel] / one.fit.fit.sums[channel]);
    return score;
  }

  void tell_progress(std::size_t done) const {
    if (q_.progress) q_.progress("simulations", done, q_.most_moves + 1);
  }

  std::vector<std::size_t> moves_left(Member const& member) const {
    std::vector<std::size_t> left;
    for (std::size_t move = 0; move < q_.moves.size(); ++move)
      if (!member.taken.contains(move)) left.push_back(move);
    return left;
  }

  // A number of the loop bends the plane: it begins at each of its starts beside the parent, and cold, beside the base
  // and every start of the parent's own number of the loop, because the parent has made up for what is missing in it.
  // Pairs only: of three the first two have been searched so
  std::vector<LoopPoint> begun(LoopPoint const& parent, std::size_t move) const {
    std::vector<LoopPoint> warm, cold{parent};
    for (auto const& start : q_.moves[move].starts) warm.push_back(with_move(q_, parent, move, start));
    if (parent.moves.empty()) return warm;
    cold.front().terms = base_terms_;
    if (parent.moves.size() > 1) return warm;
    for (std::size_t const one : parent.moves) {
      LoopMove const& own = q_.moves[one];
      if (!bends(own)) continue;
      std::vector<LoopPoint> more;
      for (auto const& point : cold)
        for (auto const& start : own.starts) {
          more.push_back(point);
          auto const& keys = drive_effect_of(own.subject.key).keys;
          for (std::size_t k = 0; k < keys.size(); ++k) more.back().loop.values[keys[k]] = start[k];
        }
      cold = std::move(more);
    }
    for (auto const& point : cold)
      for (auto const& start : q_.moves[move].starts) warm.push_back(with_move(q_, point, move, start));
    return warm;
  }

  // The best of several starts: all get a look, the better third and no fewer than three are followed a little
  // (successive halving: Jamieson, Talwalkar 2016, AISTATS, arXiv:1502.07943)
  LoopFit best_of(std::vector<LoopPoint> const& points, int threads) const {
    if (points.size() == 1) return fitted(q_, points.front(), LoopSearch::a_little, threads);
    std::vector<LoopFit> fits;
    for (auto const& point : points) fits.push_back(fitted(q_, point, LoopSearch::a_look, threads));
    std::stable_sort(fits.begin(), fits.end(),
                     [&](LoopFit const& a, LoopFit const& b) { return leaves_less(a, b, q_.counts); });
    fits.resize(std::min(fits.size(), std::max<std::size_t>(3, (fits.size() + 2) / 3)));
    for (auto& fit : fits)
      if (!fit.fit.failed) fit = fitted(q_, fit.point, LoopSearch::a_little, threads);
    return *std::min_element(fits.begin(), fits.end(),
                             [&](LoopFit const& a, LoopFit const& b) { return leaves_less(a, b, q_.counts); });
  }

  // warm from the parent, followed a little: an effect at the start that gains most on the plane, a number of the loop
  // at each
  LoopFit begun_with(LoopFit const& parent, std::size_t move, std::vector<std::size_t> const& starts) const {
    LoopMove const& own = q_.moves[move];
    return best_of(bends(own) ? begun(parent.point, move)
                              : std::vector{with_move(q_, parent.point, move, own.starts[starts.front()])},
                   1);
  }

  bool predicts_better(LoopErrors const& before, LoopErrors const& after) const {
    return after.both() < (1.0 - q_.numbers.least_fall) * before.both();
  }

  bool is_too_small(LoopFit const& fit, std::size_t move) const {
    double const least = q_.moves[move].least;
    return least > 0.0 && numbers_of(q_, fit, move).front().value < least;
  }

  MoveRefusal refusal_of(Member const& parent, LoopFit const& fit, std::size_t move) const {
    if (fit.fit.failed || !(gain_of(parent.fit, fit, q_.counts) > 0.0)) return MoveRefusal::failed_fit;
    if (is_too_small(fit, move)) return MoveRefusal::too_small;
    if (!predicts_better(parent.fit.judged(q_), fit.judged(q_))) return MoveRefusal::not_predicted;
    return is_at_bound(q_, parent.fit, fit, move) ? MoveRefusal::at_bound : MoveRefusal::none;
  }

  struct TriedMove {
    LoopFit fit;
    MoveRefusal refusal = MoveRefusal::none;
  };

  // each is followed to its end
  std::vector<TriedMove> tried(Member const& parent, std::vector<ScannedMove> const& asked) const {
    std::vector<TriedMove> all(asked.size());
    parallel_for(all.size(), q_.threads, [&](std::size_t i, int) {
      TriedMove& one = all[i];
      one.fit = begun_with(parent.fit, asked[i].move, asked[i].starts);
      if (!one.fit.fit.failed) one.fit = followed(q_, one.fit);
      one.refusal = refusal_of(parent, one.fit, asked[i].move);
    });
    return all;
  }

  // what one member of the beam becomes with one more move
  std::vector<Member> children_of(Member const& parent) {
    LoopScan const scan = scan_moves(q_, parent.fit, moves_left(parent), step_++);
    LoopStepFacts step{{}, scan.replicates, {}};
    for (std::size_t const move : parent.fit.point.moves) step.model.push_back(q_.moves[move].subject);
    std::vector<ScannedMove> asked;
    for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(q_.numbers.refined), scan.moves.size()); ++i)
      if (scan.moves[i].p <= q_.numbers.alpha && scan.moves[i].gain > 0.0) asked.push_back(scan.moves[i]);
    std::vector<TriedMove> fits = tried(parent, asked);
    std::vector<Member> children;
    for (ScannedMove const& move : scan.moves) {
      MoveFacts facts{q_.moves[move.move].subject, move.gain, move.p, move.level, parent.fit.judged(q_)};
      if (move.p <= q_.numbers.alpha) facts.refusal = MoveRefusal::smaller;
      auto const place =
          std::find_if(asked.begin(), asked.end(), [&](ScannedMove const& one) { return one.move == move.move; });
      if (place != asked.end()) {
        TriedMove& own = fits[static_cast<std::size_t>(place - asked.begin())];
        facts.refusal = own.refusal;
        facts.after = own.fit.judged(q_);
        if (!own.fit.fit.failed) facts.gain = gain_of(parent.fit, own.fit, q_.counts);
        if (facts.refusal == MoveRefusal::none) {
          children.push_back({std::move(own.fit), parent.taken});
          children.back().taken.emplace(move.move, move);
        }
      }
      step.moves.push_back(facts);
    }
    std::stable_sort(step.moves.begin(), step.moves.end(),
                     [](MoveFacts const& a, MoveFacts const& b) { return a.gain > b.gain; });
    facts_.steps.push_back(std::move(step));
    return children;
  }

  // the next beam, its best first; the same moves in another order are one model
  std::vector<Member> grown(std::vector<Member> const& beam, Member const& best) {
    std::vector<Member> all;
    for (auto const& parent : beam)
      for (auto& child : children_of(parent)) {
        auto const same = std::find_if(all.begin(), all.end(), [&](Member const& one) {
          return std::equal(one.taken.begin(), one.taken.end(), child.taken.begin(), child.taken.end(),
                            [](auto const& a, auto const& b) { return a.first == b.first; });
        });
        if (same == all.end())
          all.push_back(std::move(child));
        else if (leaves_less(child.fit, same->fit, q_.counts))
          *same = std::move(child);
      }
    // one more move that leaves more than the best of fewer leads nowhere
    std::erase_if(all, [&](Member const& one) { return !(score(one, best) > 0.0); });
    std::stable_sort(all.begin(), all.end(),
                     [&](Member const& a, Member const& b) { return score(a, best) > score(b, best); });
    all.resize(std::min(all.size(), static_cast<std::size_t>(q_.numbers.beam)));
    return all;
  }

  // fitted without each of its moves, in their order
  std::vector<LoopFit> without_each(Member const& member) const {
    auto const& moves = member.fit.point.moves;
    std::vector<LoopFit> fits(moves.size());
    parallel_for(moves.size(), q_.threads,
                 [&](std::size_t i, int) { fits[i] = fitted(q_, without_move(q_, member.fit.point, moves[i])); });
    return fits;
  }

  // all that goes may together cost less than least_fall
  void drop_useless(Member& best) {
    LoopErrors const whole = best.fit.judged(q_);
    without_ = without_each(best);
    while (!without_.empty()) {
      std::size_t weakest = without_.size();
      double least = 0.0;
      for (std::size_t i = 0; i < without_.size(); ++i) {
        if (without_[i].fit.failed) continue;
        std::size_t const move = best.fit.point.moves[i];
        double const beyond = gain_of(without_[i], best.fit, q_.counts) - best.taken.at(move).level;
        bool const is_needed = beyond > 0.0 && predicts_better(without_[i].judged(q_), whole);
        if (is_needed || (weakest < without_.size() && beyond >= least)) continue;
        weakest = i;
        least = beyond;
      }
      if (weakest == without_.size()) return;
      best.taken.erase(best.fit.point.moves[weakest]);
      best.fit = std::move(without_[weakest]);
      without_ = without_each(best);
    }
  }

  // What stands in the place of a move about as well: D within the chance of either, or an error that is hardly higher.
  // A fit is made where one step on the plane gains at least half of the move's own
  std::vector<LoopSubject> rivals_of(Member const& best, std::size_t place, double gain) {
    constexpr double half_way = 0.5;
    std::size_t const move = best.fit.point.moves[place];
    LoopFit const& without = without_[place];
    if (without.fit.failed) return {};
    std::vector<std::size_t> asked = moves_left(best);
    asked.push_back(move);
    std::vector<ScannedMove> const others = scan_moves(q_, without, asked, step_++).moves;
    double const own_step =
        std::find_if(others.begin(), others.end(), [&](ScannedMove const& one) { return one.move == move; })->gain;
    std::vector<char> is_rival(others.size(), 0);
    parallel_for(others.size(), q_.threads, [&](std::size_t i, int) {
      double const least = gain - std::max(best.taken.at(move).level, others[i].level);
      if (q_.moves[others[i].move].subject == q_.moves[move].subject || others[i].gain < half_way * own_step) return;
      LoopFit fit = begun_with(without, others[i].move, others[i].starts);
      if (!fit.fit.failed) fit = followed(q_, fit);
      if (fit.fit.failed || is_at_bound(q_, without, fit, others[i].move)) return;
      double const own = gain_of(without, fit, q_.counts);
      bool const is_as_good = own >= least || !predicts_better(fit.judged(q_), best.fit.judged(q_));
      is_rival[i] = own > 0.0 && is_as_good ? 1 : 0;
    });
    std::vector<LoopSubject> rivals;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (is_rival[i] != 0) rivals.push_back(q_.moves[others[i].move].subject);
    return rivals;
  }

  void tell(Member const& best) {
    for (std::size_t i = 0; i < best.fit.point.moves.size(); ++i) {
      std::size_t const move = best.fit.point.moves[i];
      double const gain = gain_of(without_[i], best.fit, q_.counts);
      facts_.kept.push_back({q_.moves[move].subject, gain, best.taken.at(move).p, numbers_of(q_, best.fit, move),
                             rivals_of(best, i, gain)});
    }
    facts_.final_train = training_errors(q_, best.fit);
    facts_.final_validation = best.fit.validation;
    facts_.numbers = numbers_of(q_, best.fit);
    auto const says_nothing = [](double error) { return error >= 1.0; };
    bool const is_lost = says_nothing(facts_.final_train.position) || says_nothing(facts_.final_train.torque);
    facts_.reason = is_lost ? LoopReason::predicts_nothing : LoopReason::decides;
  }

  LoopQuestion const& q_;
  std::uint32_t step_ = 0;
  Eigen::VectorXd base_terms_{};
  std::vector<LoopFit> without_{};  // of the best, without each of its moves
  LoopFacts facts_{};
};

}  // namespace

LoopClimb climb_ladder(LoopQuestion const& question, std::vector<LoopPoint> const& starts) {
  return Ladder(question).run(starts);
}

}  // namespace torquescope
