"""Settings of Python as texts of --set."""
from __future__ import annotations

import json
import os
from typing import Any, Iterable, Mapping, Optional

import numpy as np

from . import _native


def is_empty(value: Any) -> bool:
    """True for a cell of a table without a value: NaN, NaT and NA of pandas, None, and an empty text."""
    if value is None or (isinstance(value, str) and not value):
        return True
    return type(value).__name__ in ("NAType", "NaTType") or (isinstance(value, (float, np.floating)) and bool(np.isnan(value)))


def _nested(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else text(value)


def text(value: Any) -> str:
    """A value as --set takes it. Floats are written by repr, whose shortest form reads back as the same bits."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (int, np.integer)):
        return repr(int(value))
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_nested(str(key))}: {_nested(one)}" for key, one in value.items()) + "}"
    if isinstance(value, Iterable):
        return "[" + ", ".join(_nested(one) for one in value) + "]"
    raise TypeError(f"a setting must be a number, a text, a list or a mapping, not {type(value).__name__}")


def mapping(settings: Optional[Mapping[str, Any]]) -> dict[str, Any]:
    """Settings as a dictionary."""
    if settings is None:
        return {}
    if not isinstance(settings, Mapping):
        raise TypeError(f'settings are a mapping from key to value, as in {{"duration": 2}}, not {type(settings).__name__}')
    return dict(settings)


def check_range(name: str, value: Any, low: int, high: int) -> None:
    """Raises TypeError for another value than a whole number, and ValueError for one outside the range."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number from {low} to {high}, not {type(value).__name__}")
    if not low <= value <= high:
        raise ValueError(f"{name} is {value}; expected {low} to {high}")


def thread_count(threads: Optional[int]) -> int:
    """The number of threads; without one, the processors that this process may use."""
    if threads is None:
        return min(len(os.sched_getaffinity(0)), _native.most_threads)
    check_range("threads", threads, 1, _native.most_threads)
    return int(threads)


def path_text(path: Any) -> str:
    """A path as the program gets it. Raises ValueError for a null character, at which the path would end."""
    text_of_path = os.fsdecode(path)
    if "\0" in text_of_path:
        raise ValueError(f"{text_of_path!r} has a null character; expected a path without one")
    return text_of_path


def texts(settings: Mapping[str, Any]) -> list[str]:
    """Settings `key.path=value`, in the order of the mapping."""
    settings = mapping(settings)
    return [f"{key}={text(value)}" for key, value in settings.items()]


def set_options(settings: Optional[Mapping[str, Any]]) -> list[str]:
    """Settings as options of the program."""
    return [word for one in texts(settings or {}) for word in ("--set", one)]


def records(rows: Any) -> tuple[list[dict[str, Any]], Any]:
    """Rows of a DataFrame, or an iterable of mappings, as dictionaries; and their index, None for an iterable."""
    if hasattr(rows, "to_dict"):
        return rows.to_dict("records"), rows.index
    if isinstance(rows, Mapping):
        raise TypeError("expected a DataFrame, or a list of mappings: one for each point")
    return [dict(one) for one in rows], None
