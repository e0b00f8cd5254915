#include "python/native/python_plugins.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "core/errors.h"
#include "kit/catalog.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

constexpr const char* kManual = "A class written in Python (gaitlab.cpg, gaitlab.controller), registered in this process.";

struct PythonClass {
  Kind kind;
  std::string name, unit;
  py::object type;
  std::vector<NumberSetting> settings;
};

/// Destroys an object that holds objects of Python, under the interpreter's lock. After the interpreter's end, it is not
/// destroyed.
template <class T>
void end_locked(T* object) {
  if (Py_IsInitialized() == 0) return;
  const py::gil_scoped_acquire held;
  delete object;
}

/// Settings of a class in a scenario. They keep the class.
struct ClassValues {
  std::shared_ptr<PythonClass> of;
  std::vector<double> values;
  void fields(Fields& f) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const NumberSetting& s = of->settings[k];
      f.number(s.key.c_str(), values[k], {s.unit.c_str(), s.low, s.high, s.about.c_str()});
    }
  }
};

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

/// Type, text and place of an exception, on one line: `ZeroDivisionError: division by zero (gait.py:12)`.
std::string told(py::error_already_set& error) {
  std::string text = text_of(error.type().attr("__name__"));
  if (const std::string value = text_of(error.value()); !value.empty()) text += ": " + value;
  std::ranges::replace(text, '\n', ' ');
  py::object place = error.trace();
  if (!place || place.is_none()) return text;
  for (py::object next = place.attr("tb_next"); !next.is_none(); next = place.attr("tb_next")) place = next;
  return text + " (" + text_of(place.attr("tb_frame").attr("f_code").attr("co_filename")) + ":" +
         text_of(place.attr("tb_lineno")) + ")";
}

/// Calls Python under the interpreter's lock. An exception becomes one of C++; Python's exception is released under the lock.
template <class Call>
auto under_lock(Call call) {
  const py::gil_scoped_acquire held;
  try {
    return call();
  } catch (py::error_already_set& error) {
    throw std::runtime_error(told(error));
  } catch (const py::cast_error& error) {
    throw std::runtime_error(error.what());
  }
}

/// An array of Python, made once. Numbers are copied in and out, so that nothing of Python points into the simulation.
class CopiedArray {
 public:
  py::array_t<double>& of(In values) {
    if (static_cast<std::size_t>(array_.size()) != values.size())
      array_ = py::array_t<double>(static_cast<py::ssize_t>(values.size()));
    std::copy(values.begin(), values.end(), array_.mutable_data());
    return array_;
  }
  void take(Out values) const {
    if (static_cast<std::size_t>(array_.size()) != values.size()) throw std::runtime_error("the size of an array was changed");
    std::copy(array_.data(), array_.data() + values.size(), values.begin());
  }

 private:
  py::array_t<double> array_{py::ssize_t{0}};
};

/// An attribute of an object, or None if it has none. An attribute whose computation raises AttributeError is not absent.
py::object attribute(const py::object& self, const char* name) {
  try {
    return self.attr(name);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_AttributeError)) throw;
    const py::object found = py::module_::import("inspect").attr("getattr_static")(self, name, py::none());
    if (!found.is_none()) throw;
    return py::none();
  }
}

/// The number of states that a class gives; None is 0.
std::size_t states_of(const py::object& given) {
  if (given.is_none()) return 0;
  constexpr Py_ssize_t kMost = 1000000;
  const Py_ssize_t states = PyNumber_AsSsize_t(given.ptr(), nullptr);  // -1 if the number is not whole
  if (PyErr_Occurred() != nullptr) PyErr_Clear();
  if (states < 0 || states > kMost)
    throw std::runtime_error("states is " + text_of(py::repr(given)) + "; expected a whole number from 0 to 1000000");
  return static_cast<std::size_t>(states);
}

/// Throws if a method returned an array of its own instead of filling its argument.
void expect_filled(const char* method, const py::object& returned, const py::object& argument, const char* name) {
  if (returned.is(argument) || !(py::isinstance<py::array>(returned) || py::isinstance<py::list>(returned))) return;
  throw std::runtime_error(std::string(method) + "() returned " + text_of(py::type::of(returned).attr("__name__")) +
                           "; expected a method that fills its argument, as in " + name + "[:] = ...");
}

/// The object, its methods (None for a missing one) and the arrays that the methods get.
struct BoundObject {
  py::object self, output, derivative, event, update, start, measured;
  std::size_t states = 0;
  CopiedArray x, rate, setpoint, limit, command, angle, speed, torque, touching, channels, load;

  BoundObject(Kind kind, py::object made, const std::vector<std::string>& channel_names) : self(std::move(made)) {
    output = attribute(self, "output");
    derivative = attribute(self, "derivative");
    event = attribute(self, "event");
    update = attribute(self, "update");
    start = attribute(self, "start");
    states = states_of(attribute(self, "states"));
    if (kind == Kind::cpg && states > 0 && derivative.is_none() && event.is_none())
      throw std::runtime_error("has states, but neither derivative(m, x, rate) nor event(m, x), which would change them");
    measured = py::module_::import("types").attr("SimpleNamespace")();
    measured.attr("channel_names") = py::cast(channel_names);
  }
  const py::object& of(const Measured& m) {
    measured.attr("t") = m.t;
    measured.attr("period") = m.period;
    measured.attr("angle") = angle.of(m.angle);
    measured.attr("speed") = speed.of(m.speed);
    measured.attr("torque") = torque.of(m.torque);
    measured.attr("touching") = touching.of(m.touching);
    measured.attr("channels") = channels.of(m.channels);
    measured.attr("load") = load.of(m.load);
    return measured;
  }
};

using Bound = std::unique_ptr<BoundObject, void (*)(BoundObject*)>;

void start_states(BoundObject& bound, Out x) {
  if (bound.start.is_none()) return;
  under_lock([&] {
    const py::array& states = bound.x.of(x);
    expect_filled("start", bound.start(states), states, "x");
    bound.x.take(x);
  });
}

class PythonCpg final : public Cpg {
 public:
  explicit PythonCpg(Bound bound) : bound_(std::move(bound)) {}
  [[nodiscard]] std::size_t states() const override { return bound_->states; }
  void start(Out x) const override { start_states(*bound_, x); }
  void derivative(const Measured& m, In x, Out rate) const override {
    if (bound_->derivative.is_none()) return;
    under_lock([&] {
      const py::array& rates = bound_->rate.of(rate);
      expect_filled("derivative", bound_->derivative(bound_->of(m), bound_->x.of(x), rates), rates, "rate");
      bound_->rate.take(rate);
    });
  }
  void event(const Measured& m, Out x) const override {
    if (bound_->event.is_none()) return;
    under_lock([&] {
      const py::array& states = bound_->x.of(x);
      expect_filled("event", bound_->event(bound_->of(m), states), states, "x");
      bound_->x.take(x);
    });
  }
  void output(double t, In x, Out setpoint) const override {
    under_lock([&] {
      std::ranges::fill(setpoint, std::nan(""));
      const py::array& setpoints = bound_->setpoint.of(setpoint);
      expect_filled("output", bound_->output(t, bound_->x.of(x), setpoints), setpoints, "setpoint");
      bound_->setpoint.take(setpoint);
      if (!setpoint.empty() && std::ranges::all_of(setpoint, [](double one) { return std::isnan(one); })) {
        throw std::runtime_error(
            "output() filled no set point; expected a method that fills its argument, as in setpoint[:] = ...");
      }
    });
  }

 private:
  Bound bound_;
};

class PythonController final : public Controller {
 public:
  PythonController(Bound bound, std::shared_ptr<PythonClass> type) : bound_(std::move(bound)), type_(std::move(type)) {}
  [[nodiscard]] std::string_view command_unit() const override { return type_->unit; }
  [[nodiscard]] std::size_t states() const override { return bound_->states; }
  void start(Out x) const override { start_states(*bound_, x); }
  void update(const Measured& m, In setpoint, In limit, Out x, Out command) const override {
    under_lock([&] {
      BoundObject& b = *bound_;
      std::ranges::fill(command, std::nan(""));
      const py::array& commands = b.command.of(command);
      const py::array& states = b.x.of(x);
      expect_filled("update", b.update(b.of(m), b.setpoint.of(setpoint), b.limit.of(limit), states, commands), commands,
                    "command");
      b.x.take(x);
      b.command.take(command);
    });
    const auto unknown = std::ranges::find_if(x, [](double one) { return std::isnan(one); });
    if (unknown != x.end()) throw std::runtime_error("update() left x[" + std::to_string(unknown - x.begin()) + "] nan");
    for (std::size_t j = 0; j < command.size(); ++j) {
      if (std::isnan(command[j])) throw std::runtime_error("update() left command[" + std::to_string(j) + "] nan");
      command[j] = std::clamp(command[j], -limit[j], limit[j]);
    }
  }

 private:
  Bound bound_;
  std::shared_ptr<PythonClass> type_;
};

py::list joints_of(const RobotInfo& robot) {
  const py::object joint = py::module_::import("gaitlab").attr("Joint");
  py::list joints;
  for (const JointInfo& one : robot.joints)
    joints.append(joint(one.name, one.module, one.lo, one.hi, one.driven, one.parent, one.origin, one.axis));
  return joints;
}

void* make_of_python(const RobotInfo& robot, std::span<const void* const> settings) {
  const auto& values = *static_cast<const ClassValues*>(settings[0]);
  return under_lock([&]() -> void* {
    py::dict named;
    for (std::size_t k = 0; k < values.values.size(); ++k) named[values.of->settings[k].key.c_str()] = values.values[k];
    const Kind kind = values.of->kind;
    Bound bound(new BoundObject(kind, values.of->type(joints_of(robot), named), robot.channels), &end_locked<BoundObject>);
    if (kind == Kind::cpg) return static_cast<Cpg*>(new PythonCpg(std::move(bound)));
    return static_cast<Controller*>(new PythonController(std::move(bound), values.of));
  });
}

Entry entry_of(const std::shared_ptr<PythonClass>& type) {
  Entry entry{type->kind,
              type->name,
              kManual,
              [](const Entry& of) {
                auto values = std::make_shared<ClassValues>();
                values->of = std::static_pointer_cast<PythonClass>(of.context);
                for (const NumberSetting& s : values->of->settings) values->values.push_back(s.value);
                return std::shared_ptr<void>(values);
              },
              [](void* values, Fields& f) { static_cast<ClassValues*>(values)->fields(f); },
              &make_of_python};
  entry.context = type;
  return entry;
}

using Classes = std::vector<std::shared_ptr<PythonClass>>;

/// The registered classes, under their mutex. Nobody asks for the interpreter's lock while holding it.
struct RegisteredClasses {
  std::mutex mutex;
  Classes all;
  std::size_t added = 0;
};
RegisteredClasses& classes() {
  static auto* const made = new RegisteredClasses;  // never destroyed: the interpreter may be gone by then
  return *made;
}

}  // namespace

void add_class(Kind kind, const std::string& name, const std::string& unit, const py::object& type,
               std::vector<NumberSetting> settings) {
  std::shared_ptr<PythonClass> added(new PythonClass{kind, name, unit, type, std::move(settings)}, &end_locked<PythonClass>);
  try {
    kit::standard_catalog().add(entry_of(added));
  } catch (const std::invalid_argument& error) {
    throw InputError(SourceLocation{kind == Kind::cpg ? "gaitlab.cpg" : "gaitlab.controller"}, error.what());
  }
  RegisteredClasses& known = classes();
  const std::lock_guard lock(known.mutex);
  ++known.added;
  const auto same = std::ranges::find_if(known.all, [&](const auto& one) { return one->kind == kind && one->name == name; });
  if (same == known.all.end()) {
    known.all.push_back(added);
  } else {
    std::swap(*same, added);  // the old one ends after the mutex is unlocked
  }
}

std::size_t classes_added() {
  const std::lock_guard lock(classes().mutex);
  return classes().added;
}

std::size_t register_classes(Catalog& catalog) {
  RegisteredClasses& known = classes();
  Classes all;
  std::size_t added = 0;
  {
    const std::lock_guard lock(known.mutex);
    all = known.all;
    added = known.added;
  }
  catalog.set_origin("Python");
  for (const std::shared_ptr<PythonClass>& one : all) catalog.add(entry_of(one));
  catalog.set_origin(std::string(kBuiltIn));
  return added;
}

}  // namespace gaitlab::python
