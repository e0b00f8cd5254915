"""Gears with play: their torques, recomputed from the angles in the trace (docs/equations.md, play of a gear)."""
import numpy as np

DAMPING = 0.5 / 50  # s: damping over stiffness, those of a stop


def hear_gears(record):
    """Differences between the torques of gears in the trace and the law of their flanks, with the play as built."""
    hinges = {f"m{k}/{hinge['name']}": hinge for k in range(record.robot.count) for hinge in record.robot.type_of[k].get("hinges", [])}
    factor = record.per_joint(record.scenario.get("as_built", {}), "play", 1.0)
    wrong, trace = [], record.trace
    for j, name in enumerate(record.names):
        width = hinges[name].get("play", 0) * factor[j]
        if not width > 0 or f"joint.{j}.angle" not in trace:
            continue
        if f"joint.{j}.motor_angle" not in trace:
            wrong.append(f"{name} has play, but the trace lacks the angle of its motor")
            continue
        of = lambda what: trace[f"joint.{j}.{what}"]
        apart, speed = of("motor_angle") - of("angle"), of("motor_speed") - of("speed")
        stiffness = hinges[name].get("play_stiffness", 50)
        push = stiffness * (np.abs(apart) - width / 2 + DAMPING * speed * np.sign(apart))
        torque = np.where(np.abs(apart) > width / 2, np.sign(apart) * np.maximum(push, 0), 0)
        # A row has 15 digits of angles near 1 rad.
        off = np.abs(torque - of("gear_torque")).max()
        if off > 1e-12 * stiffness + 1e-12 * np.abs(torque).max():
            wrong.append(f"the torque of the gear of {name} is off by {off:.3g} N m from the law of a play of {width:.4g} rad")
    return wrong
