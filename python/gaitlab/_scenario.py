"""Scenarios."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Mapping, NamedTuple, Sequence, Union

from . import _native
from ._settings import mapping, path_text, texts
from ._warnings import tell

if TYPE_CHECKING:
    from ._episodes import Episodes


Plugins = Union[str, Sequence[Union[str, "os.PathLike[str]"]]]


def trusted(plugins: Plugins) -> tuple[bool, list[str]]:
    """The argument `plugins` as "all of them" and a list of files."""
    if isinstance(plugins, str) and plugins not in ("trust", "refuse"):
        raise ValueError(f"plugins must be 'trust', 'refuse' or a list of files, not {plugins!r}")
    return plugins == "trust", [] if isinstance(plugins, str) else [path_text(file) for file in plugins]


class Leg(NamedTuple):
    """A leg of the robot (docs/modules.md)."""

    name: str  #: `front_left`
    joints: list[str]  #: its driven joints, from the trunk outwards
    side: int  #: 1 on the left, -1 on the right, 0 in the middle
    hip: tuple[float, float, float]  #: origin of its first joint, m, in the base frame at zero angles
    foot: tuple[float, float, float]  #: middle of its sole, m, in the base frame at zero angles


@dataclass(frozen=True)
class Check:
    """Parts and sizes of a scenario, as `gaitlab check` prints them."""

    name: str
    mass: float  #: of the robot, kg
    masses: Mapping[str, float]  #: of each body, kg
    ranges: Mapping[str, tuple[float, float]]  #: of each joint, rad; infinite for one that turns freely
    modules: int
    links: int
    degrees_of_freedom: int
    engine: str
    integrator: str
    step: float  #: s
    damping: float  #: step times damping rate for the standing robot; allowed up to 1
    start: tuple[float, float, float]  #: base frame at the start, m
    contacts: int  #: number of contact elements
    rows: float  #: rows of the trace
    columns: float  #: columns of the trace
    megabytes: float  #: size of the trace, MB
    seconds: float  #: estimated CPU time of `gaitlab run`, s, to within a factor of two; 0 if the engine has no known cost
    fails: str  #: error that ends the run in its first steps; "" without one


class Scenario:
    """A scenario, read and checked: Scenario("hexapod.yaml", {"cpg.frequency": 0.5}).

    path: a file, or the name of a shipped scenario (`gaitlab list scenarios`).
    settings: values by key, as --set takes them. Numbers, lists and mappings keep their bits; a text is read as YAML.
    plugins: "trust" loads the plugin libraries that the scenario names and runs their code, "refuse" loads none, and a list of
        files loads only these.

    Raises InputError with all problems, with the text that `gaitlab check` prints.
    """

    def __init__(
        self,
        path: Union[str, "os.PathLike[str]"],
        settings: Union[Mapping[str, Any], None] = None,
        *,
        plugins: Plugins = "trust",
    ) -> None:
        self.path = path_text(path)
        self.settings: dict[str, Any] = mapping(settings)
        all_plugins, files = trusted(plugins)
        self._plugins = plugins if isinstance(plugins, str) else files
        self._native = _native.read(self.path, texts(self.settings), all_plugins, files)
        tell(self.warnings)

    @property
    def name(self) -> str:
        return self._native.name

    @property
    def joints(self) -> list[str]:
        """Names of the joints, by number."""
        return self._native.joints

    @property
    def legs(self) -> list[Leg]:
        """Legs of the robot, from front to rear, left before right."""
        return [Leg(*leg) for leg in self._native.legs()]

    @property
    def resolved(self) -> str:
        """The complete scenario with all defaults, YAML."""
        return self._native.resolved()

    @property
    def warnings(self) -> list[str]:
        """Warnings that `gaitlab check` prints, each with its place."""
        return self._native.warnings(True)

    @property
    def notes(self) -> list[str]:
        """Notes that `gaitlab check` prints, each with its place."""
        return self._native.warnings(False)

    def check(self) -> Check:
        """Makes the simulation, and takes its sizes and first steps. Raises InputError if the step or the memory is refused."""
        return Check(**self._native.check())

    def with_(self, settings: Mapping[str, Any]) -> "Scenario":
        """The scenario with further settings. It shares the robot and everything else that the settings do not change."""
        settings = mapping(settings)
        other = Scenario.__new__(Scenario)
        other.path, other._plugins = self.path, self._plugins
        # A key that is set again comes last, as on the command line.
        other.settings = {**{k: v for k, v in self.settings.items() if k not in settings}, **settings}
        other._native = self._native.with_(texts(settings))
        tell(other.warnings)
        return other

    def start(self, **settings: Any) -> "Episodes":
        """One environment of this scenario, which is stepped from Python: gaitlab.start(scenario, 1, ...)."""
        from ._episodes import start

        return start(self, 1, **settings)

    def __repr__(self) -> str:
        return f"<gaitlab.Scenario {self.name!r}, {len(self.joints)} joints>"

    def __reduce__(self) -> tuple[Any, ...]:
        path = os.path.abspath(self.path) if os.path.exists(self.path) else self.path
        return _again, (path, self.settings, self._plugins)


def scenario_of(given: Union[Scenario, str, "os.PathLike[str]"]) -> Scenario:
    """A scenario that is given as such, or by its path or name."""
    if isinstance(given, Scenario):
        return given
    if isinstance(given, (str, os.PathLike)):
        return Scenario(given)
    raise TypeError(f"a scenario must be a gaitlab.Scenario, a path or the name of a shipped scenario, not {type(given).__name__}")


def _again(path: str, settings: Mapping[str, Any], plugins: Any) -> Scenario:
    return Scenario(path, settings, plugins=plugins)
