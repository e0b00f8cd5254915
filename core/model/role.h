// What a body is to the eye.
#pragma once
#include <cstddef>

#include "core/model/module_type.h"

namespace gaitlab {

/// The block that carries the active or the passive faces, or the link between them.
enum class Role { active, link, passive, other };

/// `active`, `link`, `passive`, `other`.
inline const char* name_of(Role role) {
  constexpr const char* kNames[] = {"active", "link", "passive", "other"};
  return kNames[static_cast<std::size_t>(role)];
}

/// Of a body of a module type: the gender of the body's first face; link without faces.
inline Role role_of(const ModuleType& type, std::size_t body) {
  for (const FaceType& face : type.faces) {
    if (face.body == body) return face.gender == Gender::active ? Role::active : Role::passive;
  }
  return Role::link;
}

}  // namespace gaitlab
