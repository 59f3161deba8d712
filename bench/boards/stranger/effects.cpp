// Effects by their names: which values a law of a case has, in which order.
#include <stdexcept>

#include "stranger/drive_effects.hpp"
#include "stranger/friction_effects.hpp"
#include "stranger/outside_effects.hpp"
#include "stranger/travel_effects.hpp"

namespace stranger {

std::unique_ptr<Effect> make_effect(ConcealedLaw const& law, Rig const& rig, std::string const& case_name) {
  auto const value = [&](std::size_t k) { return law.values.at(k); };
  auto const is = [&](char const* form) { return law.form == form; };
  using std::make_unique;
  if (is("lorentz")) return make_unique<LorentzStribeck>(value(0), value(1));
  if (is("windage")) return make_unique<Windage>(value(0), value(1));
  if (is("eyring")) return make_unique<ThinningGrease>(value(0), value(1));
  if (is("rounded_v")) return make_unique<OneSidedLoss>(value(0), value(1));
  if (is("log_ageing")) return make_unique<AgeingContact>(value(0), value(1), value(2));
  if (is("tight_spot")) return make_unique<TightSpot>(value(0), value(1), value(2));
  if (is("pressed_bearing")) return make_unique<PressedBearing>(value(0), rig);
  if (is("worm_flank")) return make_unique<WormFlank>(value(0), value(1) * value(0), rig);
  if (is("two_time_warm_up")) return make_unique<WarmingGear>(value(0), value(1), value(2), rig);
  if (is("loose_screw")) return make_unique<LooseScrew>(value(0), value(1), value(2));
  if (is("oblique_axis")) return make_unique<ObliqueAxis>(value(0), value(1));
  if (is("rational_spring")) return make_unique<HardeningSpring>(value(0), value(1), value(2));
  if (is("bouc_wen_hose")) return make_unique<Hose>(value(0), value(1), value(2), value(3));
  if (is("hunt_crossley")) return make_unique<RubberBuffer>(value(0), value(1), value(2));
  if (is("tabulated")) return make_unique<TabulatedCogging>(value(0), value(1), value(2));
  if (is("wavy_motor")) return make_unique<WavyMotor>(value(0), value(1));
  if (is("wavy_gear")) return make_unique<WavyGear>(value(0), value(1));
  if (is("off_centre_disc")) return make_unique<OffCentreDisc>(value(0), value(1));
  if (is("soft_shaft")) return make_unique<SoftShaft>(value(0), value(1), 0, rig);
  if (is("damped_gap")) return make_unique<SoftShaft>(value(1), value(2), value(0), rig);
  if (is("bristles")) return make_unique<Bristles>(value(0), value(1), 0);
  if (is("slip_elements")) return make_unique<Bristles>(value(0), 0, static_cast<int>(value(1)));
  if (is("late_torque")) return make_unique<LateTorque>(value(0));
  if (is("second_order_current")) return make_unique<SecondOrderCurrent>(value(0), value(1));
  if (is("saturated_iron")) return make_unique<SaturatedIron>(value(0));
  if (is("creeping_zero")) return make_unique<CreepingZero>(value(0), value(1));
  if (is("gripped_load")) return make_unique<GrippedLoad>(value(0), value(1), value(2), rig);
  if (is("leaning")) return make_unique<Leaning>(value(0), value(1), value(2));
  if (is("press_next_door")) return make_unique<PressNextDoor>(value(0), value(1), Chance{case_name, "press"});
  if (is("rotor_run_up")) return make_unique<RotorRunUp>(value(0), value(1), value(2));
  if (is("dropping_channel")) return make_unique<DroppingChannel>(value(0), value(1), Chance{case_name, "dropping"});
  if (is("flash_heat")) return make_unique<FlashHeat>(value(0), value(1), rig);
  if (is("floating_base")) return make_unique<FloatingBase>(value(0), rig, Chance{case_name, "floating"});
  if (is("eddy_brake")) return make_unique<EddyBrake>(value(0), value(1), value(2));
  throw std::invalid_argument("no law is called " + law.form);
}

}  // namespace stranger
