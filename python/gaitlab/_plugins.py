"""Pattern generators and controllers written in Python."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, TypeVar, Union

from . import _native

_Class = TypeVar("_Class", bound=type)
_Setting = Union[float, tuple[Any, ...]]
_OF_SECTION = {"cpg": ("type", "step"), "controller": ("type", "period")}


class Joint(NamedTuple):
    """A joint as the constructor of a class gets it."""

    name: str  #: `m3/passive`
    module: int
    lo: float  #: range, rad; infinite if it turns freely
    hi: float
    driven: bool  #: False for a joint without a motor
    parent: int  #: number of the next joint towards the base, or -1
    origin: tuple[float, float, float]  #: point on the axis, m, in the base frame at zero angles
    axis: tuple[float, float, float]  #: in the base frame at zero angles


def cpg(name: str, **settings: _Setting) -> Callable[[_Class], _Class]:
    """Decorator that registers a class as `cpg: {type: NAME}` for the scenarios that are read afterwards.

    settings: numbers of the scenario's section, each a default or (default, unit, low, high, sentence).

    The class is made once per run with (joints, settings): a list of Joint, and a dict of the settings. It has

        output(t, x, setpoint)          fills setpoint, rad, a value per joint
        states                          number of states; default 0. They need derivative() or event()
        start(x)                        fills the initial states
        derivative(m, x, rate)          fills the time derivatives of the states
        event(m, x)                     changes states at a control tick, before output()

    t is the time, s. m has t, period (s) and the arrays angle (rad), speed (rad/s), torque (N m), load (N), touching (1 or 0 per
    module) and channels (of sensors), whose names are the list channel_names. Arrays are copies, filled in place: setpoint[:] = ... All that changes belongs into x and never
    into self, because runs integrate derivative() several times a step.

    An exception ends the run; its type, text and line are in the outcome. A class registered again under its name replaces the
    old one; scenarios read before keep the old one.
    """

    def check(made: type) -> None:
        if not callable(getattr(made, "output", None)):
            raise TypeError(f"a CPG has a method output(t, x, setpoint); {made.__name__} has none")
        states = getattr(made, "states", 0)
        if isinstance(states, int) and states > 0 and not (hasattr(made, "derivative") or hasattr(made, "event")):
            raise TypeError(f"{made.__name__} has states, but neither derivative(m, x, rate) nor event(m, x), which would change them")

    return _registration("cpg", name, "", settings, check)


def controller(name: str, *, unit: str, **settings: _Setting) -> Callable[[_Class], _Class]:
    """Decorator that registers a class as `controller: {type: NAME}` for the scenarios that are read afterwards.

    unit: of the command: "V", "N m" or "duty" (a share of the supply), as the actuator takes it.
    settings: as for cpg().

    The class is made once per run with (joints, settings). It has

        update(m, setpoint, limit, x, command)    fills command, a value per joint, held until the next control tick
        states                                    number of states; default 0
        start(x)                                  fills the initial states

    m: as for cpg(). setpoint (rad), limit (largest command, in the unit) and command have a value per joint; x are the states, which
    update() may change. A command beyond its limit is cut. All that changes belongs into x and never into self.
    """

    def check(made: type) -> None:
        if not callable(getattr(made, "update", None)):
            raise TypeError(f"a controller has a method update(m, setpoint, limit, x, command); {made.__name__} has none")

    if unit not in ("V", "N m", "duty"):
        raise ValueError(f"unit is {unit!r}; expected 'V', 'N m' or 'duty'")
    return _registration("controller", name, unit, settings, check)


def _registration(
    kind: str, name: str, unit: str, settings: dict[str, _Setting], check: Callable[[type], None]
) -> Callable[[_Class], _Class]:
    numbers = []
    for key, given in settings.items():
        row = given if isinstance(given, tuple) else (given, "", -1e9, 1e9, f"Setting {key}.")
        try:
            default, of, low, high, about = row
            numbers.append((key, float(default), str(of), float(low), float(high), str(about)))
        except (OverflowError, TypeError, ValueError):
            raise ValueError(f"setting {key} is {given!r:.100}; expected a number, or (default, unit, low, high, sentence)") from None
        if key in _OF_SECTION[kind]:
            raise ValueError(f"setting {key} has the name of a key of section {kind}; expected another name")
        if not float(low) <= float(default) <= float(high):
            raise ValueError(f"setting {key}: the default {default} is outside {low} to {high}")

    def register(made: _Class) -> _Class:
        if not isinstance(made, type):
            raise TypeError(f'gaitlab.{kind}("{name}") decorates a class, not {type(made).__name__}; its instances are made by the run')
        check(made)
        _native.add_class(kind, name, unit, made, numbers)
        return made

    return register
