"""Output on the terminal: the first screen, and the numbers with --verbose. Definitions: docs/numbers.md (the summary)."""
import re

import numpy as np

from told.bodies import heading
from told.check import SAME, worst_of
from told.motors import grown, peaks, rms
from told.sentences import Expression, printed, same
from told.verdict import by_urgency, sentence

LIMIT = ["none", "voltage", "current"]
AT = r"{%speak:.3f} N m at t = {%stime:.2f} s(?: \((?:voltage|current) limit\))?"
LINES = {
    "robot": r"{modules:d} modules?, {bodies:d} bod(?:y|ies), {joints:d} joints?, {dof:d} degrees? of freedom, {mass:.3f} kg",
    "judged": r"t = {from:.4g} to {to:.4g} s, (?:not a whole period of a limit cycle|the last {periods:d} periods? of {period:.4g} s)",
    "motors": r"(?:no joint at a limit of its motor|{some:d} of {driven:d} joints? reach(?:es)? a limit(?:, for an instant|, {longest} "
              r"longest: at its limit {limited:pct} of the time \((?:voltage|current|{voltage:pct} voltage, {current:pct} current)\))"
              r"(?: voltage limit: {v_some:d} joints?, {v_joint} longest, {v_share:pct})?"
              r"(?: current limit: {c_some:d} joints?, {c_joint} longest, {c_share:pct})?)"
              r"(?: before: {ever:d} of {driven:d} joints?, {ever_joint} longest: {ever_share:pct} of the run)?"
              r"(?: first of the run: {first} at t = {first_time:.2f} s \((?:voltage|current)\))?",
    "torque": r"{longest}: peak " + AT.replace("%s", "") + r" RMS {rms:.3f} N m(?: largest: {strongest}: " +
              AT.replace("%s", "strongest_") + r")?(?: before: {ever_strongest}: " + AT.replace("%s", "ever_") + r")?"
              r"(?: at most {of_rest:.0f} % of what a motor holds at rest, apart from gear losses \({rest_joint}, {rest:.3f} N m\))?",
    "tracking": r"{far}: {error:th} rad at t = {error_time:.2f} s(?: before: {ever_far}: {ever_error:th} rad at t = "
                r"{ever_error_time:.2f} s)?",
    "range": r"{beyond:d} of {joints:d} joints beyond their range, {farthest} farthest: {excess:.3g} rad, {excess_share:pct} of the time; "
             r"set point {setpoint_share:pct}",
    "distance": r"{distance:.4f} m \(x {x:+.4f}, y {y:+.4f}\), heading change {heading:+.3f} rad",
    "speed": r"{speed:.4f} m/s over a path of {path:.4f} m",
    "limit cycle": r"none found|from t = {cycle_from:.2f} s, period {period:.4f} s, repeats to {repeats:pct}",
    "transport": r"cost of transport undefined: (?:no weight|travelled less than 1 mm)|cost of transport {lossless:words}: these motors "
                 r"lose next to nothing|cost {electrical_cost:.3g} electrical, "
                 r"{mechanical_cost:.3g} mechanical \(J per N of weight and m\)(?: the gears create {created_share:pct} of the energy "
                 r"drawn \(eq\. 2\))?",
    "engine": r"\w+ \(\w+\)",
    "steps": r"step (?:auto \(at most \S+ s\)|\S+ s)(?:, accuracy {accuracy:rough})?(?:, {solves:.0f} solves)? ?(?:;? ?torque error about "
             r"{torque_error:rough} \(joint {inaccurate}\)(?:, beyond the accuracy first at {event:.4g} s \(joint {event_joint}\))?"
             r"|;? ?torque error not estimated)?",
    "energy": r"{drawn:.4g} J drawn; {missing:.2g} J unaccounted for(?: \({missing_share:.2g} %\))? = {copper:.4g} copper"
              r"(?: [+-] {gear:.3g} gear)?(?: [+-] {stored:.3g} stored)?(?: [+-] {contact:.3g} contact)?"
              r"(?: [+-] {friction:.3g} friction)?(?: [+-] {stops:.3g} stops)?(?: [+-] {hinges:.3g} hinges)?(?: [+-] {dry:.3g} joint friction)?"
              r"(?: [+-] {missing:.3g} residual)?(?: the gears created {created:.3g} J: eq\. 2 on back-driven joints"
              r"(?:; take actuator\.efficiency_model: directional)?)?",
    "stability": r"h lambda at most {stability:.2f} at t = {stability_time:.2f} s: .*; above 1 in {above:pct} of the ticks",
}
READ = {title: Expression(text) for title, text in LINES.items()}
GAIT = Expression(r"{speed:.4f} m/s over the run(?:, {per_period:.4f} m per period of {period:.4g} s \({cycle_speed:.4f} m/s\))?"
                  r"(?:, turns by {heading:+.2f} rad)?(?:, cost of transport {lossless:words}: these motors lose next to nothing"
                  r"|, cost of transport {electrical_cost:.3g}"
                  r"(?:: the gears create {created_share:pct} of the energy drawn \(eq\. 2\))?)?")
HEAD = Expression(r".*: {simulated:.6g} s simulated in \S+ s")


def sections(text):
    """List of the sections of an output as (title, lines joined to one)."""
    out = []
    for line in text.splitlines():
        match = re.match(r"  (too close(?= )|\S(?:.*?\S)??(?=  )) +(\S.*)$", line)
        if match:
            out.append([match[1], match[2]])
        elif line[:4] == "    " and out:
            out[-1][1] += " " + line.strip()
    return out


def numbers(judged):
    """All values that --verbose prints, by the names in LINES. A set of names contains parts with equal values."""
    r, w = judged.record, judged.window
    n, run = {}, r.run
    n |= {"modules": r.robot.count, "bodies": len(r.robot.bodies), "joints": r.count, "mass": r.mass, "simulated": r.end,
          "dof": r.count + {"floating": 6, "planar": 3}.get(r.scenario["robot"]["base"], 0), "from": w.start, "to": w.end,
          "periods": w.periods, "period": w.cycle.period, "cycle_from": w.cycle.start, "repeats": w.cycle.error,
          "doubt": w.cycle.doubt()}
    if r.driven.any():
        motor_numbers(r, w, n)
    if r.count:
        angle, share, outside = (r.joints[c] for c in ("range_worst", "range_share", "setpoint_outside"))
        j, near = worst_of(angle)
        n |= {"beyond": int(((share > 0) | (outside > 0)).sum()), "farthest": {r.names[k] for k in near}, "excess": angle[j],
              "excess_share": share[j], "setpoint_share": outside[j]}
    com = r.com()
    travel, steps = (com[-1] - com[0])[:2], np.diff(com[:, :2], axis=0)
    n |= {"x": travel[0], "y": travel[1], "distance": np.linalg.norm(travel), "path": np.linalg.norm(steps, axis=1).sum(),
          "heading": heading(r).sum()}
    n["speed"] = n["distance"] / r.end
    if w.periods:
        t = r.poses["t"]
        at = lambda time: np.array([np.interp(time, t, com[:, k]) for k in (0, 1)])
        n["cycle_speed"] = np.linalg.norm(at(w.end) - at(w.start)) / (w.end - w.start)
        n["per_period"] = n["cycle_speed"] * w.cycle.period
    if r.count:
        whole = r.weight * n["distance"]
        n["electrical_cost"] = r.joints["electrical"].sum() / whole if whole else 0.0
        n["mechanical_cost"] = r.joints["shaft_positive"].sum() / whole if whole else 0.0
        n["created"] = r.joints["created"].sum()
        n["created_share"] = n["created"] / run["energy.electrical"] if run["energy.electrical"] else np.nan
    errors = r.torque_errors()
    if len(errors):
        n |= {"torque_error": errors.max(), "inaccurate": {r.names[int(np.argmax(errors))]}, "event": run["parting.twin.time"],
              "event_joint": r.names[int(run["parting.twin.joint"])]}
    n |= {"accuracy": r.scenario["physics"].get("accuracy", np.nan), "solves": run["solves"], "drawn": run["energy.electrical"],
          "lossless": "not meaningful" if (run["energy.copper"] + run["energy.gear"] + run["energy.hinges"] + run["energy.dry"]) < 0.01 * run["energy.electrical"]
          or abs(n.get("electrical_cost", 1)) < 0.001 else None, "missing": abs(r.residual()), "missing_share": 100 * abs(r.residual()) / r.energy_scale(), "copper": run["energy.copper"]}
    n |= {name: abs(run["energy." + name]) for name in ("gear", "stored", "contact", "friction", "stops", "hinges", "dry")}
    ticks = run["control_ticks"]
    n |= {"stability_time": run["stability.time"], "above": run["control_ticks_above_1"] / ticks if ticks else 0.0}
    step = r.scenario["physics"]["step"]
    n["stability"] = run["stability.rate"] * float(step) if step != "auto" else np.nan
    return n


def reached(r, first):
    """Arrays (rows, joints) after a row: True if a joint is at a limit for some time or at the tick's largest torque, and the limit."""
    v, c = np.diff(r.tick("voltage_limited"), axis=0) > 0, np.diff(r.tick("current_limited"), axis=0) > 0
    instant = r.tick("peak_limit")[1:]
    return (v | c | (instant > 0))[first:]


def times(r, what, joint, most):
    """Ends of the rows in which a peak is reached up to rounding errors. In a steady state of the motors these are many."""
    return tuple(r.t[r.tick(what)[:, joint] >= most * (1 - 1e-7)])


def motor_numbers(r, w, n):
    share_v, share_c = (grown(r, f"{kind}_limited", w) / w.length for kind in ("voltage", "current"))
    share, effective = share_v + share_c, rms(r, "torque_square", w)
    peak, rows = peaks(r, "torque_peak", w.first)
    ever_peak, ever_rows = peaks(r, "torque_peak", 0)
    # Order of joints: longest time at a limit, then largest RMS, then largest peak.
    order = max(range(r.count), key=lambda j: (share[j], effective[j], peak[j]))
    near = {j for j in range(r.count) if share[j] >= share[order] * (1 - SAME) and effective[j] >= effective[order] * (1 - SAME)
            and peak[j] >= peak[order] * (1 - SAME)}
    within, ever = reached(r, w.first), reached(r, 0)
    n |= {"driven": int(r.driven.sum()), "some": int(within.any(0).sum()), "ever": int(ever.any(0).sum()),
          "longest": {r.names[j] for j in near}, "limited": share[order], "voltage": share_v[order], "current": share_c[order]}
    for letter, values in (("v", share_v), ("c", share_c)):
        j, near = worst_of(values)
        n |= {f"{letter}_some": int((values > 0).sum()), f"{letter}_joint": {r.names[k] for k in near}, f"{letter}_share": values[j]}
    whole = (r.tick("voltage_limited") + r.tick("current_limited"))[-1] / (r.t[-1] - r.t[0])
    j, near = worst_of(whole)
    n |= {"ever_joint": {r.names[k] for k in near}, "ever_share": whole[j]}
    if ever.any():
        spent = np.maximum(*(np.diff(r.tick(f"{kind}_limited"), axis=0) for kind in ("voltage", "current")))
        begins = {j: r.t[k + 1] - spent[k, j] for j in np.flatnonzero(ever.any(0)) if (k := int(np.argmax(ever[:, j]))) >= 0}
        first_time = min(begins.values())
        n |= {"first": {r.names[j] for j, one in begins.items() if one <= first_time + SAME}, "first_time": first_time}
    n |= {"peak": peak[order], "time": times(r, "torque_peak", order, peak[order]), "rms": effective[order]}
    for prefix, values, at in (("strongest", peak, rows), ("ever", ever_peak, ever_rows)):
        j, near = worst_of(values)
        name = "strongest" if prefix == "strongest" else "ever_strongest"
        n |= {name: {r.names[k] for k in near}, f"{prefix}_peak": values[j], f"{prefix}_time": times(r, "torque_peak", j, values[j])}
    if np.isfinite(r.at_rest).any():
        j, near = worst_of(peak / r.at_rest)
        n |= {"of_rest": 100 * peak[j] / r.at_rest[j], "rest_joint": {r.names[k] for k in near}, "rest": r.at_rest[j]}
    for prefix, first in (("", w.first), ("ever_", 0)):
        values, at = peaks(r, "error_peak", first)
        j, near = worst_of(values)
        n |= {f"{prefix}far": {r.names[k] for k in near}, f"{prefix}error": values[j],
              f"{prefix}error_time": times(r, "error_peak", j, values[j])}


def loose(name, known):
    """Tolerance of a number that is computed from the estimated period."""
    doubt = known["doubt"]
    return {"repeats": 2 * np.pi * doubt, "cycle_from": 0.04, "from": doubt * known["period"] * max(1, known["periods"]),
            "period": doubt * known["period"], "per_period": doubt * known.get("per_period", 0),
            "cycle_speed": doubt * known.get("cycle_speed", 0)}.get(name, 0)


def hear(expression, text, known, who):
    found = expression.read(text)
    if found is None:
        return [f"{who}: no expression reads {text!r}"]
    wrong = []
    for name, kind, said in found:
        expected = known.get(name)
        if not kind:
            ok = expected is not None and (said in expected if isinstance(expected, set) else said == expected)
        else:
            times = expected if isinstance(expected, tuple) else (expected,)
            ok = expected is not None and any(same(kind, said, one, loose(name, known)) for one in times)
        if not ok:
            wrong.append(f"{who}: {name} is {said} in {text!r}, recomputed {expected}")
    return wrong


def first_screen(text, verdict, judged, known, end=""):
    """Compares the first screen with the record and with the checks of verdict.json, whose numbers are recomputed elsewhere. `end` is
    the end of the deciding sentence."""
    parts, wrong, checks = sections(text), [], verdict["checks"]
    said = {}
    for title, line in parts:
        said.setdefault(title, line)

    def must(title, expected):
        if said.get(title) != expected:
            wrong.append(f"terminal: {title} is {said.get(title)!r}, recomputed {expected!r}")

    of = {status: [c for c in checks if c["status"] == status] for status in ("fail", "too close", "warn", "not judged")}
    word = verdict["verdict"]
    fails = sorted(by_urgency(of["fail"]), key=lambda c: c["id"] != verdict["decided_by"])  # sorted() is stable
    if word == "feasible":
        chosen = " (chosen figures)" if verdict["chosen_motors"] else ""
        must("verdict", f"feasible with these motors{chosen}, over {verdict['rests_on']}")
    elif word == "not judged":
        must("verdict", f"not judged: {verdict['reason']}")
    else:
        must("verdict", f"{word}: {sentence(fails[0])}{end}")
        fails = fails[1:]
    for title, list_ in (("fails", fails), ("too close", of["too close"]), ("warns", [c for c in of["warn"] if c["id"] != "created"])):
        must(title, " ".join(sentence(c) for c in list_) if list_ else None)
    no_dock = sum(c["id"].startswith("dock_") for c in of["not judged"]) == 4
    names = list(dict.fromkeys("docks" if no_dock and c["id"].startswith("dock_") else c["id"] for c in of["not judged"]))
    must("unknown", ", ".join(names) + " (gaitlab explain verdict)" if names else None)
    if word in ("feasible", "not judged") and verdict["tightest"]:
        c = next(c for c in checks if c["id"] == verdict["tightest"])
        part = f" of {c['worst']}" if c["worst"] else ""
        must("tightest", f"{c['id'].replace('_', ' ')}{part}, margin {printed('pct', c['margin'])}")
    else:
        must("tightest", None)
    _, limits, changed = verdict["rests_on"].partition("limits: ")
    conditions = limits + changed if verdict["verdict"] != "feasible" else ""
    must("rests on", "; ".join(one for one in (verdict["figures"], conditions) if one) or None)
    if "gait" in said:
        wrong += hear(GAIT, said["gait"], known, "terminal: gait")
        if known.get("lossless") and "cost of transport" in said["gait"] and "next to nothing" not in said["gait"]:
            wrong.append(f"terminal: a cost of transport without losses: {said['gait']!r}")
    return wrong


def verbose(text, known):
    wrong, seen = [], set()
    wrong += hear(HEAD, text.splitlines()[0], known, "terminal: head")
    for title, line in sections(text):
        if title in READ:
            seen.add(title)
            wrong += hear(READ[title], line, known, f"terminal: {title}")
    return wrong, seen
