"""All checks of a record, the verdict that follows from them, and differences of a verdict.json."""
import math

import numpy as np

from told import battery, bodies, docks, motors, trust
from told.check import Told, graded, margin
from told.sentences import LACKS, NO_MOTORS, RESTS_ON, TORN, read, same
from told.shapes import Collisions, depths
from told.window import Window, limit_cycle

GROUPS = {"motor": ("voltage", "current", "envelope", "speed", "stall", "heat", "gear_peak", "gear_continuous"),
          "trust": ("periodic", "evidence", "torque_error", "predictable", "ledger", "created", "supply", "step", "coarse", "law")}
WHOLE = {"outcome", "brownout", "fall", "upright", "gear_peak", "stops", "setpoints", "start", "collision", "dock_tension", "dock_shear",
         "dock_bending", "dock_torsion", "in_ground", "field", "torque_error", "predictable", "ledger", "created", "supply", "step", "coarse", "law"}
CAN_FAIL = {"outcome", "fall", "progress", "upright", "voltage", "current", "speed", "stall", "heat", "gear_peak", "gear_continuous", "brownout", "battery",
            "tracking", "stops", "collision", "dock_tension", "dock_shear", "dock_bending", "dock_torsion", "in_ground"}

# Kinds of missing evidence, and words of their sentences.
LACK = {"makes energy": ["makes energy"], "moves nothing": ["moves no joint", "there is no cpg"], "grows": ["the set points "], "torque error": ["the torque of joint"],
        "energy": ["the energy is unaccounted"], "coarse": ["the shortest steps"], "short": ["that a gait needs", "shorter than the required"],
        "not on it": ["the robot is not on it"], "no gravity": ["there is no gravity"], "falls freely": ["falls freely"]}
INSTANT = 0.1  # an interval shorter than this is reported by its start, s


def outcome(record):
    done = record.run["ended"] == 0
    duration = record.scenario["duration"]
    return Told("pass" if done else "fail", record.end, duration, least=True, outcome=record.outcome)


def in_ground(record):
    """Check `in_ground` on a plane. For other grounds the result is None, because they are not recomputed."""
    if record.solver or record.ground == "none":
        return Told()
    found = depths(record)
    if not found:
        return Told()
    if record.ground != "plane":
        return None
    limit, t, some = record.limits["sink"], record.poses["t"], some_shaped(record, len(found))
    body = max(found, key=lambda b: found[b].max())
    depth = found[body]
    deepest, k = depth.max(), int(np.argmax(depth))
    if deepest <= limit:
        return some or Told("pass", 0.0, limit, margin=1.0)
    told = Told("fail", deepest, limit, margin=margin(deepest, limit), worst=body, start=t[k], end=t[k])
    told.ties = [b for b in found if found[b].max() >= deepest * (1 - 1e-9)]
    firsts = {b: t[np.argmax(found[b] > limit)] for b in found if found[b].max() > limit}
    told.first, told.parts = min(firsts.values()), len(firsts)
    then = {b: found[b][np.searchsorted(t, told.first)] for b in firsts if firsts[b] == told.first}
    told.first_parts = [b for b in then if then[b] >= max(then.values()) - 1e-9]
    return told


def some_shaped(record, shaped):
    """Result `not judged` if nothing was found, but bodies without shapes might collide; None if all bodies have shapes."""
    bodies_ = len(record.robot.bodies)
    return Told(also={"shaped": shaped, "bodies": bodies_}) if shaped < bodies_ else None


def collision(record):
    if record.solver:
        return Told()
    found = Collisions(record)
    if not found.shaped:
        return Told()
    limits = record.limits
    told = Told("pass", 0.0, limits["collision"], margin=margin(0.0, limits["collision"]))
    if not found.pairs:
        return some_shaped(record, found.shaped) or told
    depth, when = max(found.pairs.values())
    told = Told(graded(depth, limits["touch"], limits["collision"]), depth, limits["collision"], start=when, end=when)
    told.margin, told.loose = margin(depth, limits["collision"]), 3e-6 / depth  # 3e-6 m is the tolerance of the search
    told.undecided = tuple({graded(depth - 3e-6, limits["touch"], limits["collision"])} - {told.status})
    told.ties = tuple({name for pair, (d, _) in found.pairs.items() if d >= depth - 3e-6 for name in pair})
    told.worst, told.parts, told.first = told.ties[0], len(found.pairs), found.first
    told.first_parts = tuple(found.first_bodies)
    told.rows = {(when, when)}
    told.also = {"other": told.ties}
    return told


class Judged:
    """Recomputed verdict. `checks` is {id: Told, or None if the check is not recomputed}; `lacks` is the missing evidence."""

    def __init__(self, record, start=None, whole=True):
        self.record = r = record
        period = trust.set_point_period(r)
        begin = trust.begin(r, period)
        self.window = w = Window(record, limit_cycle(record), period, begin)
        self.own_start = w.start
        if start is not None:
            w.set(record, start)
        self.evidence = e = trust.Evidence(record, w, period, begin)
        self.checks = {
            "outcome": outcome(r), "fall": bodies.fall(r, w), "progress": bodies.progress(r, w, e.borne, e.long_enough, period),
            "upright": bodies.upright(r, w, e.period), "voltage": motors.at_limit(r, w, "voltage"),
            "current": motors.at_limit(r, w, "current"), "envelope": motors.envelope(r, w), "speed": motors.speed(r, w),
            "stall": motors.stall(r, w), "heat": motors.heat(r, w), "gear_peak": motors.gear_peak(r, w), "gear_continuous": motors.gear_continuous(r, w),
            "brownout": battery.brownout(r), "battery": battery.battery(r, w),
            "tracking": motors.tracking(r, w), "stops": motors.stops(r, w), "setpoints": motors.setpoints(r, w),
            "start": motors.start(r, w), "collision": collision(r) if whole else None,
            "dock_tension": docks.dock(r, "tension"), "dock_shear": docks.dock(r, "shear"),
            "dock_bending": docks.dock(r, "bending"), "dock_torsion": docks.dock(r, "torsion"),
            "in_ground": in_ground(r), "slip": bodies.slip(r, w), "airborne": bodies.airborne(r, w),
            "stability": bodies.stability(r, w), "field": bodies.field(r, w), "periodic": trust.periodic(r, w, e),
            "evidence": Told(), "torque_error": trust.torque_error(r),
            "predictable": trust.predictable(r), "creep": bodies.creep(r, w), "ledger": trust.ledger(r), "created": trust.created(r),
            "supply": trust.supply(r), "step": trust.step(r), "coarse": trust.coarse(r), "law": trust.law(r)}
        complete = e.long_enough and e.borne and not e.untrusted and not self.impossible()
        self.checks["evidence"] = Told("pass" if complete else "not judged", w.end - w.start, also=self.missing())
        for check, told in self.checks.items():
            if told is None:
                continue
            told.span = told.span or ("whole run" if check in WHOLE else "window")
            told.can_fail = check in CAN_FAIL if told.can_fail is None else told.can_fail
            told.doubt = w.cycle.doubt()
            told.also = {"off_by": r.torque_errors().max(initial=0)} | told.also
            if told.status == "not judged" or check == "outcome":
                told.margin = np.nan
            self.spread(check, told)

    def spread(self, check, told):
        """Sets `too close` for a motion that is not predictable, if disturbed rollouts are on both sides of the limit or are not
        judged."""
        margins = None if self.record.spread is None else self.record.spread[f"margin.{check}"]
        if margins is None or told.status == "not judged" or not told.can_fail or np.isnan(margins[0]):
            return
        without = int(np.isnan(margins).sum())
        if without > 0 or margins.min() < 0 <= margins.max():
            told.status = "too close"
            told.also = told.also | {"rollouts": len(margins), "without": without, "margin_low": margins.min(), "margin_high": margins.max()}

    def missing(self):
        """Numbers of the sentence on missing evidence."""
        r, e = self.record, self.evidence
        errors = r.torque_errors()
        j = int(np.argmax(errors)) if len(errors) else 0
        creators = np.flatnonzero(r.makes_energy) if r.count else []
        return e.also | self.impossible() | {
            "borne": e.share, "unknown": " and ".join(e.unknown), "half": 0.5, "off": errors[j] if len(errors) else np.nan,
            "inaccurate": r.names[j] if r.count else None,
            "most": r.most_error(), "limits": trust.changed_limits(r), "residual": abs(r.residual()) / r.energy_scale(), "kept": 0.05,
            "coarse": r.run["coarse_time"] / r.end if r.end else np.nan, "accuracy": r.scenario["physics"].get("accuracy", np.nan),
            "parted": r.run.get("parting.chaotic.time", np.nan), "times": "1 + 1e-9",
            "change": r.run.get("parting.chaotic.share", np.nan),
            "unpredictable": r.names[int(r.run.get("parting.chaotic.joint", 0))] if r.count else None,
            "creator": r.names[creators[0]] if len(creators) else None, "cpg": (r.scenario.get("cpg") or {}).get("type"),
            "x": r.torque_constant[creators[0]] if len(creators) else np.nan,
            "y": r.speed_constant[creators[0]] if len(creators) else np.nan}

    def unstable(self):
        """Numbers of the sentence on an unstable controller; empty if it is stable."""
        r, found = self.record, []
        t, z = r.poses["t"], r.poses["base.z"]
        def first(rows):
            return t[np.argmax(rows)] if rows.any() else np.inf
        speed = np.linalg.norm(np.diff(r.poses.vector("base.", "xyz"), axis=0), axis=1) / np.diff(t)
        fall = np.sqrt(2 * np.linalg.norm(r.gravity) * (np.maximum.accumulate(z) - z))[1:]
        thrown = np.concatenate([[False], (speed > 10) & (speed > 2 * fall)])
        for j in np.flatnonzero(r.joints["reversals"] > 0):
            since = r.joints["reversing_from"][j]
            q, (low, high) = r.pose("angle")[:, j], r.robot.ranges[j]
            beyond = np.maximum(0, np.maximum(q - high, low - q))
            if np.isfinite(begin := min(first(beyond > 1), first(thrown))) and begin >= since:
                found.append((beyond.max(), -j, since))
        if not found:
            return {}
        worst = r.names[-max(found)[1]]
        return {"since": min(f[2] for f in found), "control": r.scenario["controller"]["period"], "torn": len(found), "only": worst,
                "thrower": worst, "beyond": max(found)[0], "thrown": speed[thrown[1:]].max(initial=0)}

    def impossible(self):
        """Numbers of the sentence on motors with more than 1500 W per kg of their module; empty if there are none."""
        r, found = self.record, []
        for m in range(r.robot.count if "power" not in r.scenario.get("accept", []) else 0):
            own = [j for j, name in enumerate(r.names) if name.startswith(f"m{m}/") and r.driven[j]]
            mass = sum(body.mass for body in r.robot.bodies if body.name.startswith(f"m{m}/"))
            power = sum(r.power[j] for j in own)
            if power > 1500 * mass:
                found.append((power / mass, -m, power, mass))
        density, m, power, mass = max(found, default=(0, 0, 0, 0))
        return {"power": power, "powerful": f"m{-m}", "heavy": mass, "density": density, "weaker": len(found) - 1} if found else {}

    def word(self, checks):
        """Verdict that follows from these checks. They are those of the program, so that one difference is reported only once."""
        e, record = self.evidence, self.record
        of = {c["id"]: c for c in checks}
        status = {name: c["status"] for name, c in of.items()}
        failing = [c for c in checks if c["status"] == "fail"]
        if status["outcome"] == "fail":
            return "failed"
        if self.impossible():
            return "not judged"
        if any(map(self.decides, failing)):
            return "infeasible"
        if failing or not (e.long_enough and e.borne and not e.untrusted) or "too close" in status.values():
            return "not judged"
        if all(status[name] == "not judged" for name in GROUPS["motor"]):
            return "not judged"
        if record.floating and record.ground != "none" and not record.solver and "not judged" in (status["fall"], status["in_ground"]):
            return "not judged"
        return "feasible"

    def decides(self, check):
        """True if a failure makes the gait infeasible. In a run that is too short, only checks of the whole run count; with inaccurate
        torques, only failures beyond their errors."""
        e, told = self.evidence, self.checks[check["id"]]  # no check with an error is None
        return check["status"] == "fail" and (e.long_enough or check["span"] == "whole run") and (
            not e.untrusted or e.inexact and told is not None and told.certain)

    def decided_by(self, checks, word):
        """Ids of the checks that may decide `infeasible` or `failed`: failed checks of the robot as a whole, or those with the least
        margin."""
        if word not in ("infeasible", "failed"):
            return [None]
        return [by_urgency([c for c in checks if c["status"] == "fail" and (word == "failed" or self.decides(c))])[0]["id"]]


def sentence(check):
    """Text of a check with the missing amount, and with the time if a part was worst at an instant."""
    times = check["from"], check["to"]
    instant = check["part"] != "none" and check["status"] != "pass" and None not in times and times[1] - times[0] < INSTANT
    return check["text"] + (f", at {times[0]:.2f} s" if instant else "") + ("; missing: " + check["missing"] if check["missing"] else "")


def by_urgency(checks):
    """Checks in order of urgency: checks of the robot as a whole, then checks without a margin, then checks by margin."""
    return sorted(checks, key=lambda c: (c["group"] != "run", -math.inf if c["margin"] is None else c["margin"]))


def tightest(checks):
    """Ids of the checks with the least margin, among the checks that can fail."""
    may = [c for c in checks if c["can_fail"] and c["margin"] is not None and (c["limit"] != 0 or c["status"] == "fail")]
    least = min((c["margin"] for c in may), default=None)
    return [c["id"] for c in may if c["margin"] <= least + 1e-12 * max(1, abs(least))] if may else [None]


def close(a, b, loose=1e-9):
    """True if two numbers agree to 1e-9, the tolerance for sums in a different order. A null in the file is NaN here."""
    a, b = (math.nan if x is None else float(x) for x in (a, b))
    return (math.isnan(a) and math.isnan(b)) or abs(a - b) <= loose * max(abs(a), abs(b)) + 1e-12


def compare(told, check):
    """Texts of the differences between verdict.json and the recomputed check."""
    told, wrong = told.of(check["worst"]), []

    def must(ok, what, expected, found):
        if not ok:
            wrong.append(f"{check['id']}: {what} {found}, recomputed {expected}")

    status = check["status"]
    must(status == told.status or status in told.undecided, "status", told.status, status)
    if check["span"] != told.span:
        must(False, "span", told.span, check["span"])
    must(check["can_fail"] == told.can_fail, "can_fail", told.can_fail, check["can_fail"])
    if status != told.status or status == "not judged" and check["id"] not in ("evidence",):
        return wrong
    loose = getattr(told, "loose", 1e-9)
    for name, expected in (("value", told.value), ("limit", told.limit), ("margin", told.margin), ("error", told.error)):
        allowed = loose * abs(told.value)
        if name == "margin":  # follows from the value; the margin of an interval has a tolerance of 1e-6
            allowed = allowed / abs(told.limit or 1) + (2e-6 if check["id"] in GROUPS["motor"][:2] else 0) * (1 + abs(expected))
        must(close(check[name], expected) or check[name] is not None and abs(check[name] - expected) <= allowed + 2e-6 * abs(
            expected) * (told.unit == "s"), name, expected, check[name])
    must(check["worst"] in (told.ties or (told.worst,)) or check["worst"] == told.worst, "worst", told.ties or told.worst, check["worst"])
    must(told.unit in (None, check["unit"]), "unit", told.unit, check["unit"])
    must(check["parts"] == told.parts, "parts", told.parts, check["parts"])
    timed = told.worst is None or check["worst"] == told.worst or check["id"] in ("collision", "in_ground")
    if timed and not told.plateau(check["from"], check["to"]):
        must(close(check["from"], told.start), "from", told.start, check["from"])
        must(close(check["to"], told.end), "to", told.end, check["to"])
    must(close(check["first"], told.first), "first", told.first, check["first"])
    parts = getattr(told, "first_parts", [told.first_part])
    must(check["first_part"] in parts, "first_part", parts, check["first_part"])
    return wrong


def hear(told, check, text, who):
    """Texts of the differences between a sentence and the recomputed check."""
    found = read(check["id"], check["status"], text)
    if found is None:
        return [f"{who}: no expression reads this sentence of {check['id']}: {text!r}"]
    if told is None:
        return []
    if check["id"] == "outcome" and check["status"] == "fail" and text != told.outcome:
        return [f"{who}: outcome: {text!r}, recorded {told.outcome!r}"]
    told = told.of(check["worst"])
    numbers, wrong = told.numbers(), []
    for name, kind, said in found:
        expected = numbers.get(name)
        if not kind:
            ok = said == expected or name == "worst" and said in told.ties or isinstance(expected, tuple) and said in expected
        else:
            ok = expected is not None and same(kind, said, expected)
            if not ok and name == "from":
                ok = any(same(kind, said, row[0]) for row in getattr(told, "rows", ()))
            if not ok and name == "value" and hasattr(told, "loose"):
                ok = same(kind, said, expected, told.loose * abs(expected))
            if not ok and name == "period" and expected:
                ok = same(kind, said, expected, told.doubt * expected)
        if not ok:
            wrong.append(f"{who}: {check['id']}: {name} is {said} in {text!r}, recomputed {expected}")
    return wrong


def hear_unstable(told, verdict):
    """Differences of a verdict whose only sentence is that on its controller."""
    found = TORN.read(verdict.get("unstable", ""))
    if found is None:
        return [f"no expression reads {verdict.get('unstable')!r}, recomputed {told}"]
    wrong = [f"{name} is {said} in {verdict['unstable']!r}, recomputed {told[name]}" for name, kind, said in found
             if not (same(kind, said, told[name]) if kind else said == told[name])]
    passed = [c["id"] for c in verdict["checks"] if c["status"] == "pass"]
    return wrong + [f"unstable, and {passed} pass"] * bool(passed) + ["unstable, and feasible"] * (verdict["verdict"] == "feasible")


def hear_evidence(judged, verdict):
    """Differences of `rests_on`, and of the reason of a verdict `not judged`: missing evidence, present failures, or checks that are too
    close."""
    lacks, wrong = judged.missing(), []

    def numbers(found, text):
        for name, kind, said in found:
            loose = judged.window.cycle.doubt() * lacks[name] if name in ("period", "held", "take", "inside", "left", "start", "each") and name in lacks else 0
            loose = 0.01 * abs(lacks["by"]) if name == "by" and name in lacks else loose  # 20 001 samples of a period for an integral
            if name not in lacks or not (same(kind, said, lacks[name], loose) if kind else said == lacks[name]):
                wrong.append(f"evidence: {name} is {said} in {text!r}, recomputed {lacks.get(name)}")

    found = RESTS_ON.read(verdict["rests_on"])
    if found is None:
        return [f"evidence: no expression reads {verdict['rests_on']!r}"]
    numbers(found, verdict["rests_on"])
    says = "time" if "do not repeat" in verdict["rests_on"] else "set points" if "does not settle" in verdict["rests_on"] else "cycle"
    if ("; not known: " in verdict["rests_on"]) != bool(judged.evidence.unknown):
        wrong.append(f"rests_on is {verdict['rests_on']!r}, recomputed that nobody knows {judged.evidence.unknown}")
    if ("; limits: " in verdict["rests_on"]) != bool(lacks["limits"]):
        wrong.append(f"rests_on is {verdict['rests_on']!r}, recomputed limits {lacks['limits']!r}")
    if says != judged.evidence.kind:
        wrong.append(f"rests_on is of the {says}, {verdict['rests_on']!r}, recomputed the {judged.evidence.kind}")
    if verdict["verdict"] != "not judged":
        return wrong + ([f"reason is {verdict['reason']!r}"] if verdict["reason"] else [])
    if judged.impossible():
        if (found := LACKS.read(verdict["reason"])) is None:
            return wrong + [f"reason: no expression reads {verdict['reason']!r}"]
        return numbers(found, verdict["reason"]) or wrong
    reason, _, so_far = verdict["reason"].partition("; so far: ")
    fails = by_urgency([c for c in verdict["checks"] if c["status"] == "fail"])
    close_ = by_urgency([c for c in verdict["checks"] if c["status"] == "too close"])
    first = sentence(fails[0]) if fails else ""
    if so_far != first:
        wrong.append(f"reason: so far {so_far!r}, recomputed {first!r}")
    e = judged.evidence
    lacks_ = [e.untrusted, "short" if e.short else "grows" if e.grows else "moves nothing" if e.still else "", e.unborne]
    lacks_ = [e.unborne] if e.unborne in ("no gravity", "falls freely") else [one for one in lacks_ if one]
    said = reason.split("; and ") if lacks_ else [reason]
    if len(said) != max(1, len(lacks_)):
        wrong.append(f"reason: {reason!r}, recomputed {lacks_}")
    for lack, text in zip(lacks_, said):
        if not any(words in text for words in LACK[lack]):
            wrong.append(f"reason: {text!r}, recomputed {lack}")
    if reason in [c["text"] for c in close_[:1]] and not fails:
        return wrong
    for text in said:
        if (found := LACKS.read(text)) is not None:
            numbers(found, text)
        elif NO_MOTORS.read(text) is None:
            wrong.append(f"reason: no expression reads {text!r}")
    return wrong
