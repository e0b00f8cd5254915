// The contact laws of a scenario and their properties, so that nothing else tests for a law by its name.
#pragma once
#include "core/names.h"

namespace gaitlab {

enum class ContactLaw { penalty, solver };  ///< forces of penetration and velocity, or constraints of the engine's own solver

/// Properties of a contact law.
struct ContactModel {
  ContactLaw value;
  const char* text;          ///< `contact.law`
  bool penalty_settings;     ///< forces by PenaltyContact: stiffness, damping, friction that is viscous at low speed
  bool element_forces;       ///< the ground acts at contact elements alone, by forces, from which reactions and loads follow
  bool moves_boxes;          ///< boxes of the ground may have a mass
  bool keeps_bodies_apart;   ///< bodies touch one another and the ground by their shapes
  bool any_ground;           ///< else plane and boxes alone
  bool rotor_inertia;        ///< joints may have the reflected inertia of rotors
  bool complete_state;       ///< forces follow from the state, so that a copy of it is a snapshot
  bool converges;            ///< torques converge as the step becomes shorter
  bool has_step_of_its_own;  ///< the engine's `solver_step`, with its default integrator
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
