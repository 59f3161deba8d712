#pragma once
// The effects that a decision about one joint has taken so far, and their fit.
//
// Useless    an effect that gains no more than chance gives it beside those taken later, where judged rows are
//            predicted no worse without it
// Threads    plain records, pure functions
// Source     engine/infer/decision/THEORY.md, The rules

#include <span>
#include <vector>

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

struct DecisionContext {
  DecisionQuestion const& question;
  JointStrips const& rows;
  JointScales const& scales;  // of the model without effects
};

struct AcceptedModel {
  std::vector<EffectFacts> effects{};  // in the order of the fit's
  FittedModel fit{};
  double judged = 0.0;  // its error on judged rows
};

FittedModel fitted_with(DecisionContext const& on, std::vector<ShapedEffect> effects, FittedStrips const& sizes);

std::vector<ShapedEffect> shaped_effects(AcceptedModel const& model);
std::vector<ShapedEffect> shaped_without(AcceptedModel const& model, std::size_t place);
FittedModel fitted_without(DecisionContext const& on, AcceptedModel const& model, std::size_t place);

// effects of one kind that may be asked beside it; one that is no wave only once
std::vector<Effect const*> effects_to_ask(DecisionContext const& on, AcceptedModel const& model, bool of_clock);
std::vector<EffectQuestion> questions_of(DecisionContext const& on, std::vector<Effect const*> const& effects);

FoldKind folds_of(Effect const& effect);
// D of an effect beside a model that has not got it
double gain_beside(FittedModel const& without, EffectFacts const& effect);
// D that chance gives an effect, as last asked; 0 where it never was
double level_of(std::span<StepFacts const> steps, Effect const* effect);

// with one more, all shapes fitted together; sizes: of the joint beside the effect, without which they are bent
AcceptedModel with_effect(DecisionContext const& on, AcceptedModel model, EffectFacts effect,
                          FittedStrips const& sizes);
AcceptedModel without_useless(DecisionContext const& on, AcceptedModel model, std::span<StepFacts const> steps);
// effects of a clock explain what any incomplete model leaves
AcceptedModel without_effects_of_clock(DecisionContext const& on, AcceptedModel model);

}  // namespace torquescope
