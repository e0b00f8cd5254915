// Implicit step of one of the rollouts of a kernel, in scalar code.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab::articulated {

/// Takes the implicit steps (implicit.h) that only one rollout of a kernel needs. Lanes divide their steps at different times;
/// a step of one lane takes 1.7 times as long in a kernel of four lanes as in scalar code. The results have the same bits.
class Solo {
 public:
  Solo() = default;
  Solo(const Solo&) = delete;
  Solo& operator=(const Solo&) = delete;
  virtual ~Solo() = default;

  /// Advances x (StateLayout, SI) by a step h (s) and sets the results. `command` has an entry per joint. The step ends `end`
  /// seconds after the start of the whole step of the kernel.
  virtual void step(Out x, In command, double h, double end) = 0;

  virtual void change(In hold, In since) = 0;  ///< see Plant::change_joints; with all lanes of the kernel

  In torque, speed, angle;  ///< by joint, at the end of the step: torque, N m; speed, rad/s; angle, rad
  In slope;                 ///< by joint: slope of the motor's tangent in the last solve, N m s/rad
  double contact = 0, friction = 0, stops = 0, hinges = 0;  ///< works, J (StepResult)
  double solves = 0, off = 0;                               ///< number of solves; number of motors and stops off their law
  bool unfinished = false;                                  ///< true if Newton's method did not converge
  bool slides = false;                                      ///< true if most of the load slides
  bool switches = false;                                    ///< true if a joint began or ceased to stick
};

/// Solo of one lane. Not a smart pointer, whose functions would be compiled for several processors (kernel_avx2.cpp).
struct SoloOfLane {
  Solo* get = nullptr;
};

}  // namespace gaitlab::articulated
