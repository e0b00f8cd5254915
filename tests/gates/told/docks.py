"""Checks of docks: docs/reference/verdict.md, docs/numbers.md (verdict.json, loads)."""
import numpy as np

from told.check import SAME, Told, graded, margin, widen


def dock_limits(record, quantity):
    """Limits of docks by module: the smaller limit of the connectors of both faces; NaN if neither states a limit."""
    out, sources = {}, {}
    for row in record.scenario["robot"].get("docks", []):
        own, child, theirs, parent, _ = row
        found = []
        for module, face in ((child, own), (parent, theirs)):
            name = record.robot.face(int(module), face).get("connector")
            connectors = record.robot.type_of[int(module)].get("connectors", {})
            if name in connectors and quantity in connectors[name]:
                found.append(float(connectors[name][quantity]))
        out[int(child)] = min(found, default=np.nan)
    return out


def dock(record, quantity):
    if record.robot.count < 2 or record.solver or record.loads is None or len(record.loads) < 2:
        return Told()
    limits, t, warn = dock_limits(record, quantity), record.loads["t"], record.limits["warn_share"]
    peaks = {}
    for m, limit in limits.items():
        load = record.loads[f"dock.{m}.{quantity}"]
        load = load if quantity == "tension" else np.abs(load)
        load = np.where(np.abs(load) < 1e-9, 0.0, load)  # rounding errors (N, N m)
        if np.isnan(load).all():
            return None
        k = int(np.nanargmax(load))  # the last row of a run that ended early is NaN
        beyond = np.flatnonzero(load > limit)
        peaks[m] = (load[k], t[k], t[beyond[0]] if len(beyond) else np.nan)
    stated = {m: peaks[m][0] / limits[m] for m in peaks if limits[m] > 0}
    by = stated or {m: peaks[m][0] for m in peaks}
    most = max(by.values())
    ties = [m for m in sorted(by) if by[m] >= most - SAME * abs(most)]
    m = ties[0]
    value, when, _ = peaks[m]
    told = Told("not judged", value, np.nan, worst=f"m{m}", ties=[f"m{k}" for k in ties], start=when, end=when)
    told.also = {"docks": len(peaks), "open": len(peaks) - len(stated)}
    if not stated:
        return told
    told.limit, told.margin, told.parts = limits[m], margin(value, limits[m]), sum(s > 1 for s in stated.values())
    told.status = graded(stated[m], warn, 1)
    told.also["share"] = max(0.0, stated[m])
    firsts = [(peaks[k][2], k) for k in stated if np.isfinite(peaks[k][2])]
    if firsts:
        told.first = min(firsts)[0]
        told.first_parts = [f"m{k}" for when, k in firsts if when == told.first]
        told.first_part = told.first_parts[0]
    return widen(told, record.torque_errors().max() if record.count else 0)
