// Contact laws of a scenario and their properties. Other code tests these properties, not the name of a law.
#pragma once
#include "core/names.h"

namespace gaitlab {

enum class ContactLaw { penalty, solver };  ///< forces from penetration and speed, or constraints in the engine's solver

/// Properties of a contact law.
struct ContactModel {
  ContactLaw value;
  const char* text;          ///< value of `contact.law`
  bool penalty_settings;     ///< forces of PenaltyContact, with stiffness, damping, and friction that is viscous at low speed
  bool element_forces;       ///< the ground acts only on contact elements, with forces that determine reactions and loads
  bool moves_boxes;          ///< boxes of the ground may have a mass
  bool keeps_bodies_apart;   ///< bodies touch one another and the ground with their shapes
  bool any_ground;           ///< all types of ground are possible; if false, only plane and boxes
  bool rotor_inertia;        ///< joints may have the reflected inertia of rotors
  bool complete_state;       ///< the state determines the forces, so that a copy of the state is a snapshot
  bool converges;            ///< torques converge as the step becomes shorter
  bool has_step_of_its_own;  ///< the default step is `solver_step` of the engine, for its default integrator with given steps
};

template <>
struct EnumNames<ContactLaw> {
  static constexpr ContactModel kTable[] = {{.value = ContactLaw::penalty,
                                             .text = "penalty",
                                             .penalty_settings = true,
                                             .element_forces = true,
                                             .moves_boxes = false,
                                             .keeps_bodies_apart = false,
                                             .any_ground = true,
                                             .rotor_inertia = true,
                                             .complete_state = true,
                                             .converges = true,
                                             .has_step_of_its_own = false},
                                            {.value = ContactLaw::solver,
                                             .text = "bullet",
                                             .penalty_settings = false,
                                             .element_forces = false,
                                             .moves_boxes = true,
                                             .keeps_bodies_apart = true,
                                             .any_ground = false,
                                             .rotor_inertia = false,
                                             .complete_state = false,
                                             .converges = false,
                                             .has_step_of_its_own = true}};
};

}  // namespace gaitlab
