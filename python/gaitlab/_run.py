"""Runs."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Union

from . import _native
from ._scenario import Plugins, Scenario, scenario_of, trusted
from ._settings import path_text
from ._table import Table
from ._warnings import tell


class Run:
    """A run: simulated by run(), or read from a folder by read(). Nothing is written before save()."""

    def __init__(self, native: _native.Run) -> None:
        self._native = native
        self.outcome: str = native.outcome
        """`done`, or the reason of an early end with its step and time."""
        self.summary: dict[str, Any] = json.loads(native.summary())
        """The numbers of summary.json by name, SI units; None for unknown ones."""
        self.verdict: dict[str, Any] = json.loads(native.verdict())
        """The content of verdict.json: `verdict` is its word, `checks` a list."""
        self.warnings: list[str] = native.warnings()
        """Warnings that `gaitlab run` prints, each with its place."""

    @property
    def name(self) -> str:
        return self._native.name

    @property
    def resolved(self) -> str:
        """The complete scenario of the run, YAML."""
        return self._native.resolved()

    @property
    def measured(self) -> Union[dict[str, float], None]:
        """The numbers `measured.*` of the summary, such as `angle.mae`: how far the run is from its log, SI units; None without a log."""
        found = self.summary.get("measured")
        return None if found is None else {f"{of}.{name}": value for of, numbers in found.items() for name, value in numbers.items()}

    @property
    def trace(self) -> Table:
        """The rows of trace.h5, one per trace.period."""
        return Table(self._native.table("trace"))

    @property
    def ticks(self) -> Table:
        """Peaks and integrals of the motors at control ticks, over all steps (/recording/ticks)."""
        return Table(self._native.table("ticks"))

    @property
    def loads(self) -> Table:
        """Loads of docks and feet at control ticks (/recording/loads); without columns for run(..., loads=False)."""
        return Table(self._native.table("loads"))

    @property
    def poses(self) -> Table:
        """Pose of the base, angles and set points at control ticks (/recording/poses)."""
        return Table(self._native.table("poses"))

    def save(self, folder: Union[str, "os.PathLike[str]", None] = None) -> str:
        """Writes the files of `gaitlab run` into a new or empty folder (default runs/NAME, then NAME-2 ...). Returns its path."""
        saved = self._native.save(None if folder is None else path_text(folder))
        tell()
        return saved

    def figure(self) -> str:
        """The figure of the run, SVG."""
        return self._native.figure()

    def page(self) -> str:
        """The page report.html, which needs no network."""
        return self._native.page()

    def __repr__(self) -> str:
        return f"<gaitlab.Run {self.name!r}: {self.outcome}, {self.verdict['verdict']}>"

    def _repr_html_(self) -> str:
        import html

        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:720px;border:0"></iframe>'


def run(
    scenario: Union[Scenario, str, "os.PathLike[str]"],
    *,
    progress: Union[Callable[[float], object], None] = None,
    loads: bool = True,
) -> Run:
    """Simulates a scenario as `gaitlab run` does, and judges the run. Nothing is written.

    scenario: a Scenario, or the path or name of one.
    progress: called with the share that is done, about twenty times a second and at the end. An exception stops the run.
    loads: False leaves out most loads of docks and feet, as rollouts do; checks of the verdict that need them are not judged.

    A run that diverges is a Run with its `.outcome`; InputError is raised for one that cannot begin. Ctrl-C ends the run and
    raises KeyboardInterrupt.
    """
    made = Run(_native.simulate(scenario_of(scenario)._native, progress, loads))
    tell(made.warnings)
    return made


def read(folder: Union[str, "os.PathLike[str]"], *, plugins: Plugins = "refuse") -> Run:
    """Reads a run folder, or a trace.h5, and judges the run. Raises InputError if it is neither.

    plugins: as in Scenario. By default a folder whose scenario names plugin libraries is refused, because it may come from others.
    """
    made = Run(_native.read_run(path_text(folder), *trusted(plugins)))
    tell(made.warnings)
    return made
