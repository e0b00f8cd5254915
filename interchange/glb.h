// A glTF 2.0 file under construction: its objects, and their numbers.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "interchange/mesh.h"

namespace gaitlab::interchange {

/// Objects (nodes, meshes ...) refer to one another by index. All numbers of the buffer are float32, rounded to nearest, or
/// uint32, little-endian, each accessor in a separate view.
class Glb {
 public:
  Glb() = default;
  ~Glb() = default;
  Glb(const Glb&) = delete;
  Glb& operator=(const Glb&) = delete;

  /// Adds an object to one of the file's lists (`nodes`, `materials` ...); returns its index.
  std::size_t add(const char* list, nlohmann::json object);
  /// An object that was added.
  nlohmann::json& at(const char* list, std::size_t index) { return json_[list][index]; }

  /// Adds an accessor with `width` numbers per element (1, 3 or 4), with their least and largest; `drawn`: for vertices.
  std::size_t floats(const std::vector<float>& numbers, std::size_t width, bool drawn = false);
  std::size_t vectors(const std::vector<Vec3>& vectors);
  std::size_t indices(const Triangles& triangles);

  [[nodiscard]] std::size_t size() const { return buffer_.size(); }  ///< bytes of numbers

  /// The whole file: header, JSON with `generator`, numbers. The same calls give the same bytes.
  [[nodiscard]] std::string finish(std::string_view generator);

 private:
  /// Accessor of the numbers added to the buffer since its size was `from`, in bytes.
  std::size_t accessor(std::size_t from, int component, const char* type, std::size_t count, int target);

  nlohmann::json json_;
  std::string buffer_;
};

/// `#RRGGBB` (sRGB) as a matt material.
nlohmann::json material(const std::string& name, std::string_view colour);

}  // namespace gaitlab::interchange
