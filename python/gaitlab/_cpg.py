"""Pattern generators written in Python."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, TypeVar, Union

from . import _native

_Class = TypeVar("_Class", bound=type)


class Joint(NamedTuple):
    """A joint as the constructor of a CPG gets it."""

    name: str  #: `m3/passive`
    module: int
    lo: float  #: range, rad; infinite if it turns freely
    hi: float
    driven: bool  #: False for a joint without a motor
    parent: int  #: number of the next joint towards the base, or -1
    origin: tuple[float, float, float]  #: point on the axis, m, in the base frame at zero angles
    axis: tuple[float, float, float]  #: in the base frame at zero angles


def cpg(name: str, **settings: Union[float, tuple[Any, ...]]) -> Callable[[_Class], _Class]:
    """Decorator that registers a class as `cpg: {type: NAME}` for the scenarios that are read afterwards.

    settings: numbers of the scenario's section, each a default or (default, unit, low, high, sentence).

    The class is made once per run with (joints, settings): a list of Joint, and a dict of the settings. It has

        output(t, x, setpoint)          fills setpoint, rad, a value per joint
        states                          number of states; default 0. They need derivative() or event()
        start(x)                        fills the initial states
        derivative(m, x, rate)          fills the time derivatives of the states
        event(m, x)                     changes states at a control tick, before output()

    t is the time, s. m has t, period (s) and the arrays angle (rad), speed (rad/s), torque (N m), touching (1 or 0 per module)
    and channels (of sensors). Arrays are copies, filled in place: setpoint[:] = ... All that changes belongs into x and never
    into self, because runs integrate derivative() several times a step.

    An exception ends the run; its type, text and line are in the outcome. A class registered again under its name replaces the
    old one; scenarios read before keep the old one.
    """
    numbers = []
    for key, given in settings.items():
        row = given if isinstance(given, tuple) else (given, "", -1e9, 1e9, f"Setting {key}.")
        try:
            default, unit, low, high, about = row
            numbers.append((key, float(default), str(unit), float(low), float(high), str(about)))
        except (OverflowError, TypeError, ValueError):
            raise ValueError(f"setting {key} is {given!r:.100}; expected a number, or (default, unit, low, high, sentence)") from None

    def register(made: _Class) -> _Class:
        if not isinstance(made, type):
            raise TypeError(f'gaitlab.cpg("{name}") decorates a class, not {type(made).__name__}; its instances are made by the run')
        if not callable(getattr(made, "output", None)):
            raise TypeError(f"a CPG has a method output(t, x, setpoint); {made.__name__} has none")
        states = getattr(made, "states", 0)
        if isinstance(states, int) and states > 0 and not (hasattr(made, "derivative") or hasattr(made, "event")):
            raise TypeError(f"{made.__name__} has states, but neither derivative(m, x, rate) nor event(m, x), which would change them")
        _native.add_cpg(name, made, numbers)
        return made

    return register
