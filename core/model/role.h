// Role of a body in drawings, which sets its colour.
#pragma once
#include "core/model/module_type.h"
#include "core/names.h"

namespace gaitlab {

/// The role of a block is the gender of its faces, or other if its faces do not have a gender. The role of a body without faces
/// is link.
enum class Role { active, link, passive, other };

template <>
struct EnumNames<Role> {
  using enum Role;
  static constexpr EnumName<Role> kTable[] = {{active, "active"}, {link, "link"}, {passive, "passive"}, {other, "other"}};
};

/// Role of a body of a module type, by the gender of its first face; link if it has no faces.
inline Role role_of(const ModuleType& type, std::size_t body) {
  for (const FaceType& face : type.faces) {
    if (face.body != body) continue;
    return face.gender == Gender::active ? Role::active : face.gender == Gender::passive ? Role::passive : Role::other;
  }
  return Role::link;
}

}  // namespace gaitlab
