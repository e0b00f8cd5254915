"""Folders of studies, read only."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Union

from ._settings import path_text

if TYPE_CHECKING:
    import pandas


class Study:
    """The journal of a study (`gaitlab sweep`, `optimize` or `evaluate`), also while it runs. Each table is read anew."""

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        folder = path_text(folder)
        file = os.path.join(folder, "study.db") if os.path.isdir(folder) else folder
        if not os.path.isfile(file):
            raise FileNotFoundError(f"{file}: there is no journal of a study")
        self.path = os.path.abspath(file)

    def table(self, query: str) -> "pandas.DataFrame":
        """The result of a query in SQL. The tables are described in docs/studies.md."""
        import sqlite3  # imported here, because few sessions need them
        from urllib.parse import quote

        import pandas

        journal = sqlite3.connect(f"file:{quote(self.path)}?mode=ro", uri=True)
        try:
            journal.execute("pragma trusted_schema=off")  # a journal may come from others
            return pandas.read_sql(query, journal)
        finally:
            journal.close()

    @property
    def points(self) -> "pandas.DataFrame":
        """A row per completed run: parameters, quantities, outcome, verdict, objectives, violation; NaN for unknown values."""
        return self.table("select * from run order by run")

    @property
    def quantities(self) -> "pandas.DataFrame":
        """Name, column, unit and definition of each quantity."""
        return self.table("select * from quantity")

    @property
    def best(self) -> "pandas.DataFrame":
        """The rows of `points` that are kept, the best first."""
        return self.table("select * from best")

    def __repr__(self) -> str:
        return f"<gaitlab.Study {self.path!r}>"


def study(folder: Union[str, "os.PathLike[str]"]) -> Study:
    """Opens the folder of a study, or its study.db."""
    return Study(folder)
