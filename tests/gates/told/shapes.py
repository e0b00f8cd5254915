"""Shapes of bodies by their support functions: how deep bodies are in a plane, and in one another.

The way out of a convex body is the least overlap over all directions; here over directions of a grid, then about the best of
them, where the program tries the products of edges. Round shapes are prisms of 24 sides, with corners every 15 degrees from the
x axis on (report/analysis/convex.h)."""
from fnmatch import fnmatchcase

import numpy as np

from paper.robot import rpy

CORNERS = np.arange(24) * np.pi / 12


class Shape:
    def __init__(self, data):
        self.kind = next(k for k in ("box", "cylinder", "half_cylinder", "sphere", "hull") if k in data)
        self.size = np.atleast_1d(np.array(data[self.kind], float))
        self.origin, self.turn = np.array(data.get("origin", [0, 0, 0]), float), rpy(data.get("rpy", [0, 0, 0]))
        if self.kind == "hull":
            return
        half = self.kind == "half_cylinder"  # the half at positive x
        at = CORNERS[np.cos(CORNERS) > -1e-9] if half else CORNERS
        self.corners = self.size[0] * np.stack([np.cos(at), np.sin(at)])

    def support(self, d):
        """Support function of the shape for directions (n, 3) in the body's frame."""
        local = d @ self.turn
        if self.kind == "box":
            reach = np.abs(local) @ (self.size / 2)
        elif self.kind == "hull":
            reach = (local @ self.size.T).max(1)
        elif self.kind == "sphere":
            reach = self.size[0] * np.linalg.norm(d, axis=1)
        else:
            _, length = self.size
            across = (local[:, [0, 2]] @ self.corners).max(1)
            reach = across + np.abs(local[:, 1]) * length / 2
        return reach + d @ self.origin


def shapes(record):
    """Shapes by body, for all bodies with shapes."""
    out = {}
    for k in range(record.robot.count):
        for name, body in record.robot.type_of[k]["bodies"].items():
            if body.get("shape"):
                out[f"m{k}/{name}"] = [Shape(one) for one in body["shape"]]
    return out


def depths(record):
    """Dictionary {body: depths below the plane z = 0 at the control ticks}."""
    out, motion, down = {}, record.motion(), np.array([0, 0, -1.0])
    for body, parts in shapes(record).items():
        p, r, _, _ = motion[body]
        out[body] = np.max([part.support(down @ r) for part in parts], 0) - p[:, 2]
    return out


def directions(count):
    k = np.arange(count) + 0.5
    z, phi = 1 - 2 * k / count, k * 2.399963229728653
    return np.stack([np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z], -1)


EVERYWHERE, NEAR = directions(500), directions(80)


def penetration(parts_a, parts_b, pose_a, pose_b, ignored):
    """Depth of overlap of two bodies, m: the largest of the shortest ways out of each other of any two shapes; 0 if it is at most
    `ignored`. The search samples all directions, then finer ones about the best, down to 0.6^30 of 0.1 rad: with 0.4^9 it was 7 um
    too large in a ridge between two faces."""
    (pa, ra), (pb, rb) = pose_a, pose_b
    deepest = ignored
    for a in parts_a:
        for b in parts_b:
            overlap = lambda d: a.support(d @ ra) + b.support(-d @ rb) + d @ (pa - pb)
            values = overlap(EVERYWHERE)
            best, at, spread = values.min(), EVERYWHERE[np.argsort(values)[:6]], 0.1  # the minimum may be near any of the six best
            for _ in range(30):
                if best <= deepest:
                    break
                near = (at[:, None, :] + spread * NEAR[None, :, :]).reshape(-1, 3)
                near = np.concatenate([near / np.linalg.norm(near, axis=1)[:, None], at])
                values = overlap(near).reshape(-1)
                group = np.concatenate([np.repeat(np.arange(len(at)), len(NEAR)), np.arange(len(at))])
                at = np.stack([near[group == g][np.argmin(values[group == g])] for g in range(len(at))])
                best, spread = min(best, values.min()), spread * 0.6
            deepest = max(deepest, best)
    return deepest if deepest > ignored else 0.0


def bound(parts_a, parts_b, pose_a, pose_b):
    """Upper bound of the penetration for all rows, from the axes of both bodies and the line between them."""
    (pa, ra), (pb, rb) = pose_a, pose_b
    most = np.full(len(pa), -np.inf)
    between = (pa - pb) / np.maximum(np.linalg.norm(pa - pb, axis=1), 1e-9)[:, None]
    axes = [r[:, :, k] * sign for r in (ra, rb) for k in range(3) for sign in (1, -1)] + [-between, between]
    for a in parts_a:
        for b in parts_b:
            least = np.full(len(pa), np.inf)
            for d in axes:
                own, other = np.einsum("nij,ni->nj", ra, d), np.einsum("nij,ni->nj", rb, -d)
                least = np.minimum(least, a.support(own) + b.support(other) + np.einsum("ni,ni->n", d, pa - pb))
            most = np.maximum(most, least)
    return most


def at_zero(data):
    """{body: (place, turn)} of a module type with all hinges at 0, in the frame of its root."""
    hinges = data.get("hinges", [])
    poses = {name: (np.zeros(3), np.eye(3)) for name in data["bodies"] if name not in {h["child"] for h in hinges}}
    while len(poses) < len(data["bodies"]):
        for hinge in hinges:
            if hinge["parent"] in poses:
                p, r = poses[hinge["parent"]]
                poses[hinge["child"]] = p + r @ np.array(hinge.get("origin", [0, 0, 0]), float), r @ rpy(hinge.get("rpy", [0, 0, 0]))
    return poses


class OneModule:
    """What bodies of one module may overlap: pairs of may_overlap anything, others sqrt(2) of what they do at angles 0."""

    def __init__(self, record, found):
        self.robot, self.found, self.known = record.robot, found, {}
        self.of_robot = record.scenario["robot"].get("may_overlap", [])

    def left_out(self, a, b):
        (ma, own), (mb, other) = a.split("/"), b.split("/")
        rules = [(a, b, pair) for pair in self.of_robot]
        if ma == mb:
            rules += [(own, other, pair) for pair in self.robot.type_of[int(ma[1:])].get("may_overlap", [])]
        return any(fnmatchcase(x, p) and fnmatchcase(y, q) for x, y, pair in rules for p, q in (pair, pair[::-1]))

    def design(self, a, b):
        (ma, own), (mb, other) = a.split("/"), b.split("/")
        if ma != mb:
            return 0.0
        data = self.robot.type_of[int(ma[1:])]
        key = id(data), own, other
        if key not in self.known:
            poses = at_zero(data)
            self.known[key] = np.sqrt(2) * penetration(self.found[a], self.found[b], poses[own], poses[other], 0.0)
        return self.known[key]


class Collisions:
    """Collisions of bodies that can move relative to each other. `pairs` is {(a, b): (depth, time)} for pairs deeper than
    limits.touch, beyond their overlap by design; `first` is the time of the first collision with its bodies."""

    def __init__(self, record):
        found, motion, robot, t = shapes(record), record.motion(), record.robot, record.poses["t"]
        touch, link = record.limits["touch"], {}
        self.shaped, self.pairs, self.first, self.first_bodies = len(found), {}, np.inf, set()
        for body in robot.order:  # docked bodies belong to one link
            link[body.name] = link[body.parent.name] if body.parent is not None and body.joint is None else body.name
        own = OneModule(record, found)
        names = [b.name for b in robot.order if b.name in found]
        reach = {n: max(np.linalg.norm(part.origin) + np.linalg.norm(part.size) for part in found[n]) for n in names}
        for i, a in enumerate(names):
            for b in names[i + 1:]:
                if link[a] == link[b] or own.left_out(a, b):
                    continue
                (pa, ra), (pb, rb) = motion[a][:2], motion[b][:2]
                rows = np.flatnonzero(np.linalg.norm(pa - pb, axis=1) < reach[a] + reach[b])
                if not len(rows):
                    continue
                most = bound(found[a], found[b], (pa[rows], ra[rows]), (pb[rows], rb[rows]))
                design = own.design(a, b)
                most = most - design
                self.pair(a, b, found, motion, rows[most > touch], most[most > touch], touch, t, design)

    def pair(self, a, b, found, motion, rows, most, touch, t, design):
        poses = lambda row: [(motion[n][0][row], motion[n][1][row]) for n in (a, b)]
        depth = lambda row: max(0.0, penetration(found[a], found[b], *poses(row), touch + design) - design)
        best, when, seen = 0.0, np.nan, {}
        for k in np.argsort(-most):
            if most[k] <= best:
                break
            seen[k] = depth(rows[k])
            if seen[k] > best:
                best, when = seen[k], t[rows[k]]
        if best <= touch:
            return
        self.pairs[a, b] = best, when
        for k in np.argsort(rows):  # ordered by time
            if t[rows[k]] > self.first:
                break
            d = seen.get(k)
            if (depth(rows[k]) if d is None else d) > touch:
                self.first_bodies = {a, b} | (self.first_bodies if t[rows[k]] == self.first else set())
                self.first = t[rows[k]]
                break
