#include "engine/data/column_name.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/data/column_suggestion.hpp"

namespace torquescope {
namespace column_name_test {

struct Example {
  char const* column;
  WordKind quantity;
  bool commanded;
  double si;  // of one unit; -1: the name has none, 0: it depends on the drive
  char const* number;
};

constexpr double no_unit = -1.0, depends_on_drive = 0.0;
constexpr double degree = std::numbers::pi / 180, turn = 2 * std::numbers::pi;

TEST(ColumnName, SaysQuantityUnitAndJointAsLoggersWriteThem) {
  Example const examples[] = {{"t_s", WordKind::time, false, 1.0, ""},
                              {"Time [ms]", WordKind::time, false, 1e-3, ""},
                              {"timestamp_us", WordKind::time, false, 1e-6, ""},
                              {"%time", WordKind::time, false, no_unit, ""},
                              {"field.header.stamp", WordKind::time, false, no_unit, ""},
                              {"stamp.nanosec", WordKind::time, false, 1e-9, ""},
                              {"q1_rad", WordKind::position, false, 1.0, "1"},
                              {"field.position0", WordKind::position, false, no_unit, "0"},
                              {"position[2]", WordKind::position, false, no_unit, "2"},
                              {"actual_q_5", WordKind::position, false, no_unit, "5"},
                              {"Axis2.ActPos[Inc]", WordKind::position, false, depends_on_drive, "2"},
                              {"angle (deg)", WordKind::position, false, degree, ""},
                              {"x_mm", WordKind::position, false, 1e-3, ""},
                              {"current_position", WordKind::position, false, no_unit, ""},
                              {"theta_m", WordKind::position, false, no_unit, ""},  // of the motor, no length
                              {"target_q_0", WordKind::position, true, no_unit, "0"},
                              {"qref", WordKind::position, true, no_unit, ""},
                              {"goal", WordKind::position, true, no_unit, ""},
                              {"r_rad", WordKind::position, true, 1.0, ""},
                              {"qd_rad", WordKind::position, true, 1.0, ""},  // desired: a speed has no rad
                              {"qd_radps", WordKind::velocity, false, 1.0, ""},
                              {"qd_rad_s", WordKind::velocity, false, 1.0, ""},
                              {"speed_rpm", WordKind::velocity, false, turn / 60, ""},
                              {"v_mps", WordKind::velocity, false, 1.0, ""},
                              {"tau3_Nm", WordKind::torque, false, 1.0, "3"},
                              {"ActualTorque[mNm]", WordKind::torque, false, 1e-3, ""},
                              {"torque_permille", WordKind::torque, false, depends_on_drive, ""},
                              {"field.effort0", WordKind::torque, false, no_unit, "0"},
                              {"taudes1_Nm", WordKind::torque, true, 1.0, "1"},
                              {"F_N", WordKind::torque, false, 1.0, ""},
                              {"i_A", WordKind::drive, false, depends_on_drive, ""},
                              {"ides1_A", WordKind::drive, true, depends_on_drive, "1"},
                              {"present_current", WordKind::drive, false, no_unit, ""},
                              {"motor current (mA)", WordKind::drive, false, depends_on_drive, ""},
                              {"u_V", WordKind::drive, false, depends_on_drive, ""},
                              // a current by its unit alone, and of the axis of the motor that makes torque
                              {"Achse X [mA]", WordKind::drive, false, depends_on_drive, ""},
                              {"i_q_A", WordKind::drive, false, depends_on_drive, ""},
                              {"i_d_A", WordKind::drive, true, depends_on_drive, ""},
                              {"q_d", WordKind::position, true, no_unit, ""},
                              {"tau_J_d[3]", WordKind::torque, true, no_unit, "3"},
                              // data sets for imitation
                              {"observation.state[0]", WordKind::position, false, no_unit, "0"},
                              {"observation.effort[0]", WordKind::torque, false, no_unit, "0"},
                              {"qpos[0]", WordKind::position, false, no_unit, "0"},
                              {"joint_torques[1]", WordKind::torque, false, no_unit, "1"},
                              {"joint_commands[1]", WordKind::position, true, no_unit, "1"},
                              {"velocities_2", WordKind::velocity, false, no_unit, "2"},
                              {"action[0]", WordKind::position, true, no_unit, "0"},
                              // German, French, Spanish, Japanese, Chinese
                              {"Zeit [ms]", WordKind::time, false, 1e-3, ""},
                              {"Motorstrom [mA]", WordKind::drive, false, depends_on_drive, ""},
                              {"Sollwinkel (Grad)", WordKind::position, true, degree, ""},
                              {"Lageistwert [°]", WordKind::position, false, degree, ""},
                              {"Drehmomentistwert", WordKind::torque, false, no_unit, ""},
                              {"Winkelgeschwindigkeit [°/s]", WordKind::velocity, false, degree, ""},
                              {"Temps (s)", WordKind::time, false, 1.0, ""},
                              {"Vitesse mesurée", WordKind::velocity, false, no_unit, ""},
                              {"Couple (N·m)", WordKind::torque, false, 1.0, ""},
                              {"Consigne de position [rad]", WordKind::position, true, 1.0, ""},
                              {"Posición [rad]", WordKind::position, false, 1.0, ""},
                              {"Par motor [Nm]", WordKind::torque, false, 1.0, ""},
                              {"Corriente [A]", WordKind::drive, false, depends_on_drive, ""},
                              {"時間（秒）", WordKind::time, false, 1.0, ""},
                              {"速度 [rpm]", WordKind::velocity, false, turn / 60, ""},
                              {"指令位置［deg］", WordKind::position, true, degree, ""},
                              {"J2トルク(Nm)", WordKind::torque, false, 1.0, "2"},
                              {"电机电流 [A]", WordKind::drive, false, depends_on_drive, ""}};
  for (auto const& example : examples) {
    SCOPED_TRACE(example.column);
    auto const name = parse_column_name(example.column);
    auto const role = column_role(name);
    EXPECT_EQ(role.quantity, example.quantity);
    EXPECT_EQ(role.commanded, example.commanded);
    EXPECT_NEAR(name.unit ? (tells_si(*name.unit) ? name.unit->si : depends_on_drive) : no_unit, example.si, 1e-12);
    EXPECT_EQ(name.number, example.number);
    EXPECT_GT(role.score, 0);
  }
}

TEST(ColumnName, OfSomethingElseHasNoRole) {
  for (char const* column : {"k", "temp_C", "vin_V", "loop_count", "column 1", "", "status", "max", "comment"}) {
    auto const role = column_role(parse_column_name(column));
    EXPECT_TRUE(role.quantity == WordKind::doubtful || role.score <= 0) << column;
  }
}

TEST(LikelyColumns, PreferWhatWasMeasuredAndInNewtonMetres) {
  auto const best = [](char const* channel, std::vector<std::string> const& names) {
    return likely_column(channel, names);
  };
  EXPECT_EQ(best("torque", {"tau_cmd_Nm", "i_A", "tau_sensor_Nm", "fric_observer_Nm"}), "tau_sensor_Nm");
  EXPECT_EQ(best("torque", {"i_A", "ides_A", "taudes_Nm"}), "i_A") << "measured before commanded";
  EXPECT_EQ(best("torque", {"u_V", "F_N", "F_pulse_N"}), "F_N");
  EXPECT_EQ(best("torque", {"V_V", "load_pct_raw", "current_mA_raw"}), "V_V") << "registers say least";
  EXPECT_EQ(best("position", {"q_ref_rad", "q_rad"}), "q_rad");
  EXPECT_EQ(best("reference", {"q_ref_rad", "q_rad"}), "q_ref_rad");
  EXPECT_EQ(best("time", {"seq", "%time", "field.header.stamp"}), "field.header.stamp");
  EXPECT_EQ(best("position", {"a", "b"}), "");
}

}  // namespace column_name_test
}  // namespace torquescope
