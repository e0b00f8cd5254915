// Channels of a sensor, with their states one after the other.
#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sensors/channel.h"

namespace gaitlab::sensors {

class ChannelBank {
 public:
  void add(Channel channel) {
    channels_.push_back(std::move(channel));
    states_ += channels_.back().states();
  }
  [[nodiscard]] std::size_t states() const { return states_; }
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] bool draws() const {
    return std::ranges::any_of(channels_, [](const Channel& channel) { return channel.draws(); });
  }
  [[nodiscard]] bool quantises() const {
    return std::ranges::any_of(channels_, [](const Channel& channel) { return channel.quantises(); });
  }
  [[nodiscard]] std::vector<SensorStream> streams() const {
    std::vector<SensorStream> all;
    for (const Channel& channel : channels_) all.push_back(channel.stream());
    return all;
  }

  /// Computes the values of all channels, one channel after the other. truth(i) returns the true numbers of channel i.
  template <class TruthOf>
  void sense(std::int64_t tick, const TruthOf& truth, Out state, Out values) const {
    std::size_t at = 0;
    std::size_t number = 0;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const Channel& channel = channels_[i];
      channel.sense(tick, truth(i), state.subspan(at, channel.states()), values.subspan(number, channel.size()));
      at += channel.states();
      number += channel.size();
    }
  }

 private:
  std::vector<Channel> channels_;
  std::size_t states_ = 0;
};

}  // namespace gaitlab::sensors
