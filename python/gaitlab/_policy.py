"""Policies: networks that are learned while stepping, and become a CPG."""
from __future__ import annotations

import fnmatch
import json
import os
from typing import TYPE_CHECKING, Any, Callable, Sequence, Union

import numpy as np

from ._settings import path_text

if TYPE_CHECKING:
    from ._episodes import Episodes

_ACTIVATIONS: dict[str, Callable[[Any], Any]] = {
    "tanh": np.tanh,
    "relu": lambda z: np.maximum(z, 0.0),
    "elu": lambda z: np.where(z > 0, z, np.exp(np.minimum(z, 0.0)) - 1),
    "none": lambda z: z,
}


class Policy:
    """A feed-forward network for environments: `envs.step(policy.act())`, then `scenario.with_({"cpg": {"type": policy.save("policy.yaml")}})`.

    envs: the Episodes that it acts in, stepped by set points.
    layers: (weights, bias, activation) per layer, from the inputs to the outputs; activations tanh, relu, elu, none. The last layer has
        an output per joint with a motor.
    inputs: names or patterns among the columns of the observation, `previous.*` (the last outputs), `clock.sin` and `clock.cos`, in
        the order of the network (gaitlab explain cpg network).
    mean, deviation, clip: normalisation of the inputs. centre (rad, per joint with a motor) and scale (rad): set points = centre + scale
        times output. frequency: of the clock, Hz.
    """

    def __init__(
        self,
        envs: "Episodes",
        layers: Sequence[tuple[Any, Any, str]],
        *,
        inputs: Sequence[str],
        mean: Any = 0.0,
        deviation: Any = 1.0,
        clip: float = 10.0,
        centre: Any = 0.0,
        scale: Any = 0.3,
        frequency: float = 1.0,
    ) -> None:
        if envs.parts != ["setpoint"] or envs.every != 1:
            raise ValueError("a policy needs environments that are stepped by set points, every tick: action=\"setpoint\", every=1")
        self._envs = envs
        observed = [column.name for column in envs.columns]
        self._own = [f"previous.{joint}" for joint in envs.joints] + ["clock.sin", "clock.cos"]
        self.inputs = list(inputs)
        self._columns: list[int] = []
        for pattern in self.inputs:
            found = [k for k, name in enumerate(observed + self._own) if fnmatch.fnmatchcase(name, pattern.replace("[", "[[]"))]
            if not found:
                raise ValueError(f"input {pattern!r} is unknown; expected a column of the observation, previous.JOINT, clock.sin or clock.cos")
            self._columns += found
        n, motors = len(self._columns), len(envs.joints)
        self.layers = [(np.asarray(w, dtype=np.float64), np.asarray(b, dtype=np.float64), str(a)) for w, b, a in layers]
        width = n
        for k, (weights, bias, activation) in enumerate(self.layers):
            if activation not in _ACTIVATIONS:
                raise ValueError(f"activation {activation!r} of layer {k} is unknown; expected {', '.join(_ACTIVATIONS)}")
            if weights.ndim != 2 or weights.shape[1] != width or bias.shape != weights.shape[:1]:
                raise ValueError(f"layer {k} has weights {weights.shape} and bias {bias.shape}; expected (outputs, {width}) and (outputs,)")
            if not (np.all(np.isfinite(weights)) and np.all(np.isfinite(bias))):
                raise ValueError(f"layer {k} has a number that is not finite")
            width = len(weights)
        if not self.layers:
            raise ValueError("layers is empty; expected at least one (weights, bias, activation)")
        if width != motors:
            raise ValueError(f"the last layer gives {width} numbers; the robot has {motors} motors")
        self.mean = np.broadcast_to(np.asarray(mean, dtype=np.float64), (n,))
        self.deviation = np.broadcast_to(np.asarray(deviation, dtype=np.float64), (n,))
        self.centre = np.broadcast_to(np.asarray(centre, dtype=np.float64), (motors,))
        self.scale = np.broadcast_to(np.asarray(scale, dtype=np.float64), (motors,))
        self.clip, self.frequency = float(clip), float(frequency)
        checked: list[tuple[str, Union[float, None], Any]] = [
            ("mean", None, self.mean),
            ("deviation", 1e-300, self.deviation),
            ("clip", 1e-300, self.clip),
            ("centre", None, self.centre),
            ("scale", 0, self.scale),
            ("frequency", 0, self.frequency),
        ]
        for name, least, numbers in checked:
            if not np.all(np.isfinite(numbers)) or (least is not None and np.min(numbers) < least):
                raise ValueError(f"{name} has a number that is not finite" + ("" if least is None else ", negative or 0" if least else " or negative"))
        self.previous = np.zeros((envs.n, motors))
        """The last outputs, a row per environment; 0 after a reset."""

    def act(self) -> Any:
        """The set points for the present tick (n x motors), rad."""
        time = self._envs.truth["time"]
        self.previous[time == 0] = 0
        phase = 2 * np.pi * self.frequency * time
        all_inputs = np.column_stack([self._envs.observations, self.previous, np.sin(phase), np.cos(phase)])
        z = np.clip((all_inputs[:, self._columns] - self.mean) / self.deviation, -self.clip, self.clip)
        for weights, bias, activation in self.layers:
            z = _ACTIVATIONS[activation](z @ weights.T + bias)
        self.previous = z
        return self.centre + self.scale * z

    def save(self, path: Union[str, "os.PathLike[str]"]) -> str:
        """Writes a file for `cpg: {type: ./policy.yaml}`. Returns its absolute path."""
        joints = self._envs.joints
        model = {
            "inputs": self.inputs,
            "mean": self.mean.tolist(),
            "deviation": self.deviation.tolist(),
            "clip": self.clip,
            "layers": [{"weights": w.tolist(), "bias": b.tolist(), "activation": a} for w, b, a in self.layers],
            "centre": {"default": 0, **dict(zip(joints, self.centre.tolist()))},
            "scale": {"default": 0, **dict(zip(joints, self.scale.tolist()))},
        }
        lines = ["gaitlab_cpg: 1", "type: network", f"manual: A policy for {len(joints)} motors.", f"frequency: {self.frequency!r}", "model:"]
        lines += [f"  {key}: {json.dumps(value)}" for key, value in model.items()]
        with open(path_text(path), "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        return os.path.abspath(path_text(path))
