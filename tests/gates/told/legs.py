"""Legs of a robot and their names, `rear left`: docs/modules.md (legs), docs/report.md (`feet`)."""
import numpy as np

STANDS, EQUAL, MIDLINE, FLAT = 0.1, 0.01, 0.15, 1e-3  # share of the height; m; share of the widest or longest; m


class Legs:
    """Legs of a robot. `of` is {body: name of its leg} and omits bodies that belong to no leg."""

    def __init__(self, record):
        self.robot, self.of = record.robot, {}
        if record.scenario["robot"]["base"] == "fixed" or record.ground == "none" or record.scenario["contact"]["on"] == "none":
            return
        still = np.zeros((1, 3))
        base = record.rotation()[:1]
        q = record.pose("angle")[:1]
        if "angles" not in record.scenario["initial"]:  # the start follows from the gait, and the gait from the legs at 0
            q = np.array([[min(max(0.0, low), high) for low, high in record.robot.ranges]])
        self.at = self.robot.move(still, base, still, still, q, np.zeros_like(q))
        self.zero = self.robot.move(still, np.eye(3)[None], still, still, np.zeros_like(q), np.zeros_like(q))
        self.gather()
        stated = record.scenario["robot"].get("legs")
        if isinstance(stated, dict):
            for name, body in stated.items():
                chain = self.chain(self.link[body])
                self.of |= {one: name.replace("_", " ") for one, link in self.link.items() if link in chain}
        chains = [] if stated else self.standing()
        if chains:
            self.name(chains, base[0][2])

    def gather(self):
        """Links: bodies that docks hold together, by the joint that moves them (None: the base)."""
        self.link, self.parent = {}, {None: None}
        for body in self.robot.order:
            self.link[body.name] = self.link[body.parent.name] if body.parent and body.joint is None else body.joint
            if body.joint is not None:
                self.parent[body.joint] = self.link[body.parent.name]
        self.children = {link: [one for one in self.parent if one is not None and self.parent[one] == link] for link in self.parent}
        self.low, high, self.elements = {}, [], {}
        for body, centre, radius in self.robot.contacts("all").values():
            position, rotation = self.at[body][0][0], self.at[body][1][0]
            z = (position + rotation @ centre)[2] - radius
            link = self.link[body]
            self.low[link] = min(z, self.low.get(link, np.inf))
            self.elements.setdefault(link, []).append((body, centre, radius, z))
            high.append(z + 2 * radius)
        self.ground = min(self.low.values()) + STANDS * (max(high) - min(self.low.values())) if self.low else 0

    def wheel(self, link):
        low, upper = self.robot.ranges[link]
        if np.isfinite(low) or np.isfinite(upper) or len(self.elements[link]) != 1:
            return False
        body, centre, radius, _ = self.elements[link][0]
        origin, axis = self.zero.hinge[link]
        position, rotation = self.zero[body][0][0], self.zero[body][1][0]
        return radius > 0 and np.linalg.norm(np.cross(position + rotation @ centre - origin[0], axis[0])) < FLAT

    def chain(self, end):
        chain = [end]
        while self.parent[chain[0]] is not None and len(self.children[self.parent[chain[0]]]) == 1:
            chain.insert(0, self.parent[chain[0]])
        return chain

    def chains(self):
        """Chains of links from the trunk outwards, each with the distances between its joints."""
        for end in self.parent:
            if end is None or self.children[end] or end not in self.low or self.wheel(end):
                continue
            chain = self.chain(end)
            if any(self.robot.driven[joint] for joint in chain):
                at = [self.zero.hinge[joint][0][0] for joint in chain]
                at.append(self.sole(end))
                yield chain, [np.linalg.norm(b - a) for a, b in zip(at, at[1:])]

    def standing(self):
        chains = list(self.chains())
        equal = lambda a, b: len(a[1]) == len(b[1]) and all(abs(x - y) <= EQUAL for x, y in zip(a[1], b[1]))
        models = [chain for chain in chains if self.low[chain[0][-1]] <= self.ground]
        count = lambda: sum(any(equal(model, chain) for model in models) for chain in chains)
        if count() < 2:
            groups = [(sum(equal(one, other) for other in chains), -k) for k, one in enumerate(chains) if len(one[0]) > 1]
            most = max(groups, default=(0, 0))
            models = [chains[-most[1]]] if most[0] >= 4 else []
        elif len(chains) == 2 and self.low.get(None, np.inf) <= self.ground:
            models = []
        found = [chain for chain in chains if any(equal(model, chain) for model in models)]
        return [chain for chain, _ in found] if len(found) > 1 else []

    def foot(self, body, feet):
        """Name of a recorded foot in sentences: the leg, and also the body if the leg has several feet."""
        leg = self.of.get(body)
        if leg is None:
            return body
        return leg if sum(self.of.get(one) == leg for one in feet) == 1 else f"{leg}, {body}"

    def name(self, chains, up):
        forward = np.array([1.0, 0, 0]) - up * up[0]
        if np.linalg.norm(forward) < 0.5:
            forward = np.array([0, 1.0, 0]) - up * up[1]
        forward /= np.linalg.norm(forward)
        hips = np.array([self.zero.hinge[chain[0]][0][0] for chain in chains])
        place = lambda points: np.stack([points @ forward, points @ np.cross(up, forward)], -1) - np.mean(
            np.stack([points @ forward, points @ np.cross(up, forward)], -1), axis=0)
        at = place(hips)
        if np.linalg.norm(at, axis=1).max() <= FLAT:
            at = place(np.array([self.sole(chain[-1]) for chain in chains]))
        longest, widest = abs(at).max(axis=0)
        side = [0 if abs(y) < MIDLINE * widest or widest < FLAT else 1 if y > 0 else -1 for _, y in at]
        for here, word in ((1, " left"), (0, ""), (-1, " right")):
            own = sorted((k for k, one in enumerate(side) if one == here), key=lambda k: -at[k][0])
            for rank, k in enumerate(own):
                if len(own) == 1:
                    name = "middle" if abs(at[k][0]) <= MIDLINE * longest else "front" if at[k][0] > 0 else "rear"
                elif rank in (0, len(own) - 1):
                    name = "rear" if rank else "front"
                else:
                    name = "middle" if len(own) == 3 else f"{rank + 1}" + ("th" if 9 < rank < 13 else {1: "st", 2: "nd", 3: "rd"}.get((rank + 1) % 10, "th"))
                self.of |= {body: name + word for body, link in self.link.items() if link in chains[k]}

    def sole(self, link):
        """Mean of the lowest elements of a link at the start, at zero angles."""
        lowest = [self.zero[body][0][0] + self.zero[body][1][0] @ centre for body, centre, _, z in self.elements[link]
                  if z <= self.low[link] + FLAT]
        return np.mean(lowest, axis=0)
