#include "cpg/equation_names.h"

#include <algorithm>
#include <numbers>

#include "core/errors.h"

namespace gaitlab::cpg {
namespace {

using Kind = EquationNames::Kind;
using Where = EquationNames::Where;

/// Number of hinges between the joint and the base.
double depth(const RobotInfo& robot, std::size_t joint) {
  double count = 0;
  for (std::int64_t p = robot.joints[joint].parent; p >= 0; p = robot.joints[static_cast<std::size_t>(p)].parent) ++count;
  return count;
}

double side(const RobotInfo& robot, std::size_t joint) {
  constexpr double kMiddle = 1e-3;  // m; far above rounding errors, far below the size of a module
  const double y = robot.joints[joint].origin[1];
  return y > kMiddle ? 1 : y < -kMiddle ? -1 : 0;
}

using Keys = OscillatorKeys;
using Phases = std::vector<double>;

constexpr GivenValue kGiven[] = {
    {"frequency", [](const RobotInfo&, const Keys& k, const Phases&, std::size_t j) { return k.frequency[j]; }},
    {"omega",
     [](const RobotInfo&, const Keys& k, const Phases&, std::size_t j) { return 2 * std::numbers::pi * k.frequency[j]; }},
    {"amplitude", [](const RobotInfo&, const Keys& k, const Phases&, std::size_t j) { return k.amplitude[j]; }},
    {"offset", [](const RobotInfo&, const Keys& k, const Phases&, std::size_t j) { return k.offset[j]; }},
    {"phase", [](const RobotInfo&, const Keys&, const Phases& phases, std::size_t j) { return phases[j]; }},
    {"index", [](const RobotInfo&, const Keys&, const Phases&, std::size_t j) { return static_cast<double>(j); }},
    {"joints",
     [](const RobotInfo& r, const Keys&, const Phases&, std::size_t) { return static_cast<double>(r.joints.size()); }},
    {"depth", [](const RobotInfo& r, const Keys&, const Phases&, std::size_t j) { return depth(r, j); }},
    {"side", [](const RobotInfo& r, const Keys&, const Phases&, std::size_t j) { return side(r, j); }}};

std::string in_quotes(const std::string& name) { return "'" + (name.size() > 40 ? name.substr(0, 40) + "..." : name) + "'"; }

const char* text_of(Where where) {
  switch (where) {
    case Where::parameter:
      return "a parameter";
    case Where::initial:
      return "an initial value";
    case Where::derivative:
      return "a derivative";
    case Where::event:
      return "an event";
    case Where::output:
      break;
  }
  return "the output";
}

/// False for a number that is not above 0; other terms are not computed here.
bool above_zero(const Term& term) {
  if (term.kind == Term::Kind::number) return term.number > 0;
  return !(term.kind == Term::Kind::call && term.name == "~" && term.arguments[0].kind == Term::Kind::number);
}

}  // namespace

std::string offer_name(const std::string& found, const std::vector<std::string>& known, const std::string& kind) {
  // Single letters are skipped, because they are similar to one another. Very long names are skipped, because the edit distance
  // would take time.
  const std::string near = found.size() < 2 || found.size() > 200 ? std::string() : nearest(found, known);
  if (!near.empty()) return "; did you mean '" + near + "'?";
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  return "; known " + kind + ": " + all;
}

std::span<const GivenValue> given_values() { return kGiven; }

EquationNames::EquationNames()
    : entries_{{"pi", Kind::pi},
               {"t", Kind::time},
               {"angle", Kind::angle},
               {"speed", Kind::speed},
               {"torque", Kind::torque},
               {"touching", Kind::touching},
               {"load", Kind::load},
               {"limb_load", Kind::limb_load},
               {"limb_touching", Kind::limb_touching},
               {"w", Kind::weight},
               {"psi", Kind::lag}} {
  for (std::size_t k = 0; k < std::size(kGiven); ++k) entries_.push_back({kGiven[k].name, Kind::given, k});
}

std::string EquationNames::declare(const std::string& name, Kind kind, std::size_t slot) {
  static const std::vector<std::string> kWords{"i", "j", "in", "neighbours", "sum"};
  const bool word = std::ranges::find(kWords, name) != kWords.end() || expression::find_function(name) != nullptr;
  const Entry* taken = find(name);
  // A name of the model replaces these, which are newer than many models.
  if (taken != nullptr && (taken->kind == Kind::load || taken->kind == Kind::limb_load || taken->kind == Kind::limb_touching)) {
    entries_.erase(entries_.begin() + (taken - entries_.data()));
    taken = nullptr;
  }
  if (taken != nullptr && (taken->kind == Kind::parameter || taken->kind == Kind::state || taken->kind == Kind::channel)) {
    return in_quotes(name) + " is declared twice, as a parameter, a state or an input; give one of them another name";
  }
  if (word || taken != nullptr) return in_quotes(name) + " has a fixed meaning in equations; choose another name";
  entries_.push_back({name, kind, slot});
  return {};
}

std::string EquationNames::declare_channel(const std::string& name, const std::string& channel) {
  std::string wrong = declare(name, Kind::channel, channels_.size());
  if (wrong.empty()) channels_.push_back(channel);
  return wrong;
}

void EquationNames::declare_channels(const Term& term) {
  const bool dotted = term.kind == Term::Kind::name && term.name.find('.') != std::string::npos;
  if (dotted && find(term.name) == nullptr) {
    entries_.push_back({term.name, Kind::channel, channels_.size()});
    channels_.push_back(term.name);
  }
  for (const Term& argument : term.arguments) declare_channels(argument);
}

const EquationNames::Entry* EquationNames::find(const std::string& name) const {
  const auto it = std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.name == name; });
  return it == entries_.end() ? nullptr : &*it;
}

bool EquationNames::may_name(const Entry& entry, const SourceLocation& place) {
  switch (entry.kind) {
    case Kind::pi:
    case Kind::given:
      return true;
    case Kind::weight:
    case Kind::lag:
      return place.in_sum;
    case Kind::parameter:
      return place.where != Where::parameter || entry.slot < place.slot;
    case Kind::state:
    case Kind::time:
      return place.where == Where::derivative || place.where == Where::event || place.where == Where::output;
    default:
      return place.where == Where::derivative || place.where == Where::event;
  }
}

std::string EquationNames::unknown(const std::string& name, const SourceLocation& place) const {
  std::vector<std::string> known;
  for (const Entry& entry : entries_) {
    if (may_name(entry, place)) known.push_back(entry.name);
  }
  return in_quotes(name) + " is unknown" + offer_name(name, known, "names");
}

void EquationNames::check_name(const Term& term, const SourceLocation& place, std::vector<expression::Fault>& faults) const {
  const auto wrong = [&](const std::string& what) { faults.push_back({term.offset, what}); };
  const std::string name = in_quotes(term.name);
  const Entry* entry = find(term.name);
  if (entry == nullptr) {
    const bool function = term.name == "sum" || expression::find_function(term.name) != nullptr;
    return wrong(function ? name + " is a function; put its arguments in brackets after it" : unknown(term.name, place));
  }
  const bool pair = entry->kind == Kind::weight || entry->kind == Kind::lag;
  if (!place.in_sum && (pair || term.index == Term::Index::j || term.index == Term::Index::ij)) {
    return wrong(name + (pair ? " is known" : "[j] is known") + " only within sum(j in neighbours, ...)");
  }
  if (!may_name(*entry, place)) {
    if (entry->kind == Kind::parameter) return wrong(name + " is defined below; a parameter may use only parameters above it");
    const bool measured = entry->kind != Kind::state && entry->kind != Kind::time;
    return wrong(name + " may not be used in " + text_of(place.where) + "; only in a derivative" +
                 (measured ? " or an event: set a state" : ", an event or the output"));
  }
  if (pair != (term.index == Term::Index::ij)) {
    return wrong(pair ? name + " belongs to a coupling; write " + term.name + "[i,j]"
                      : name + " belongs to one joint; write [i] or [j]");
  }
  const bool single = entry->kind == Kind::pi || entry->kind == Kind::time || entry->kind == Kind::channel;
  if (term.index != Term::Index::none && single) {
    wrong(name + " is one number; write it without brackets");
  }
}

void EquationNames::check(const Term& term, const SourceLocation& place, std::vector<expression::Fault>& faults) const {
  SourceLocation inside = place;
  if (term.kind == Term::Kind::name) check_name(term, place, faults);
  if (term.kind == Term::Kind::sum) {
    if (place.in_sum) faults.push_back({term.offset, "a sum within a sum; expected one level"});
    inside.in_sum = true;
  }
  if (term.kind == Term::Kind::call) {
    const Function* function = expression::find_function(term.name);
    const std::size_t found = term.arguments.size();
    if (function == nullptr) {
      std::vector<std::string> known;
      for (const Function& f : expression::functions()) known.emplace_back(f.name);
      known.emplace_back("sum");
      faults.push_back(
          {term.offset, in_quotes(term.name) + " is not a function" +
                            (find(term.name) != nullptr ? "; multiply with *" : offer_name(term.name, known, "functions"))});
    } else if (function->op == Function::Op::mod && found == 2 && !above_zero(term.arguments[1])) {
      faults.push_back({term.arguments[1].offset, "mod(a, b): b must be above 0"});
    } else if (function->arguments != found) {
      faults.push_back({term.offset, term.name + " has " + std::to_string(found) + (found == 1 ? " argument" : " arguments") +
                                         "; expected " + std::to_string(function->arguments)});
    }
  }
  for (const Term& argument : term.arguments) check(argument, inside, faults);
}

void EquationNames::check(const Term& term, Where where, std::size_t slot, std::vector<expression::Fault>& faults) const {
  check(term, SourceLocation{where, slot, false}, faults);
}

}  // namespace gaitlab::cpg
