"""The facts of report.html: its JSON, and the text that Chromium displays. Definitions: docs/report.md."""
import json
import math
import os
import pathlib
import re
import subprocess

import numpy as np

from told.motors import grown
from told.verdict import by_urgency

SPACE = "\u00a0"
FACTS = pathlib.Path(__file__).resolve().parents[2] / "page" / "facts.mjs"
FLOORS = {"": 1e-6, "m": 1e-7, "rad": 1e-4, "rad/s": 1e-5, "N m": 1e-6, "N": 1e-5, "A": 1e-6, "J": 1e-7}


def meta(file):
    return json.loads(re.search(r'<script type="application/json" id="meta">(.*?)</script>', file.read_text(), re.S)[1])


class Browser:
    """Pages as Chromium shows them, without a network (tests/page/facts.mjs): one browser for all pages, started with the first."""

    def __init__(self):
        self.process = None

    def facts(self, file):
        """Texts {headline, events, why, facts} of a page; None where NODE_MODULES names no modules (tests/node.sh)."""
        if "NODE_MODULES" not in os.environ:
            return None
        if self.process is None:
            self.process = subprocess.Popen(["node", FACTS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(f"{file}\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{file}: the browser shows no facts")
        shown = json.loads(line)
        return shown | {"facts": dict(shown["facts"])}

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait()


# ---- number formats of the page
def number(x, digits=3, unit=None):
    if unit is not None and abs(x) < FLOORS.get(unit, 0):
        x = 0
    return "0" if x == 0 else f"{x:.{digits}g}"


NUMBER = re.compile(r"^([−-]?[\d.]+(?:e[−-]?\d+)?)")


def agrees(text, value, digits):
    """True if the number at the start of a text equals the value to this number of digits."""
    match = NUMBER.match(text)
    if not match:
        return False
    said = float(match[1].replace("−", "-"))
    if said == value:
        return True
    unit = 10.0 ** (math.floor(math.log10(max(abs(value), 1e-300))) - digits + 1)
    return abs(said - value) <= 0.5 * unit * (1 + 1e-6) + 1e-9 or value != value


def quantity(text, value, unit):
    """True if a text such as `17.2 mm`, `98 %` or `1.02 N m` agrees with a value in its unit."""
    if unit == "":
        return agrees(text, 100 * value, 3) and text.endswith("%")
    if unit == "m" and abs(value) < 0.1:
        return agrees(text, 1000 * value, 3) and text.endswith("mm")
    return agrees(text, value if abs(value) >= FLOORS.get(unit, 0) else 0.0, 3) and text.replace(SPACE, " ").endswith(unit)


def moment(text, at):
    """Text of a time, such as `3.99 s`, with two decimals, or three if two are not exact."""
    return abs(float(text.split(SPACE)[0].replace("−", "-")) - at) <= 0.5005e-2 and text.endswith("s")


def stretch(text, start, end):
    if not end - start > 1e-6:
        return moment(text, start)
    if " to " not in text:
        return False
    a, b = text.replace(SPACE + "s", "").split(" to ")
    room = 0.5005e-3 if end - start < 0.1 else 0.5005e-2
    return abs(float(a) - start) <= room and abs(float(b) - end) <= room


def part(meta_, told, names):
    """Displayed names of parts."""
    out = set()
    for name in names:
        if told["part"] == "dock":
            out.add(f"{name}'s dock")
        elif told["part"] == "foot":
            out |= {f["title"] for f in meta_["feet"] if f["name"] == name} or {name}
        else:
            out.add(name)
    return out


def longest(judged):
    """Joint that is at a limit for the largest share of the judged time: equally good names, and shares of voltage and current. None if
    no joint is at a limit."""
    r, w = judged.record, judged.window
    if not r.driven.any():
        return None
    v, c = (grown(r, f"{kind}_limited", w) / w.length for kind in ("voltage", "current"))
    most = (v + c).max()
    if not most > 0:
        return None
    near = [j for j in range(r.count) if (v + c)[j] >= most * (1 - 1e-9)]
    return {r.names[j] for j in near}, v[near[0]], c[near[0]]


def hear(shown, meta_, verdict, judged, known):
    """Differences of the page's headline and facts. Expected numbers are recomputed from the record if possible, or from verdict.json."""
    facts, wrong, checks = dict(shown["facts"]), [], {c["id"]: c for c in verdict["checks"]}

    def must(ok, name, expected, of=""):
        if not ok:
            wrong.append(f"page: {name}{of} is {shown['facts'].get(name)!r}, recomputed {expected}")

    word = verdict["verdict"]
    failing = sorted(by_urgency([c for c in verdict["checks"] if c["status"] == "fail"]), key=lambda c: c["id"] != verdict["decided_by"])
    first = failing[0] if failing else None
    said = shown["headline"].replace(SPACE, " ")
    expected = {"feasible": "Feasible with these motors", "not judged": "Not judged"}.get(word)
    if word == "infeasible":
        expected = "Not feasible with these motors" if first["group"] == "motor" else "Not feasible"
    if word == "failed":
        if not re.fullmatch(r"The run ended early, at [\d.]+ s", said) or not agrees(said.rsplit("at ", 1)[1], judged.record.end, 3):
            wrong.append(f"page: headline {said!r}, the run ended at {judged.record.end} s")
    elif said != expected:
        wrong.append(f"page: headline {said!r}, recomputed {expected!r}")
    if word == "infeasible":
        line = next((text for text, event in zip(shown["events"], verdict["events"]) if event["check"] == first["id"]), None)
        shortfall(facts, line, first, judged, meta_, must, failing)
    else:
        walked(facts, verdict, checks, judged, meta_, must, known)
    for name in facts:
        wrong.append(f"page: nothing recomputes the fact {name}: {facts[name]!r}")
    return wrong


def names_of(told, check, which):
    if told is None:
        return {check[which]}
    if which == "worst":
        return set(told.ties or [told.worst])
    return set(getattr(told, "first_parts", [told.first_part]))


def shortfall(facts, line, first, judged, meta_, must, failing):
    told, of = judged.checks[first["id"]], f" of {first['id']}"
    value, limit = (told.value, told.limit) if told else (first["value"], first["limit"])
    start, end = (told.start, told.end) if told else (first["from"], first["to"])
    at = told.first if told else first["first"]
    unit = first["unit"]
    expects = at is not None and at == at
    if expects or line is not None:
        firsts = names_of(told, first, "first_part") - {None}
        time, _, body = (line or "").partition(" s ")
        names = part(meta_, first, firsts)
        ok = expects and line is not None and moment(time + SPACE + "s", at)
        must(ok and (not names or any(body.startswith(name + " ") for name in names)), f"event {line!r}", (firsts, at), of)
    text = facts.pop("Worst", None)
    worst = names_of(told, first, "worst") - {None}
    if text is not None:
        body = text
        if worst:
            lead = [p for p in part(meta_, first, worst) if text.startswith(p + " ")]
            must(bool(lead), "Worst", worst, of)
            body = text[len(lead[0]) + 1:] if lead else text
        match = re.fullmatch(r"(.*?),? limit (≥ )?(.*)", body)
        room = getattr(told, "loose", 0) if told else 0
        near = quantity(match[1], value, unit) or room and quantity(match[1], first["value"], unit) if match else False
        ok = match and bool(match[2]) == first["least"] and near and quantity(match[3], limit, unit)
        must(ok, "Worst", (value, limit, unit), of)
    else:
        must(value != value, "Worst", value, of)
    text = facts.pop("Longest at a limit", None)
    long = longest(judged)
    if first["id"] in ("voltage", "current") and long:
        joints, v, c = long
        kinds = ", ".join(f"{kind} {number(100 * s)}{SPACE}%" for kind, s in (("voltage", v), ("current", c)) if s > 0)
        ok = text is not None and any(text.startswith(j + " ") for j in joints)
        must(ok and same_numbers(text.split(" ", 1)[1], kinds + " of the time"), "Longest at a limit", (joints, kinds))
    elif text is not None:
        must(False, "Longest at a limit", None)
    text = facts.pop("When", None)
    if start is None or start != start:
        must(text is None, "When", None, of)
    else:
        body = text or ""
        for p in part(meta_, first, worst):
            body = body.removesuffix(" " + p)
        near = told is not None and any(stretch(body, a, b) for a, b in getattr(told, "rows", ()) if text is not None)
        must(text is not None and (
            near or stretch(body, start, end if end is not None and end == end else start)), "When", (start, end, worst), of)
    text = facts.pop("Off its set point", None)
    strays = next((c for c in failing if c["id"] == "tracking"), None)
    if text is not None:
        own = judged.checks["tracking"]
        value, limit = text.split(" limit ")
        must(strays is not None and quantity(value, own.value, "rad") and quantity(limit, own.limit, "rad"),
             "Off its set point", (own.value, own.limit))


def same_numbers(a, b):
    """True if two texts differ at most by the last digit of a number."""
    split = lambda s: re.split(r"([\d.]+)", s)
    one, two = split(a), split(b)
    return len(one) == len(two) and all(x == y or re.fullmatch(r"[\d.]+", x) and agrees(x, float(y), 3) for x, y in zip(one, two))


def walked(facts, verdict, checks, judged, meta_, must, known):
    c = checks.get(verdict["tightest"])
    name = "Worst" if c and c["margin"] is not None and c["margin"] < 0 else "Tightest"
    text = facts.pop(name, None)
    if c and c["margin"] is not None and c["limit"]:
        told = judged.checks[c["id"]]
        value, limit, margin = (told.value, told.limit, told.margin) if told else (c["value"], c["limit"], c["margin"])
        body, worst = text or "", names_of(told, c, "worst") - {None}
        if worst:
            lead = [p for p in part(meta_, c, worst) if body.startswith(p + " ")]
            title = c["title"][0].lower() + c["title"][1:]
            must(bool(lead) and f" {title}: " in body, name, (worst, title))
            body = body.partition(f" {title}: ")[2]
        else:
            body = body.removeprefix(c["title"] + " ")
        if 0 <= margin <= 1:
            share = 100 * (1 + margin if c["least"] else 1 - margin)
            ok = body.replace(SPACE, " ").endswith("% of the limit") and (agrees(body, share, 2) or share < 1e-4)
        else:
            match = re.fullmatch(r"(.*), limit (≥ )?(.*)", body)
            ok = match and quantity(match[1], value, c["unit"]) and quantity(match[3], limit, c["unit"])
        must(ok, name, (value, limit, margin))
    elif text is not None:
        must(False, name, None)
    hardest, largest = facts.pop("Hardest worked", None), facts.pop("Largest torque", None)
    if hardest is not None:
        own = judged.checks["envelope"]
        match = re.fullmatch(r"(\S+) (\S+)" + SPACE + r"% of its motor at (.*)", hardest)
        must(match and match[1] in own.ties and agrees(match[2], 100 * own.value, 2), "Hardest worked", (own.ties, own.value))
    if largest is not None:  # largest of the rows of the page
        rows = max(np.abs(judged.record.trace[f"joint.{j}.torque"]).max() for j in range(judged.record.count))
        must(abs(float(largest.split(" ")[0]) - rows) <= 2e-3 + 5e-3 * rows, "Largest torque", rows)
    for name, key, scale, digits in (
            ("Speed", "speed", 100, 3), ("Cost of transport", "electrical_cost", 1, 3), ("Period", "period", 1, 4)):
        text = facts.pop(name, None)
        if text is not None:
            scale = 1 if text.endswith(" m/s") else scale
            must(key != "electrical_cost" or not known["lossless"], name, "nothing, without losses")
            near = name == "Period" and abs(float(text.split(" ")[0]) - known[key]) < 1e-3  # known to 3e-5 of itself
            must(near or agrees(text, scale * known[key], digits), name, scale * known[key])
