"""Points of a study, simulated by a child process."""
from __future__ import annotations

import json
import os
from typing import IO, TYPE_CHECKING, Any, Iterable, Mapping, Optional, Union

from . import _native
from ._native import InputError, RunError

if TYPE_CHECKING:
    from types import TracebackType

    import pandas


def program() -> str:
    """The program gaitlab: of the environment variable GAITLAB, of the module's own installation, or of PATH."""
    import shutil

    if given := os.environ.get("GAITLAB"):
        return given
    folder = os.path.dirname(os.path.abspath(_native.__file__))
    while folder != os.path.dirname(folder):
        own = os.path.join(folder, "bin", "gaitlab")
        if os.access(own, os.X_OK) and os.path.isdir(os.path.join(folder, "share", "gaitlab")):
            return own
        folder = os.path.dirname(folder)
    if found := shutil.which("gaitlab"):
        return found
    raise FileNotFoundError("the program gaitlab is not in PATH; the environment variable GAITLAB may name it")


class Evaluator:
    """A child `gaitlab evaluate`, which simulates the points that an optimiser asks for.

        with gaitlab.Evaluator("study.yaml", "runs/mine") as study:
            answers = study.evaluate([{"cpg.frequency": 0.5}, {"cpg.frequency": 1.0}])

    file: a study file (docs/studies.md). folder: of the journal (default runs/evaluate-NAME); a point that has rows there is
    answered from them. threads: default the processors that this process may use.
    """

    def __init__(
        self,
        file: Union[str, "os.PathLike[str]"],
        folder: Union[str, "os.PathLike[str]", None] = None,
        *,
        settings: Union[Mapping[str, Any], None] = None,
        threads: Optional[int] = None,
    ) -> None:
        import subprocess  # here, because few sessions need it
        import tempfile

        from ._settings import texts

        command = [program(), "evaluate", os.fspath(file), "--quiet"]
        command += [] if folder is None else ["--out", os.fspath(folder)]
        command += ["-j", str(threads or len(os.sched_getaffinity(0)))]
        for one in texts(settings or {}):
            command += ["--set", one]
        self._said: IO[bytes] = tempfile.TemporaryFile()
        self._child = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._said, text=True, encoding="utf-8"
        )

    def evaluate(self, points: Union[Iterable[Mapping[str, Any]], "pandas.DataFrame"]) -> "pandas.DataFrame":
        """Simulates the points side by side. A row per point, in their order: the parameters, outcome, objective.1 ..., violation,
        kept, feasible, `margin.ID` of each guard, and the quantities. Raises InputError if the study or a point is wrong."""
        import pandas

        if hasattr(points, "to_dict"):
            points = points.to_dict("records")
        asked = [{key: getattr(value, "item", lambda v=value: v)() for key, value in one.items()} for one in points]
        lines = [json.dumps({"id": k, "parameters": one}, allow_nan=True) for k, one in enumerate(asked)]
        answers: list[dict[str, Any]] = []
        try:
            assert self._child.stdin is not None and self._child.stdout is not None
            self._child.stdin.write("\n".join([*lines, "", ""]))
            self._child.stdin.flush()
            while len(answers) < len(asked):
                line = self._child.stdout.readline()
                if not line:
                    self._fail()
                answers.append(json.loads(line))
        except BrokenPipeError:
            self._fail()
        return pandas.DataFrame([_row(point, answer) for point, answer in zip(asked, answers)])

    def close(self) -> None:
        """Ends the child. It writes the tables and figures of the folder."""
        if self._said.closed:
            return
        self._child.communicate()
        failed = self._child.returncode
        said = self._heard()
        if failed:
            raise (InputError if failed == 2 else RunError)(said or f"gaitlab evaluate ended with code {failed}")

    def _heard(self) -> str:
        self._said.seek(0)
        text = self._said.read().decode("utf-8", "replace").rstrip("\n")
        self._said.close()
        return text

    def _fail(self) -> None:
        code = self._child.wait()
        raise (InputError if code == 2 else RunError)(self._heard() or f"gaitlab evaluate ended with code {code}")

    def __enter__(self) -> "Evaluator":
        return self

    def __exit__(
        self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: "Optional[TracebackType]"
    ) -> None:
        if error is None:
            self.close()
            return
        self._child.terminate()  # its completed runs are in the journal
        self._child.communicate()
        self._said.close()


def _row(point: Mapping[str, Any], answer: Mapping[str, Any]) -> dict[str, Any]:
    row = {**point, "outcome": answer["outcome"], "message": answer.get("message", "")}
    for k, value in enumerate(answer.get("objective") or []):
        row[f"objective.{k + 1}"] = value
    for key in ("violation", "kept", "feasible", "feasible_share", "run"):
        if key in answer:
            row[key] = answer[key]
    row.update({f"margin.{check}": value for check, value in (answer.get("margins") or {}).items()})
    row.update({name: value for name, value in (answer.get("figures") or {}).items() if name not in row})
    return row
