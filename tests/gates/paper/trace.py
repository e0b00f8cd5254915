"""A run folder: the resolved scenario and the trace's columns by name."""
import copy
import pathlib

import h5py
import numpy as np
import yaml

from paper.robot import Robot, from_quaternion
from yaml12 import Loader


class Run:
    """Run with its columns by name, the scenario as a dict, and the robot with its motion in every row (computed once)."""

    def __init__(self, name, folder):
        folder = pathlib.Path(folder)
        self.name = name
        self.scenario = yaml.load((folder / "scenario.resolved.yaml").read_text(), Loader)
        with h5py.File(folder / "trace.h5") as file:
            self.rows = file["trace"][:]
            self.columns = [column.decode() for column in file["trace"].attrs["columns"]]
            self.definitions = dict(zip(self.columns, (text.decode() for text in file["trace"].attrs["definitions"])))
        self.index = {column: k for k, column in enumerate(self.columns)}
        self.robot = Robot(self.scenario)
        self.n, self.motion_ = len(self.robot.joint_names), None

    def __getitem__(self, name):
        return self.rows[:, self.index[name]]

    def joints(self, what):
        """Array (rows, joints) of a quantity of the joints."""
        return np.stack([self[f"joint.{j}.{what}"] for j in range(self.n)], -1)

    def vector(self, prefix, names):
        return np.stack([self[prefix + name] for name in names], -1)

    def per_joint(self, value):
        """Array with the value of each joint, from a number, a list, or {default: x, NAME: y}."""
        if isinstance(value, dict):
            return np.array([float(value.get(name, value.get("default", 0))) for name in self.robot.joint_names])
        return np.broadcast_to(np.array(value, float), (self.n,)).copy()

    def changed(self, edit):
        """A copy whose scenario and rows `edit` has changed; its robot is assembled anew."""
        other = copy.copy(self)
        other.scenario, other.rows, other.motion_ = copy.deepcopy(self.scenario), self.rows.copy(), None
        edit(other)
        other.robot = Robot(other.scenario)
        return other

    def motion(self):
        if self.motion_ is None:
            self.motion_ = self.robot.move(
                self.vector("base.", "xyz"), from_quaternion(self.vector("base.q", "wxyz")),
                self.vector("base.v", "xyz"), self.vector("base.w", "xyz"), self.joints("angle"), self.joints("speed"))
        return self.motion_

    def velocity(self):
        """Array (rows, 6 + joints): velocity of the base's origin, angular velocity of the base, speeds of the joints."""
        return np.concatenate([self.vector("base.v", "xyz"), self.vector("base.w", "xyz"), self.joints("speed")], -1)

    def ticks(self):
        """Rows at the control ticks, except a tick at the last row. The row after a tick contains the command of the tick."""
        every = round(self.scenario["controller"]["period"] / self.scenario["trace"]["period"])
        return np.arange(0, len(self.rows) - 1, every)
