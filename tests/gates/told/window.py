"""The limit cycle and the window by which a run is judged. Written from docs/numbers.md (the summary; limit cycle)."""
import numpy as np

REPEATS, STILL, SHORTEST = 0.02, 1e-3, 5
START = 2.0  # omitted start of a run without a limit cycle, s; at most a fifth of the run


class Cycle:
    found, start, period, error = False, 0.0, 0.0, 1.0

    def doubt(self):
        """Relative difference that two searches for the period may have. The minimum of the error is flatter for a motion that repeats
        less accurately."""
        return max(3e-5, 0.01 * self.error)


def shifted(x, lag):
    """Values of x at i + lag for a non-integer lag, by cubic interpolation between four neighbours (Lagrange), up to the end of x."""
    whole = int(np.floor(lag))
    f = lag - whole
    padded = np.concatenate([x[:1], x, x[-1:], x[-1:]])
    n = len(x) - whole - (1 if f > 0 else 0)
    at = [padded[whole + k:whole + k + n] for k in range(4)]
    w = (-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2, (f + 1) * f * (f - 1) / 6)
    return sum(k * part for k, part in zip(w, at))


def scales(x, samples):
    half = np.ptp(x[-samples:], axis=0) / 2  # half of the range of each column
    return np.maximum(half, max(0.1 * half.max(), STILL)), half.max() > STILL


def cycle(x, spacing):
    """Limit cycle of x (rows, columns): the shortest period with an error below 2 % two periods before the end, or the best candidate."""
    best, n = Cycle(), len(x)
    if n < 12 or x.shape[1] == 0:
        return best
    errors = np.full(n // 2 + 2, np.inf)
    for lag in range(SHORTEST, n // 2 + 1):  # coarse search with 100 to 200 points per period
        scale, moves = scales(x, 2 * lag)
        some = slice(None, None, max(1, lag // 100))
        if moves:
            errors[lag] = np.sqrt(np.mean((x[n - lag:][some] - x[n - 2 * lag:n - lag][some]) ** 2, axis=0) / scale**2).max()
    for lag in range(SHORTEST, n // 2 + 1):
        if not (errors[lag] < 0.3 and errors[lag] <= errors[lag - 1] and errors[lag] <= errors[lag + 1]):
            continue
        scale, _ = scales(x, 2 * lag)

        def misfit(period):
            moved = shifted(x, period)[-lag:]
            return np.sum(((moved - x[:len(shifted(x, period))][-lag:]) / scale) ** 2)

        low, high = lag - 1.0, min(lag + 1.0, n / 2)
        for _ in range(40):
            a, b = high - (high - low) * 0.6180339887, low + (high - low) * 0.6180339887
            if misfit(a) < misfit(b):
                high = b
            else:
                low = a
        period = (low + high) / 2
        window = int(round(period))
        moved = shifted(x, period)
        squares = (moved - x[:len(moved)]) ** 2
        if len(squares) < window:
            continue
        scale, _ = scales(x, min(n, len(x) - len(squares) + window))
        sums = np.concatenate([np.zeros((1, x.shape[1])), np.cumsum(squares, axis=0)])
        e = np.sqrt((sums[window:] - sums[:-window]) / window / scale**2).max(axis=1)
        if e[-1] >= best.error:
            continue
        best = Cycle()
        best.period, best.error, best.found = period * spacing, e[-1], bool(e[-1] < REPEATS)
        if best.found:
            beyond = np.flatnonzero(e >= REPEATS)
            best.start = (beyond[-1] + 1 if len(beyond) else 0) * spacing
            return best
    return best


def grid(record):
    """Equidistant rows of the poses: all rows, except the last row if the run ends between two ticks."""
    t = record.poses["t"]
    if len(t) < 3:
        return len(t), 0
    spacing = t[1] - t[0]
    even = np.abs(t - np.arange(len(t)) * spacing) <= 1e-6 * spacing * np.maximum(np.arange(len(t)), 1)
    return (len(t) if even.all() else int(np.argmin(even))), spacing


def limit_cycle(record):
    rows, spacing = grid(record)
    angles = record.pose("angle") if record.count else np.zeros((rows, 0))
    columns = np.concatenate([angles, record.pose("setpoint")[:, record.driven]], 1) if record.driven.any() else angles
    return cycle(columns[:rows], spacing)


def set_point_cycle(record):
    rows, spacing = grid(record)
    return cycle(record.pose("setpoint")[:rows, record.driven], spacing) if record.driven.any() else Cycle()


class Window:
    """Judged window: start and end, s; number of periods; `first` is the last row of ticks before the window."""

    def __init__(self, record, found, period, begin):
        self.cycle, self.end, self.periods, self.start = found, record.end, 0, 0.0
        left, length = max(0.0, self.end - begin), found.period if found.found else period
        if length > 0:  # set points that do not repeat count from the start
            whole = int(np.floor(left / length + 1e-3))  # a thousandth of a period may be missing from a whole period
            held = max(whole - 1, 0)  # all whole periods but the first
            self.periods = held if found.found else 0
            self.start = max(0.0, self.end - held * length) if held else self.end - left + min(START, 0.2 * left)
        self.set(record, self.start)

    def set(self, record, start):
        """Sets the start of the window. Because the period is an estimate, a row within a thousandth of a period is at the start."""
        self.start = start
        near = max(1e-9, 1e-3 * self.cycle.period if self.periods else 0)
        self.first = max(0, int(np.searchsorted(record.t, start + near, "right")) - 1)
        self.length = record.t[-1] - record.t[self.first]
