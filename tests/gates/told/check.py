"""What a check must say: status, number, limit, part and times, recomputed."""
import copy

import numpy as np

SAME = 1e-9  # two parts whose numbers differ by less are equal: the worst is then either of them


class Told:
    """A check that was judged has a status; `also`: further numbers of its sentence. `ties`: parts that are as bad as the worst."""

    def __init__(self, status="not judged", value=np.nan, limit=np.nan, **more):
        self.status, self.value, self.limit, self.margin = status, value, limit, np.nan
        self.worst, self.ties, self.parts, self.least, self.unit = None, (), 0, False, None
        self.start = self.end = self.first = np.nan
        self.first_part, self.span, self.can_fail, self.error, self.also = None, None, None, 0.0, {}
        self.undecided = ()  # other statuses that rounding allows
        self.__dict__.update(more)

    def of(self, part):
        """The same with the numbers of another part that is as bad."""
        other = self.__dict__.get("others", {}).get(part)
        if other is None:
            return self
        out = copy.copy(self)
        out.__dict__.update(other)
        out.also = self.also | other.get("also", {})
        return out

    def plateau(self, start, end):
        """Whether another row is as bad as the worst, but for rounding: where motors keep a steady state, many are."""
        rows = self.__dict__.get("rows")
        return rows is not None and None not in (start, end) and any(abs(a - start) + abs(b - end) < 1e-6 for a, b in rows)

    def numbers(self):
        return {"value": self.value, "limit": self.limit, "parts": self.parts, "worst": self.worst, "at": self.start,
                "from": self.start, "to": self.end, "error": self.error, **self.also}


def margin(value, limit, least=False):
    room = value - limit if least else limit - value
    return room if limit == 0 else room / abs(limit)


def graded(value, warns, fails):
    """Beyond `warns` a warning, beyond `fails` a failure."""
    return "fail" if value > fails else "warn" if value > warns else "pass"


def worst_of(values):
    """The first of the largest numbers, equal ones being those that differ by rounding; and all of these."""
    values = np.asarray(values, float)
    most = np.nanmax(values)
    near = [k for k in range(len(values)) if values[k] >= most - SAME * max(abs(most), 1e-300)]
    return near[0], near


def widen(told, error):
    """A number whose error reaches across its limit is too close."""
    told.error = error
    low, high = told.value * (1 - error), told.value * (1 + error)
    if error > 0 and low < told.limit < high:
        told.status = "too close"
    told.also |= {"low": low / told.limit if told.limit else np.nan, "high": high / told.limit if told.limit else np.nan}
    return told
