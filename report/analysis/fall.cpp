#include "report/analysis/fall.h"

#include <utility>

#include "core/simulation/start.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

/// Computes the height of one pose after another.
class Altimeter {
 public:
  Altimeter(const Scenario& scenario, Ground ground)
      : scenario_(scenario),
        ground_(std::move(ground)),
        elements_(contact_elements(*scenario.robot, scenario.contact.on)),
        k_(*scenario.robot) {}

  double operator()(const RobotState& state) {
    k_.place(*scenario_.robot, state);
    const Vec3 com = centre_of_mass(*scenario_.robot, k_);
    if (ground_.is_plane()) return com.z();
    const double give = scenario_.limits.sink;  // m: an element deeper than this is not supported there (check `in_ground`)
    if (elements_.empty()) return com.z() - ground_.surface_below(com, give);
    double below = 0;
    for (const ContactElement& e : elements_) below += ground_.surface_below(k_.point(e.link, e.centre), give);
    return com.z() - below / static_cast<double>(elements_.size());
  }

 private:
  const Scenario& scenario_;
  Ground ground_;
  std::vector<ContactElement> elements_;
  Kinematics k_;
};

/// Ground without the boxes that move. They are at the scenario's places only at the start, and their later places are not
/// recorded.
Ground fixed_ground(const Scenario& scenario) {
  return scenario.contact.model().moves_boxes ? scenario.ground.without_moving_boxes() : scenario.ground;
}

}  // namespace

std::vector<double> heights(const Scenario& scenario, const Recording& r) {
  const States states = States::at_ticks(r, *scenario.robot);
  Altimeter height(scenario, fixed_ground(scenario));
  std::vector<double> all;
  for (std::size_t row = 0; row < states.size(); ++row) all.push_back(height(states(row)));
  return all;
}

double standing_height(const Scenario& scenario) { return Altimeter(scenario, scenario.ground)(lowered_start(scenario)); }

std::optional<Fall> fall(const Scenario& scenario, const Recording& r) {
  if (scenario.base != Base::floating || !scenario.ground.exists()) return {};
  const double standing = standing_height(scenario);
  const std::vector<double> height = heights(scenario, r);
  if (height.empty() || !(standing > 0)) return {};
  const States states = States::at_ticks(r, *scenario.robot);
  Fall found{.standing = standing, .lowest = height[0]};
  for (std::size_t row = 0; row < height.size(); ++row) {
    if (height[row] < found.lowest) {
      found.lowest = height[row];
      found.lowest_time = states.time(row);
    }
    if (!found.time && found.share() < scenario.limits.height) found.time = states.time(row);
  }
  return found;
}

}  // namespace gaitlab::report
