"""Checks of motors, gears and motion: docs/reference/verdict.md. Every function takes the record and the judged window."""
import numpy as np

from told.check import SAME, Told, graded, margin, worst_of, widen


def grown(record, what, window):
    """Growth in the window of sums from t = 0, by joint."""
    sums = record.tick(what)
    return sums[-1] - sums[window.first]


def stretches(limited, t, first):
    """Longest intervals at a limit: whole rows, and the times at the limit in the rows before and after. All equally long intervals.

    A row contains the duration at the limit, but not when: it may contain the end of one interval and the start of the next."""
    part = np.diff(limited)[first:]
    left, right = t[first:-1], t[first + 1:]
    begun, seen = None, []
    for p, a, b in zip(part, left, right):
        whole = p > 0.999 * (b - a)
        begun = a if begun is None else begun
        stop = b if whole else a + p
        seen.append((stop - begun, begun, stop))
        if not whole:
            begun = b - p
            seen.append((p, begun, b))
    longest = max(one[0] for one in seen)
    equal = [one for one in seen if one[0] >= longest * (1 - SAME) - SAME]
    return longest, equal


def at_limit(record, window, kind):
    """Checks `voltage` and `current`; for other actuators, the check of their limit."""
    if not record.driven.any():
        return Told()
    column = f"{kind}_limited"
    share = np.where(record.driven, grown(record, column, window) / window.length, 0)
    if not record.voltages and not (share > 0).any() and (kind == "voltage" or not record.all_limited):
        return Told()
    limits, period = record.limits, record.scenario["controller"]["period"]
    most = limits["saturated_periods"] * period
    table = record.tick(column)
    longest = [stretches(table[:, j], record.t, window.first) if share[j] > 0 else (0.0, [])
               for j in range(record.count)]
    by_share = np.array([margin(s, limits["saturated_share"]) for s in share])
    # An interval is a sum of rows. The tolerance lets a whole number of control periods pass.
    by_time = np.array([margin(one[0], most * (1 + 1e-6)) for one in longest])
    both = np.where(record.driven, np.minimum(by_share, by_time), np.inf)
    least = both.min()
    ties = [j for j in range(record.count) if both[j] <= least + SAME]
    widest = max(share[k] for k in ties)
    ties = [k for k in ties if share[k] >= widest * (1 - SAME)]
    j, parts = ties[0], int((share > 0).sum())
    told = Told("fail" if least < 0 else "warn" if parts else "pass", margin=least, parts=parts)

    def numbers(k):
        by = share[k] > 0 and by_time[k] < by_share[k]
        out = {"value": longest[k][0] if by else share[k], "limit": most if by else limits["saturated_share"], "unit": "s" if by else "",
               "worst": record.names[k], "also": {"share": share[k], "stretch": longest[k][0]}}
        if longest[k][1]:
            out["rows"] = {one[1:] for one in longest[k][1]}
            out["start"], out["end"] = longest[k][1][0][1:]
        return out

    told.__dict__.update(numbers(j))
    told.others = {record.names[k]: numbers(k) for k in ties if share[k] > 0}
    told.also |= {"driven": int(record.driven.sum()), "most": limits["saturated_periods"]}
    if abs(by_share[j] - by_time[j]) < 1e-6:
        told.unit = None
    if abs(least) < 1e-5:
        told.undecided = ("fail", "warn")
    told.ties = [record.names[k] for k in ties] if parts else ()
    told.worst = told.worst if parts else None
    if parts:
        first_at_limit(told, record, window, np.diff(table, axis=0))
    # Rows that are not at a limit, but with a torque within the torque error of the limit, count with their whole time.
    errors = record.torque_errors()
    peak, amperes = record.tick("envelope_peak"), record.tick("current_peak")
    busy = (np.diff(record.tick("voltage_limited"), axis=0) > 0) | (np.diff(record.tick("current_limited"), axis=0) > 0)
    wide = []
    for k in np.flatnonzero(record.driven & (errors > 0) & (errors <= record.most_error())):
        rows = (peak[1:, k] >= 1 - errors[k]) & ~busy[:, k]
        by_current = np.full(len(rows), True) if not record.voltages else amperes[1:, k] >= (1 - errors[k]) * record.i_max[k]
        rows &= by_current == (kind == "current")
        sums = np.concatenate([[0], np.cumsum(np.where(rows, np.diff(record.t), np.diff(table[:, k])))])
        near = (sums[-1] - sums[window.first]) / window.length
        on_end = stretches(sums, record.t, window.first)[0] if near > 0 else 0.0
        room = min(margin(near, limits["saturated_share"]), margin(on_end, most * (1 + 1e-6)))
        if room < 0:
            wide.append((room, near, on_end, k))
    surely = [share[k] * (1 - errors[k]) > limits["saturated_share"] or longest[k][0] * (1 - errors[k]) > most * (1 + 1e-6)
              for k in np.flatnonzero(record.driven)]
    told.certain = any(surely)
    if wide and not any(surely):
        least = min(wide)[0]
        _, near, on_end, k = max((one for one in wide if one[0] <= least + SAME), key=lambda one: one[1])
        told.status, told.error = "too close", errors[k]
        told.also |= {"near": near, "near_on_end": on_end, "near_joint": record.names[k]}
    return told


def first_at_limit(told, record, window, spent):
    """Time and name of the joint that is first at a limit in the window. In a row, the time spent at the limit counts as its end."""
    row = window.first
    spent = np.where(record.driven[None, :], spent, 0)[row:]
    begins = {j: max(record.t[row + k + 1] - spent[k, j], window.start) for j in range(record.count) if (k := int(np.argmax(spent[:, j] > 0)), spent[k, j] > 0)[1]}
    told.first = min(begins.values())
    told.first_parts = [record.names[j] for j, begin in begins.items() if begin <= told.first + SAME]
    told.first_part = told.first_parts[0]


def first_in(told, record, row, beyond):
    """Time (end of the row) and name of the joint that was first beyond its limit after a row of ticks; -1 if `beyond` contains
    the row at the start, too."""
    beyond = beyond & record.driven[None, :]
    rows = np.flatnonzero(beyond[max(row, 0):].any(axis=1))
    if len(rows):
        told.first = record.t[row + rows[0] + 1]
        told.first_parts = [record.names[j] for j in np.flatnonzero(beyond[max(row, 0) + rows[0]])]
        told.first_part = told.first_parts[0]


def peaks(record, what, first):
    """Largest magnitude after a row, and the row of ticks that contains it."""
    table = record.tick(what)[first + 1:]
    at = np.argmax(table >= table.max(axis=0) * (1 - SAME), axis=0)  # first row that equals the largest up to rounding errors
    return table[at, np.arange(record.count)], first + 1 + at


def at_row(told, record, row):
    told.end, told.start = record.t[row], record.t[row - 1]


def alike(record, what, joint, most):
    """Starts and ends of the rows in which a peak is reached up to rounding errors."""
    rows = np.flatnonzero(record.tick(what)[1:, joint] >= most * (1 - 1e-7))
    return {(record.t[k], record.t[k + 1]) for k in rows}


def rated(record, values, limits, warns, fails, rows=None):
    """Result for the joint with the least margin."""
    limits = np.where(record.driven & (limits > 0), limits, np.nan)
    if not np.isfinite(limits).any():
        return Told(), None
    share = values / limits
    j, near = worst_of(share)
    status = graded(share[j], warns, fails)
    beyond = share > (fails if np.isfinite(fails) else warns)
    told = Told(status, values[j], limits[j], margin=margin(values[j], limits[j]), worst=record.names[j],
                ties=[record.names[k] for k in near], parts=int(np.nansum(beyond)), also={"share": share[j]})
    if rows is not None:
        at_row(told, record, rows[j])
    return told, j


def envelope(record, window):
    if not record.driven.any():
        return Told()
    values, rows = peaks(record, "envelope_peak", window.first)
    warn = record.limits["warn_share"]
    told, j = rated(record, values, np.where(record.limited, 1.0, np.nan), warn, np.inf, rows)
    if told.status != "not judged":
        told.rows = alike(record, "envelope_peak", j, values[j])
        told.limit, told.margin = warn, margin(told.value, warn)
    return told


def speed(record, window):
    if not record.driven.any():
        return Told()
    warn = record.limits["warn_share"]
    within, rows = peaks(record, "speed_peak", window.first)
    ever, all_rows = peaks(record, "speed_peak", 0)
    free, _ = rated(record, within, record.no_load, warn, 1, rows)
    broken, _ = rated(record, ever, record.ratings["speed_max"], warn, 1, all_rows)
    told, limits, row, span = free, record.no_load, window.first, "window"
    worse = broken.status == "fail" or free.status != "fail" and broken.value / broken.limit >= free.value / free.limit
    if broken.status != "not judged" and (free.status == "not judged" or worse):
        told, limits, row, span = broken, record.ratings["speed_max"], 0, "whole run"
    if told.status != "not judged":
        told.span = span
        first_in(told, record, row, record.tick("speed_peak")[1:] > limits)
    return told


def of_rating(record, values, key, rows=None, first=None):
    told, j = rated(record, values, record.ratings[key], record.limits["warn_share"], 1, rows)
    if told.status == "not judged":
        return told
    if first is not None:
        first_in(told, record, 0, record.tick(first)[1:] > record.ratings[key])
    errors, share = record.torque_errors(), np.where(record.driven & (record.ratings[key] > 0), values / record.ratings[key], 0)
    widen(told, errors[j])
    across = (errors > 0) & (share * (1 - errors) < 1) & (share * (1 + errors) > 1)
    beyond = (share > 1) & (share * (1 - errors) >= 1)
    told.certain = bool(beyond.any())
    if beyond.any():  # one joint suffices
        told.status = "fail"
    elif across.any() and not across[j]:
        k = int(np.argmax(np.where(across, share * (1 + errors), 0)))
        told.status = "too close"
        told.also |= {"other": record.names[k], "other_low": share[k] * (1 - errors[k]), "other_high": share[k] * (1 + errors[k])}
    return told


def rms(record, what, window):
    return np.sqrt(np.maximum(grown(record, what, window), 0) / window.length)


def stall(record, window):
    """Torque of joints at less than 5 % of their no-load speed: RMS of all rows, and of any 0.1 s on end, against the stall torque."""
    judged = record.driven & (record.stall > 0) & np.isfinite(record.no_load)
    if not judged.any():
        return Told()
    t, first, found = record.t, window.first, {}
    slow = record.tick("speed_peak") < 0.05 * record.no_load
    square = record.tick("torque_square")
    for j in np.flatnonzero(judged):
        rows = np.flatnonzero(slow[first + 1:, j]) + first + 1
        time = (t[rows] - t[rows - 1]).sum()
        whole = np.sqrt((square[rows, j] - square[rows - 1, j]).sum() / time) if time >= 0.1 * (1 - 1e-9) else 0.0
        most, span, begun = 0.0, (np.nan, np.nan), np.nan
        for k in rows:
            a = np.searchsorted(t, t[k] - 0.1 * (1 - 1e-9), "right") - 1  # the last row that is 0.1 s before
            if a < first or not slow[a + 1:k + 1, j].all():
                continue
            value = np.sqrt(max(square[k, j] - square[a, j], 0) / (t[k] - t[a]))
            begun = t[k] if np.isnan(begun) and value > record.stall[j] else begun
            if value > most:
                most, span = value, (t[a], t[k])
        found[j] = whole, most, span, begun
    errors, free = record.torque_errors(), record.holds_more  # the law of other motors holds no more than the stall torque
    for j, (whole, most, span, begun) in found.items():
        if not free[j]:
            found[j] = min(whole, record.stall[j]), min(most, record.stall[j]), span, np.nan
    shares = {j: max(one[0], one[1]) / record.stall[j] for j, one in found.items()}
    warm = {j: one[0] / record.stall[j] for j, one in found.items()}
    j, warmest = max(shares, key=shares.get), max(warm, key=warm.get)
    if shares[j] <= 1 and warm[warmest] > 0.5:
        j = warmest
    whole, most, span, _ = found[j]
    limit, share = record.stall[j], shares[j]
    status = "fail" if share > 1 else graded(warm[j], 0.5, 1)
    all_time = whole > limit or status == "warn" or whole >= most
    told = Told(status, (whole if all_time else most) if share > 0 else 0.0, limit, margin=1 - share, parts=sum(s > 1 for s in shares.values()))
    if not share > 0:
        return told
    compared = warm if status == "warn" else shares
    told.worst, told.ties = record.names[j], [record.names[k] for k, s in compared.items() if s > compared[j] * (1 - SAME)]
    if not all_time:
        told.start, told.end = span
        told.also |= {"from": span[0]}
    begun = {record.names[k]: one[3] for k, one in found.items() if not np.isnan(one[3])}
    if begun:
        told.first = min(begun.values())
        told.first_parts = [name for name, time in begun.items() if time == told.first]
        told.first_part = told.first_parts[0]
    bars = {k: (s * (1 - errors[k] * free[k]), s * (1 + errors[k] * free[k])) for k, s in shares.items()}
    told.error = errors[j] * free[j]
    told.also |= {"low": bars[j][0], "high": bars[j][1]}
    across = [k for k in bars if bars[k][0] <= 1 < bars[k][1]]
    if across and not any(low > 1 for low, _ in bars.values()):
        told.status = "too close"
        if j not in across:
            k = max(across, key=lambda one: bars[one][1])
            told.also |= {"other": record.names[k], "other_low": bars[k][0], "other_high": bars[k][1]}
    return told


def heat(record, window):
    return of_rating(record, rms(record, "current_square", window), "i_continuous") if record.driven.any() else Told()


def gear_peak(record, window):
    if not record.driven.any():
        return Told()
    names = [f"gear.{j}.torque" for j in range(record.count)]
    if record.loads is None or not any(name in record.loads for name in names):
        values, rows = peaks(record, "torque_peak", 0)
        return of_rating(record, values, "gear_torque_peak", rows, "torque_peak")
    table = np.stack([np.abs(record.loads[name]) if name in record.loads else np.zeros(len(record.loads)) for name in names], -1)
    told = of_rating(record, table.max(axis=0), "gear_torque_peak", np.maximum(table.argmax(axis=0), 1))
    if told.status != "not judged":
        first_in(told, record, -1, table > record.ratings["gear_torque_peak"])
    return told


def gear_continuous(record, window):
    return of_rating(record, rms(record, "torque_square", window), "gear_torque_continuous") if record.driven.any() else Told()


def tracking(record, window):
    if not record.driven.any():
        return Told()
    values, rows = peaks(record, "error_peak", window.first)
    j, near = worst_of(values)
    warns = record.limits["tracking_error"]
    return Told(graded(values[j], warns, 2 * warns), values[j], 2 * warns, margin=margin(values[j], 2 * warns),
                worst=record.names[j], ties=[record.names[k] for k in near], parts=int((values > warns).sum()),
                rows=alike(record, "error_peak", j, values[j]),
                start=record.t[rows[j] - 1], end=record.t[rows[j]])


RESTS_BEYOND, STOP = 0.05, 50  # rad: a hinge without a motor may touch its stop; N m/rad (docs/equations.md, 2)


def stops(record, window):
    if not record.count:
        return Told("pass", 0.0, record.limits["beyond_range"], margin=1.0)
    angle, share = record.joints["range_worst"].copy(), record.joints["range_share"].copy()
    rests, harmless = np.where(record.driven, 0, angle), max(RESTS_BEYOND, record.limits["beyond_range"])
    angle[~record.driven] = share[~record.driven] = 0
    told = stops_of_motors(record, angle, share)
    pressed = int((rests > harmless).sum())
    worst = margin(rests.max(), harmless)
    if not rests.max() > 0 or (not worst < told.margin if pressed else told.parts):
        return told
    j, near = worst_of(rests)
    return Told("fail" if pressed else "pass", rests[j], harmless, margin=worst, worst=record.names[j],
                ties=[record.names[k] for k in near], parts=pressed, unit="rad", also={"torque": STOP * rests[j]})


def stops_of_motors(record, angle, share):
    most, longest = record.limits["beyond_range"], record.limits["beyond_range_share"]
    by_angle, by_share = [margin(a, most) for a in angle], [margin(s, longest) for s in share]
    both = np.minimum(by_angle, by_share)
    least = both.min()
    parts = int((angle > 0).sum())
    if not parts:
        return Told("pass", 0.0, most, margin=least)
    ties = [j for j in range(record.count) if both[j] <= least + SAME * max(1, abs(least))]

    def numbers(j):
        angular = by_angle[j] <= by_share[j]
        return {"value": angle[j] if angular else share[j], "limit": most if angular else longest, "unit": "rad" if angular else "",
                "worst": record.names[j], "also": {"angle": angle[j], "share": share[j], "most": longest}}

    told = Told("fail" if least < 0 else "warn", margin=least, ties=[record.names[k] for k in ties], parts=parts,
                **numbers(max(ties, key=lambda k: angle[k])))
    told.others = {record.names[k]: numbers(k) for k in ties}
    return told


def setpoints(record, window):
    if not record.driven.any():
        return Told()
    share = record.joints["setpoint_outside"]
    j, near = worst_of(share)
    if not share[j] > 0:
        return Told("pass", share[j], 0.0, margin=0.0)
    return Told("warn", share[j], 0.0, margin=-share[j], worst=record.names[j], ties=[record.names[k] for k in near])


def start(record, window):
    if not record.driven.any():
        return Told()
    jump = record.joints["start_jump"]
    j, near = worst_of(jump)
    limit = record.limits["start_jump"]
    told = Told("warn" if jump[j] > limit else "pass", jump[j], limit, margin=margin(jump[j], limit),
                worst=record.names[j], ties=[record.names[k] for k in near])
    if told.status == "warn":
        told.start = told.end = told.first = 0.0
    return told
