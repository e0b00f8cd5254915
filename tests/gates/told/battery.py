"""Checks `brownout` and `battery`: the bus of every control tick, solved anew from the trace (docs/equations.md, 3).

Only for dc_motors under commands in volts, and for traces with the control period: other buses are not recomputed."""
import numpy as np

from told.check import Told, graded, margin

GRID = 2000  # voltages of the search for the largest solution


def solutions(record):
    """Voltage and current of the bus at each control tick, by row of the trace from the second on; None if not recomputed."""
    s, a, n = record.scenario["supply"], record.actuator, record.count
    names = [f"joint.{j}.{what}" for j in range(n) for what in ("voltage_command", "speed")]
    period = record.scenario["controller"]["period"]
    t = record.trace["t"]
    if a["type"] != "dc_motor" or not all(name in record.trace for name in names) or abs(t[1] - t[0] - period) > 1e-9:
        return None
    of = lambda key: record.per_joint(a, key)
    R, Kt, Ks, gear, eta, u_max, i_max = (of(key) for key in ("R", "Kt", "Ks", "gear", "efficiency", "u_max", "i_max"))
    V0, r = s["voltage"], s.get("resistance", 0)

    def power(V, command, speed):
        u = np.clip(command, -np.minimum(V, u_max), np.minimum(V, u_max))
        emf = Ks * gear * speed
        i = np.clip((u - emf) / R, -i_max, i_max)
        total = np.where(np.abs(u - emf) > R * i_max, (R * i + emf) * i, u * i).sum()
        return max(total, 0) if not s.get("regenerates", False) else total

    out = []
    for k in range(1, len(t)):
        command = np.array([record.trace[f"joint.{j}.voltage_command"][k] for j in range(n)])
        speed = np.array([record.trace[f"joint.{j}.speed"][k - 1] for j in range(n)])
        beyond = lambda V: V - V0 + r * power(V, command, speed) / V
        high, low = V0, 0.0
        if beyond(V0) > 0:
            for V in V0 * np.arange(GRID - 1, 0, -1) / GRID:
                if beyond(V) <= 0:
                    low = V
                    break
                high = V
            while low > 0 and high - low > 1e-12 * V0:
                middle = (low + high) / 2
                low, high = (low, middle) if beyond(middle) > 0 else (middle, high)
        V = high if low > 0 or beyond(V0) <= 0 else V0 / 2
        out.append((t[k], V, power(V, command, speed) / V))
    return np.array(out)


def bus(record):
    if "solved_bus" not in record.__dict__:
        record.solved_bus = solutions(record) if record.scenario.get("supply") and record.driven.any() else Told()
    return record.solved_bus


def brownout(record):
    found = bus(record)
    if not isinstance(found, np.ndarray):
        return found
    s = record.scenario["supply"]
    if not s.get("least"):
        return Told()
    k = int(np.argmin(found[:, 1]))
    drop, limit = s["voltage"] - found[k, 1], s["voltage"] - s["least"]
    told = Told("fail" if drop > limit else "pass", drop, limit, margin=margin(drop, limit), start=found[k, 0], end=found[k, 0],
                also={"least": found[k, 1], "open": s["voltage"], "stops": s["least"]})
    told.loose = 1e-6
    told.rows = {(when, when) for when, V, _ in found if V <= found[k, 1] + 1e-9}
    if drop > limit:
        told.first = found[np.argmax(found[:, 1] < s["least"]), 0]
        row = int(np.searchsorted(record.t, told.first - 1e-9))
        current = record.tick("current_peak")[row]
        told.first_parts = [name for j, name in enumerate(record.names) if current[j] >= current.max() * (1 - 1e-9)]
        told.also["low"] = float((found[:, 1] < s["least"]).sum() * record.scenario["controller"]["period"])
    return told


def battery(record, window):
    found = bus(record)
    if not isinstance(found, np.ndarray):
        return found
    most = record.scenario["supply"].get("current", 0)
    if not most:
        return Told()
    inside = found[found[:, 0] > record.t[window.first] + 1e-9]
    rms, peak = float(np.sqrt(np.mean(inside[:, 2] ** 2))), float(np.abs(found[:, 2]).max())
    status = graded(rms / most, record.limits["warn_share"], 1)
    if status == "pass" and peak > most:
        status = "warn"
    told = Told(status, rms, most, margin=margin(rms, most), also={"peak": peak, "share": rms / most})
    told.loose = 1e-6
    return told
