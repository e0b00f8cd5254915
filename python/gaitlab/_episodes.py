"""Simulations that are stepped from Python."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._run import Run
from ._scenario import Scenario, scenario_of
from ._settings import check_range, records, texts, thread_count
from ._warnings import tell

if TYPE_CHECKING:
    import os

    import pandas

Array = npt.NDArray[Any]
_PARTS = ("setpoint", "residual", "steering", "command")
_SHAPES = {"rotation": (3, 3), "energy": (), "time": ()}


class Column(NamedTuple):
    """A column of observations: `angle.m3/passive`, `touching.m5`, or a value of a sensor, such as `imu.roll`."""

    name: str
    unit: str


class Truth(Mapping[str, Array]):
    """True quantities, a row per environment: truth["base.position"] is an array (n, 3)."""

    def __init__(self, native: _native.Episodes, copy: bool) -> None:
        self._values = native.truth()
        self._copy = copy
        self._at: dict[str, tuple[int, int]] = {}
        for k, (name, _) in enumerate(native.true_columns()):
            group = name if name.count(".") == 0 else name[: name.rindex(".")] if name.startswith("base.") else "leg.load"
            first, count = self._at.get(group, (k, 0))
            self._at[group] = (first, count + 1)
        self._at.setdefault("leg.load", (0, 0))  # a robot without legs

    def __getitem__(self, name: str) -> Array:
        if name not in self._at:
            raise KeyError(f"no truth {name!r}; known: {', '.join(self._at)}")
        first, count = self._at[name]
        part: Array = self._values[:, first : first + count]
        part = part.reshape(len(part), *_SHAPES.get(name.rpartition(".")[2], (count,)))
        return part.copy() if self._copy else part

    def __iter__(self) -> Iterator[str]:
        return iter(self._at)

    def __len__(self) -> int:
        return len(self._at)


class Episodes:
    """Environments that are stepped together; made by start().

    An environment ends when its scenario's `duration` is over, when it diverges, when a plugin raises, or by `terminate`. It then
    keeps its last rows until reset().
    """

    def __init__(self, native: _native.Episodes, n: int, terminate: Any, every: int, record: bool, copy: bool) -> None:
        self._native = native
        self._terminate = terminate
        self._running = True
        self._record, self._copy = record, copy
        self.every = every
        """Control ticks per step."""
        self._observations = native.observations()
        self.n = n
        """Number of environments."""
        self.truth = Truth(native, copy)
        """True quantities at the present tick, for rewards and tests: base.position (m), base.rotation (n x 3 x 3, base axes to world),
        base.velocity (of its origin, m/s), base.angular_velocity (rad/s), energy that the motors have drawn since the start (J),
        time (s) and leg.load (N, a column per leg). Views, valid until the next call, unless copy=True."""
        self.columns: list[Column] = [Column(*one) for one in native.observed()]
        """Names and units of the columns of an observation."""
        self.joints: list[str] = native.driven
        """Joints with a motor."""
        self.parts: list[str] = native.parts
        """The parts of an action: `setpoint`, `residual`, `steering` or `command`."""
        self.action_columns: list[str] = native.action_columns
        """Joints and steered values: the columns of an action."""
        self._shape = (n, len(self.action_columns))
        self._begin(np.ones(n, dtype=bool))

    @property
    def observations(self) -> Array:
        """The present observations, as step() and reset() return them."""
        return self._out()

    @property
    def ended(self) -> Array:
        """Per environment "" while it runs, or `done` (its time is over), `diverged`, `plugin` (which raised) or `stopped` (by
        `terminate`)."""
        return np.array(self._native.ended(), dtype=object)

    @property
    def terminated(self) -> Array:
        """True for environments that ended before their time."""
        ended = self.ended
        return np.array((ended != "") & (ended != "done"), dtype=bool)

    @property
    def truncated(self) -> Array:
        """True for environments whose time is over."""
        return np.array(self.ended == "done", dtype=bool)

    def message(self, i: int) -> str:
        """The reason why environment i ended early, with its time."""
        return self._native.message(self._index(i))

    def step(self, action: Any) -> Array:
        """Simulates `every` control ticks under these actions (n x action_columns), and returns the observations: what a controller measures at the tick, with the noise and delays of the sensors."""
        given = np.asarray(action, dtype=np.float64)
        expected = self._shape
        if given.shape != expected:
            raise ValueError(
                f"action has the shape {given.shape}; expected {expected}, for {' and '.join(self.parts)}: "
                + ", ".join(self.action_columns)
            )
        if not self._running:
            raise ValueError(f"step after the end: all {self.n} environments have ended; reset()")
        self._running = self._native.step(given)
        if self._terminate is not None:
            for i in np.flatnonzero(self._mask(self._terminate(self.truth), "terminate(truth)")):
                self._native.stop(int(i), "stopped by terminate")
            self._running = self._native.running
        return self._out()

    def reset(
        self,
        mask: Any = None,
        *,
        angles: Any = None,
        speeds: Any = None,
        base_velocity: Any = None,
        base_angular_velocity: Any = None,
    ) -> Array:
        """Puts environments back to their start, all of them or those of `mask` (n truth values), and returns the observations.

        angles (rad), speeds (rad/s): of all joints, the same for all or a row per environment, in place of those of the scenario.
        base_velocity (m/s), base_angular_velocity (rad/s): of the base, world axes. A robot that starts on the ground is lowered
        onto it with these angles.
        """
        chosen = np.ones(self.n, dtype=bool) if mask is None else self._mask(mask, "reset(mask)")
        which = [int(i) for i in np.flatnonzero(chosen)]
        joints = len(self._native.all_joints)
        rows = [
            None if given is None else self._rows(given, name, width)[which]
            for given, name, width in (
                (angles, "angles", joints),
                (speeds, "speeds", joints),
                (base_velocity, "base_velocity", 3),
                (base_angular_velocity, "base_angular_velocity", 3),
            )
        ]
        if which:
            self._native.restart(which, *rows)
            self._begin(chosen)
        return self._out()

    def snapshot(self) -> bytes:
        """Everything that changes. restore() continues from it with the same bits, in any process of this build."""
        return self._native.snapshot()

    def restore(self, snapshot: bytes) -> Array:
        """Goes back to a snapshot of the same scenarios, and returns the observations. Raises InputError for other bytes."""
        self._native.restore(snapshot)
        self._running = self._native.running
        return self._out()

    def run(self, i: int = 0, *, period: float = 0) -> Run:
        """The episode of environment i so far as a Run, with page and verdict: its set points, simulated again as `gaitlab run` does.

        Needs record=True. The run has the bits of the episode, or RunError is raised. With fast=True it is simulated with the
        integrator of the scenario instead, and differs from the episode by the error of its steps. The judgement is that of a
        recording: no feedback acts in the run. period: of the motion, s, if it repeats; windows of the verdict follow it.
        """
        if not self._record:
            raise ValueError("run(i) needs the set points of the episode: start(..., record=True)")
        made = _native.simulate(self._native.recorded(self._index(i), float(period)), None, True)
        if not self._native.fast:
            self._native.check_end(self._index(i), made)
        run = Run(made)
        tell(run.warnings)
        return run

    def set_points(self, i: int = 0) -> Array:
        """Set points of environment i since its start, rad: a row per control tick, a column per joint. Needs record=True."""
        made: Array = self._native.set_points(self._index(i))
        return made

    def __len__(self) -> int:
        return self.n

    def __repr__(self) -> str:
        return f"<gaitlab.Episodes, {self.n} environments of {len(self.joints)} motors>"

    def _out(self) -> Array:
        now: Array = self._observations
        return now.copy() if self._copy else now

    def _begin(self, chosen: Array) -> None:
        self._running = True
        if hasattr(self._terminate, "begin"):
            self._terminate.begin(self.truth, chosen)

    def _index(self, i: Any) -> int:
        check_range("environment", i, 0, self.n - 1)
        return int(i)

    def _mask(self, given: Any, what: str) -> Array:
        mask = np.asarray(given)
        if mask.dtype != bool or mask.shape != (self.n,):
            raise ValueError(f"{what}: expected {self.n} truth values, got {mask.dtype} of {mask.shape}")
        return mask

    def _rows(self, given: Any, name: str, width: int) -> Array:
        numbers = np.asarray(given, dtype=np.float64)
        if numbers.shape not in ((width,), (self.n, width)):
            raise ValueError(f"{name} has the shape {numbers.shape}; expected ({width},) or ({self.n}, {width})")
        if not np.all(np.isfinite(numbers)):
            raise ValueError(f"{name} has a number that is not finite")
        if name != "angles" and np.abs(numbers).max() > 1e4:
            raise ValueError(f"{name} has a number beyond 10000")
        return np.broadcast_to(numbers, (self.n, width))


class _Fall:
    """`terminate="fall"`: the base tilts by more than limits.tilt from its start."""

    def __init__(self, tilt: float) -> None:
        self._least = np.cos(tilt)
        self._up = np.empty((0, 3))

    def begin(self, truth: Truth, chosen: Array) -> None:
        up = truth["base.rotation"][:, 2, :]  # the world's z, base axes
        if len(self._up) != len(up):
            self._up = up.copy()
        self._up[chosen] = up[chosen]

    def __call__(self, truth: Truth) -> Array:
        return np.asarray(np.sum(truth["base.rotation"][:, 2, :] * self._up, axis=1) < self._least)


def start(
    scenario: Union[Scenario, str, "os.PathLike[str]"],
    n: Union[int, None] = None,
    *,
    overrides: Union[Iterable[Mapping[str, Any]], "pandas.DataFrame", None] = None,
    action: Union[str, Sequence[str]] = "setpoint",
    every: int = 1,
    fast: bool = False,
    record: Union[bool, None] = None,
    terminate: Union[str, Callable[[Truth], Any], None] = None,
    copy: bool = False,
    threads: Union[int, None] = 1,
    lanes: int = 0,
) -> Episodes:
    """Environments of one scenario, which are stepped from Python. Each has the bits that it would have alone.

        envs = gaitlab.start("hexapod", 256, fast=True, overrides=[{"seed": k} for k in range(256)])
        obs = envs.reset()
        for _ in range(400):
            obs = envs.step(policy(obs))

    n: number of environments; default: one per row of `overrides`, or one.
    overrides: settings per environment, as in rollouts(). They may change masses, friction, tolerances, seeds and the like, but not
        engine, step, control period or structure of the robot.
    action: `setpoint` (rad, per joint with a motor, in place of the CPG's), `residual` (rad, added to those of the CPG), `steering`
        (values of the scenario's sensors of type steering, such as a speed that the CPG follows) or `command` (V or N m, in place of
        the controller's), or a list of them, whose columns follow one another.
    every: control ticks per step.
    fast: engine articulated with implicit steps of at most 2.5 ms, in place of the scenario's engine, step and accuracy: for learning.
        run() judges with those of the scenario.
    record: True keeps the set points of each environment, for run() and set_points(); default: True for one environment.
    terminate: `fall` ends an environment when its base tilts by more than limits.tilt from its start; or a function of `truth` that
        returns a truth value per environment.
    copy: True returns new arrays; otherwise the arrays are views, valid until the next call.
    A reset repeats the noise of its environment; seeds are settings: overrides=[{"seed": k}, ...].
    threads, lanes: as in rollouts(); None for all processors. Neither changes a bit.
    """
    rows = [] if overrides is None else records(overrides)[0]
    count = (len(rows) if overrides is not None else 1) if n is None else n
    check_range("n", count, 1, 1_000_000)
    if overrides is not None and len(rows) != count:
        raise ValueError(f"overrides has {len(rows)} rows for {count} environments; expected one for each")
    parts = [action] if isinstance(action, str) else list(action)
    for part in parts:
        if part not in _PARTS:
            raise ValueError(f"action {part!r} is unknown; expected {', '.join(_PARTS)}, or a list of them")
    if not parts or len(set(parts)) != len(parts):
        raise ValueError("action is empty or names a part twice")
    if "command" in parts and len(parts) > 1:
        raise ValueError("action 'command' replaces the controller, so that set points have no effect; expected it alone")
    if {"setpoint", "steering"} <= set(parts):
        raise ValueError("action 'setpoint' replaces the CPG, so that 'steering' has no effect; expected one of them")
    check_range("every", every, 1, 1_000_000)
    check_range("lanes", lanes, 0, _native.most_lanes)
    keep = (count == 1 if record is None else bool(record)) and "command" not in parts
    if record and "command" in parts:
        raise ValueError("record: actions of the kind 'command' have no set points that could be simulated again")
    if isinstance(terminate, str) and terminate != "fall":
        raise ValueError(f"terminate is {terminate!r}; expected 'fall' or a function of truth")
    own = [texts(one) for one in rows] if overrides is not None else [[]] * count
    native = _native.start(scenario_of(scenario)._native, own, parts, int(every), thread_count(threads), lanes, bool(fast), keep)
    tell()
    return Episodes(native, count, _Fall(native.tilt) if terminate == "fall" else terminate, every, keep, copy)
