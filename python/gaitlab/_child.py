"""A child process `gaitlab COMMAND`, whose input and output are lines of JSON."""
from __future__ import annotations

import os
import re
from typing import IO, TYPE_CHECKING, NoReturn, Optional, Sequence, TypeVar, Union

from . import _native
from ._native import InputError, RunError
from ._settings import path_text

if TYPE_CHECKING:
    from types import TracebackType

Path = Union[str, "os.PathLike[str]"]
_Self = TypeVar("_Self", bound="Child")


def program() -> str:
    """Path of the program gaitlab: from the environment variable GAITLAB, the module's own installation, or PATH."""
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
    raise FileNotFoundError("the program gaitlab is not in PATH; set the environment variable GAITLAB to its path")


def _problem(line: str) -> tuple[str, int, int, str]:
    """File, line, column (0 if there is none) and text of a problem that the program has printed."""
    place, _, text = line.partition(": error: ")
    file, row, column = re.fullmatch(r"(.*?)(?::(\d+))?(?::(\d+))?", place, re.S).groups()  # type: ignore[union-attr]
    return file, int(row or 0), int(column or 0), text


class Child:
    """The process. Used as a context, it ends with the context; an exception terminates it."""

    def __init__(self, name: str, file: Path, folder: Optional[Path], options: Sequence[str]) -> None:
        import subprocess  # imported here, because few sessions need it
        import tempfile

        command = [program(), name, path_text(file), "--quiet", *options]
        command += [] if folder is None else ["--out", path_text(folder)]
        self._name = name
        self._said: IO[bytes] = tempfile.TemporaryFile()
        self._child = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._said, text=True, encoding="utf-8"
        )

    def close(self) -> None:
        """Ends the child, which writes the tables and figures of its folder."""
        if self._said.closed:
            return
        self._child.communicate()
        if self._child.returncode:
            self._fail()
        self._said.close()

    def _write(self, lines: Sequence[str]) -> None:
        assert self._child.stdin is not None
        try:
            self._child.stdin.write("".join(line + "\n" for line in lines))
            self._child.stdin.flush()
        except (BrokenPipeError, ValueError):  # ValueError: the pipe was closed before
            self._fail()

    def _read(self) -> str:
        """The next line, or "" at the end of the output."""
        assert self._child.stdout is not None
        return self._child.stdout.readline() if not self._child.stdout.closed else ""

    def _fail(self) -> NoReturn:
        code = self._child.wait()
        if self._said.closed:
            raise RunError(f"gaitlab {self._name} has ended")
        self._said.seek(0)
        text = self._said.read().decode("utf-8", "replace").rstrip("\n")
        self._said.close()
        text = text or f"gaitlab {self._name} ended with code {code}"
        if code != 2:
            raise RunError(text)
        wrong = InputError(text)
        setattr(wrong, "problems", [_problem(line) for line in text.split("\n") if ": error: " in line])  # as the module does
        raise wrong

    def __enter__(self: _Self) -> _Self:
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
