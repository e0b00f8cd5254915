"""Pattern generation: eq. 7-10 and the gaits without states, from the paper, docs/equations.md, 5 and the manuals."""
import numpy as np


class Network:
    """Phase oscillators of a resolved scenario: frequencies, couplings, start."""

    names = ("phi", "r", "x")

    def __init__(self, run):
        cpg = run.scenario["cpg"]
        model, n = cpg["model"], run.n
        self.omega = 2 * np.pi * run.per_joint(cpg["frequency"])
        self.R, self.X = run.per_joint(cpg["amplitude"]), run.per_joint(cpg["offset"])
        constants = model.get("parameters", model)
        self.a_r, self.a_x = (float(constants.get(long, constants.get(short, 2)))
                              for long, short in (("amplitude_rate", "a_r"), ("offset_rate", "a_x")))
        self.weighted = bool(model.get("amplitude_weighted", False))
        lag = run.per_joint(cpg["phase_lag"])
        self.edges = edges(run, cpg["couplings"], lag, float(model.get("coupling", 1)))
        self.start = self.phases(n)
        self.constants = constants
        self.source, self.target = (np.array([edge[k] for edge in self.edges], int) for k in (0, 1))
        self.weight, self.lag = (np.array([edge[k] for edge in self.edges], float) for k in (2, 3))

    def phases(self, n):
        """Sums of lags along the couplings; all 0 if the lags contradict one another."""
        phase = [None] * n
        for root in range(n):
            if phase[root] is not None or any(j == root for _, j, _, _ in self.edges) and root:
                continue
            phase[root], queue = 0.0, [root]
            while queue:
                i = queue.pop(0)
                for a, b, _, lag in self.edges:
                    other, value = (b, phase[i] + lag) if a == i else (a, phase[i] - lag) if b == i else (None, 0)
                    if other is None:
                        continue
                    if phase[other] is None:
                        phase[other] = value
                        queue.append(other)
                    elif abs(phase[other] - value) > 1e-9:
                        return np.zeros(n)
        return np.array([p or 0.0 for p in phase])

    def pull(self, phi, strength):
        """Coupling sum_j w_ij strength_j sin(phi_j - phi_i - psi_ij) with psi_ij = -lag."""
        terms = self.weight * strength[self.source] * np.sin(phi[self.source] - phi[self.target] + self.lag)
        return np.bincount(self.target, terms, len(phi))

    def rates(self, state):
        """Rates of the states by eq. 7-9. The state is an array (3, joints) of phi, r, x."""
        phi, r, x = state
        d_phi = self.omega + self.pull(phi, r if self.weighted else np.ones_like(r))
        return np.stack([d_phi, self.a_r * (self.R - r), self.a_x * (self.X - x)])

    def initial(self):
        return np.stack([self.start, np.zeros_like(self.start), self.X])

    def output(self, state, sin=np.sin):
        """Set points by eq. 10. The state is an array (names, ...)."""
        phi, r, x = state
        return x + r * sin(phi)

    def integrate(self, ticks, period, step):
        """States at every tick (ticks, names, joints) by the classical Runge-Kutta method."""
        state = self.initial()
        out, count = [state], round(period / step)
        h = period / count
        for _ in range(ticks - 1):
            for _ in range(count):
                k1 = self.rates(state)
                k2 = self.rates(state + h / 2 * k1)
                k3 = self.rates(state + h / 2 * k2)
                k4 = self.rates(state + h * k3)
                state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            out.append(state)
        return np.array(out)


class Kuramoto(Network):
    """CPG `kuramoto_amplitude`: couplings are weighted with amplitudes; amplitudes and offsets obey equations of order 2."""

    names = ("phi", "r", "dr", "x", "dx")

    def rates(self, state):
        phi, r, dr, x, dx = state
        d_phi = self.omega + self.pull(phi, r)
        a_r, a_x = self.a_r, self.a_x
        return np.stack([d_phi, dr, a_r * (a_r / 4 * (self.R - r) - dr), dx, a_x * (a_x / 4 * (self.X - x) - dx)])

    def initial(self):
        zero = np.zeros_like(self.start)
        return np.stack([self.start, zero, zero, self.X, zero])

    def output(self, state, sin=np.sin):
        return state[3] + state[1] * sin(state[0])


class Hopf(Network):
    """CPG `hopf` with a duty factor of 0.5. The limit cycles are circles; a coupling is the difference to the state of the other
    oscillator, rotated by the lag. At phase 0 the set point rises through its mean, a quarter turn before x = 1."""

    names = ("x", "y")

    def rates(self, state):
        z = state[0] + 1j * state[1]
        a = self.constants["rate"]
        d = (a * (1 - np.abs(z) ** 2) + 1j * self.omega) * z
        np.add.at(d, self.target, self.weight * (np.exp(1j * self.lag) * z[self.source] - z[self.target]))
        return np.stack([d.real, d.imag])

    def initial(self):
        z = 0.01 * np.exp(1j * (self.start - np.pi / 2))
        return np.stack([z.real, z.imag])

    def output(self, state, sin=None):
        return self.X + self.R * state[0]


def edges(run, rule, lag, weight):
    """Couplings (from, to, weight, lag) of a rule or a list (docs/equations.md, 5)."""
    n, robot = run.n, run.robot
    if not isinstance(rule, str):
        number = lambda name: robot.joint_names.index(name) if name in robot.joint_names else int(name)
        return [(number(c["from"]), number(c["to"]), float(c["weight"]), float(c["phase_lag"])) for c in rule]
    if rule == "chain":  # eq. 16, 17
        return [(i - 1, i, weight, lag[i]) for i in range(1, n)]
    others = [(j, i) for i in range(n) for j in range(n) if i != j]
    if rule == "all":
        chain = np.concatenate([[0], np.cumsum(lag[1:])])
        return [(j, i, weight / (n - 1), chain[i] - chain[j]) for j, i in others]
    towards_base = {joints[0]: joints[1] for joints in (robot.joints_to(b) for b in robot.bodies if b.joint is not None)
                    if len(joints) > 1}
    parents = [(towards_base[i], i, weight, lag[i]) for i in range(n) if i in towards_base]
    if rule == "parent":
        return parents
    assert rule == "siblings"
    return parents + [(j, i, weight, lag[i] - lag[j]) for j, i in others if towards_base.get(i, -1) == towards_base.get(j, -2)]


def ramp(t, time):
    return np.minimum(1, t / time) if time > 0 else np.ones_like(t)


def sine(run, t):
    """Set points of the CPG `sine`, which prescribes the limit cycle."""
    net, cpg = Network(run), run.scenario["cpg"]
    t = t[:, None]
    return net.X + ramp(t, cpg["model"]["ramp"]) * net.R * np.sin(net.omega * t + net.start)


def tripod(run, t):
    """Set points of figure 11, for the order `alternate` and a duty factor of 0.5: two groups of legs stand and swing alternately.
    Leg modules are docked sideways to the spine; front legs have the largest x."""
    cpg = run.scenario["cpg"]
    model = cpg["model"]
    assert model["order"] == "alternate" and model["duty_factor"] == 0.5 and not model["reverse"]
    grow = ramp(t, model["ramp"])
    amplitude, tilt = cpg["amplitude"] * grow, model["tilt"] * grow
    turns = cpg["frequency"] * t
    # Positions of the legs on the resting robot, and depths and lengths of their feet.
    robot = run.robot
    zero = np.zeros((1, run.n))
    origin = np.zeros((1, 3))
    rest = robot.move(origin, np.eye(3)[None], origin, origin, zero, zero)
    sides = {}
    for module in sorted(robot.childless):
        hip = rest[f"m{module}/link"]
        if module and abs(hip[1][0, 2, 0]) > 0.5:  # the link points down
            sides.setdefault(np.sign(hip[0][0, 1]), []).append((-hip[0][0, 0], module))
    out = np.zeros((len(t), run.n))
    for side, legs in sides.items():
        for place, (_, module) in enumerate(sorted(legs)):
            # As in the first picture of figure 11, the legs right front, left middle and right rear stand first.
            second = (place % 2 == 0) == (side > 0)
            phase = (turns + (0.5 if second else 0.0)) % 1.0
            standing = phase < 0.5
            u, s = 2 * phase, 2 * phase - 1
            stance = 1 - 2 * u
            swing = -np.cos(np.pi * s)
            swing_least = -(1 - 2 * s)  # magnitude equal to that of the stance of the other group
            swing = np.where(np.abs(swing) < np.abs(swing_least), swing_least, swing)
            angle = amplitude * np.where(standing, stance, swing)
            lift = tilt * np.where(standing, np.sin(np.pi * u) ** 2, 0)
            hip, ankle = sorted((b for b in robot.bodies if b.joint is not None and b.name.startswith(f"m{module}/")),
                                key=lambda b: b.joint)
            # The hip moves towards +x. A positive rotation about world y moves a hanging leg towards -x.
            out[:, hip.joint] = -np.sign(rest.hinge[hip.joint][1][0, 1]) * angle
            out[:, ankle.joint] = -np.sign(rest.hinge[ankle.joint][1][0, 1]) * (lift - angle)
    return out


def keyframes(run, t):
    """Set points of the CPG `keyframes`: straight lines, a periodic cubic spline, or a cubic spline at rest at both ends."""
    model = run.scenario["cpg"]["model"]
    frames = model["frames"]
    times = np.array([float(frame["time"]) for frame in frames])
    y = np.stack([run.per_joint(frame["angles"]) for frame in frames])
    h, n = np.diff(times), len(times)
    A, b = np.zeros((n, n)), np.zeros_like(y)
    slope = np.diff(y, axis=0) / h[:, None]
    for k in range(1, n - 1):
        A[k, k - 1:k + 2] = h[k - 1], 2 * (h[k - 1] + h[k]), h[k]
        b[k] = 6 * (slope[k] - slope[k - 1])
    if model["repeat"]:  # M_0 = M_last, and the speed is continuous at the seam
        A[0, 0], A[0, -1] = 1, -1
        A[-1, 0], A[-1, 1], A[-1, -2], A[-1, -1] = 2 * h[0], h[0], h[-1], 2 * h[-1]
        b[-1] = 6 * (slope[0] - slope[-1])
    else:  # at rest at both ends
        A[0, :2], A[-1, -2:] = (2 * h[0], h[0]), (h[-1], 2 * h[-1])
        b[0], b[-1] = 6 * slope[0], -6 * slope[-1]
    M = np.linalg.solve(A, b) if model["interpolation"] == "spline" else np.zeros_like(y)
    local = t % times[-1] if model["repeat"] else np.minimum(t, times[-1])
    k = np.clip(np.searchsorted(times, local, side="right") - 1, 0, n - 2)
    B = ((local - times[k]) / h[k])[:, None]
    A, H = 1 - B, (h[k] ** 2)[:, None]
    out = A * y[k] + B * y[k + 1] + ((A**3 - A) * M[k] + (B**3 - B) * M[k + 1]) * H / 6
    return y[0] + ramp(t, model["ramp"])[:, None] * (out - y[0])
