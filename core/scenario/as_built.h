// The robot as built: its differences from the drawings, measured or drawn at random within tolerances.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/model/robot.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Sections `tolerances` and `as_built`. A number of a part (module, joint, or the whole robot) is the value in `as_built` or,
/// without such a value, drawn:
///     x = neutral + deviation * min(max(n, -3), 3),  n normal with mean 0 and deviation 1
/// where `neutral` is 1 for factors and 0 for angles. n is a Philox draw (core/math/philox.h). Its key is the seed, and its
/// counter the names of part and number, such as m3/active.R or robot.supply. The same seed therefore gives the same robot.

/// A deviation in the section `tolerances`.
struct Tolerance {
  const char* key;
  Spec spec;
};

/// A number in the section `as_built`, for each part of one category.
struct BuiltNumber {
  enum class Of { robot, modules, motors, gears };
  const char* key;
  Of of;
  std::size_t tolerance;  ///< index in kTolerances
  double neutral;         ///< value of a part that equals the drawings
  Spec spec;
};

inline constexpr const char* kTolerancesSection = "tolerances";
inline constexpr const char* kAsBuiltSection = "as_built";

extern const std::array<Tolerance, 9> kTolerances;
extern const std::array<BuiltNumber, 11> kBuiltNumbers;

/// Values of the section `tolerances`, in the order of kTolerances.
struct Tolerances {
  std::array<double, 9> deviation{};
  [[nodiscard]] bool any() const { return *this != Tolerances(); }
  bool operator==(const Tolerances&) const = default;
  void fields(Fields& f);
};

/// Values of the section `as_built`, in the order of kBuiltNumbers. All are neutral by default.
struct AsBuilt {
  std::array<PerJoint, 11> numbers;

  AsBuilt();
  /// All numbers unknown (NaN), for the time before the section is read.
  static AsBuilt unknown();
  [[nodiscard]] bool any() const { return *this != AsBuilt(); }
  bool operator==(const AsBuilt&) const = default;
  void fields(Fields& f);
};

/// Names of a robot's modules: m0, m1 ...
std::vector<std::string> module_names(const Robot& robot);

/// Parts of the robot that have a number. The name is empty for a part that cannot differ: for module 0, the root, if the
/// number concerns docks, for a hinge without a motor, and, if the number concerns gears, for a gear without play.
std::vector<std::string> parts_with(const BuiltNumber& number, const Robot& robot);

/// Replaces unknown numbers by draws. Numbers of parts that cannot differ are neutral: docks of module 0, motors of hinges
/// without a motor, gears without play. Returns the number of draws.
std::size_t draw(AsBuilt& built, const Tolerances& tolerances, const Robot& robot, std::uint64_t seed);

/// The differences of each module; empty if there are none.
std::vector<ModuleBuild> module_builds(const AsBuilt& built, std::size_t modules);

/// Key that states or draws factors on play other than 1, such as tolerances.play; empty if there is none.
std::string play_key(const AsBuilt& stated, const Tolerances& tolerances);
/// Factor on the play of a joint's gear.
double play_build(const AsBuilt& built, std::size_t joint);

/// Factors on the constants of a motor.
struct MotorBuild {
  double R = 1;              ///< factor on the resistance
  double Kt = 1;             ///< factor on torque constant and back-EMF constant
  double gear_friction = 1;  ///< factor on the lost share 1 - efficiency and on friction
  double supply = 1;         ///< factor on the largest voltage
  bool operator==(const MotorBuild&) const = default;
};
MotorBuild motor_build(const AsBuilt& built, std::size_t joint);
/// True if a motor differs from the drawings.
bool motors_differ(const AsBuilt& built);

}  // namespace gaitlab
