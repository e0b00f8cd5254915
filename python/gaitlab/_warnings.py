"""Warnings of the program as warnings of Python."""
from __future__ import annotations

import os
import sys
import warnings
from typing import Iterable

from . import _native


class Warning(UserWarning):
    """A warning that the program gaitlab prints on stderr: on a scenario, on a run, or on threads that cannot be started."""


def _level() -> int:
    """The stacklevel, seen from tell(), of the first frame outside this package, so that a warning names the user's line."""
    package, level = os.path.dirname(__file__), 2
    frame = sys._getframe(2)
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == package:
        frame, level = frame.f_back, level + 1
    return level


def tell(texts: Iterable[str] = ()) -> None:
    """Issues the texts, and what the module would have printed since the last call."""
    for text in [*_native.take_said(), *texts]:
        warnings.warn(text, Warning, stacklevel=_level())
