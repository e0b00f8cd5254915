// Entries of the first lanes of a lane group, from arrays with index joint * lanes + lane.
#pragma once
#include <array>
#include <vector>

#include "core/plugin/fields.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// Extracts the entries of the first lanes. The result is a copy in the slot `Place`, or the array itself if all lanes are
/// wanted. The methods allocate nothing.
class FirstLanes {
 public:
  enum Place {
    torque,
    speed,
    angle,
    setpoint,
    voltage,
    current,
    saturation,
    power_in,
    copper,
    gear,
    dry,
    available,
    bound,
    places
  };

  FirstLanes(const StateLayout& layout, std::size_t lanes) : layout_(layout), lanes_(lanes) {
    for (auto& copy : copies_) copy.assign(layout.joints * lanes, 0.0);
  }
  [[nodiscard]] bool all() const { return lanes_ == layout_.lanes; }
  In of(In values, Place place) { return all() ? values : In(copy(values, 0, copies_[place])); }
  Out of(Out values, Place place) { return all() ? values : copy(values, 0, copies_[place]); }
  /// Copies the entries of as many lanes, from lane `lane` on.
  In from(In values, std::size_t lane, Place place) { return copy(values, lane, copies_[place]); }

 private:
  Out copy(In values, std::size_t lane, std::vector<double>& to) const {
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      for (std::size_t l = 0; l < lanes_; ++l) to[j * lanes_ + l] = values[j * layout_.lanes + lane + l];
    }
    return to;
  }

  StateLayout layout_;
  std::size_t lanes_;
  std::array<std::vector<double>, places> copies_;
};

}  // namespace gaitlab
