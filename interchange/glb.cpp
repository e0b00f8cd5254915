#include "interchange/glb.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>

#include "core/math/functions.h"

namespace gaitlab::interchange {

namespace {

// Constants of the glTF 2.0 specification (sections 4.4 and 3.6).
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedInt = 5125, kVertices = 34962, kIndices = 34963;

void append(std::string& to, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) to.push_back(static_cast<char>((word >> shift) & 0xFFU));
}

void append_chunk(std::string& to, std::uint32_t type, const std::string& bytes) {
  append(to, static_cast<std::uint32_t>(bytes.size()));
  append(to, type);
  to += bytes;
}

}  // namespace

std::size_t Glb::add(const char* list, nlohmann::json object) {
  json_[list].push_back(std::move(object));
  return json_[list].size() - 1;
}

std::size_t Glb::accessor(std::size_t from, int component, const char* type, std::size_t count, int target) {
  nlohmann::json view{{"buffer", 0}, {"byteOffset", from}, {"byteLength", buffer_.size() - from}};
  if (target != 0) view["target"] = target;
  return add(
      "accessors",
      {{"bufferView", add("bufferViews", std::move(view))}, {"componentType", component}, {"type", type}, {"count", count}});
}

std::size_t Glb::floats(const std::vector<float>& numbers, std::size_t width, bool drawn) {
  const std::size_t from = buffer_.size();
  std::vector<float> least(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width));
  std::vector<float> largest = least;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    append(buffer_, std::bit_cast<std::uint32_t>(numbers[i]));
    least[i % width] = std::min(least[i % width], numbers[i]);
    largest[i % width] = std::max(largest[i % width], numbers[i]);
  }
  const char* type = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
  const std::size_t made = accessor(from, kFloat, type, numbers.size() / width, drawn ? kVertices : 0);
  at("accessors", made)["min"] = least;
  at("accessors", made)["max"] = largest;
  return made;
}

std::size_t Glb::vectors(const std::vector<Vec3>& vectors) {
  std::vector<float> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) {
    for (const double x : v) numbers.push_back(static_cast<float>(x));
  }
  return floats(numbers, 3, true);
}

std::size_t Glb::indices(const Triangles& triangles) {
  const std::size_t from = buffer_.size();
  for (const std::uint32_t corner : triangles) append(buffer_, corner);
  return accessor(from, kUnsignedInt, "SCALAR", triangles.size(), kIndices);
}

std::string Glb::finish(std::string_view generator) {
  json_["scene"] = 0;
  json_["asset"] = {{"version", "2.0"}, {"generator", generator}};
  if (!buffer_.empty()) json_["buffers"] = nlohmann::json::array({{{"byteLength", buffer_.size()}}});
  // Names may come from a file with any encoding, and invalid UTF-8 is replaced.
  std::string json = json_.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::size_t chunks = 8 + json.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
  std::string file;
  file.reserve(12 + chunks);
  append(file, kMagic);
  append(file, kVersion);
  append(file, static_cast<std::uint32_t>(12 + chunks));
  append_chunk(file, kJsonChunk, json);
  if (!buffer_.empty()) append_chunk(file, kBinaryChunk, buffer_);
  return file;
}

nlohmann::json material(const std::string& name, std::string_view colour) {
  nlohmann::json factor;
  for (const std::size_t at : {1U, 3U, 5U}) {
    int byte = 0;
    std::from_chars(colour.data() + at, colour.data() + at + 2, byte, 16);
    const double srgb = byte / 255.0;
    // Conversion from sRGB to linear (IEC 61966-2-1).
    factor.push_back(srgb <= 0.04045 ? srgb / 12.92 : math::pow((srgb + 0.055) / 1.055, 2.4));
  }
  factor.push_back(1);
  return {{"name", name},
          {"pbrMetallicRoughness", {{"baseColorFactor", factor}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}}};
}

}  // namespace gaitlab::interchange
