"""Every step of an integrator (docs/equations.md, 7) and what it adds to the ledger (8), for traces with a row per step."""
import numpy as np

from paper import checks, laws
from paper.laws import EPS
from paper.robot import from_quaternion, skew


def steps(gate, run, rules):
    """Checks every step of the integrator, and its contribution to the ledger, for a trace with a row per step."""
    physics, law, motor, robot = run.scenario["physics"], run.scenario["contact"], laws.Motor(run), run.robot
    h, implicit = physics["step"], physics["integrator"] == "implicit"
    assert run.scenario["trace"]["period"] == h and run.scenario["robot"]["base"] == "floating"
    q, qd, v = run.joints("angle"), run.joints("speed"), run.velocity()
    motion, rows = run.motion(), slice(0, len(q) - 1)
    command, after = run.joints("voltage_command")[1:], v[1:]
    q, qd, v = q[rows], qd[rows], v[rows]
    mass, bias = motion.equations(np.array(physics["gravity"], float), run.joints("speed"))
    mass, bias = mass[rows], bias[rows]
    joints = np.arange(6, 6 + run.n)
    mass[:, joints, joints] += motor.reflected

    # Positions.
    gate.see("motion, positions", run, np.diff(run.joints("angle"), axis=0) - h * after[:, 6:], 1 + np.abs(q))
    gate.see("motion, positions", run, np.diff(run.vector("base.", "xyz"), axis=0) - h * after[:, :3])
    rotation = from_quaternion(run.vector("base.q", "wxyz"))
    spun = turned_by(h * after[:, 3:6]) @ rotation[:-1]
    gate.see("motion, positions", run, spun - rotation[1:])

    # Forces on the joints at the start of the step, or for implicit methods with the velocity at its end.
    speed = after[:, 6:] if implicit else qd
    i, saturation = motor.current(command, speed)
    torque = motor.torque(i, speed)
    ranges = np.array(robot.ranges)
    stop_torque = implicit_stop(q, speed, h, ranges) if implicit else laws.stop(q, speed, ranges)
    force = np.zeros_like(v)
    force[:, 6:] = torque + stop_torque
    terms = np.abs(force)
    plain = np.ones(len(v), bool)

    # The matrices and contacts of an implicit step are those at the pose to which the velocity at the start leads.
    if implicit:
        ahead = run.robot.move(run.vector("base.", "xyz")[:-1] + h * v[:, :3], turned_by(h * v[:, 3:6]) @ rotation[:-1], v[:, :3],
                               v[:, 3:6], q + h * qd, qd)
        mass, bias = ahead.equations(np.array(physics["gravity"], float), qd)
        mass[:, joints, joints] += motor.reflected

    # Forces of the ground.
    ground, rubbed, moved = 0, 0, (v + after) / 2 if implicit else v
    worked, fast = 1e-30, np.linalg.norm(v[:, :3], axis=1) + np.abs(v[:, 3:]).sum(1) + np.abs(after[:, 3:]).sum(1)
    for _, name, touch in checks.elements(run):
        if implicit:
            body, centre, radius = run.robot.contacts(law["on"])[name]
            point = ahead[body][0] + ahead[body][1] @ centre - np.array([0, 0, radius])
            linear, _ = ahead.jacobian(run.robot.by_name[body], point)
            at, p = np.einsum("nki,ni->nk", linear, v), -point[:, 2]
            fn, _, _ = laws.normal_force(p, -at[:, 2], law)
            push, tangential, good = implicit_touch(law, touch.f[rows], h, p, fn, at, np.einsum("nki,ni->nk", linear, after))
            plain &= good
        else:
            linear, _ = motion.jacobian(touch.body, touch.point)
            linear, p = linear[rows], touch.p[rows]
            at = np.einsum("nki,ni->nk", linear, v)
            fn, _, _ = laws.normal_force(p, -at[:, 2], law)
            push, tangential = fn, laws.friction(fn, at * [1, 1, 0], touch.f[rows], law["slip_speed"])
        pushed = tangential + push[:, None] * np.array([0, 0, 1])
        force += np.einsum("nki,nk->ni", linear, pushed)
        terms += np.einsum("nki,nk->ni", np.abs(linear), np.abs(pushed))
        along = np.einsum("nki,ni->nk", linear, moved)
        # The penetration p is computed from the pose, so that its rounding error is that of a length of about 1 mm.
        _, spring, damper = laws.normal_force(np.where(p > 0, p + 1e-3, 0), 0, law)
        slip = 1 + touch.f[rows] * (1 + fast / np.maximum(np.linalg.norm(at[:, :2], axis=1), law["slip_speed"]))
        worked = worked + ((spring + damper * fast) * np.linalg.norm(along, axis=1) + push * fast) * slip * h
        ground, rubbed = ground - push * along[:, 2] * h, rubbed - (tangential * along).sum(1) * h
    needed = np.einsum("nij,nj->ni", mass, (after - v) / h)
    terms += np.abs(bias) + np.einsum("nij,nj->ni", np.abs(mass), np.abs(after) + np.abs(v)) / h
    # Residuals are relative to the largest term of the robot, because the rounding error of a force affects the equations of all bodies.
    gate.see("motion, implicit" if implicit else "motion, velocities", run, needed + bias - force, terms.max(1)[:, None], plain[:, None])
    gate.cover("implicit steps away from corners" if implicit else "explicit steps", run, plain.sum())

    # Contributions of the step to the ledger.
    voltage = motor.R * i + motor.Ks * motor.n * speed
    drawn, copper = motor.drawn(voltage, i, speed), motor.R * i**2
    size = (np.abs(drawn) + copper + np.abs(torque * speed)).sum(1) * h
    add = lambda part: np.diff(run[f"energy.{part}"])
    total = lambda part: EPS * 4 * np.abs(run[f"energy.{part}"][1:])
    for part, value in (("electrical", drawn), ("copper", copper), ("gear", drawn - copper - torque * speed)):
        gate.see("ledger, motors", run, np.maximum(np.abs(add(part) - value.sum(1) * h) - total(part), 0), size)
    for part, value in (("contact", ground), ("friction", rubbed)):
        gate.see("ledger, implicit" if implicit else "ledger, ground", run, np.maximum(np.abs(add(part) - value) - total(part), 0), worked, plain)
    met = (qd + after[:, 6:]) / 2 if implicit else qd
    gate.see("ledger, stops", run, np.maximum(np.abs(add("stops") + (stop_torque * met).sum(1) * h) - total("stops"), 0))


def turned_by(vector):
    """Rotation matrices of rotation vectors."""
    angle = np.linalg.norm(vector, axis=1)[:, None, None] + 1e-300
    cross = skew((vector[:, :, None] / angle)[:, :, 0])
    return np.eye(3) + np.sin(angle) * cross + 2 * np.sin(angle / 2) ** 2 * cross @ cross


def implicit_stop(q, end, h, ranges):
    """Torque of the hinge stops at the speed at the end of the step (docs/equations.md, 7)."""
    reached = q + h * end
    high = q > ranges.mean(1)
    excess = reached - np.where(high, ranges[:, 1], ranges[:, 0])
    within = (q <= ranges[:, 1]) & (q >= ranges[:, 0])
    torque = -50 * excess - 0.5 * np.where(within, excess / h, end)
    return np.where(np.where(high, torque < 0, torque > 0), torque, 0)


def implicit_touch(law, f, h, p, fn, start, end):
    """Normal force and friction for k = d = 1 (docs/equations.md, 7), and the rows in which both are exact up to rounding: the
    element rests or is in the air. Landing and sliding are nonlinear, and the solve satisfies them to a tolerance."""
    assert law["exponent"] == law["damping_exponent"] == 1
    depth, damping = p + h * start[:, 2], law["damping"] * np.maximum(p, 0)
    reached = depth - h * end[:, 2]
    rests = np.where(reached > 0, np.maximum(law["stiffness"] * reached - damping * end[:, 2], 0), 0)
    lands = np.where(reached > 0, np.maximum(law["stiffness"] * reached - law["damping"] * reached * end[:, 2], 0), 0)
    push = np.where(depth > 0, rests, lands)
    flat = np.array([1, 1, 0])
    slow, fast = (np.linalg.norm(x * flat, axis=1) for x in (start, end))
    tangential = -(f * fn / np.maximum(fast, law["slip_speed"]))[:, None] * end * flat
    sticks = (fast < 0.99 * law["slip_speed"]) & (slow < law["slip_speed"])
    return push, tangential, ((fn == 0) | sticks) & ((depth > 0) | (push == 0))


def runge_kutta(gate, run, rules):
    """Checks the classical Runge-Kutta method for the complete state, with the orientation as a quaternion, q' = (0, omega) q / 2."""
    h, n = run.scenario["physics"]["step"], run.n
    assert run.scenario["trace"]["period"] == h and run.scenario["physics"]["integrator"] == "rk4"
    places = np.concatenate([run.vector("base.", "xyz"), run.vector("base.q", "wxyz"), run.joints("angle")], -1)
    velocities, command = run.velocity(), run.joints("voltage_command")[1:]

    def rates(place, velocity):
        w, x, y, z = np.moveaxis(place[:, 3:7], 1, 0)
        p, q, r = np.moveaxis(velocity[:, 3:6], 1, 0)
        turned = np.stack([-p * x - q * y - r * z, p * w + q * z - r * y, q * w + r * x - p * z, r * w + p * y - q * x], -1) / 2
        return np.concatenate([velocity[:, :3], turned, velocity[:, 6:]], -1), accelerations(run, place, velocity, command)

    start = places[:-1], velocities[:-1]
    k1 = rates(*start)
    k2 = rates(*(x + h / 2 * k for x, k in zip(start, k1)))
    k3 = rates(*(x + h / 2 * k for x, k in zip(start, k2)))
    k4 = rates(*(x + h * k for x, k in zip(start, k3)))
    place, velocity = (x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(start, k1, k2, k3, k4))
    place[:, 3:7] /= np.linalg.norm(place[:, 3:7], axis=1)[:, None]
    gate.see("motion, rk4", run, velocity - velocities[1:])
    gate.see("motion, rk4", run, place - places[1:])
    gate.cover("Runge-Kutta steps", run, len(place))


def accelerations(run, place, velocity, command):
    """Accelerations v' of M v' + c = forces at a state."""
    motor, law, gravity = laws.Motor(run), run.scenario["contact"], np.array(run.scenario["physics"]["gravity"], float)
    q, qd = place[:, 7:], velocity[:, 6:]
    motion = run.robot.move(place[:, :3], from_quaternion(place[:, 3:7]), velocity[:, :3], velocity[:, 3:6], q, qd)
    mass, bias = motion.equations(gravity, qd)
    joints = np.arange(6, 6 + run.n)
    mass[:, joints, joints] += motor.reflected
    force = -bias
    force[:, 6:] += motor.torque(motor.current(command, qd)[0], qd) + laws.stop(q, qd, np.array(run.robot.ranges))
    for body, centre, radius in run.robot.contacts(law["on"]).values():
        p, rotation, v, w = motion[body]
        arm = rotation @ centre - np.array([0, 0, radius])
        v = v + np.cross(w, arm)
        fn, _, _ = laws.normal_force(-(p + arm)[:, 2], -v[:, 2], law)
        pushed = laws.friction(fn, v * [1, 1, 0], run.scenario["ground"]["friction"], law["slip_speed"])
        pushed[:, 2] = fn
        linear, _ = motion.jacobian(run.robot.by_name[body], p + arm)
        force += np.einsum("nki,nk->ni", linear, pushed)
    return np.linalg.solve(mass, force[:, :, None])[:, :, 0]
