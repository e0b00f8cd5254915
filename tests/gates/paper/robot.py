"""The robot of a resolved scenario: assembly by docks, poses, velocities and Jacobians of all bodies, for many rows at once.

Written from docs/numbers.md (docking, joints, names) and docs/equations.md, 1; shares no code with the program.
Arrays over rows come first: rotations (rows, 3, 3), vectors (rows, 3)."""
import numpy as np


def skew(v):
    """The matrices S with S x = v cross x."""
    zero = np.zeros(v.shape[:-1])
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    return np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1), np.stack([-y, x, zero], -1)], -2)


def turn(axis, angle):
    """Rotations about one unit axis by many angles (Rodrigues)."""
    s = skew(np.asarray(axis, float))
    angle = np.asarray(angle, float)[..., None, None]
    return np.eye(3) + np.sin(angle) * s + (1 - np.cos(angle)) * (s @ s)


def rpy(angles):
    roll, pitch, yaw = angles
    return turn([0, 0, 1], yaw) @ turn([0, 1, 0], pitch) @ turn([1, 0, 0], roll)


def from_quaternion(q):
    """Rotation matrices from body to world axes of quaternions q (rows, 4) as w, x, y, z, which need not be normalised."""
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack([
        np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
        np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
        np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1)], -2)


class Body:
    """Body with its connection to the parent body, and its properties in its own frame."""

    def __init__(self, name, data):
        self.name, self.parent, self.joint = name, None, None
        self.mass = float(data["mass"])
        self.com = np.array(data.get("com", [0, 0, 0]), float)
        xx, yy, zz, xy, xz, yz = map(float, data["inertia"])
        self.inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


class Robot:
    """bodies in an order in which every parent comes first; joint_names and ranges by joint number."""

    def __init__(self, scenario):
        section = scenario["robot"]
        self.types, self.bodies, self.by_name = section["types"], [], {}
        self.joint_names, self.ranges, self.driven = [], [], []
        docks = {int(row[1]): row for row in section.get("docks", [])}
        self.count = len(docks) + 1
        chosen = section["modules"]
        self.type_of = [self.types[chosen if isinstance(chosen, str) else chosen.get(k, chosen.get("default"))]
                        for k in range(self.count)]
        self.childless = set(range(self.count)) - {int(row[3]) for row in docks.values()}
        self.reference = {}
        for k in range(self.count):
            data = self.type_of[k]
            if k == 0:
                children = {hinge["child"] for hinge in data.get("hinges", [])}
                self.reference[k] = next(name for name in data["bodies"] if name not in children)
            else:
                self.reference[k] = self.face(k, docks[k][0])["body"]
            self.add_module(k)
        # Modules may be numbered in any order, so that a parent may appear later in the list.
        for k, (child_face, _, parent_face, parent, orientation) in docks.items():
            self.dock(k, child_face, int(parent), parent_face, int(orientation))
        self.order = []
        waiting = list(self.bodies)
        while waiting:
            ready = [b for b in waiting if b.parent is None or b.parent in self.order]
            self.order += ready
            waiting = [b for b in waiting if b not in ready]

    def face(self, module, number):
        return next(f for f in self.type_of[module]["faces"] if int(f["id"]) == int(number))

    def add_module(self, k):
        """Bodies and joints of module k, breadth-first from its reference body, siblings in file order."""
        data = self.type_of[k]
        for name, body in data["bodies"].items():
            self.by_name[f"m{k}/{name}"] = Body(f"m{k}/{name}", body)
            self.bodies.append(self.by_name[f"m{k}/{name}"])
        seen, queue = {self.reference[k]}, [self.reference[k]]
        while queue:
            near = queue.pop(0)
            for hinge in data.get("hinges", []):
                if near not in (hinge["parent"], hinge["child"]):
                    continue
                backwards = hinge["child"] == near
                far = hinge["parent"] if backwards else hinge["child"]
                if far in seen:
                    continue
                seen.add(far)
                queue.append(far)
                body = self.by_name[f"m{k}/{far}"]
                body.parent, body.joint = self.by_name[f"m{k}/{near}"], len(self.joint_names)
                axis = np.array(hinge["axis"], float)
                body.axis, body.backwards = axis / np.linalg.norm(axis), backwards
                body.origin = np.array(hinge.get("origin", [0, 0, 0]), float)
                body.rest = rpy(hinge.get("rpy", [0, 0, 0]))
                low, high = (-np.inf, np.inf) if hinge["range"] == "free" else map(float, hinge["range"])
                self.driven.append(hinge.get("drive") != "none")
                self.joint_names.append(f"m{k}/{hinge['name']}")
                self.ranges.append((-high, -low) if backwards else (low, high))

    def dock(self, k, child_face, parent, parent_face, orientation):
        """Docks a module: faces coincide and normals are opposite. The child is rotated about its outward normal, starting with
        aligned reference directions."""
        own, other = self.face(k, child_face), self.face(parent, parent_face)

        def frame(normal, reference):
            return np.stack([normal, reference, np.cross(normal, reference)], -1)

        n_c, r_c = np.array(own["normal"], float), np.array(own["reference"], float)
        n_p, r_p = np.array(other["normal"], float), np.array(other["reference"], float)
        body = self.by_name[f"m{k}/{own['body']}"]
        body.parent = self.by_name[f"m{parent}/{other['body']}"]
        quarter = turn(-n_p, orientation * np.pi / 2)
        quarter = np.where(abs(quarter - np.rint(quarter)) < 1e-12, np.rint(quarter), quarter)
        body.rest = quarter @ frame(-n_p, r_p) @ frame(n_c, r_c).T
        body.origin = np.array(other["origin"], float) - body.rest @ np.array(own["origin"], float)

    def move(self, p, rotation, v, w, q, qd):
        """Poses and velocities of all bodies, and hinges in the world, from those of base and joints (docs/equations.md, 1)."""
        out = Motion(self)
        for body in self.order:
            if body.parent is None:
                out.place(body, p, rotation, v, w)
                continue
            p_p, r_p, v_p, w_p = out[body.parent]
            if body.joint is None:
                d = r_p @ body.origin
                out.place(body, p_p + d, r_p @ body.rest, v_p + np.cross(w_p, d), w_p)
                continue
            angle, speed = q[:, body.joint], qd[:, body.joint]
            if not body.backwards:
                d, axis = r_p @ body.origin, r_p @ body.rest @ body.axis
                r = r_p @ body.rest @ turn(body.axis, angle)
                beyond = np.zeros_like(d)
            else:  # The hinge is at the frame of the parent body; the frame of the child body is displaced from it.
                d, axis = np.zeros_like(p_p), r_p @ body.axis
                r = r_p @ turn(body.axis, angle) @ body.rest.T
                beyond = -(r @ body.origin)
            w_c = w_p + axis * speed[:, None]
            out.place(body, p_p + d + beyond, r, v_p + np.cross(w_p, d) + np.cross(w_c, beyond), w_c)
            out.hinge[body.joint] = (p_p + d, axis)
        return out

    def contacts(self, on):
        """Dictionary {name: (body, centre, radius)} of all elements of the list that contact.on selects."""
        out = {}
        for k in range(self.count):
            count = {}
            for e in self.type_of[k].get("contacts", {}).get("feet" if on == "feet" else "all", []):
                kind = "point" if "point" in e else "sphere"
                number = count.get((e["body"], kind), 0)
                count[e["body"], kind] = number + 1
                out[f"m{k}/{e['body']}/{kind[0]}{number}"] = (
                    f"m{k}/{e['body']}", np.array(e[kind], float), float(e.get("radius", 0)))
        return out

    def joints_to(self, body):
        """Numbers of the joints between the base and a body, including the joint of the body."""
        out = []
        while body is not None:
            out += [] if body.joint is None else [body.joint]
            body = body.parent
        return out


class Motion:
    """Poses and velocities of all bodies in world axes, and derived quantities. The first index of arrays is the row."""

    def __init__(self, robot):
        self.robot, self.pose, self.hinge = robot, {}, {}

    def place(self, body, *pose):
        self.pose[body.name] = pose

    def __getitem__(self, body):
        """Tuple (p, R, v, w) of a body. p and v are position and velocity of the origin of the body's frame."""
        return self.pose[body if isinstance(body, str) else body.name]

    def com(self, body):
        """Centre of mass of a body and its velocity."""
        p, r, v, w = self[body]
        d = r @ body.com
        return p + d, v + np.cross(w, d)

    def spin(self, body):
        """Angular momentum R I R^T omega and inertia tensor R I R^T of a body."""
        _, r, _, w = self[body]
        inertia = r @ body.inertia @ np.swapaxes(r, -1, -2)
        return np.einsum("nij,nj->ni", inertia, w), inertia

    def jacobian(self, body, x):
        """Jacobians (rows, 3, 6 + joints) of the velocity of the body's material point at x, and of its angular velocity."""
        base = self.robot.order[0]
        p = self[base][0]
        linear = np.zeros((len(x), 3, 6 + len(self.robot.joint_names)))
        angular = np.zeros_like(linear)
        linear[:, :, :3], linear[:, :, 3:6], angular[:, :, 3:6] = np.eye(3), -skew(x - p), np.eye(3)
        for joint in self.robot.joints_to(body):
            point, axis = self.hinge[joint]
            linear[:, :, 6 + joint], angular[:, :, 6 + joint] = np.cross(axis, x - point), axis
        return linear, angular

    def equations(self, gravity, qd):
        """Mass matrix and bias of M v' + c = generalised forces, with gravity in the bias. The equations of Newton and Euler for every
        body are projected by its Jacobians (Kane), without recursion."""
        size = 6 + qd.shape[1]
        mass, bias = np.zeros((len(qd), size, size)), np.zeros((len(qd), size))
        zero = np.zeros((len(qd), 3))
        drift = {}  # accelerations at v' = 0 of the frame's origin, and angular accelerations
        for body in self.robot.order:
            p, _, _, w = self[body]
            a, alpha = zero, zero
            if body.parent is not None:
                p_p, _, _, w_p = self[body.parent]
                a_p, alpha_p = drift[body.parent.name]
                point = p if body.joint is None else self.hinge[body.joint][0]
                a = a_p + np.cross(alpha_p, point - p_p) + np.cross(w_p, np.cross(w_p, point - p_p))
                alpha = alpha_p
                if body.joint is not None:
                    alpha = alpha_p + np.cross(w_p, self.hinge[body.joint][1] * qd[:, body.joint, None])
                    a = a + np.cross(alpha, p - point) + np.cross(w, np.cross(w, p - point))
            drift[body.name] = a, alpha
            c, _ = self.com(body)
            a_c = a + np.cross(alpha, c - p) + np.cross(w, np.cross(w, c - p)) - gravity
            momentum, inertia = self.spin(body)
            linear, angular = self.jacobian(body, c)
            mass += body.mass * np.einsum("nki,nkj->nij", linear, linear)
            mass += np.einsum("nki,nkl,nlj->nij", angular, inertia, angular, optimize=True)
            torque = np.einsum("nij,nj->ni", inertia, alpha) + np.cross(w, momentum)
            bias += body.mass * np.einsum("nki,nk->ni", linear, a_c) + np.einsum("nki,nk->ni", angular, torque)
        return mass, bias
