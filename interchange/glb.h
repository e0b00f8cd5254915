// Writer of a binary glTF 2.0 file (.glb): its objects and its buffer of numbers.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "interchange/mesh.h"

namespace gaitlab::interchange {

/// A glTF file under construction. Objects (nodes, meshes, ...) refer to one another by index. Numbers in the buffer are
/// float32, rounded to nearest, or uint32, little-endian. Each accessor has its own buffer view.
class Glb {
 public:
  Glb() = default;  // NOLINT(bugprone-exception-escape): a JSON null does not throw
  ~Glb() = default;
  Glb(const Glb&) = delete;
  Glb& operator=(const Glb&) = delete;

  /// Adds an object to one of the file's lists (`nodes`, `materials`, ...). Returns its index in the list.
  std::size_t add(const char* list, nlohmann::json object);
  /// An object that was added before, for changes.
  nlohmann::json& at(const char* list, std::size_t index) { return json_[list][index]; }

  /// Adds an accessor of elements with `width` numbers each (1, 3 or 4) and stores their least and largest values. `drawn` is
  /// true for vertex data. Returns the accessor's index.
  std::size_t floats(const std::vector<float>& numbers, std::size_t width, bool drawn = false);
  std::size_t vectors(const std::vector<Vec3>& vectors);
  std::size_t indices(const Triangles& triangles);

  [[nodiscard]] std::size_t size() const { return buffer_.size(); }  ///< bytes in the buffer of numbers

  /// Content of the file: header, JSON with `generator`, and buffer. The same calls produce the same bytes.
  [[nodiscard]] std::string finish(std::string_view generator);

 private:
  /// Adds an accessor for the numbers in the buffer from byte `from` on.
  std::size_t accessor(std::size_t from, int component, const char* type, std::size_t count, int target);

  nlohmann::json json_;
  std::string buffer_;
};

/// Matt material of a colour `#RRGGBB` (sRGB).
nlohmann::json material(const std::string& name, std::string_view colour);

}  // namespace gaitlab::interchange
