"""Checks of the base, of bodies and the ground: docs/reference/verdict.md, docs/numbers.md (verdict.json, loads)."""
import numpy as np

from paper.robot import rpy
from told.check import SAME, Told, graded, margin, widen
from told.legs import Legs

LEAST_WAY = 0.01  # least distance of a walk, m
QUARTER, NEARLY = np.pi / 2, np.pi / 4


# ---- ground
def field_height(ground, x, y):
    """Height of a heightfield: Catmull-Rom interpolation in both directions, and the heights of the border outside."""
    field = ground["heightfield"]
    values, (x0, y0, z0), d = np.array(field["values"], float), field.get("origin", [0, 0, 0]), field["spacing"]

    def axis(u, count):
        """Four nodes around a coordinate and their weights. A node outside the border is extrapolated linearly from the two nodes
        before it (documented only in core/laws/heightfield.h)."""
        u = np.clip(u, 0, count - 1)
        cell = np.minimum(np.floor(u), count - 2).astype(int)
        f = u - cell
        w = list(np.stack([-f + 2 * f**2 - f**3, 2 - 5 * f**2 + 3 * f**3, f + 4 * f**2 - 3 * f**3, -f**2 + f**3]) / 2)
        before, behind = np.where(cell == 0, w[0], 0), np.where(cell + 2 == count, w[3], 0)
        w = [w[0] - before, w[1] + 2 * before - behind, w[2] - before + 2 * behind, w[3] - behind]
        return w, [np.clip(cell + k, 0, count - 1) for k in (-1, 0, 1, 2)]

    wx, columns = axis((np.asarray(x) - x0) / d, values.shape[1])
    wy, rows = axis((np.asarray(y) - y0) / d, values.shape[0])
    return z0 + sum(wy[r] * wx[c] * values[rows[r], columns[c]] for r in range(4) for c in range(4))


def carried(record, at):
    """Heights of the ground below points (rows, 3): the highest surface on the vertical that is at most limits.sink above the point."""
    ground, kind = record.scenario["ground"], record.ground
    if kind == "heightfield":
        return field_height(ground, at[:, 0], at[:, 1])
    surface = np.zeros(len(at))
    for box in ground.get("boxes", []) if kind == "boxes" else []:
        r, half = rpy(box.get("rpy", [0, 0, 0])), np.array(box["size"], float) / 2
        # The vertical line in the frame of the box, intersected with the three pairs of faces.
        origin = (np.concatenate([at[:, :2], np.zeros((len(at), 1))], 1) - np.array(box["center"], float)) @ r
        up = r[2]
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (-half - origin) / up, (half - origin) / up
        parallel, inside = np.abs(up) < 1e-12, np.abs(origin) <= half
        low = np.where(parallel, np.where(inside, -np.inf, np.inf), np.minimum(a, b)).max(1)
        high = np.where(parallel, np.where(inside, np.inf, -np.inf), np.maximum(a, b)).min(1)
        counts = (high >= low) & (high <= at[:, 2] + record.limits["sink"])
        surface = np.where(counts & (high > surface), high, surface)
    return surface


def elements(record):
    """Contact elements that can touch the ground: all, or those of free blocks of modules without children (docs/numbers.md)."""
    on, robot = record.scenario["contact"]["on"], record.robot
    found = robot.contacts(on) if on != "none" else {}
    docked = {f"m{k}/{robot.reference[k]}" for k in range(1, robot.count)}
    free = lambda body: int(body[1:].split("/")[0]) in robot.childless and body not in docked
    return found if on == "all" else {name: e for name, e in found.items() if free(e[0])}


def heights(record):
    """Heights of the centre of mass above the mean height of the ground below the contact elements."""
    com, motion = record.com(), record.motion()
    points = [motion[body][0] + motion[body][1] @ centre for body, centre, _ in elements(record).values()]
    return com[:, 2] - np.mean([carried(record, at) for at in points or [com]], axis=0)


def standing(record):
    """Height at the start after lowering the robot onto the ground; NaN if this function does not recompute it."""
    height = heights(record)[0]
    if record.scenario["robot"].get("on_ground", True) and len(record.scenario["robot"].get("position", [0, 0])) < 3:
        return height
    if record.ground != "plane" or not elements(record):
        return np.nan
    motion = record.motion()
    return height - min((motion[body][0] + motion[body][1] @ centre)[0, 2] - radius for body, centre, radius in elements(record).values())


def stance(record):
    """Heights of the centre of mass above the lowest point of the contact elements, in the poses of the set points (within the ranges of
    the hinges), with the initial mean orientation of all bodies, weighted by mass. NaN without contact elements."""
    rows, count, robot = len(record.poses), record.count, record.robot
    found = elements(record)
    if not found:
        return np.full(rows, np.nan)
    asked = record.pose("setpoint") if count else np.zeros((rows, 0))
    for j, (low, high) in enumerate(robot.ranges):
        asked[:, j] = np.clip(asked[:, j], low, high)
    still = np.zeros((rows, 3))
    first, level = record.motion(), np.broadcast_to(np.eye(3), (rows, 3, 3))
    pose = robot.move(still, level, still, still, asked, 0 * asked)
    # The rotation that brings all bodies nearest to their first orientations, by least squares.
    u, _, v = np.linalg.svd(sum(body.mass * first[body][1][0] @ np.swapaxes(pose[body][1], -1, -2) for body in robot.bodies))
    u[:, :, 2] *= np.linalg.det(u @ v)[:, None]
    pose = robot.move(still, u @ v, still, still, asked, 0 * asked)
    com = sum(body.mass * pose.com(body)[0][:, 2] for body in robot.bodies) / sum(body.mass for body in robot.bodies)
    low = np.min([(pose[body][0] + pose[body][1] @ centre)[:, 2] - radius for body, centre, radius in found.values()], axis=0)
    return com - low


LEAST_STANCE = 0.01  # share of the standing height; for a pose whose feet are above its centre of mass


def fall(record, window):
    if not record.floating or record.ground == "none":
        return Told()
    height, above, limit, t = heights(record), standing(record), record.limits["height"], record.poses["t"]
    if not np.isfinite(above):
        return None
    if not above > 0:
        return Told()
    # The lower of two heights: that at the start, and that in the pose of the set points.
    lower = np.fmin(above, np.maximum(stance(record), LEAST_STANCE * above))
    share = height / lower
    low = int(np.argmin(share))
    value = share[low]
    told = Told("fail" if value < limit else "pass", value, limit, least=True, margin=margin(value, limit, True))
    below = np.flatnonzero(share < limit)
    told.start, told.end = t[below[0]] if len(below) else t[low], t[low]
    told.first = told.start if len(below) else np.nan
    if len(below) and share[-1] < limit:
        told.end = record.end
    told.also = {"below": -height[low], "stays": "not rise again" if len(below) and share[-1] < limit else None}
    return told


# ---- the base
def turned(record):
    """Angles at control ticks between the vertical and the axis that pointed upwards at the start."""
    r = record.rotation()
    axis = r[0].T @ np.array([0, 0, 1.0])
    return np.arccos(np.clip((r @ axis)[:, 2], -1, 1))


def tilted(record):
    """The smaller of the angles of turned() and of the mean axis of all bodies, weighted by mass, that pointed upwards at the start."""
    motion, mean = record.motion(), 0
    for body in record.robot.bodies:
        r = motion[body.name][1]
        mean = mean + body.mass * (r @ (r[0].T @ np.array([0, 0, 1.0])))
    return np.minimum(turned(record), np.arccos(np.clip(mean[:, 2] / np.linalg.norm(mean, axis=1), -1, 1)))


def steps_of_turn(record):
    """Rotation vectors of the base from tick to tick, in world axes."""
    r = record.rotation()
    d = r[1:] @ np.swapaxes(r[:-1], -1, -2)
    axis = np.stack([d[:, 2, 1] - d[:, 1, 2], d[:, 0, 2] - d[:, 2, 0], d[:, 1, 0] - d[:, 0, 1]], -1) / 2
    sine = np.linalg.norm(axis, axis=1)
    angle = np.arctan2(sine, (np.trace(d, axis1=1, axis2=2) - 1) / 2)
    return axis * np.where(sine > 1e-12, angle / np.maximum(sine, 1e-300), 1)[:, None]


def heading(record):
    """Rotation about world z from tick to tick: the twist of the rotation."""
    r = record.rotation()
    d = r[1:] @ np.swapaxes(r[:-1], -1, -2)
    # The twist of a quaternion is 2 atan2(z, w), with 4 w z = d10 - d01 and 4 w w = 1 + trace.
    wz, ww = d[:, 1, 0] - d[:, 0, 1], 1 + np.trace(d, axis1=1, axis2=2)
    return 2 * np.arctan2(wz, ww)


def rolls(record, window, period):
    """True if the base makes at least one turn (rounded) about horizontal axes in every period, and its axis comes within 45 degrees
    of the upward and of the downward vertical."""
    t, turn, tilt = record.poses["t"], steps_of_turn(record)[:, :2], turned(record)[1:]
    if window.periods:
        edges = window.end - window.cycle.period * np.arange(window.periods, -1, -1)
    elif period:
        edges = np.array([record.end - period, record.end])
    else:
        edges = np.linspace(window.start, window.end, 3)
    # The horizontal axes rotate with the heading of the base, so that a robot that turns while it rolls is also rolling.
    yaw = np.concatenate([[0], np.cumsum(heading(record))])[:-1]
    c, s = np.cos(yaw), np.sin(yaw)
    own = np.stack([c * turn[:, 0] + s * turn[:, 1], -s * turn[:, 0] + c * turn[:, 1]], -1)
    sums = []
    for a, b in zip(edges[:-1], edges[1:]):
        rows = (t[1:] > a + 1e-9) & (t[1:] <= b + 1e-9)
        both = rows.any() and tilt[rows].min() < NEARLY and tilt[rows].max() > np.pi - NEARLY
        sums.append(np.linalg.norm(own[rows].sum(0)) / (2 * np.pi) if both else 0.0)
    return bool(sums) and min(sums) >= 0.5, sums


def upright(record, window, period):
    if not record.floating:
        return Told()
    tilt, t, limits = tilted(record), record.poses["t"], record.limits
    k = int(np.argmax(tilt))
    over = np.flatnonzero(tilt > QUARTER)
    told = Told("pass", tilt[k], QUARTER, margin=margin(tilt[k], QUARTER), start=t[k], end=t[k], also={"tilt": limits["tilt"]})
    told.status = "warn" if tilt[k] > limits["tilt"] else "pass"
    if not len(over):
        return told
    told.start = told.first = t[over[0]]
    told.status = "fail"
    does, told.turns = rolls(record, window, period)
    if does:
        return Told(also={"rolls": True})
    if not window.periods and period and record.end < 3 * period and record.end - t[over[0]] < period:
        return Told(also={"over": t[over[0]]})
    return told


def extent(record):
    """Diagonal of the bounding box of the origins of all bodies and of all contact elements at the start."""
    motion = record.motion()
    at = [motion[body][0][0] for body in record.robot.order]
    at += [(motion[body][0] + motion[body][1] @ centre)[0] for body, centre, _ in record.robot.contacts("all").values()]
    return float(np.linalg.norm(np.max(at, 0) - np.min(at, 0)))


def halves(window, period):
    """Start of the first of two intervals up to the end, and their length. They consist of whole periods. The middle of an odd number
    is in both, and a single period is compared with the period before it. Without periods, they are halves of the time after the
    start. The length is 0 if the run does not contain two intervals."""
    start = window.start if window.periods else max(window.start, min(2.0, 0.2 * window.end))
    length = window.end - start
    unit = (length / window.periods if window.periods else period) or length / 2
    count = max(2, np.floor(length / unit + 1e-3))
    begin = window.end - count * unit
    return (begin, np.ceil(count / 2) * unit) if begin >= -1e-3 * unit else (0.0, 0.0)


def progress(record, window, borne, long_enough, period):
    if not record.floating or record.ground == "none":
        return Told()
    t, com = record.poses["t"], record.com()
    if len(t) < 3:
        return Told()
    rows = np.flatnonzero(t >= window.start)
    a, b, per = rows[0], len(t) - 1, max(window.periods, 1)
    value = np.linalg.norm((com[b] - com[a])[:2]) / per
    asked, factor, size = record.limits["progress"], 1 if window.periods else 10, extent(record)
    limit = (asked or 0.01 * factor) * size
    turn = abs(heading(record)[a:].sum()) / per
    goes = value >= limit or (not asked and turn >= 0.01 * factor)
    status = "pass" if goes else "fail" if asked else "warn" if long_enough else "not judged"
    told = Told(status, value, limit, least=True, start=t[a], end=t[b], can_fail=asked > 0)
    told.margin = margin(value, limit, True) if asked else np.nan
    begin, half = halves(window, period)
    k = min(int(np.searchsorted(t, begin)), b)
    # Along the ground: coming down onto it is not sliding.
    ground = com[:, 2] - heights(record)
    fallen = record.mass * (record.gravity @ [*(com[b] - com[k])[:2], ground[b] - ground[k]])
    driven = record.joints["shaft"].sum() if record.count else 0.0
    if borne and fallen > max(driven, record.least_energy()):
        step = np.linalg.norm(np.diff(com[:, :2], axis=0), axis=1)

        def way(low, high):
            return step[(t[1:] > low) & (t[1:] <= high)].sum()

        before = way(begin, begin + half)
        faster = way(window.end - half, window.end) / before if before > 0 else 1.0
        if faster > 1.2:
            told.status, told.value, told.limit, told.least, told.unit = "fail", faster, 1.2, False, "times"
            told.margin, told.can_fail = margin(faster, 1.2), True
            told.also = {"fallen": fallen, "driven": driven}
    return told


# ---- feet and ground
def on_ground(record):
    return record.floating and record.ground != "none" and not record.solver and record.loads is not None and len(record.loads) > 1


def slip(record, window):
    if not on_ground(record):
        return Told()
    first = window.first
    grown = {name: record.loads[name][-1] - record.loads[name][first] for name in record.loads.columns}
    feet = {name[5:-5]: grown[name] for name in grown if name.startswith("foot.") and name.endswith(".slid")}
    worst = max(feet, key=feet.get) if feet and max(feet.values()) > 0 else None
    way = grown["path"]
    called = Legs(record).foot
    told = Told(worst=worst, also={"way": way, "slid": feet.get(worst, 0), "slip": grown["slip"], "least_way": LEAST_WAY,
                                   "foot": tuple(called(one, feet) for one in feet if worst and feet[one] >= feet[worst] * (1 - SAME))})
    told.ties = [name for name in feet if worst and feet[name] >= feet[worst] * (1 - SAME)]
    if way < LEAST_WAY:
        return told
    told.value, told.limit = grown["slip"] / way, record.limits["slip"]
    told.status, told.margin = graded(told.value, told.limit, np.inf), margin(told.value, told.limit)
    told.start, told.end = record.loads["t"][first], record.loads["t"][-1]
    return told


def creep(record, window):
    if not on_ground(record):
        return Told()
    com, first = record.com(), window.first
    travel = np.linalg.norm((com[-1] - com[first])[:2])
    crept = np.hypot(*(record.loads[name][-1] - record.loads[name][first] for name in ("creep.x", "creep.y")))
    told = Told(also={"way": travel, "crept": crept, "least_way": LEAST_WAY, "half": record.slip_speed / 2})
    if travel < LEAST_WAY:
        return told
    told.value, told.limit = crept / travel, 0.02
    told.status, told.margin = graded(told.value, told.limit, np.inf), margin(told.value, told.limit)
    told.start, told.end = record.loads["t"][first], record.loads["t"][-1]
    return told


def borne(record, window):
    """Shares of the weight on the ground at the control ticks in the window; None if they are not required."""
    if not record.floating or not record.weight > 0 or not elements(record) or record.ground == "none":
        return None
    t = record.poses["t"]
    return record.poses["load"][t > window.start + 1e-12] / record.weight


def airborne(record, window):
    shares = borne(record, window)
    if shares is None:
        return Told()
    value = float(np.mean(shares < 0.05))
    return Told("warn" if value > 0 else "pass", value, 0.0, margin=-value, start=window.start, end=window.end, also={"weight": 0.05})


def stability(record, window):
    if not on_ground(record) or record.ground != "plane":
        return Told()
    inside = record.loads["stability"][window.first + 1:]
    seen = inside[~np.isnan(inside)]
    if not len(seen):
        return Told()
    k = int(np.nanargmin(inside))
    return Told("pass", inside[k], start=record.loads["t"][window.first + 1 + k], end=record.loads["t"][window.first + 1 + k],
                also={"way": abs(inside[k]), "outside": np.mean(seen < 0), "aloft": 1 - len(seen) / len(inside)})


def field(record, window):
    if record.ground != "heightfield":
        return Told()
    form = record.scenario["ground"]["heightfield"]
    rows, columns = np.shape(form["values"])
    x0, y0, _ = form.get("origin", [0, 0, 0])
    u, v = (record.com()[:, :2] - [x0, y0]).T / form["spacing"]
    beside = (u < 0) | (v < 0) | (u > columns - 1) | (v > rows - 1)
    if beside[0]:
        return Told()
    if not beside.any():
        return Told("pass")
    k = int(np.argmax(beside))
    t = record.poses["t"][k]
    return Told("warn", t, start=t, end=t, first=t, also={"x": record.com()[k, 0], "y": record.com()[k, 1], "t": t})
