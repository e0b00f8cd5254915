// Text of an MJCF file with its includes, reduced to the parts that a module needs.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "interchange/robot_note.h"
#include "interchange/xml_tags.h"

namespace gaitlab::interchange {

/// Parts without effect on bodies, joints and contact (sensors, cameras, materials, options of the simulator ...) become
/// blanks, so that a missing texture or an element that libmujoco lacks does not matter, and lines stay. So do the geoms of the
/// world, tendons and equality constraints, with a note.
class MjcfText {
 public:
  /// Reads the file and its includes. A mesh file is in the folder `meshes`, or if that is empty in the `meshdir` of the file.
  /// Throws InputError for a file that cannot be read, is not XML, or includes itself, for an actuator that does not act on a
  /// joint, and for a composite body.
  MjcfText(const std::string& file, const std::string& meshes);
  MjcfText(const MjcfText&) = delete;
  MjcfText& operator=(const MjcfText&) = delete;

  /// Text for libmujoco. It has limits where it states a range, as since MuJoCo 3, and `actuatorfrcrange` of joints as their
  /// `user` data. Only the mesh files whose numbers (in the order of the file) are in `meshes` are read; the others become a
  /// small tetrahedron.
  [[nodiscard]] std::string text(const std::set<std::size_t>& meshes) const;
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Place of a line of the text; the file for line 0.
  [[nodiscard]] SourceLocation place(int line) const;
  /// Number of bodies.
  [[nodiscard]] std::size_t bodies() const { return elements_.size(); }
  /// Place of a body, counted as in the model, from 1 on, and of a joint of it.
  [[nodiscard]] SourceLocation body(std::size_t b) const;
  [[nodiscard]] SourceLocation joint(std::size_t b, std::size_t k) const;
  /// True if the file states the inertia of the body, so that it does not follow from its geoms.
  [[nodiscard]] bool states_inertia(std::size_t b) const { return !from_geoms_ && elements_[b - 1].inertial; }
  /// Names of geoms that contact pairs mention.
  [[nodiscard]] const std::set<std::string>& paired() const { return paired_; }
  /// Takes an attribute that libmujoco lacks and that has no effect on a module out of all elements `tag`; false for another.
  bool drop_attribute(const std::string& tag, const std::string& name);
  [[nodiscard]] const std::vector<RobotNote>& notes() const { return notes_; }

 private:
  /// Part of the text, equal to that of a file.
  struct Piece {
    std::size_t offset;  ///< of its first character in the text
    SourceLocation first;
  };
  struct Element {
    std::size_t tag;
    std::vector<std::size_t> joints = {};  ///< tags
    bool inertial = false;
  };

  void add_file(const std::string& file, int depth);
  void add_piece(const std::string& text, const std::string& file, std::size_t begin, std::size_t end);
  [[nodiscard]] SourceLocation place_of(std::size_t offset) const;
  [[nodiscard]] std::string section_of(std::size_t tag) const;
  void blank(std::size_t begin, std::size_t end);
  void find_bodies();
  void check_actuators() const;
  void reduce();

  std::string file_, meshes_;
  std::string text_;  ///< with blanks in the place of parts that are left out
  std::vector<Piece> pieces_;
  std::set<std::string> included_;
  std::vector<XmlTag> tags_;             ///< of the text before parts became blanks
  std::vector<Element> elements_;        ///< bodies in the order of the file
  std::vector<std::size_t> mesh_files_;  ///< tags of meshes in the order of the file
  std::set<std::string> paired_;
  bool from_geoms_ = false;  ///< true for `inertiafromgeom="true"`
  std::vector<RobotNote> notes_;
};

}  // namespace gaitlab::interchange
