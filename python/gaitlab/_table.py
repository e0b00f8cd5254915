"""Tables of a run."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator, Mapping

import numpy as np

if TYPE_CHECKING:
    import pandas


class Table(Mapping[str, "np.ndarray[Any, Any]"]):
    """Named columns of a run: table["joint.0.torque"] is a read-only array with a value per row.

    The arrays share the memory of the run, which lives as long as one of them.
    """

    def __init__(self, raw: Mapping[str, Any]) -> None:
        self.values: "np.ndarray[Any, Any]" = raw["values"]  # type: ignore[assignment]
        """All columns: rows x columns, float64, read-only, in the order of `columns`."""
        self.columns: list[str] = raw["names"]
        """Names of the columns; the first one is `t`, s."""
        self.units: dict[str, str] = dict(zip(raw["names"], raw["units"]))
        """Unit of each column; "" for a number without a unit."""
        self.definitions: dict[str, str] = dict(zip(raw["names"], raw["definitions"]))
        """Definition of each column, in a sentence."""
        self._at = {name: k for k, name in enumerate(self.columns)}

    def __getitem__(self, name: str) -> "np.ndarray[Any, Any]":
        return self.values[:, self._at[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"<gaitlab.Table, {self.values.shape[0]} rows of {len(self.columns)} columns>"

    def to_pandas(self) -> "pandas.DataFrame":
        """A copy as a DataFrame, with `t` (s) as its index and the units in attrs["units"]."""
        import pandas

        frame = pandas.DataFrame(self.values.copy(), columns=self.columns)
        if "t" in self._at:
            frame = frame.set_index("t")
        frame.attrs["units"] = self.units
        return frame
