#include "sensors/steering.h"

#include <algorithm>
#include <cctype>

namespace gaitlab::sensors {

const char* const SteeringSensor::kManual =
    R"(Values that an operator sends: a number, or points in time, with straight lines between them.

    v(t) = v_k + (v_k+1 - v_k) (t - t_k)/(t_k+1 - t_k)          t_k <= t <= t_k+1, at the control tick; constant outside

A CPG or a controller reads the values as those of any sensor, NAME.VALUE: `model: {steering: NAME}` of type legs, names in
equations, inputs of a network, Measured::channels in C++ and Python. Trace columns sensor.NAME.VALUE. In Python
`gaitlab.start(..., action="steering")` sends them at each step. They are free of errors.
Source: none; linear interpolation. Defaults (chosen): 0, no unit.

    sensors:
      remote:
        type: steering
        values:
          speed: {unit: m/s, value: 0.1}
          turn: {unit: rad/s, points: [[0, 0], [2, 0], [3, 0.3]]})";

void SteeringSensor::Sent::fields(Fields& f) {
  f.text("unit", unit, "Unit, for columns; that of speed and side is m/s, that of turn rad/s.");
  f.rows("points", points, {"", -1e9, 1e9, "Rows [time (s), value], in ascending order of time, in place of `value`."});
  if (points.empty()) f.number("value", value, {"", -1e9, 1e9, "The value, if it is constant."});
  const char* const fixed = name == "turn" ? "rad/s" : name == "speed" || name == "side" ? "m/s" : "";
  if (*fixed != '\0' && !unit.empty() && unit != fixed)
    f.problem("unit", "unit of " + name + " is " + unit.substr(0, 20) + "; expected " + fixed + ", or another name");
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::string number = "point " + std::to_string(k) + " of points";
    if (points[k].size() != 2)
      return f.problem("points", number + " has " + std::to_string(points[k].size()) + " numbers; expected [time, value]");
    if (k > 0 && points[k][0] <= points[k - 1][0])
      return f.problem("points", number + " is not later than the one before it; a jump takes a control period");
  }
}

void SteeringSensor::Settings::fields(Fields& f) {
  Marked(f, Need::required).by_name("values", values, "turn: {unit: rad/s, value: 0.2}", "Values by name.");
  for (const Sent& one : values) {
    const auto part = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); };
    if (one.name.empty() || std::isalpha(static_cast<unsigned char>(one.name[0])) == 0 ||
        !std::ranges::all_of(one.name, part)) {
      f.problem("values",
                "'" + one.name.substr(0, 40) + "' is not a name of a value; expected a letter, then letters, digits and _");
    }
  }
}

SteeringSensor::SteeringSensor(const SensorSite& site, const Settings& settings)
    : period_(site.period), sent_(settings.values) {
  for (const Sent& one : sent_) {
    const std::string name = site.name + "." + one.name;
    readings_.push_back({name, "sensor." + name, one.unit, "value of " + one.name + " that the operator sends"});
  }
}

void SteeringSensor::sense(const Truth& truth, Out, Out values) const {
  const double t = static_cast<double>(truth.tick) * period_;
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    const auto& points = sent_[i].points;
    const auto next = std::ranges::find_if(points, [&](const auto& point) { return point[0] > t; });
    if (points.empty()) {
      values[i] = sent_[i].value;
    } else if (next == points.begin()) {
      values[i] = points.front()[1];
    } else if (next == points.end()) {
      values[i] = points.back()[1];
    } else {
      const auto& from = *(next - 1);
      values[i] = from[1] + ((*next)[1] - from[1]) * ((t - from[0]) / ((*next)[0] - from[0]));
    }
  }
}

}  // namespace gaitlab::sensors
