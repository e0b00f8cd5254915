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
        if (column := self._at.get(name)) is None:
            raise KeyError(self._unknown(name))
        return self.values[:, column]

    def __contains__(self, name: object) -> bool:
        return name in self._at

    def _unknown(self, name: object) -> str:
        """The message for an unknown column: those of the same quantity and joint, else the nearest names."""
        import difflib  # imported here, because few sessions need it

        text = str(name)
        place, _, quantity = text.rpartition(".")
        part = place.partition(".")[2]
        near = [
            one for one in self.columns if part and one.endswith("." + quantity) and self.definitions[one].endswith(" " + part)
        ] or difflib.get_close_matches(text, self.columns, 3)
        return f"no column {text}" + (f"; did you mean {' or '.join(near)}?" if near else "; Table.columns has the names")

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
