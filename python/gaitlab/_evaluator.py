"""Points of a study, simulated by a child process."""
from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Union

from ._child import Child, Path
from ._settings import is_empty, records, set_options, thread_count

if TYPE_CHECKING:
    import pandas


class Evaluator(Child):
    """A child `gaitlab evaluate`, which simulates the points that an optimiser asks for.

        with gaitlab.Evaluator("study.yaml", "runs/mine") as study:
            answers = study.evaluate([{"cpg.frequency": 0.5}, {"cpg.frequency": 1.0}])

    file: a study file (docs/studies.md). folder: the folder of the journal (default runs/evaluate-NAME); a point with rows in this
    journal is answered from them. threads: number of threads (default: the processors that this process may use).
    """

    def __init__(
        self,
        file: Path,
        folder: Optional[Path] = None,
        *,
        settings: Union[Mapping[str, Any], None] = None,
        threads: Optional[int] = None,
    ) -> None:
        super().__init__("evaluate", file, folder, ["-j", str(thread_count(threads)), *set_options(settings)])

    def evaluate(self, points: Union[Iterable[Mapping[str, Any]], "pandas.DataFrame"]) -> "pandas.DataFrame":
        """Simulates the points side by side. A row per point, in their order: the parameters, outcome, objective.1 ..., violation,
        kept, feasible, `margin.ID` of each guard, and the quantities. Raises InputError if the study or a point is wrong."""
        import pandas

        rows, index = records(points)
        asked = [{key: _value(value, key, k) for key, value in one.items()} for k, one in enumerate(rows)]
        self._write([*(json.dumps({"id": k, "parameters": one}) for k, one in enumerate(asked)), ""])
        answers = []
        for point in asked:
            line = self._read()
            if not line:
                self._fail()
            answers.append(_row(point, json.loads(line)))
        return pandas.DataFrame(answers, index=index)


def _value(value: Any, key: str, row: int) -> Any:
    """A value for JSON. Raises ValueError for an empty cell of a table, and for a number that is not finite."""
    plain = getattr(value, "item", lambda: value)()
    if is_empty(plain) or (isinstance(plain, float) and not math.isfinite(plain)):
        raise ValueError(f"{key} of row {row} is {value!r}; expected a value of the parameter")
    return plain


def _row(point: Mapping[str, Any], answer: Mapping[str, Any]) -> dict[str, Any]:
    row = {**point, "outcome": answer["outcome"], "message": answer.get("message", "")}
    for k, value in enumerate(answer.get("objective") or []):
        row[f"objective.{k + 1}"] = value
    for key in ("violation", "kept", "feasible", "feasible_share", "verdict", "simulated", "run"):
        if key in answer:
            row[key] = answer[key]
    row.update({f"margin.{check}": value for check, value in (answer.get("margins") or {}).items()})
    row.update({name: value for name, value in (answer.get("figures") or {}).items() if name not in row})
    return row
