"""Recomputed result of a check: status, number, limit, part and times."""
import copy

import numpy as np

SAME = 1e-9  # numbers that differ by less are equal; either of two parts with equal numbers may be the worst


class Told:
    """Result of a check; it has a status if it is judged. `also` are further numbers of its sentence, `ties` parts that are as bad as
    the worst."""

    def __init__(self, status="not judged", value=np.nan, limit=np.nan, **more):
        self.status, self.value, self.limit, self.margin = status, value, limit, np.nan
        self.worst, self.ties, self.parts, self.least, self.unit = None, (), 0, False, None
        self.start = self.end = self.first = np.nan
        self.first_part, self.span, self.can_fail, self.error, self.also = None, None, None, 0.0, {}
        self.certain = False  # a part is beyond its limit by more than the error of its torque
        self.undecided = ()  # other statuses that are possible with rounding errors
        self.__dict__.update(more)

    def of(self, part):
        """Result with the numbers of a different part that is as bad as the worst."""
        other = self.__dict__.get("others", {}).get(part)
        if other is None:
            return self
        out = copy.copy(self)
        out.__dict__.update(other)
        out.also = self.also | other.get("also", {})
        return out

    def plateau(self, start, end):
        """True if another row is as bad as the worst row up to rounding errors, as in a steady state of the motors."""
        rows = self.__dict__.get("rows")
        return rows is not None and None not in (start, end) and any(abs(a - start) + abs(b - end) < 1e-6 for a, b in rows)

    def numbers(self):
        return {"value": self.value, "limit": self.limit, "parts": self.parts, "worst": self.worst, "at": self.start,
                "from": self.start, "to": self.end, "error": self.error, "first": self.first,
                "first_part": tuple(getattr(self, "first_parts", [self.first_part])), **self.also}


def margin(value, limit, least=False):
    room = value - limit if least else limit - value
    return room if limit == 0 else room / abs(limit)


def graded(value, warns, fails):
    """Status of a value: `warn` beyond the limit `warns`, `fail` beyond the limit `fails`."""
    return "fail" if value > fails else "warn" if value > warns else "pass"


def worst_of(values):
    """Index of the first largest number, and indices of all numbers that equal it up to rounding errors."""
    values = np.asarray(values, float)
    most = np.nanmax(values)
    near = [k for k in range(len(values)) if values[k] >= most - SAME * max(abs(most), 1e-300)]
    return near[0], near


def widen(told, error):
    """Sets the status `too close` if the limit is within the error of the number."""
    told.error = error
    low, high = told.value * (1 - error), told.value * (1 + error)
    told.certain = bool(low > told.limit)
    if error > 0 and low < told.limit < high:
        told.status = "too close"
    told.also |= {"low": low / told.limit if told.limit else np.nan, "high": high / told.limit if told.limit else np.nan}
    return told
