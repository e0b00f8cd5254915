"""Legs of a robot and their names, `m5 rear left`: docs/modules.md (legs), docs/report.md (`feet`).
A leg is a chain without branches that is docked sideways to the spine and ends in feet below its last joint about y."""
import numpy as np

SIDEWAYS, ABOUT_Y, BESIDE = 0.7, 0.9, 1e-3  # two cosines; tolerance for two legs side by side, m


class Legs:
    """Legs of a robot. `of` is {module: name of its leg} and omits modules that belong to no leg."""

    def __init__(self, record):
        self.robot, self.of = record.robot, {}
        robot = record.robot
        docks = {int(row[1]): row for row in record.scenario["robot"].get("docks", [])}
        children = {k: [m for m, row in docks.items() if int(row[3]) == k] for k in range(robot.count)}
        still, none = np.zeros((1, 3)), np.zeros((1, len(robot.joint_names)))
        self.motion = robot.move(still, np.eye(3)[None], still, still, none, none)
        found, taken = [], set()
        for m in self.outwards(children):
            if m not in docks or m in taken or abs(self.normal(docks[m])[1]) < SIDEWAYS:
                continue
            chain = [m]
            while len(children[chain[-1]]) == 1:
                chain += children[chain[-1]]
            joints, feet = self.joints(chain), self.feet(chain[-1])
            if len(joints) < 2 or not len(feet):
                continue
            hip, ankle = joints[0], joints[-1]
            if hip[2] > ankle[2] > feet[:, 2].min():
                found.append((hip[0], hip[1] > 0, chain))
                taken |= self.below(m, children)
        if len(found) >= 4 and record.ground != "none" and record.scenario["contact"]["on"] != "none":
            self.name(found)

    def outwards(self, children):
        """Modules ordered so that every parent is before its children."""
        out, queue = [], [0]
        while queue:
            out.append(queue.pop(0))
            queue += children[out[-1]]
        return out

    def below(self, module, children):
        return {module}.union(*(self.below(child, children) for child in children[module]))

    def normal(self, row):
        """Outward normal of the parent's face at a dock, in the frame of the base."""
        face = self.robot.face(int(row[3]), row[2])
        return self.motion[f"m{int(row[3])}/{face['body']}"][1][0] @ np.array(face["normal"], float)

    def joints(self, chain):
        """Positions of the driven joints about y of a leg, from the spine outwards."""
        at = []
        for k, name in enumerate(self.robot.joint_names):
            origin, axis = self.motion.hinge[k]
            if int(name[1:].split("/")[0]) in chain and self.robot.driven[k] and abs(axis[0, 1]) > ABOUT_Y:
                at.append((chain.index(int(name[1:].split("/")[0])), k, origin[0]))
        return [origin for _, _, origin in sorted(at, key=lambda one: one[:2])]

    def feet(self, module):
        return np.array([self.motion[body][0][0] + self.motion[body][1][0] @ centre
                         for body, centre, _ in self.robot.contacts("feet").values() if body.startswith(f"m{module}/")])

    def name(self, found):
        for side in (True, False):
            legs = sorted((leg for leg in found if leg[1] == side), key=lambda leg: -leg[0])
            for rank, (_, left, chain) in enumerate(legs):
                middle = "middle" if len(legs) == 3 else f"{rank + 1}" + {1: "nd", 2: "rd"}.get(rank, "th")
                place = "front" if rank == 0 else "rear" if rank + 1 == len(legs) else middle
                self.of |= {module: f"m{chain[0]} {place} {'left' if left else 'right'}" for module in chain}

    def foot(self, body, feet):
        """Name of a recorded foot in sentences: the leg, and also the body if the leg has several feet."""
        leg = lambda one: self.of.get(int(one[1:].split("/")[0]))
        if leg(body) is None:
            return body
        return leg(body) if sum(leg(one) == leg(body) for one in feet) == 1 else f"{leg(body)}, {body}"
