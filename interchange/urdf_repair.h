// Faults of URDF files that other readers forgive, repaired before urdfdom reads the file.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace gaitlab::interchange {

struct UrdfRepair {
  struct Note {
    std::size_t offset;  ///< of the fault in the text of the file
    std::string text;
    bool changed;  ///< false if it has no effect on the motion
  };
  /// A part of a link: its name, true for its collision and false for its visual, and the number of the part.
  using Part = std::tuple<std::string, bool, std::size_t>;

  std::string text;                 ///< for urdfdom
  std::vector<Note> notes;          ///< one for each fault, in the order of the file
  std::set<Part> capsules;          ///< parts that are capsules; cylinders in `text`
  std::set<std::string> no_limits;  ///< joints without an element `limit`, which has no effort and no velocity in `text`
  std::set<std::string> no_ranges;  ///< joints whose `limit` has neither `lower` nor `upper`
};

inline constexpr double kNoEffort = 1.25e307;  ///< N m, in `text` in the place of a missing effort; see also kNoSpeed
inline constexpr double kNoSpeed = 1.25e307;   ///< rad/s, in the place of a missing velocity

/// Repairs a URDF file:
/// - materials are removed, because no part of a module has one; a note if one has no name or that of another;
/// - `<capsule radius length>`, which URDF lacks, becomes a cylinder that is listed;
/// - a number may end in a second point (`-1.57.`), a vector may have commas between its numbers, and 4 numbers for 3;
/// - a joint with a range may lack `limit`, or its effort or velocity.
/// A value that needs a guess, such as `0,5` for one number, is left as it is. `text` is the file, and
/// `without_comments` is the same with blanks in the place of comments.
UrdfRepair repaired_urdf(std::string_view text, std::string_view without_comments);

}  // namespace gaitlab::interchange
