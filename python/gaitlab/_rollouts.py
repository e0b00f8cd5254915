"""Many runs of one scenario as a table."""
from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _native
from ._scenario import Scenario, scenario_of
from ._settings import check_range, records, texts, thread_count
from ._warnings import tell

if TYPE_CHECKING:
    import os

    import pandas


class Rollouts(Mapping[str, "np.ndarray[Any, Any]"]):
    """A row per rollout, in the order of the overrides: table["speed"] is an array; NaN for unknown quantities."""

    def __init__(self, raw: Mapping[str, Any], overrides: Sequence[Mapping[str, Any]], index: Any = None) -> None:
        self.values: "np.ndarray[Any, Any]" = raw["values"]  # type: ignore[assignment]
        """All quantities: rows x quantities, float64, in the order of `quantities`."""
        self.quantities: list[str] = raw["names"]
        self.units: dict[str, str] = dict(zip(raw["names"], raw["units"]))
        self.overrides = list(overrides)
        self._index = index
        self.outcome: list[str] = raw["outcome"]
        """Per row `done`, `refused` (by the scenario), `diverged`, `plugin` (which threw) or `not run` (interrupted)."""
        self.verdict: list[str] = raw["verdict"]
        """Per row the word of the verdict; "" unless the row is `done`."""
        self.message: list[str] = raw["message"]
        """Per row the reason of the outcome, or of the verdict if the row is `done`."""
        self._at = {name: k for k, name in enumerate(self.quantities)}

    def __getitem__(self, name: str) -> "np.ndarray[Any, Any]":
        return self.values[:, self._at[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self.quantities)

    def __len__(self) -> int:
        return len(self.quantities)

    def __repr__(self) -> str:
        return f"<gaitlab.Rollouts, {len(self.outcome)} rows of {len(self.quantities)} quantities>"

    def to_pandas(self) -> "pandas.DataFrame":
        """A copy as a DataFrame: overrides, quantities, outcome, verdict, message; units in attrs["units"]. Its index is that of the
        DataFrame of overrides, if it was one."""
        import pandas

        index = range(len(self.outcome)) if self._index is None else self._index
        parts = [
            pandas.DataFrame(self.overrides, index=index),
            pandas.DataFrame(self.values.copy(), columns=self.quantities, index=index),
            pandas.DataFrame({"outcome": self.outcome, "verdict": self.verdict, "message": self.message}, index=index),
        ]
        frame = pandas.concat(parts, axis=1)
        frame.attrs["units"] = self.units
        return frame


def rollouts(
    scenario: Union[Scenario, str, "os.PathLike[str]"],
    overrides: Union[Iterable[Mapping[str, Any]], "pandas.DataFrame"],
    *,
    threads: Union[int, None] = None,
    lanes: int = 0,
    estimate_every: int = 16,
    quantities: Sequence[str] = (),
    progress: Union[Callable[[int, int], object], None] = None,
) -> Rollouts:
    """Simulates the scenario under each of `overrides`, bit-identical to `gaitlab sweep`, and writes nothing.

    scenario: a Scenario, or the path or name of one.
    overrides: mappings from key to value, or a DataFrame with a column per key. A row that the scenario refuses is a row of the
        table with the outcome `refused`.
    threads: number (default: the processors that this process may use). lanes: largest number of rollouts side by side in a
        thread; 0: as many as engine and processor allow. Neither changes the results.
    estimate_every: the torque error is estimated for one row in this number (docs/studies.md, accuracy of the step); 1: for every
        row, which takes up to half as long again. Columns that depend on it are NaN in the other rows.
    quantities: names of the columns, also `torque.peak[m3/active]` and `margin.ID[LIMIT]`; default: those of every run
        (gaitlab.quantities()).
    progress: called with the numbers of ended and of all rollouts, about twenty times a second and at the end.

    KeyboardInterrupt, and an exception of `progress`, stop the work; its attribute `rollouts` has the rows that ended.
    """
    if isinstance(quantities, str):
        raise TypeError(f"quantities are a list of names: quantities=[{quantities!r}]")
    rows, index = records(overrides)
    count = thread_count(threads)
    check_range("lanes", lanes, 0, _native.most_lanes)
    check_range("estimate_every", estimate_every, 0, sys.maxsize)
    raw = _native.rollouts(scenario_of(scenario)._native, [texts(one) for one in rows], list(quantities), count, lanes, estimate_every, progress)
    table = Rollouts(raw, rows, index)
    if raw["raised"] is not None:
        try:
            raw["raised"].rollouts = table
        except AttributeError:  # an exception without attributes
            pass
        raise raw["raised"]
    tell()
    return table


class QuantityText(NamedTuple):
    """A quantity of rollouts: its name, unit and meaning."""

    name: str
    unit: str
    meaning: str


def quantities(*, of_joints: bool = False) -> list[QuantityText]:
    """Quantities that every run has, or those whose names accept [JOINT]."""
    return [QuantityText(*one) for one in _native.quantities(of_joints)]
