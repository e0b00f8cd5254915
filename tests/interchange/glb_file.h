// Reader of binary glTF files that is independent of the program's writer: objects, numbers, poses of the nodes.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab::test {

/// Binary glTF file. Throws if the container violates the specification of glTF 2.0.
class GlbFile {
 public:
  explicit GlbFile(std::string bytes) : bytes_(std::move(bytes)) {
    expect(bytes_.starts_with("glTF"), "magic");
    expect(word(4) == 2, "version");
    expect(word(8) == bytes_.size(), "length");
    expect(bytes_.compare(16, 4, "JSON") == 0, "first chunk");
    const std::size_t text = word(12);
    expect(text % 4 == 0, "alignment of the first chunk");
    json_ = nlohmann::json::parse(bytes_.substr(20, text));
    binary_ = 20 + text + 8;
    if (20 + text == bytes_.size()) return;
    expect(bytes_.compare(binary_ - 4, 4, std::string("BIN\0", 4)) == 0, "second chunk");
    expect(word(binary_ - 8) + binary_ == bytes_.size(), "length of the second chunk");
    expect(json_["buffers"][0]["byteLength"] == bytes_.size() - binary_, "length of the buffer");
    for (std::size_t n = 0; n < json_["nodes"].size(); ++n) {
      numbers_[json_["nodes"][n]["name"]] = n;
      for (const std::size_t child : json_["nodes"][n].value("children", std::vector<std::size_t>())) parents_[child] = n;
    }
    if (!json_.contains("animations")) return;
    const nlohmann::json& animation = json_["animations"][0];
    for (const nlohmann::json& channel : animation["channels"]) {
      const nlohmann::json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      const nlohmann::json& target = channel["target"];
      channels_[{target["node"], target["path"]}] = numbers(sampler["output"].get<std::size_t>());
    }
  }

  [[nodiscard]] const nlohmann::json& json() const { return json_; }
  [[nodiscard]] std::size_t node(const std::string& name) const { return numbers_.at(name); }
  [[nodiscard]] bool has_node(const std::string& name) const { return numbers_.contains(name); }

  /// Numbers of an accessor, row by row. Throws if the accessor's `min` or `max` differs from the numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t accessor) const {
    const nlohmann::json& a = json_["accessors"][accessor];
    const nlohmann::json& view = json_["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t width = std::map<std::string, std::size_t>{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}}.at(a["type"]);
    const std::size_t count = width * a["count"].get<std::size_t>();
    const std::size_t from = view["byteOffset"];
    expect(from % 4 == 0 && view["byteLength"] == 4 * count, "a view is its accessor's, aligned");
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t bits = word(binary_ + from + 4 * i);
      all.push_back(a["componentType"] == 5126 ? static_cast<double>(std::bit_cast<float>(bits)) : bits);
    }
    for (std::size_t i = 0; i < width && a.contains("min"); ++i) {
      double least = all[i];
      double largest = all[i];
      for (std::size_t k = i; k < count; k += width) {
        least = std::min(least, all[k]);
        largest = std::max(largest, all[k]);
      }
      expect(a["min"][i] == least && a["max"][i] == largest, "least and largest");
    }
    return all;
  }

  [[nodiscard]] std::vector<double> times() const {
    return numbers(json_["animations"][0]["samplers"][0]["input"].get<std::size_t>());
  }
  /// Keyframes of the `translation` or `rotation` of a node; empty if the animation has no such channel.
  [[nodiscard]] const std::vector<double>& channel(std::size_t node, const std::string& path) const {
    static const std::vector<double> kNone;
    const auto found = channels_.find({node, path});
    return found == channels_.end() ? kNone : found->second;
  }
  [[nodiscard]] const std::vector<double>& channel(const std::string& name, const std::string& path) const {
    return channel(node(name), path);
  }

  /// Pose of node n in the frame of its parent at a keyframe, without scale. Without a channel, the pose is constant.
  [[nodiscard]] Pose in_parent(std::size_t n, std::size_t frame) const {
    const nlohmann::json& node = json_["nodes"][n];
    const auto part = [&](const char* path, const std::vector<double>& still) {
      const std::vector<double>& moves = channel(n, path);
      if (moves.empty()) return node.value(path, still);
      const auto from = moves.begin() + static_cast<std::ptrdiff_t>(frame * still.size());
      return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(still.size()));
    };
    const std::vector<double> p = part("translation", {0, 0, 0});
    const std::vector<double> q = part("rotation", {0, 0, 0, 1});
    return {Quat(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix(), {p[0], p[1], p[2]}};
  }
  /// Number of the parent of node n; -1 if the node has no parent.
  [[nodiscard]] int parent(std::size_t n) const { return parents_.contains(n) ? static_cast<int>(parents_.at(n)) : -1; }
  /// Pose of a node in the world of gaitlab (z up), which is the frame of the node `world`.
  [[nodiscard]] Pose pose(const std::string& name, std::size_t frame) const {
    Pose total;
    for (std::size_t n = node(name); parent(n) >= 0; n = parents_.at(n)) total = in_parent(n, frame) * total;
    return total;
  }

 private:
  static void expect(bool so, const char* what) {
    if (!so) throw std::runtime_error(std::string("glTF: ") + what);
  }
  [[nodiscard]] std::uint32_t word(std::size_t at) const {
    expect(at + 4 <= bytes_.size(), "a number beyond the end");
    std::uint32_t made = 0;
    for (std::size_t k = 4; k-- > 0;) made = (made << 8U) | static_cast<unsigned char>(bytes_[at + k]);
    return made;
  }

  std::string bytes_;
  nlohmann::json json_;
  std::size_t binary_ = 0;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::size_t, std::size_t> parents_;
  std::map<std::pair<std::size_t, std::string>, std::vector<double>> channels_;
};

}  // namespace gaitlab::test
