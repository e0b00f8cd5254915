"""Reader of a trace.h5: its tables by the names of their columns, the stored scenario, and its motors.

Written from docs/numbers.md (the trace), docs/files.md (its tables) and docs/reference/plugins.md (motors); shares no code with the program."""
import h5py
import numpy as np
import yaml

from paper.robot import Robot, from_quaternion
from yaml12 import Loader

# Default limits of a scenario (docs/reference/scenario.md).
LIMITS = {"warn_share": 0.8, "tracking_error": 0.1, "saturated_share": 0.01, "saturated_periods": 3, "height": 0.5,
          "tilt": 1.0471975511965976, "beyond_range": 0.01, "beyond_range_share": 0.01, "start_jump": 0.05, "touch": 0.0005,
          "collision": 0.002, "sink": 0.005, "energy_residual": 0.01, "energy_created": 0.05, "slip": 0.2, "torque_error": 0.05,
          "progress": 0}


class Table:
    """Table with columns by name; a missing column is None."""

    def __init__(self, dataset):
        self.rows = dataset[:]
        self.columns = [name.decode() for name in dataset.attrs["columns"]]
        self.index = {name: k for k, name in enumerate(self.columns)}

    def __contains__(self, name):
        return name in self.index

    def __getitem__(self, name):
        return self.rows[:, self.index[name]]

    def __len__(self):
        return len(self.rows)

    def vector(self, prefix, names):
        return np.stack([self[prefix + name] for name in names], -1)


class Record:
    def __init__(self, file):
        with h5py.File(file) as h5:
            self.trace = Table(h5["trace"])
            tables = h5["recording"]
            self.ticks, self.poses, self.joints, run = (Table(tables[name]) for name in ("ticks", "poses", "joints", "run"))
            self.loads = Table(tables["loads"]) if "loads" in tables else None
            self.spread = Table(tables["spread"]) if "spread" in tables else None
            self.scenario = yaml.load(h5.attrs["scenario"].decode(), Loader)
            self.outcome = h5.attrs["outcome"].decode()
        self.run = {name: run[name][0] for name in run.columns}
        self.robot = Robot(self.scenario)
        self.names, self.count = self.robot.joint_names, len(self.robot.joint_names)
        self.limits = LIMITS | self.scenario.get("limits", {})
        self.actuator = self.scenario["actuator"]
        has_motors = self.actuator["type"] != "none"
        self.driven = np.array([has_motors and driven for driven in self.robot.driven], bool)
        self.t, self.end = self.ticks["t"], self.run["simulated"]
        self.floating = self.scenario["robot"]["base"] == "floating"
        self.ground = self.scenario["ground"]["type"]
        self.mass = sum(body.mass for body in self.robot.bodies)
        self.gravity = np.array(self.scenario["physics"]["gravity"], float)
        self.weight = self.mass * np.linalg.norm(self.gravity)
        self.solver = self.scenario["contact"].get("law") == "bullet"  # Bullet's solver also separates bodies
        self.slip_speed = self.scenario["contact"].get("slip_speed", 0.01)
        self.adaptive = self.scenario["physics"]["integrator"] == "adaptive"
        self.motors()
        self.motion_ = None

    # ---- columns
    def tick(self, what):
        """Array (rows, joints) of a tick column, which covers all steps."""
        return np.stack([self.ticks[f"joint.{j}.{what}"] for j in range(self.count)], -1)

    def pose(self, what):
        return np.stack([self.poses[f"joint.{j}.{what}"] for j in range(self.count)], -1)

    def com(self):
        return self.poses.vector("com.", "xyz")

    def rotation(self):
        return from_quaternion(self.poses.vector("base.q", "wxyz"))

    def motion(self):
        """Poses of all bodies at control ticks."""
        if self.motion_ is None:
            still = np.zeros((len(self.poses), 3))
            angles = self.pose("angle") if self.count else np.zeros((len(self.poses), 0))
            self.motion_ = self.robot.move(self.poses.vector("base.", "xyz"), self.rotation(), still, still, angles, 0 * angles)
        return self.motion_

    def per_joint(self, section, key, missing=np.nan):
        """Setting of every joint. The value is `missing` if it is not stated, or if it is 0 and 0 means not stated."""
        value = section.get(key)
        if value is None:
            return np.full(self.count, missing)
        if isinstance(value, dict):
            return np.array([float(value.get(name, value.get("default", missing))) for name in self.names])
        return np.broadcast_to(np.array(value, float), (self.count,)).copy()

    # ---- motors
    def motors(self):
        """Speed without load, torque at rest at the largest command, and True if such a limit exists."""
        a, kind, of = self.actuator, self.actuator["type"], lambda key: self.per_joint(self.actuator, key)
        self.voltages = kind in ("dc_motor", "servo")
        nothing = np.full(self.count, np.nan)
        self.torque_constant = self.speed_constant = nothing  # efficiency Kt, and Ks, of motors that could create energy
        self.no_load, self.at_rest, self.limited, self.i_max = nothing, nothing, np.zeros(self.count, bool), nothing
        self.stall = nothing  # stall torque at the supply, of any model of the efficiency
        held = nothing  # torque at rest of the simulated motor
        directional = a.get("efficiency_model") == "directional"
        worn = self.per_joint(self.scenario.get("as_built", {}), "gear_friction", 1.0)  # factor on the losses of each joint
        with np.errstate(divide="ignore", invalid="ignore"):
            if kind == "dc_motor":
                dry, viscous = worn * np.nan_to_num(of("dry_friction")), worn * np.nan_to_num(of("viscous_friction"))
                gear_share = 1 - worn * (1 - of("efficiency"))
                drive = gear_share * of("Kt") * of("gear") / of("R")
                self.no_load = (drive * of("u_max") - dry) / (drive * of("Ks") * of("gear") + viscous)
                current = np.minimum(of("u_max") / of("R"), of("i_max"))
                self.at_rest = of("gear") * gear_share * of("Kt") * current
                self.stall = of("gear") * gear_share * of("Kt") * of("u_max") / of("R")
                held = self.at_rest / (gear_share if directional else 1) + dry
                self.limited, self.i_max = self.driven.copy(), of("i_max")
                self.torque_constant, self.speed_constant = gear_share * of("Kt"), of("Ks")
                self.makes_energy = self.driven & (self.torque_constant > self.speed_constant * (1 + 1e-9))
            elif kind == "servo":
                v, t0, w0 = of("voltage"), of("stall_torque"), of("no_load_speed")
                k = v / w0
                u = np.where(of("u_max") > 0, of("u_max"), v)
                efficiency = np.nan_to_num(of("efficiency"))
                stall = np.nan_to_num(of("stall_current"))
                stall = np.where(stall > 0, stall, t0 / (np.where(efficiency > 0, efficiency, 0.7) * k))
                share = np.where(np.isnan(of("load_friction")), 0.15, of("load_friction"))
                load = (1 - share) / (1 + share)
                dry = np.where(np.isnan(of("dry_friction")), 0.03 * t0, of("dry_friction"))
                viscous = np.where(np.isnan(of("viscous_friction")), 0.1 * t0 / w0, of("viscous_friction"))
                line, free = t0, w0
                if a.get("stall_torque_at") == "joint":
                    line = (t0 + dry) / load
                    free = w0 * line / (line - (dry + viscous * w0) / load)
                    k = v / free
                    stall = np.nan_to_num(of("stall_current"))
                    stall = np.where(stall > 0, stall, line / (np.where(efficiency > 0, efficiency, 0.7) * k))
                # The line is that of the drawings; its losses are those of the robot as built.
                load, dry, viscous = (1 - worn * share) / (1 + worn * share), worn * dry, worn * viscous
                eta = line / (stall * k)
                self.i_max = np.where(of("i_max") > 0, of("i_max"), stall)
                largest = line * np.minimum(1, np.minimum(u / v, self.i_max / stall))  # of the motor at rest
                self.at_rest = largest
                # Speed at which load * line falls to the friction of the joint.
                slope = line / free
                self.no_load = (load * line * u / v - dry) / (load * slope + viscous)
                self.limited = self.driven.copy()
                self.stall = t0 * np.minimum(1, u / v)
                held = largest / load + dry
                self.makes_energy = self.driven & (eta > 1 + 1e-9)
            else:
                limit = np.nan_to_num(of("limit")) if kind == "torque" else np.zeros(self.count)
                self.at_rest, self.limited = np.where(limit > 0, limit, np.nan), limit > 0
                self.makes_energy = np.zeros(self.count, bool)
            self.holds_more = held > self.stall * (1 + 1e-9)
        self.no_load[~np.isfinite(self.no_load)] = np.nan
        self.power = self.at_rest * self.no_load / 4 if kind != "servo" else of("stall_torque") * of("no_load_speed") / 4
        self.ratings = {key: of(key) for key in ("i_continuous", "gear_torque_peak", "gear_torque_continuous", "speed_max")}
        self.all_limited = bool(np.all(self.limited[self.driven]))

    def most_error(self):
        """Largest torque error of a judged run."""
        return min(self.limits["torque_error"], 0.1)

    def torque_errors(self):
        """Torque error of every joint relative to its peak (at least 2 % of the largest of all peaks); 0 without an estimate."""
        if not self.run["torque_error.estimated"] or not self.count:
            return np.zeros(self.count)
        peak, error = self.joints["torque_error_peak"], self.joints["torque_error"]
        largest = max(peak.max(), 0)
        return error / np.maximum(peak, 0.02 * largest) if largest > 0 else np.zeros(self.count)

    def chaotic(self):
        """True if a factor of 1 + 1e-9 on gravity changes the torques by more than their permitted error."""
        accuracy = self.scenario["physics"].get("accuracy", 0) if self.adaptive else 0
        share = self.run.get("parting.chaotic.share", 0)
        return bool(self.adaptive and self.run["torque_error.estimated"] and not share <= max(0.01, accuracy))

    def spread_numbers(self):
        """Least and largest values of the rollouts with slightly disturbed gravity."""
        if self.spread is None:
            return {}
        out = {"rollouts": len(self.spread["distance"])}
        for name, column in (("peak", "torque_peak"), ("rms", "torque_rms"), ("way", "distance"), ("margin", "margin")):
            out |= {f"low_{name}": self.spread[column].min(), f"high_{name}": self.spread[column].max()}
        return out

    # ---- energies
    def residual(self):
        """Residual of the ledger (docs/equations.md, 8): drawn energy minus all other terms."""
        e = self.run
        return e["energy.electrical"] - sum(e["energy." + name] for name in (
            "copper", "gear", "stored", "contact", "friction", "stops", "hinges", "dry"))

    def least_energy(self):
        return max(self.weight * 1e-3, np.finfo(float).tiny)

    def energy_scale(self):
        return max(abs(self.run["energy.electrical"]), abs(self.run["energy.stored"]), self.least_energy())
