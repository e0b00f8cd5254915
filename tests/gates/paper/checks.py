"""Every equation against the columns of a run, sample by sample. Each check names the lines of LINES that it tests."""
import numpy as np

from paper import gaits, laws
from paper.laws import EPS
from paper.robot import from_quaternion, rpy

# Lines by key: compared quantity, tolerance, reason for the tolerance. Residuals are relative to the added terms unless stated otherwise.
FEW = 16 * EPS, "at most eight operations a side, each of which rounds by half of 2.2e-16"
CHAIN = 4e-14, "up to 17 hinges between base and body, ten roundings of 2.2e-16 at each, of lengths below 1 m"
SUMS = 4e-14, "as the poses; the sums over bodies are of positive terms or relative to these"
LINES = {
    "eq. 1": ("current = (u - Ks n w) / R, |u| <= u_max, |i| <= i_max", *FEW),
    "eq. 1, terminals": ("voltage = R i + Ks n w", *FEW),
    "eq. 1, limits": ("saturation 0, 1, 2 (samples that differ)", 0, "a choice, no arithmetic"),
    "eq. 2": ("torque = eta Kt i n", *FEW),
    "eq. 2, directional": ("torque = eta^s Kt i n, s = w sign(i) / w_t or sign(w i)", 64 * EPS, "eight operations and a power, good to some units"),
    "torque at rest": ("between eta Kt i n - F and Kt i n / eta + F", 1e-8, "torques of a solve are 1e-9 of the largest at rest"),
    "eq. 3": ("command of joints with Kp alone", *FEW),
    "eq. 4": ("command less Kp e, of joints without Kd: I and anti-windup", 2e-13, "one rounding a tick, up to 800 ticks"),
    "eq. 5": ("command less Kp e, of joints without Ki: D", 2e-13, "as eq. 4"),
    "eq. 6": ("command = P + I + D of all joints", 2e-13, "as eq. 4"),
    "eq. 7": ("phases, by RK4 at cpg.step", 1e-12, "up to 4000 stages, one rounding of 2.2e-16 each"),
    "eq. 7, limit cycle": ("phases, closed form 2 pi f t + sum of lags", 1e-12, "as eq. 7: on a line RK4 is exact"),
    "eq. 7, refined": ("phases off the limit cycle, by RK4 at a sixteenth of cpg.step", 1,
                       "in units of the method's own error, which is 16/15 of what halving the step changes; twice that"),
    "eq. 8": ("amplitudes, by RK4 at cpg.step", 1e-12, "as eq. 7"),
    "eq. 8, exact": ("amplitudes, closed form R (1 - exp(-a t))", 1, "in units of RK4's error, t a (a h)^4 / 120 exp(-a t) R; twice that"),
    "eq. 9": ("offsets, by RK4 at cpg.step", 1e-12, "as eq. 7"),
    "eq. 10": ("set points = x + r sin(phi), from the columns of the states", *FEW),
    "cpg kuramoto_amplitude": ("states by RK4, set points", 1e-12, "as eq. 7"),
    "cpg hopf": ("states by RK4, set points", 1e-12, "as eq. 7"),
    "gait sine": ("set points on the limit cycle", 1e-13, "the phase, up to 200 rad, rounds by 3e-14"),
    "gait tripod": ("set points of figure 11", 1e-13, "the phase of the cycle, up to 10 turns, rounds by 2e-15; slopes below 10"),
    "gait keyframes": ("set points of lines and cubic splines", 1e-13, "solving for six frames loses one digit, time of 5 s another"),
    "no gait": ("set points = initial angles", 0, "copied"),
    "eq. 12, penetration": ("penetration against plane and boxes, m", *CHAIN),
    "eq. 12, normal": ("Fn = Kn p^k + Cd p^d p', at p of the trace", 1e-13, "p' of up to 17 hinges, relative to the speeds that it sums"),
    "eq. 12, friction": ("Ft = -f Fn v / max(|v|, v_lim), all components", 1e-13, "as the normal force"),
    "hinge stop": ("stop torque", *FEW),
    "poses": ("body.*, from base, joint angles and docks; m and cosines", *CHAIN),
    "com": ("com.*, m", *SUMS),
    "momentum": ("momentum.*", *SUMS),
    "angular momentum": ("angular_momentum.*", *SUMS),
    "kinetic energy": ("energy.kinetic", *SUMS),
    "potential energy": ("energy.potential", *SUMS),
    "stored": ("kinetic, rotors and potential, less those at the start", *SUMS),
    "ledger": ("electrical - copper - gear - stored - contact - friction - stops - residual", *FEW),
    "hinge moments": ("reaction along the axis = motor + stop torque", 1e-9,
                      "inverse dynamics of accelerations that forces of 100 N gave to inertias of 1e-4 kg m^2: six digits are lost"),
    "ledger, motors": ("electrical, copper and gear, step by step", 1e-13, "relative to the powers that are summed"),
    "ledger, ground": ("contact and friction, step by step", 1e-13, "as eq. 12; the sum so far may round by four units more"),
    "ledger, implicit": ("contact and friction, away from corners, at the mean of two velocities", 1e-13, "as ledger, ground"),
    "ledger, stops": ("stops, step by step, J", 1e-15, "the sum so far may round by four units; what one step adds is below 1e-3 J"),
    "motion, velocities": ("M (v+ - v) / h = forces - bias, every step", 64 * EPS, "relative to M v / h and the terms that are summed"),
    "motion, implicit": ("the same with forces at the velocity of the step's end", 64 * EPS, "as the explicit one"),
    "motion, rk4": ("velocities after a classical Runge-Kutta step, accelerations from Newton and Euler, m/s and rad/s", 1e-11,
                    "h a of up to 1 rad/s, of which solving for a loses the condition of M, up to 1e4, times 2.2e-16"),
    "motion, positions": ("q+ = q + h qd+, x+ = x + h v+, turned by h omega+", 1e-14, "one addition; quaternions to four roundings"),
}


class Gate:
    """Largest residual of every line, its place, and the number of samples."""

    def __init__(self):
        self.worst, self.where, self.count, self.seen = {}, {}, {}, {}

    def see(self, key, run, difference, scale=1.0, where=None):
        difference = np.abs(np.asarray(difference, float))
        scale = np.broadcast_to(np.asarray(scale, float), difference.shape)
        with np.errstate(invalid="ignore", divide="ignore"):
            residual = np.where(difference == 0, 0.0, difference / scale)
        if where is not None:
            residual = residual[np.broadcast_to(where, residual.shape)]
        if not residual.size:
            return
        residual = np.where(np.isnan(residual), np.inf, residual)
        self.count[key] = self.count.get(key, 0) + residual.size
        if residual.max() >= self.worst.get(key, -1):
            self.worst[key], self.where[key] = float(residual.max()), run.name

    def cover(self, key, run, count):
        """Counts samples of a situation that must occur in some run, because the gate would otherwise pass without a test."""
        self.seen[key] = self.seen.get(key, 0) + int(count)

    def red(self, key):
        return key in self.worst and not self.worst[key] <= LINES[key][1]


def motors(gate, run, rules):
    if run.scenario["actuator"]["type"] == "none":
        return
    motor, w, command = laws.Motor(run), run.joints("speed"), run.joints("voltage_command")
    if motor.type == "torque":
        limited = np.clip(command, -motor.limit, motor.limit)
        gate.see("eq. 2", run, run.joints("torque") - limited, np.abs(limited))
        gate.see("eq. 1, limits", run, run.joints("saturation") != np.where(np.abs(command) > motor.limit, 2, 0))
        return
    emf = np.abs(motor.Ks * motor.n * w)
    i, saturation = motor.current(command, w)
    gate.see("eq. 1", run, run.joints("current") - i, (np.minimum(np.abs(command), motor.u_max) + emf) / motor.R)
    # A current that equals its limit up to rounding errors may count as limited or not.
    clear = np.abs(np.abs(motor.R * i) - motor.R * motor.i_max) > 64 * EPS * (np.abs(command) + emf)
    clear |= saturation == 2
    gate.see("eq. 1, limits", run, run.joints("saturation") != saturation, where=clear)
    i = run.joints("current")
    gate.see("eq. 1, terminals", run, run.joints("voltage") - (motor.R * i + motor.Ks * motor.n * w), motor.R * np.abs(i) + emf)
    torque = motor.torque(i, w)
    jumps = (motor.directional | (motor.dry > 0)) & (not motor.explicit)
    turns = ~(jumps & (w == 0))
    size = np.abs(torque - motor.friction(w)) + np.abs(motor.friction(w))
    gate.see("eq. 2, directional" if motor.directional else "eq. 2", run, run.joints("torque") - torque, size, where=turns)
    least, most = motor.at_rest(i)
    beyond = np.maximum(least - run.joints("torque"), run.joints("torque") - most)
    gate.see("torque at rest", run, np.maximum(beyond, 0), np.abs(least) + np.abs(most), where=~turns)
    gate.cover("joints that stick", run, (~turns).sum())
    gate.cover("motors below their limits", run, (saturation == 0).sum())
    gate.cover("motors at the voltage limit", run, (saturation == 1).sum())
    gate.cover("motors at the current limit", run, (saturation == 2).sum())
    if motor.directional:
        gate.cover("directional gears driven backwards", run, (w * i < 0).sum())


def controllers(gate, run, rules):
    if run.scenario["actuator"]["type"] == "none":
        return
    section, ticks = run.scenario["controller"], run.ticks()
    command = run.joints("voltage_command")[ticks + 1]
    if section["type"] == "hold":
        gate.see("eq. 6", run, command - run.per_joint(section["command"]))
        return
    gains = [run.per_joint(section[key]) for key in ("Kp", "Ki", "Kd", "N")]
    _, Ki, Kd, _ = gains
    error = run.joints("setpoint")[ticks + 1] - run.joints("angle")[ticks]
    limit = laws.Motor(run).command_limit
    P, I, D, u = laws.pid(error, gains, section["period"], limit, section["anti_windup"], rules.get("anti-windup", "last"),
                          rules.get("derivative", 1))
    scale = np.maximum.accumulate(np.abs(P) + np.abs(I) + np.abs(D))
    gate.see("eq. 3", run, command - P, scale, (Ki == 0) & (Kd == 0))
    gate.see("eq. 4", run, command - P - I, scale, (Ki != 0) & (Kd == 0))
    gate.see("eq. 5", run, command - P - D, scale, (Ki == 0) & (Kd != 0))
    gate.see("eq. 6", run, command - u, scale)
    gate.cover("integrals held by anti-windup", run,
               ((np.diff(I, axis=0) == 0) & (Ki != 0) & (error[:-1] != 0)).sum() if section["anti_windup"] else 0)
    gate.cover("integrals without anti-windup", run, 0 if section["anti_windup"] or not Ki.any() else len(u))


def patterns(gate, run, rules):
    if run.scenario["actuator"]["type"] == "none":
        return
    cpg, ticks = run.scenario.get("cpg"), run.ticks()
    section = run.scenario["controller"]
    t, setpoint = run["t"][ticks], run.joints("setpoint")[ticks + 1]
    gate.see("no gait" if cpg is None else "eq. 10", run, run.joints("setpoint")[:1] - run.joints("angle")[:1])
    if cpg is None:
        gate.see("no gait", run, setpoint - run.per_joint(run.scenario["initial"]["angles"]))
    elif cpg["type"] in ("phase_oscillator", "equations"):
        network = gaits.Network(run)
        states = network.integrate(len(ticks), section["period"], cpg["step"])
        columns = state_columns(run, network, ticks)
        largest = np.maximum.accumulate(np.abs(states).max(2, keepdims=True)) + 1
        for k, key in enumerate(("eq. 7", "eq. 8", "eq. 9")):
            gate.see(key, run, columns[:, k] - states[:, k], largest[:, k])
        phi, r, x = states_of = np.moveaxis(columns, 1, 0)
        asked = network.output(states_of, rules.get("sin", np.sin))
        gate.see("eq. 10", run, setpoint - asked, np.abs(x) + np.abs(r) * (1 + np.abs(phi)))
        along = network.start + network.omega * t[:, None]
        if np.allclose(states[:, 0], along, atol=1e-9):
            gate.see("eq. 7, limit cycle", run, phi - along, np.abs(along) + 1)
        else:
            halved = network.integrate(len(ticks), section["period"], cpg["step"] / 2)
            fine = network.integrate(len(ticks), section["period"], cpg["step"] / 16)
            own = np.abs(states[:, 0] - halved[:, 0]).max() * 16 / 15
            gate.see("eq. 7, refined", run, phi - fine[:, 0], 2 * own + 1e-12 * np.abs(phi).max())
            gate.cover("phases off the limit cycle", run, len(ticks))
        a, at = network.a_r, network.a_r * t[:, None]
        bound = 2 * at * (a * cpg["step"]) ** 4 / 120 * np.exp(-at) * np.abs(network.R)
        gate.see("eq. 8, exact", run, r - network.R * -np.expm1(-at), bound + 1e-12)
    elif cpg["type"] in ("kuramoto_amplitude", "hopf"):
        network = {"hopf": gaits.Hopf, "kuramoto_amplitude": gaits.Kuramoto}[cpg["type"]](run)
        states, columns = network.integrate(len(ticks), section["period"], cpg["step"]), state_columns(run, network, ticks)
        asked = network.output(np.moveaxis(columns, 1, 0))
        gate.see(f"cpg {cpg['type']}", run, columns - states, 1 + np.abs(states).max())
        gate.see(f"cpg {cpg['type']}", run, setpoint - asked, 1 + np.abs(asked))
    elif cpg["type"] in ("sine", "tripod", "keyframes"):
        gate.see(f"gait {cpg['type']}", run, setpoint - getattr(gaits, cpg["type"])(run, t))


def state_columns(run, network, ticks):
    """Array (ticks, names, joints) of the state columns."""
    return np.stack([np.stack([run[f"cpg.{name}.{j}"] for j in range(run.n)], -1)[ticks] for name in network.names], 1)


class Touch:
    """One contact element in all rows: material point, its velocity, penetration, normal and friction coefficient.
    plain: rows in which the element touches only the plane or only one box (several boxes: docs/equations.md, 6, Boxes)."""

    def __init__(self, run, body, centre, radius):
        p, rotation, v, w = run.motion()[body]
        c = p + rotation @ centre
        ground = run.scenario["ground"]
        self.p, self.f = radius - c[:, 2], np.full(len(c), float(ground["friction"]))
        self.normal = np.broadcast_to([0.0, 0, 1], c.shape).copy()
        self.plain = np.ones(len(c), bool)
        for box in ground.get("boxes", []):
            turned, size = rpy(box["rpy"]), np.array(box["size"], float)
            local = (c - np.array(box["center"], float)) @ turned
            depth = np.stack([size / 2 - local, size / 2 + local], 1)  # depth of the centre below the faces +x, +y, +z; -x ...
            inside = (depth > 0).all((1, 2))
            depth[:, 1, 2] = np.where(inside, np.inf, depth[:, 1, 2])  # excludes the lower face if it is inside the plane
            flat = depth.reshape(-1, 6)
            face = flat.argmin(1)
            direction = np.concatenate([turned.T, -turned.T])[face]
            # Omitted are elements in several boxes, near an edge with equal depths below two faces, and spheres near a box.
            near = (np.abs(local) < size / 2 + radius).all(1)
            self.plain &= ~near | (inside & (self.p <= 0) & (radius == 0))
            self.p = np.where(inside, flat.min(1), self.p)
            self.normal[inside] = direction[inside]
            self.f = np.where(inside, float(box["friction"]), self.f)
            self.boxed = inside | getattr(self, "boxed", False)
        self.point = c - radius * self.normal
        self.v = v + np.cross(w, self.point - p)
        self.rate = -(self.v * self.normal).sum(1)
        self.tangential = self.v + self.rate[:, None] * self.normal
        self.body = run.robot.by_name[body]


def elements(run):
    """List of (number, name, Touch) for all contact columns."""
    known = run.robot.contacts(run.scenario["contact"]["on"])
    number = 0
    while f"contact.{number}.fn" in run.index:
        name = run.definitions[f"contact.{number}.fn"].split()[-1]
        yield number, name, Touch(run, *known[name])
        number += 1


def contacts(gate, run, rules):
    law = run.scenario["contact"]
    base = run.motion()[run.robot.order[0]]
    speed = np.linalg.norm(base[2], axis=1) + np.linalg.norm(base[3], axis=1) + np.abs(run.joints("speed")).sum(1) + 1e-6
    for number, name, touch in elements(run):
        column = f"contact.{number}."
        p, ok = run[column + "penetration"], touch.plain
        gate.see("eq. 12, penetration", run, p - np.maximum(touch.p, 0), where=ok)
        fn, spring, damper = laws.normal_force(p, touch.rate, law)
        gate.see("eq. 12, normal", run, run[column + "fn"] - fn, spring + damper * speed, ok)
        force = laws.friction(fn, touch.tangential, touch.f, law["slip_speed"]) + fn[:, None] * touch.normal
        slip = np.linalg.norm(touch.tangential, axis=1)
        scale = (spring + damper * speed) * (1 + touch.f * (1 + speed / np.maximum(slip, law["slip_speed"])))
        gate.see("eq. 12, friction", run, run.vector(column + "f", "xyz") - force, scale[:, None], ok[:, None])
        kind = "points" if name.split("/")[-1][0] == "p" else "spheres"
        on = ok & (fn > 0)
        gate.cover(f"{kind} that stick", run, (on & (slip <= law["slip_speed"])).sum())
        gate.cover(f"{kind} that slide", run, (on & (slip > law["slip_speed"])).sum())
        gate.cover("contacts that would pull", run, (ok & (p > 0) & (fn == 0)).sum())
        gate.cover("contacts on boxes", run, (on & getattr(touch, "boxed", False)).sum())
        gate.cover("Hertz contacts", run, on.sum() if law["exponent"] == 1.5 else 0)


def stops(gate, run, rules):
    q, qd, ranges = run.joints("angle"), run.joints("speed"), np.array(run.robot.ranges)
    torque = laws.stop(q, qd, ranges, **rules.get("stop", {}))
    excess = np.maximum(np.maximum(q - ranges[:, 1], ranges[:, 0] - q), 0)
    # The rounding error of the excess is that of a difference of two angles.
    scale = laws.STOP_STIFFNESS * (excess + np.abs(q)) + laws.STOP_DAMPING * np.abs(qd)
    gate.see("hinge stop", run, run.joints("stop_torque") - torque, scale)
    gate.cover("stops that push", run, (torque != 0).sum())
    gate.cover("stops that would pull", run, ((excess > 0) & (torque == 0)).sum())


def bodies(gate, run, rules):
    motion, robot = run.motion(), run.robot
    momentum, spin, kinetic, weighted, mass = 0, 0, 0, 0, sum(body.mass for body in robot.order)
    size, speed = 0, 0
    for body in robot.order:
        p, rotation, v, w = motion[body]
        gate.see("poses", run, p - run.vector(f"body.{body.name}.", "xyz"), 1 + np.abs(p))
        gate.see("poses", run, rotation - from_quaternion(run.vector(f"body.{body.name}.q", "wxyz")))
        if body.parent is None and run.scenario["robot"]["base"] == "fixed":
            v = w = np.zeros_like(v)
        c, vc = motion.com(body)
        own, _ = motion.spin(body)
        weighted = weighted + body.mass * c
        momentum = momentum + body.mass * vc
        spin = spin + np.cross(c, body.mass * vc) + own
        kinetic = kinetic + (body.mass * (vc**2).sum(1) + (w * own).sum(1)) / 2
        size = np.maximum(size, np.abs(c).max(1))
        speed = np.maximum(speed, np.linalg.norm(vc, axis=1))
    gate.see("com", run, weighted / mass - run.vector("com.", "xyz"), 1 + size[:, None])
    gate.see("momentum", run, momentum - run.vector("momentum.", "xyz"), mass * (speed[:, None] + 1e-9))
    gate.see("angular momentum", run, spin - run.vector("angular_momentum.", "xyz"), mass * ((speed + 1e-9) * (1 + size))[:, None])
    gate.see("kinetic energy", run, kinetic - run["energy.kinetic"], mass * (speed + 1e-9) ** 2)
    gravity = np.array(run.scenario["physics"]["gravity"], float)
    potential = -weighted @ gravity
    weight = mass * np.linalg.norm(gravity)
    gate.see("potential energy", run, potential - run["energy.potential"], weight * (1 + size))
    energy = kinetic + potential + (laws.Motor(run).reflected * run.joints("speed") ** 2).sum(1) / 2
    gate.see("stored", run, energy - energy[0] - run["energy.stored"], weight * (1 + size) + mass * speed**2)
    names = ("electrical", "copper", "gear", "stored", "contact", "friction", "stops", "residual", "dry")
    parts = [run[f"energy.{part}"] for part in names if f"energy.{part}" in run.index]
    gate.see("ledger", run, parts[0] - sum(parts[1:]), sum(map(np.abs, parts)))


def reactions(gate, run, rules):
    if "reaction.0.mx" not in run.index or laws.Motor(run).reflected.any():
        return
    motion = run.motion()
    for j in range(run.n):
        moment = run.vector(f"reaction.{j}.m", "xyz")
        along = (moment * motion.hinge[j][1]).sum(1)
        torque = sum(run[f"joint.{j}.{of}"] for of in ("torque", "stop_torque") if f"joint.{j}.{of}" in run.index)
        gate.see("hinge moments", run, along - torque, np.abs(moment).sum(1) + 0.1)


ALL = (motors, controllers, patterns, contacts, stops, bodies, reactions)
