"""The laws of a joint and of a contact (eq. 1-6 and 12, hinge stop), for many rows at once; from the paper and docs/equations.md."""
import numpy as np

EPS = np.finfo(float).eps
STOP_STIFFNESS, STOP_DAMPING = 50.0, 0.5  # docs/equations.md, 2
CREEP = 0.1  # rad/s; docs/equations.md, 3: friction under explicit integrators


class Motor:
    """Settings of the actuator per joint. Every array is (rows, joints)."""

    def __init__(self, run):
        section = run.scenario["actuator"]
        self.type = section["type"]
        self.load = np.ones(run.n)
        if self.type == "torque":
            limit = section.get("limit")
            self.limit = run.per_joint(np.inf if limit in (None, "none") else limit)
        if self.type == "dc_motor":
            get = lambda key: run.per_joint(section[key])
            self.R, self.Kt, self.Ks, self.n, self.eta = (get(key) for key in ("R", "Kt", "Ks", "gear", "efficiency"))
            self.u_max, self.i_max, self.rotor = get("u_max"), get("i_max"), get("rotor_inertia")
            self.turn_speed, self.load = float(section["turn_speed"]), np.ones(run.n)
            if section["efficiency_model"] == "directional":
                self.eta, self.load = self.load, self.eta
        if self.type == "servo":  # docs/equations.md, 3
            get = lambda key, absent=0.0: run.per_joint(section.get(key, absent))
            V, T0, w0, I0, eta = (get(key) for key in ("voltage", "stall_torque", "no_load_speed", "stall_current", "efficiency"))
            share = get("load_friction", 0.15)
            self.load, self.turn_speed = (1 - share) / (1 + share), 0.6
            self.rotor = get("rotor_inertia", np.nan)
            self.rotor = np.where(np.isnan(self.rotor), 0.03 * T0 / w0, self.rotor)
            dry, viscous = get("dry_friction", np.nan), get("viscous_friction", np.nan)
            dry, viscous = np.where(np.isnan(dry), 0.03 * T0, dry), np.where(np.isnan(viscous), 0.1 * T0 / w0, viscous)
            if section["stall_torque_at"] == "joint":
                rest, free = (T0 + dry) / self.load, (dry + viscous * w0) / self.load
                T0, w0 = rest, w0 * rest / (rest - free)
            k = V / w0
            I0 = np.where(I0 > 0, I0, T0 / (np.where(eta > 0, eta, 0.7) * k))
            self.R, self.Kt, self.Ks, self.n, self.eta = V / I0, k, k, np.ones(run.n), T0 / (I0 * k)
            u, i = get("u_max"), get("i_max")
            self.u_max = np.where(u > 0, u, V)
            self.i_max = np.where(i > 0, i, V / self.R)
            self.dry, self.viscous = dry, viscous
        motor = self.type in ("dc_motor", "servo")
        self.directional = motor and bool(np.any(self.load < 1))
        self.explicit = run.scenario["physics"]["integrator"] in ("semi_implicit", "rk4")
        if self.type != "servo":
            self.dry, self.viscous = (run.per_joint(section.get(key, 0.0)) for key in ("dry_friction", "viscous_friction"))
        self.reflected = self.n**2 * self.rotor if motor else np.zeros(run.n)  # adds to the joint's inertia
        self.command_limit = self.u_max if motor else self.limit if self.type == "torque" else np.full(run.n, np.inf)

    def current(self, command, w):
        """Current by eq. 1 with both limits, and the active limit: 0 for none, 1 for the voltage, 2 for the current."""
        free = (np.clip(command, -self.u_max, self.u_max) - self.Ks * self.n * w) / self.R
        saturation = np.where(np.abs(free) > self.i_max, 2, np.where(np.abs(command) > self.u_max, 1, 0))
        return np.clip(free, -self.i_max, self.i_max), saturation

    def efficiency(self, i, w):
        """Efficiency eta, times load^s of docs/equations.md, 3."""
        if not self.directional:
            return np.broadcast_to(self.eta, i.shape)
        return self.eta * self.load ** (np.clip(w * np.sign(i) / self.turn_speed, -1, 1) if self.explicit else np.sign(w * i))

    def drawn(self, voltage, i, w):
        """Electrical power. A servo that is driven gets back no more than its torque takes."""
        power = voltage * i
        return np.where(w * i < 0, self.R * i**2 + self.eta * self.Kt * i * self.n * w, power) if self.type == "servo" else power

    def torque(self, i, w):
        """Torque by eq. 2, less friction."""
        return self.efficiency(i, w) * self.Kt * i * self.n + self.friction(w)

    def friction(self, w):
        """Torque of dry and viscous friction of a joint that turns."""
        return -self.dry * (np.tanh(w / CREEP) if self.explicit else np.sign(w)) - self.viscous * w

    def at_rest(self, i):
        """Least and largest torque of a joint at rest under an implicit integrator."""
        shaft = self.eta * self.Kt * i * self.n
        sides = (self.load * shaft, shaft / self.load)
        return np.minimum(*sides) - self.dry, np.maximum(*sides) + self.dry

    def damping(self, command, i, w):
        """Slope -dT/dw of the torque; 0 while the current is limited."""
        b = self.eta * self.Kt * self.Ks * self.n**2 / self.R
        if self.directional:
            e = self.efficiency(i, w)
            b = e * (self.Kt * self.Ks * self.n**2 / self.R)
            if self.explicit:
                b = b + e * self.Kt * np.abs(i) * self.n * np.abs(np.log(self.load)) / self.turn_speed
        return np.where(self.current(command, w)[1] == 2, 0.0, b)


def pid(error, gains, period, limit, anti_windup=True, rule="last", sign=1):
    """P, I, D and their sum by eq. 3-6 for an array (ticks, joints) of errors, one row per tick.
    `rule` selects the error that the condition of anti-windup compares; "this", "off" and sign -1 are mutants."""
    Kp, Ki, Kd, N = gains
    ticks, joints = error.shape
    I, D, u = (np.zeros((ticks, joints)) for _ in range(3))
    with np.errstate(invalid="ignore", divide="ignore"):
        for k in range(ticks):
            e, last = error[k], error[k - 1] if k else error[0]
            if k:
                compared = e if rule == "this" else last
                held = (np.abs(u[k - 1]) > limit) & (compared * u[k - 1] > 0) & bool(anti_windup) & (rule != "off")
                I[k] = np.where(held, I[k - 1], I[k - 1] + Ki * period * last)
                D[k] = np.where(Kd > 0, (Kd * D[k - 1] + sign * Kd * N * (e - last)) / (Kd + N * period), 0.0)
            u[k] = Kp * e + I[k] + D[k]
    return Kp * error, I, D, u


def stop(q, qd, ranges, stiffness=STOP_STIFFNESS, damping=STOP_DAMPING):
    """Torque of a hinge stop outside [lo, hi] (docs/equations.md, 2). The torque never pulls the joint towards the stop."""
    low, high = ranges[:, 0], ranges[:, 1]
    torque = np.where(q > high, np.minimum(-stiffness * (q - high) - damping * qd, 0), 0)
    return np.where(q < low, np.maximum(-stiffness * (q - low) - damping * qd, 0), torque)


def normal_force(p, rate, law):
    """Normal force by the first line of eq. 12, for a penetration p and its rate."""
    spring = law["stiffness"] * np.maximum(p, 0) ** law["exponent"]
    damper = law["damping"] * np.maximum(p, 0) ** law["damping_exponent"]
    return np.where(p > 0, np.maximum(spring + damper * rate, 0), 0), np.where(p > 0, spring, 0), np.where(p > 0, damper, 0)


def friction(fn, v, f, slip_speed):
    """Friction force by the second line of eq. 12, for the tangential velocity v (rows, 3)."""
    speed = np.linalg.norm(v, axis=-1)
    sticking = -(f * fn / slip_speed)[..., None] * v
    sliding = -(f * fn / np.maximum(speed, slip_speed))[..., None] * v
    return np.where((speed <= slip_speed)[..., None], sticking, sliding)
