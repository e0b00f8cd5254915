"""A search of the program whose points Python evaluates."""
from __future__ import annotations

import itertools
import json
import math
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Union

from ._child import Child, Path
from ._native import RunError
from ._settings import is_empty, set_options

if TYPE_CHECKING:
    import pandas


class Search(Child):
    """A child `gaitlab optimize --ask`: its methods choose the points of a study, and the caller gives their results.

        with gaitlab.Search("study.yaml", "runs/mine") as search:
            while len(points := search.ask()):
                table = gaitlab.rollouts(scenario, points).to_pandas()
                search.tell(table.assign(objective=table["speed"]))

    file: a study file (docs/studies.md) with one run per point. folder: the folder of the journal (default runs/optimize-NAME); a
    search that was ended continues in it. method, runs, seed: values that replace those of the file.
    """

    def __init__(
        self,
        file: Path,
        folder: Optional[Path] = None,
        *,
        settings: Union[Mapping[str, Any], None] = None,
        method: Optional[str] = None,
        runs: Optional[int] = None,
        seed: Optional[int] = None,
    ) -> None:
        options = ["--ask", *set_options(settings)]
        for name, value in (("--method", method), ("--runs", runs), ("--seed", seed)):
            options += [] if value is None else [name, str(value)]
        super().__init__("optimize", file, folder, options)
        self._points: dict[int, Mapping[str, Any]] = {}  # points of this batch that are not asked yet
        self._open: set[int] = set()  # points that are asked but not told
        self._objectives = 1
        self._ended = False
        self._read_batch()  # read here, so that errors of the file are raised immediately

    def ask(self, n: Optional[int] = None) -> "pandas.DataFrame":
        """The next points, at most n: a column per parameter, and as index the number of the point. Without n all points that the
        method offers now, its generation. Empty if the search has ended. Raises RunError if all points of the generation
        were given out, but results are missing."""
        import pandas

        if n is not None and n < 1:
            raise ValueError("n is at least 1")
        if self._said.closed:
            raise RunError("the search is closed")
        if not self._points and not self._ended:
            if self._open:
                some = ", ".join(str(number) for number in sorted(self._open)[:5])
                raise RunError(
                    f"{len(self._open)} points of this generation have no result; tell() gives it "
                    f"(points {some}{', ...' if len(self._open) > 5 else ''})"
                )
            self._read_batch()
        numbers = list(itertools.islice(self._points, n))
        self._open.update(numbers)
        return pandas.DataFrame([self._points.pop(k) for k in numbers], index=pandas.Index(numbers, name="point", dtype="int64"))

    def tell(self, rows: "pandas.DataFrame") -> None:
        """Gives the results of points that were asked, all or some, in any order.

        rows: the number of the point as index, as in the table of ask(), and the columns
            objective, or objective.1 ... : the study's objectives, each in the direction of the study; NaN: not known
            violation: 0 if the point satisfies all limits, else more than 0, the larger the farther from satisfying them. Without
                this column it follows from `verdict`, if there is one, as in tables of rollouts: 0 for a feasible gait, otherwise
                -margin, at least 0.5; and it is 0 without a verdict
            outcome, message: of a failed point a word other than `done`, and the reason. NaN, None and "" are `done`. A point whose
                word is `not run` has no result: it stays open, and is told again later
            others: quantities for the journal, where the study has a column of this name

        Raises ValueError, and gives nothing, if a row has no number as objective, a negative violation, an outcome that is no text,
        another verdict than those of the program, or a point that is not open.
        """
        if not hasattr(rows, "to_dict"):
            raise TypeError(f"rows must be a DataFrame with the index of the table of ask(), not {type(rows).__name__}")
        results: list[dict[str, Any]] = []
        seen: set[int] = set()
        for number, row in zip(rows.index, rows.to_dict("records")):
            if number not in self._open or number in seen:
                raise ValueError(f"point {number} is not open; expected points of ask() without a result, by the index of the table")
            seen.add(number)
            if (result := _result(int(number), row, self._objectives)) is not None:
                results.append(result)
        if len(results) > 1 and all("outcome" not in one and set(one["objective"]) <= {None} for one in results):
            raise ValueError("no row has an objective; a column assigned from a table with another index is NaN")
        self._write([json.dumps(one) for one in results])
        self._open.difference_update(one["id"] for one in results)

    def close(self) -> None:
        super().close()
        self._ended = True
        self._points.clear()
        self._open.clear()

    def _read_batch(self) -> None:
        while line := self._read():
            if not line.strip():
                return
            question = json.loads(line)
            self._points[question["id"]] = question["parameters"]
            self._objectives = question.get("objectives", 1)
        self._ended = True
        if self._child.wait():
            self._fail()


def _number(value: Any, what: str, number: int) -> Optional[float]:
    """A number for JSON; None for NaN."""
    try:
        found = math.nan if not isinstance(value, str) and is_empty(value) else float(value)
    except (OverflowError, TypeError, ValueError):
        found = math.inf
    if math.isinf(found):
        raise ValueError(f"{what} of point {number} is {value!r:.100}; expected a number, or NaN if it is not known")
    return None if math.isnan(found) else found


def _word(row: Mapping[str, Any], column: str, number: int) -> str:
    """The text of a cell; "" for an empty one, which pandas fills with NaN."""
    value = row.get(column)
    if is_empty(value):
        return ""
    if not isinstance(value, str):
        raise ValueError(f"{column} of point {number} is {value!r}; expected a text, or NaN if there is none")
    return value


def _verdict(row: Mapping[str, Any], number: int) -> str:
    """The verdict of a row; "" without one."""
    word = _word(row, "verdict", number)
    if word not in ("", "feasible", "infeasible", "not judged"):
        raise ValueError(f"verdict of point {number} is {word!r}; expected 'feasible', 'infeasible' or 'not judged'")
    return word


def _violation(row: Mapping[str, Any], number: int) -> Optional[float]:
    """The violation of a row, or what follows from its verdict. None without either."""
    if "violation" in row:
        given = _number(row["violation"], "violation", number)
        if given is None or given < 0:
            raise ValueError(f"violation of point {number} is {row['violation']}; expected 0 or more")
        return given
    verdict = _verdict(row, number)
    if not verdict:
        return None
    margin = row.get("margin")
    return 0.0 if verdict == "feasible" else max(0.5, -margin if isinstance(margin, float) and math.isfinite(margin) else 0.5)


def _objective_names(row: Mapping[str, Any], count: int) -> list[str]:
    """Names of the columns with the objectives of a study. Raises ValueError if one is missing, or there are more than objectives."""
    numbered = [f"objective.{k}" for k in range(1, count + 1)]
    expected = "objective, or objective.1" if count == 1 else f"objective.1 to {numbered[-1]}"
    for key in row:
        number = str(key).removeprefix("objective.")
        if number != key and number.isdecimal() and key not in numbered:
            raise ValueError(f"the table has a column {key}; expected {expected}, as the study has {count}")
    names = ["objective"] if count == 1 and "objective" in row else numbered
    for name in names:
        if name not in row:
            raise ValueError(f"the table has no column {'objective' if count == 1 else name}; expected {expected}")
    return names


def _is_finite(value: Any) -> bool:
    """True for a number that JSON and a double can have."""
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # a whole number above 1.8e308
        return False


def _result(number: int, row: Mapping[str, Any], objectives: int) -> Optional[dict[str, Any]]:
    """A result as `gaitlab optimize --ask` reads it. None for a point that was not run."""
    outcome = _word(row, "outcome", number) or "done"
    if outcome == "not run":
        return None
    if outcome != "done":
        failed = {"id": number, "outcome": outcome, "message": _word(row, "message", number)[:2000]}
        return failed | {"simulated": _number(row.get("simulated", math.nan), "simulated", number)}
    names = _objective_names(row, objectives)
    figures = {key: float(value) for key, value in row.items() if key not in (*names, "violation") and _is_finite(value)}
    result: dict[str, Any] = {"id": number, "objective": [_number(row[name], name, number) for name in names], "figures": figures}
    violation = _violation(row, number)
    if violation is not None:
        result["violation"] = violation
    if verdict := _verdict(row, number):
        result["verdict"] = verdict
    return result
