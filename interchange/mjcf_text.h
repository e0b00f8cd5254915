// Text of an MJCF file with its includes, reduced to what a module takes from it.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "interchange/robot_bodies.h"
#include "interchange/robot_note.h"
#include "interchange/xml_tags.h"

namespace gaitlab::interchange {

/// Parts without effect on bodies, joints and contact (sensors, cameras, materials, options of the simulator ...) become
/// blanks, so that a missing texture or an element that libmujoco lacks does not matter, and lines stay. So do the geoms of the
/// world, tendons and equality constraints, with a note, and meshes that are only drawn.
class MjcfText {
 public:
  /// Reads the file and its includes. A mesh file is in the folder `meshes`, or if that is empty in the `meshdir` of the file.
  /// Throws InputError for a file that cannot be read, is not XML, or includes itself, and for an actuator that does not act on
  /// a joint.
  MjcfText(const std::string& file, const std::string& meshes);
  MjcfText(const MjcfText&) = delete;
  MjcfText& operator=(const MjcfText&) = delete;

  /// Text for libmujoco. It has limits where it states a range, as since MuJoCo 3.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Place of a line of the text; the file for line 0.
  [[nodiscard]] SourceLocation place(int line) const;
  /// Place of a body, counted as in the model, from 1 on, and of a joint of it.
  [[nodiscard]] SourceLocation body(std::size_t b) const;
  [[nodiscard]] SourceLocation joint(std::size_t b, std::size_t k) const;
  /// Largest torque of all actuators on a joint, N m (`actuatorfrcrange` of MuJoCo 3); nothing if the file has none.
  [[nodiscard]] std::optional<double> torque_limit(std::size_t b, std::size_t k) const;
  /// Takes an attribute out of all elements `tag`; false if none has it. A note counts them.
  bool drop_attribute(const std::string& tag, const std::string& name);
  [[nodiscard]] const std::vector<RobotNote>& notes() const { return notes_; }

 private:
  /// Part of the text that stands as it is in a file.
  struct Piece {
    std::size_t offset;  ///< of its first character in the text
    SourceLocation first;
  };
  struct Element {
    std::size_t tag;
    std::vector<std::size_t> joints = {};                   ///< tags
    std::vector<std::optional<double>> torque_limits = {};  ///< by joint
  };

  void add_file(const std::string& file, int depth);
  void add_piece(const std::string& text, const std::string& file, std::size_t begin, std::size_t end);
  [[nodiscard]] SourceLocation place_of(std::size_t offset) const;
  [[nodiscard]] bool inside(std::size_t tag, std::string_view section) const;
  /// Value of an attribute, of the element or of its default class; empty if there is none.
  [[nodiscard]] std::string_view value(std::size_t tag, std::string_view attribute) const;
  [[nodiscard]] std::optional<std::size_t> default_of(std::string_view name, std::string_view tag) const;
  void blank(std::size_t begin, std::size_t end);
  void blank(const XmlTag& tag) { blank(tag.begin, tag.close_end); }
  void blank(const XmlTag::Attribute& attribute);
  void left_out(const XmlTag& first, const std::string& text, bool changed);
  void reduce();
  void drop_drawn_meshes();
  void check_actuators() const;

  std::string file_, meshes_;
  std::string text_;  ///< with blanks in the place of what is left out
  std::vector<Piece> pieces_;
  std::set<std::string> included_;
  std::vector<XmlTag> tags_;       ///< of the text before parts became blanks
  std::vector<Element> elements_;  ///< bodies in the order of the file
  std::vector<RobotNote> notes_;
};

}  // namespace gaitlab::interchange
