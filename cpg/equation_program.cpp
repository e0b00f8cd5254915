#include "cpg/equation_program.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace gaitlab::cpg {
namespace {

using Op = expression::Function::Op;
using Kind = EquationNames::Kind;

/// Joints with a parent, and their parents; a joint precedes its parent.
std::vector<std::pair<std::size_t, std::size_t>> inwards(const std::vector<std::int64_t>& parent) {
  std::vector<std::pair<std::size_t, std::size_t>> order;  // depth, joint
  for (std::size_t j = 0; j < parent.size(); ++j) {
    std::size_t depth = 0;
    for (std::int64_t p = parent[j]; p >= 0; p = parent[static_cast<std::size_t>(p)]) ++depth;
    if (depth > 0) order.emplace_back(depth, j);
  }
  std::ranges::stable_sort(order, std::greater<>(), [](const auto& one) { return one.first; });
  for (auto& [first, second] : order) {
    first = second;
    second = static_cast<std::size_t>(parent[first]);
  }
  return order;
}

}  // namespace

EquationProgram::EquationProgram(const EquationNames& names, const EquationTables& tables, std::span<const Term> texts)
    : joints_(tables.joints), module_(tables.module), inwards_(inwards(tables.parent)), names_(&names), tables_(&tables) {
  for (const Coupling& c : tables.couplings) {
    from_.push_back(static_cast<std::size_t>(c.from));
    to_.push_back(static_cast<std::size_t>(c.to));
  }
  width_ = std::max({std::size_t{1}, joints_, from_.size()});  // a robot may have no joint
  for (std::size_t k = 0; k < texts.size(); ++k) put_out(compile(texts[k], Over::joints), k);
  scratch_.assign(blocks_ * width_, 0.0);
  names_ = nullptr;
  tables_ = nullptr;
}

EquationProgram::Block EquationProgram::keep(const std::vector<double>& values) {
  const std::size_t offset = fixed_.size();
  fixed_.insert(fixed_.end(), values.begin(), values.end());
  return {Base::fixed, offset};
}

EquationProgram::Block EquationProgram::constant(double value, Over over) {
  return keep(std::vector<double>(count(over), value));
}

EquationProgram::Block EquationProgram::take_scratch() {
  if (free_.empty()) free_.push_back(blocks_++);
  const std::size_t block = free_.back();
  free_.pop_back();
  return {Base::scratch, block * width_};
}

void EquationProgram::give_back(const Block& block) {
  if (block.base != Base::scratch) return;
  const std::size_t number = block.offset / width_;
  if (std::ranges::find(free_, number) == free_.end()) free_.push_back(number);  // both operands of x * x are the same number
}

/// Adds an instruction. If its operands are constant, computes its result instead.
EquationProgram::Block EquationProgram::emit(Instruction instruction, Over over) {
  instruction.count = count(over);
  bool fixed = instruction.move != Move::time;
  for (const Block& in : instruction.in) fixed = fixed && in.base == Base::fixed;
  if (fixed) {
    std::vector<double> values(instruction.count);
    Bases bases{};
    bases[static_cast<std::size_t>(Base::fixed)] = fixed_.data();
    execute(instruction, bases, 0, values.data());
    return keep(values);
  }
  instruction.out = take_scratch();  // precedes the release of the operands, so that no instruction works in place
  for (const Block& in : instruction.in) give_back(in);
  instructions_.push_back(instruction);
  return instruction.out;
}

EquationProgram::Block EquationProgram::compile(const Term& term, Over over) {
  switch (term.kind) {
    case Term::Kind::number:
      return constant(term.number, over);
    case Term::Kind::name:
      return compile_name(term, over);
    case Term::Kind::call:
      return compile_call(term, over);
    case Term::Kind::sum:
      break;
  }
  Instruction sum{Move::sum};
  sum.in[0] = compile(term.arguments[0], Over::couplings);
  return emit(sum, Over::joints);
}

EquationProgram::Block EquationProgram::compile_name(const Term& term, Over over) {
  const EquationNames::Entry& entry = *names_->find(term.name);
  Block value;
  switch (entry.kind) {
    case Kind::pi:
      return constant(std::numbers::pi, over);
    case Kind::time:
      return emit({Move::time}, over);
    case Kind::weight:
    case Kind::lag: {
      std::vector<double> values;
      for (const Coupling& c : tables_->couplings) values.push_back(entry.kind == Kind::weight ? c.weight : -c.phase_lag);
      return keep(values);
    }
    case Kind::given:
      value = keep(tables_->given[entry.slot]);
      break;
    case Kind::parameter:
      value = keep(tables_->parameters[entry.slot]);
      break;
    case Kind::state:
      value = {Base::state, entry.slot * joints_};
      break;
    case Kind::angle:
      value.base = Base::angle;
      break;
    case Kind::speed:
      value.base = Base::speed;
      break;
    case Kind::torque:
      value.base = Base::torque;
      break;
    case Kind::load:
      value.base = Base::load;
      break;
    case Kind::limb_load:
    case Kind::limb_touching: {
      Instruction limb{Move::limb};
      limb.in[0].base = Base::load;
      value = emit(limb, Over::joints);
      if (entry.kind == Kind::limb_load) break;
      Instruction touches;
      touches.op = Op::gt;
      touches.in[0] = value;
      touches.in[1] = constant(0, Over::joints);
      value = emit(touches, Over::joints);
      break;
    }
    case Kind::channel: {
      Instruction one{Move::one};
      one.in[0] = {Base::channels, tables_->channels[entry.slot]};
      return emit(one, over);
    }
    case Kind::touching: {
      Instruction gather{Move::gather_module};
      gather.in[0].base = Base::touching;
      value = emit(gather, Over::joints);
      break;
    }
  }
  if (over == Over::joints) return value;
  Instruction gather{term.index == Term::Index::j ? Move::gather_from : Move::gather_to};
  gather.in[0] = value;
  return emit(gather, over);
}

EquationProgram::Block EquationProgram::compile_call(const Term& term, Over over) {
  Instruction call;
  call.op = expression::find_function(term.name)->op;
  const std::vector<Term>& arguments = term.arguments;
  // A square is computed as a product, which is cheaper and correct for every sign.
  const bool square = call.op == Op::pow && arguments[1].kind == Term::Kind::number && arguments[1].number == 2;
  call.in[0] = compile(arguments[0], over);
  if (square) {
    call.op = Op::mul;
    call.in[1] = call.in[0];
    return emit(call, over);
  }
  for (std::size_t k = 1; k < arguments.size(); ++k) call.in[k] = compile(arguments[k], over);
  return emit(call, over);
}

void EquationProgram::put_out(const Block& value, std::size_t text) {
  const Block out{Base::result, text * joints_};
  if (value.base == Base::scratch) {  // the value is the result of the last instruction
    instructions_.back().out = out;
  } else {
    Instruction copy{Move::copy};
    copy.in[0] = value;
    copy.out = out;
    copy.count = joints_;
    instructions_.push_back(copy);
  }
  give_back(value);
}

void EquationProgram::execute(const Instruction& instruction, const Bases& bases, double t, double* out) const {
  const auto block = [&](std::size_t k) {
    return bases[static_cast<std::size_t>(instruction.in[k].base)] + instruction.in[k].offset;
  };
  const double* a = block(0);
  const std::size_t n = instruction.count;
  switch (instruction.move) {
    case Move::none:
      return expression::calculate(instruction.op, n, out, a, block(1), block(2));
    case Move::copy:
      std::copy_n(a, n, out);
      return;
    case Move::time:
      std::fill_n(out, n, t);
      return;
    case Move::one:
      std::fill_n(out, n, *a);
      return;
    case Move::limb:
      std::copy_n(a, n, out);
      for (const auto& [joint, parent] : inwards_) out[parent] += out[joint];
      return;
    case Move::gather_from:
      for (std::size_t k = 0; k < n; ++k) out[k] = a[from_[k]];
      return;
    case Move::gather_to:
      for (std::size_t k = 0; k < n; ++k) out[k] = a[to_[k]];
      return;
    case Move::gather_module:
      for (std::size_t k = 0; k < n; ++k) out[k] = a[module_[k]];
      return;
    case Move::sum:
      std::fill_n(out, n, 0.0);
      for (std::size_t k = 0; k < to_.size(); ++k) out[to_[k]] += a[k];
      return;
  }
}

void EquationProgram::run(const EquationInputs& inputs, Out result) const {
  const Bases bases{fixed_.data(),          scratch_.data(),      inputs.state.data(),    inputs.angle.data(),
                    inputs.speed.data(),    inputs.torque.data(), inputs.touching.data(), inputs.load.data(),
                    inputs.channels.data(), result.data()};
  for (const Instruction& instruction : instructions_) {
    double* base = instruction.out.base == Base::result ? result.data() : scratch_.data();
    execute(instruction, bases, inputs.t, base + instruction.out.offset);
  }
}

}  // namespace gaitlab::cpg
