"""Evidence, accuracy and predictability of a run (docs/reference/verdict.md)."""
import math
import re
from fractions import Fraction

import numpy as np

from told.bodies import borne, elements
from told.check import Told, graded, margin
from told.record import LIMITS
from told.window import set_point_cycle

SETTLED, PERIODS, LEAST_TIME, BORNE, RESIDUAL, COARSE = 0.01, 3, 2.0, 0.5, 0.05, 0.10
MOST_ERROR = 0.5  # largest error of torques with which a failure beyond its own error still decides
ESTIMATE = 1e-3  # share of a period that may be missing from three periods


def read_by_output(model):
    """Texts of the equations on which set points depend: the output, and all states that it uses directly or indirectly."""
    states, texts, seen = {name: str(text) for name, text in model.get("states", {}).items()}, [str(model["output"])], set()
    for text in texts:  # the list grows during the loop
        for name in states.keys() & set(re.findall(r"\w+", text)) - seen:
            seen.add(name)
            texts.append(states[name])
    return " ".join(texts)


def frequencies(record):
    """Frequencies of the driven joints, Hz, if they determine the period of the CPG's set points."""
    cpg = record.scenario.get("cpg") or {}
    if "frequency" not in cpg:
        return []
    if cpg["type"] == "equations" and "model" in cpg:
        if not re.search(r"\b(frequency|omega)\b", read_by_output(cpg["model"])):
            return []
    f = record.per_joint(cpg, "frequency")
    return [x for x in f[record.driven] if x > 0]


def common_period(frequencies_):
    """Common period of all frequencies, s."""
    f = [Fraction(one).limit_denominator(10000) for one in frequencies_]
    return float(Fraction(math.lcm(*(one.denominator for one in f)), math.gcd(*(
        one.numerator * (math.lcm(*(o.denominator for o in f)) // one.denominator) for one in f))))


def set_point_period(record):
    """Period of the set points, s, from the run, or from the settings if the run is too short; 0 if the set points do not repeat."""
    found, cpg = set_point_cycle(record), record.scenario.get("cpg") or {}
    if found.found:
        return found.period
    asked = record.pose("setpoint")[:, record.driven] if record.driven.any() else np.zeros((1, 0))
    if not np.ptp(asked, axis=0).max(initial=0) > 0:
        return 0.0
    model, f = cpg.get("model") or {}, frequencies(record)
    if cpg.get("type") == "keyframes" and model.get("repeat", True):
        return float(model["frames"][-1]["time"])
    return common_period(f) if f else 0.0


RAMPS = ("sine", "tripod", "keyframes", "table")


def full_size(record):
    """Time from which on the set points have their full size, s: the end of a ramp, or 98 % of the amplitude."""
    cpg = record.scenario.get("cpg") or {}
    model, kind = cpg.get("model") or {}, cpg.get("type")
    rate = model.get("amplitude_rate", 0)
    if kind in ("phase_oscillator", "hopf", "van_der_pol", "matsuoka") and rate > 0:
        return 3.912 / rate  # ln 50, to the digits of the program
    if kind == "kuramoto_amplitude" and rate > 0:
        return 11.6678 / rate  # (1 + z) exp(-z) = 0.02 at z = rate t / 2
    return model.get("ramp", 0.0) if kind in RAMPS else 0.0


def begin(record, period):
    """Start of the gait, s: full size of the set points, and the ground has carried half of the weight in the mean of each period since."""
    ramp = full_size(record) if (record.scenario.get("cpg") or {}).get("type") in RAMPS else 0.0
    full = ramp if ramp < record.end else 0.0
    if not period > 0 or not record.floating or not record.weight > 0 or not elements(record) or record.ground == "none":
        return full
    t, load = record.poses["t"], record.poses["load"]
    impulse = np.concatenate([[0.0], np.cumsum(load[1:] * np.diff(t))])
    last = np.searchsorted(t, t + period * (1 + 1e-9), "right") - 1
    rows = np.flatnonzero(t[-1] - t >= period)
    light = rows[impulse[last[rows]] - impulse[rows] < BORNE * record.weight * (t[last[rows]] - t[rows])]
    return max(full, t[light[-1] + 1]) if len(light) and light[-1] != rows[-1] else full  # never carried at the end: not at all


def drift(record, window, period, full):
    """Largest change of mean or RMS of a joint's set points between first and last period of the window, as a share of its range, and the
    numbers of the sentence on it."""
    if not period > 0 or not record.driven.any():
        return 0.0, {}
    t, x = record.poses["t"], record.pose("setpoint")[:, record.driven]
    unit = math.ceil(20 * (t[1] - t[0]) / period) * period
    begin_ = max(window.start, full)
    between = math.floor((window.end - begin_) / unit - 1 + 1e-3) * unit
    if not between > 0:
        return 0.0, {}
    def level(a, b):
        grid_ = np.linspace(a, b, 20001)
        y = np.stack([np.interp(grid_, t, one) for one in x.T])
        return y.mean(axis=1), np.sqrt((y ** 2).mean(axis=1))
    (m0, r0), (m1, r1) = level(window.end - unit - between, window.end - between), level(window.end - unit, window.end)
    inside = x[t >= begin_]
    jump = np.abs(np.diff(inside, axis=0)).max(axis=0) * (t[1] - t[0]) / unit
    mean, rms, width = m1 - m0, r1 - r0, np.ptp(inside, axis=0)
    share = (np.maximum(np.abs(mean), np.abs(rms)) - jump) / np.maximum(width, 2e-3)
    j = int(np.argmax(share))
    moves = abs(mean[j]) >= abs(rms[j])
    by = (mean if moves else rms)[j] * period / between
    return float(share[j]), {"way": "drift" if moves else "grow" if by > 0 else "shrink", "level": "mean" if moves else "RMS", "by": by,
                             "grower": [n for n, d in zip(record.names, record.driven) if d][j], "each": period, "width": width[j]}


class Evidence:
    def __init__(self, record, window, period, start):
        found = window.cycle
        self.period = period
        self.repeats, self.also = self.period > 0, {}
        self.kind, self.long_enough = "time", record.end >= LEAST_TIME * (1 - 1e-9)
        self.also = {"judged": window.end - window.start, "simulated": record.end, "least": LEAST_TIME}
        if found.found and found.error <= SETTLED and window.periods:
            self.kind, self.long_enough = "cycle", True
            self.also |= {"periods": window.periods, "period": found.period}
        elif self.period:
            self.kind, held = "set points", (record.end - start) / self.period
            self.long_enough = held >= PERIODS * (1 - ESTIMATE)
            self.also |= {"left": record.end - start, "held": held, "period": self.period, "take": start + PERIODS * self.period,
                          "inside": (window.end - window.start) / self.period, "start": start}
        self.also["start"] = start
        self.short = not self.long_enough
        share, drifts = drift(record, window, period, full_size(record))
        self.grows = full_size(record) > record.end or share > 0.01
        self.also |= drifts | {"full_at": full_size(record), "take_full": full_size(record) + PERIODS * period}
        self.also["full"] = max(start, full_size(record))
        self.still = not self.moves(record, self.also["full"])
        self.long_enough = self.long_enough and not self.grows and not self.still
        self.untrusted, self.unborne = self.distrust(record), self.support(record, window)
        self.inexact = self.untrusted == "torque error" and record.torque_errors().max() <= MOST_ERROR and (
            abs(record.residual()) / record.energy_scale() <= RESIDUAL) and not (
            record.adaptive and record.run["coarse_time"] / record.end > COARSE)
        self.borne = not self.unborne
        self.unknown = self.nobody_knows(record)

    def moves(self, record, start):
        """True if a set point changes after the start by more than a ramp leaves to do."""
        if not record.driven.any():
            return True
        x, later = record.pose("setpoint")[:, record.driven], record.poses["t"] >= start
        return not later.any() or bool((np.ptp(x[later], axis=0) > 0.025 * np.ptp(x, axis=0)).any())

    def support(self, record, window):
        """Reason for which no ground carries a robot with a floating base; empty if a ground does, or if this is unknown."""
        shares = borne(record, window)
        self.share = float(shares.mean()) if shares is not None and len(shares) else np.nan
        if not record.floating:
            return ""
        if not np.linalg.norm(record.gravity) > 0:
            return "no gravity"
        if record.ground == "none" or not record.solver and not elements(record):
            return "falls freely"
        return "not on it" if self.share < BORNE else ""

    def nobody_knows(self, record):
        """Reasons for which the run is no evidence for a verdict, in the order in which they are reported."""
        ground = record.floating and not self.unborne and np.isnan(self.share)
        off = record.scenario["physics"].get("estimate") == "off"
        torques = not off and record.driven.any() and not record.torque_errors().max(initial=0) > 0 and self.untrusted != "makes energy"
        return ["the ground's share of the weight"] * bool(ground) + ["the error of the torques"] * bool(torques)

    def distrust(self, record):
        """Name of the missing accuracy; empty if the run is accurate."""
        if record.driven.any() and record.makes_energy.any():
            return "makes energy"
        error = record.torque_errors()
        if record.chaotic():
            if record.spread is None:
                return "not predictable"
        elif len(error) and error.max() > record.most_error():
            return "torque error"
        if record.driven.any() and not abs(record.residual()) / record.energy_scale() <= RESIDUAL:
            return "energy"
        if record.adaptive and record.run["coarse_time"] / record.end > COARSE:
            return "coarse"
        if record.driven.any() and not record.torque_errors().max(initial=0) > 0 and record.scenario["physics"].get("estimate") == "off":
            return "no estimate"
        return ""


UNITS = {"tracking_error": " rad", "tilt": " rad", "beyond_range": " rad", "start_jump": " rad", "touch": " m", "collision": " m", "sink": " m"}


def changed_limits(record):
    """Limits that are not the defaults, in words."""
    def number(value):
        return repr(float(value)).removesuffix(".0") if abs(value) < 1e15 else repr(value)
    return "; ".join(f"{key} {number(record.limits[key])}{UNITS.get(key, '')} in the scenario, {'%.4g' % preset} by default"
                     for key, preset in LIMITS.items() if record.limits[key] != preset)


def periodic(record, window, evidence):
    found = window.cycle
    if not found.found and (not evidence.repeats or not evidence.long_enough):
        return Told()
    told = Told("pass" if found.found else "warn", found.error, 0.02, margin=margin(found.error, 0.02), also={"period": found.period})
    # The error depends on the period and changes by up to 2 pi times the relative error of the period. For a motion that does not
    # repeat, the period is not well defined.
    told.loose = 2 * np.pi * found.doubt() / found.error if found.found else 0.05
    return told


def torque_error(record):
    error = record.torque_errors()
    if not len(error) or not error.max() > 0:
        return Told()
    j = int(np.argmax(error))
    accuracy = record.scenario["physics"].get("accuracy", 0.01) if record.adaptive else 0.01
    limit = record.most_error()
    told = Told(graded(error[j], min(accuracy, limit), np.inf), error[j], limit, margin=margin(error[j], limit),
                worst=record.names[j], ties=[record.names[j]])
    if told.status == "warn" and record.run["parting.twin.time"] >= 0:
        told.first, told.first_part = record.run["parting.twin.time"], record.names[int(record.run["parting.twin.joint"])]
    return told


def predictable(record):
    """Change of the torques by a disturbed gravity: by 1e-9 if that change exceeds the limit, otherwise by 1e-6."""
    if not record.adaptive or not record.run["torque_error.estimated"] or not record.run["parting.chaotic.share"] > 0:
        return Told()
    limit = max(0.01, record.scenario["physics"].get("accuracy", 0))
    name = "chaotic" if record.chaotic() else "ill"
    share, joint = record.run[f"parting.{name}.share"], record.names[int(record.run[f"parting.{name}.joint"])]
    told = Told(graded(share, limit, np.inf), share, limit, margin=margin(share, limit),
                also={"times": "1 + 1e-9" if name == "chaotic" else "1 + 1e-6"} | record.spread_numbers())
    if told.status == "warn":
        told.worst, told.ties, told.first_part = joint, [joint], joint
        told.start = told.end = told.first = record.run[f"parting.{name}.time"]
    return told


def ledger(record):
    if not record.driven.any():
        return Told()
    missing, limit = abs(record.residual()), record.limits["energy_residual"]
    value = missing / record.energy_scale()
    return Told(graded(value, limit, np.inf), value, limit, margin=margin(value, limit),
                also={"missing": missing, "drawn": abs(record.run["energy.electrical"])})


def created(record):
    if not record.driven.any():
        return Told()
    value, limit = record.joints["created"].sum() / record.energy_scale(), record.limits["energy_created"]
    return Told(graded(value, limit, np.inf), value, limit, margin=margin(value, limit))


def supply(record):
    if not record.driven.any():
        return Told()
    value, drawn = record.run["energy.electrical"], record.joints["electrical"].sum()
    gave = value < -record.least_energy() or (record.weight > 0 and drawn < 0)
    return Told("warn" if gave else "pass", value, 0.0, least=True, margin=value, also={"gave": max(-value, -drawn)})


def step(record):
    ticks = record.run["control_ticks"]
    if not ticks:
        return Told()
    value = record.run["control_ticks_above_1"] / ticks
    told = Told(graded(value, 0.01, np.inf), value, 0.01, margin=margin(value, 0.01))
    if told.status == "warn":
        told.start = told.end = record.run["stability.time"]
    return told


def coarse(record):
    if not record.adaptive or not record.end > 0:
        return Told()
    value = record.run["coarse_time"] / record.end
    return Told(graded(value, 0.10, np.inf), value, 0.10, margin=margin(value, 0.10),
                also={"accuracy": record.scenario["physics"]["accuracy"]})


def law(record):
    if not record.driven.any():
        return Told()
    return Told(graded(record.run["off_law"], 0, np.inf), record.run["off_law"], 0.0, margin=-record.run["off_law"])
