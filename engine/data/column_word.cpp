#include "engine/data/column_word.hpp"

#include <algorithm>
#include <array>

namespace torquescope {
namespace column_words {

struct Entry {
  std::string_view word;
  WordKind kind;
  int weight = 0;
};

constexpr WordKind time_ = WordKind::time, position = WordKind::position, velocity = WordKind::velocity,
                   acceleration = WordKind::acceleration, torque = WordKind::torque, drive = WordKind::drive,
                   commanded = WordKind::commanded, measured = WordKind::measured, doubtful = WordKind::doubtful;

// English, German, ROS, CiA 402 and the drives' own tools
constexpr std::array entries{Entry{"stamp", time_, 100},
                             Entry{"time", time_, 95},
                             Entry{"timestamp", time_, 95},
                             Entry{"t", time_, 90},
                             Entry{"zeit", time_, 90},
                             Entry{"elapsed", time_, 80},
                             Entry{"clock", time_, 70},
                             Entry{"millis", time_, 85},
                             Entry{"micros", time_, 85},
                             Entry{"seconds", time_, 60},
                             Entry{"secs", time_, 60},
                             Entry{"sec", time_, 60},
                             Entry{"q", position, 100},
                             Entry{"pos", position, 100},
                             Entry{"position", position, 100},
                             Entry{"theta", position, 95},
                             Entry{"angle", position, 95},
                             Entry{"winkel", position, 95},
                             Entry{"qm", position, 90},
                             Entry{"weg", position, 90},
                             Entry{"phi", position, 85},
                             Entry{"encoder", position, 80},
                             Entry{"enc", position, 80},
                             Entry{"x", position, 40},
                             Entry{"qd", velocity, 100},
                             Entry{"dq", velocity, 100},
                             Entry{"qdot", velocity, 100},
                             Entry{"vel", velocity, 100},
                             Entry{"velocity", velocity, 100},
                             Entry{"velocities", velocity, 100},
                             Entry{"speed", velocity, 95},
                             Entry{"omega", velocity, 90},
                             Entry{"drehzahl", velocity, 90},
                             Entry{"rpm", velocity, 80},
                             Entry{"qdd", acceleration, 100},
                             Entry{"ddq", acceleration, 100},
                             Entry{"qddot", acceleration, 100},
                             Entry{"acc", acceleration, 100},
                             Entry{"accel", acceleration, 100},
                             Entry{"acceleration", acceleration, 100},
                             Entry{"tau", torque, 100},
                             Entry{"torque", torque, 100},
                             Entry{"trq", torque, 100},
                             Entry{"effort", torque, 95},
                             Entry{"drehmoment", torque, 95},
                             Entry{"force", torque, 90},
                             Entry{"kraft", torque, 90},
                             Entry{"moment", torque, 85},
                             Entry{"f", torque, 70},
                             Entry{"iq", drive, 64},
                             Entry{"current", drive, 60},
                             Entry{"strom", drive, 60},
                             Entry{"i", drive, 58},
                             Entry{"curr", drive, 58},
                             Entry{"cur", drive, 58},
                             Entry{"amps", drive, 55},
                             Entry{"u", drive, 50},
                             Entry{"v", drive, 50},
                             Entry{"volt", drive, 50},
                             Entry{"voltage", drive, 50},
                             Entry{"load", drive, 42},
                             Entry{"pwm", drive, 40},
                             Entry{"duty", drive, 40},
                             Entry{"ref", commanded},
                             Entry{"reference", commanded},
                             Entry{"goal", commanded},
                             Entry{"qg", commanded},
                             Entry{"target", commanded},
                             Entry{"tgt", commanded},
                             Entry{"desired", commanded},
                             Entry{"des", commanded},
                             Entry{"cmd", commanded},
                             Entry{"command", commanded},
                             Entry{"commanded", commanded},
                             Entry{"set", commanded},
                             Entry{"setpoint", commanded},
                             Entry{"sp", commanded},
                             Entry{"demand", commanded},
                             Entry{"demanded", commanded},
                             Entry{"soll", commanded},
                             Entry{"nominal", commanded},
                             Entry{"r", commanded},
                             Entry{"actual", measured},
                             Entry{"act", measured},
                             Entry{"present", measured},
                             Entry{"measured", measured},
                             Entry{"meas", measured},
                             Entry{"msr", measured},
                             Entry{"feedback", measured},
                             Entry{"fb", measured},
                             Entry{"ist", measured},
                             Entry{"state", measured},
                             Entry{"sensor", measured},
                             Entry{"error", doubtful},
                             Entry{"err", doubtful},
                             Entry{"limit", doubtful},
                             Entry{"max", doubtful},
                             Entry{"min", doubtful},
                             Entry{"std", doubtful},
                             Entry{"var", doubtful},
                             Entry{"temp", doubtful},
                             Entry{"temperature", doubtful},
                             Entry{"observer", doubtful},
                             Entry{"fric", doubtful},
                             Entry{"friction", doubtful},
                             Entry{"pulse", doubtful},
                             Entry{"sim", doubtful},
                             Entry{"simulated", doubtful},
                             Entry{"model", doubtful},
                             Entry{"est", doubtful},
                             Entry{"estimated", doubtful},
                             Entry{"ext", doubtful},
                             Entry{"external", doubtful},
                             Entry{"ff", doubtful},
                             Entry{"true", doubtful},
                             Entry{"status", doubtful},
                             Entry{"mode", doubtful},
                             Entry{"flag", doubtful},
                             Entry{"seq", doubtful},
                             Entry{"index", doubtful},
                             Entry{"raw", WordKind::raw}};

}  // namespace column_words

std::optional<ColumnWord> column_word(std::string_view word) {
  auto const found = std::find_if(column_words::entries.begin(), column_words::entries.end(),
                                  [&](auto const& e) { return e.word == word; });
  if (found != column_words::entries.end()) return ColumnWord{found->kind, found->weight};
  constexpr std::size_t shortest_plural = 5;  // "commands", as topics of ROS are called; "vels" may be anything
  bool const is_plural = word.size() >= shortest_plural && word.ends_with('s') && !word.ends_with("ss");
  return is_plural ? column_word(word.substr(0, word.size() - 1)) : std::nullopt;
}

}  // namespace torquescope
