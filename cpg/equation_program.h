// Compact program that evaluates checked trees of `equations` for all joints at once.
#pragma once
#include <array>
#include <cstdint>
#include <utility>

#include "cpg/equation_names.h"

namespace gaitlab::cpg {

/// Values that are known when a program is made, one per joint unless stated otherwise.
struct EquationTables {
  std::size_t joints = 0;
  std::vector<std::vector<double>> given, parameters;  ///< values by slot, then by joint
  std::vector<Coupling> couplings;
  std::vector<std::size_t> module;    ///< module of each joint
  std::vector<std::int64_t> parent;   ///< next joint towards the base, or -1
  std::vector<std::size_t> channels;  ///< number in Measured::channels, by slot
};

/// Inputs of a run. A span that no text uses may be empty.
struct EquationInputs {
  double t = 0;
  In state, angle, speed, torque;  ///< index of state: slot * joints + joint; index of the other spans: joint
  In touching;                     ///< index: number of the module
  In load = {}, channels = {};     ///< index: joint; number of the sensor value
};

/// Program of instructions. Each instruction is a loop over all joints or, within a neighbour sum, over all couplings, whose
/// values are then added by target joint. Values that depend on no input are computed once, when the program is made. One
/// object serves one rollout: run() writes to its scratch memory and does not allocate. An instruction costs about a nanosecond
/// per joint, plus its functions.
class EquationProgram {
 public:
  EquationProgram() = default;
  /// Compiles trees that have passed EquationNames::check.
  EquationProgram(const EquationNames& names, const EquationTables& tables, std::span<const Term> texts);
  /// Evaluates all texts. The index of `result` is text * joints + joint.
  void run(const EquationInputs& inputs, Out result) const;

 private:
  enum class Base : std::uint8_t { fixed, scratch, state, angle, speed, torque, touching, load, channels, result };
  /// A block of numbers with one number per joint or per coupling.
  struct Block {
    Base base = Base::fixed;
    std::size_t offset = 0;
  };
  enum class Move : std::uint8_t { none, copy, time, one, gather_from, gather_to, gather_module, limb, sum };
  struct Instruction {
    Move move = Move::none;  ///< `none` means that the instruction computes `op`
    Function::Op op = {};
    std::array<Block, 3> in = {};
    Block out = {};
    std::size_t count = 0;
  };
  using Bases = std::array<const double*, 10>;

  /// Set over which a place in a text is evaluated: joints or, within a sum, couplings.
  enum class Over { joints, couplings };
  Block compile(const Term& term, Over over);
  Block compile_name(const Term& term, Over over);
  Block compile_call(const Term& term, Over over);
  Block emit(Instruction instruction, Over over);
  Block constant(double value, Over over);
  Block keep(const std::vector<double>& values);
  Block take_scratch();
  void give_back(const Block& block);
  void put_out(const Block& value, std::size_t text);
  void execute(const Instruction& instruction, const Bases& bases, double t, double* out) const;
  [[nodiscard]] std::size_t count(Over over) const { return over == Over::joints ? joints_ : from_.size(); }

  std::size_t joints_ = 0;
  std::vector<std::size_t> from_, to_, module_;
  /// Joints and the next ones towards the base, from the ends of the limbs inwards.
  std::vector<std::pair<std::size_t, std::size_t>> inwards_;
  std::vector<Instruction> instructions_;
  std::vector<double> fixed_;
  mutable std::vector<double> scratch_;
  // The following members are used only during construction.
  const EquationNames* names_ = nullptr;
  const EquationTables* tables_ = nullptr;
  std::vector<std::size_t> free_;
  std::size_t blocks_ = 0, width_ = 0;
};

}  // namespace gaitlab::cpg
