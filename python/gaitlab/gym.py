"""Environments for Gymnasium 1.x: gaitlab.gym.Env and gaitlab.gym.VectorEnv, over gaitlab.start."""
from __future__ import annotations

from typing import Any, Callable, Mapping, Union

import numpy as np
import numpy.typing as npt

try:
    import gymnasium
    from gymnasium.vector import AutoresetMode
    from gymnasium.vector.utils import batch_space
except ImportError as error:
    raise ImportError("gaitlab.gym needs gymnasium (pip install gymnasium); gaitlab.start needs nothing") from error

from ._episodes import Episodes, Truth, start
from ._scenario import Scenario, scenario_of

Array = npt.NDArray[Any]
Reward = Callable[[Any, Truth, Any, Any], Any]


class _Progress:
    """The reward without one of the user's: way forwards (m) less 0.02 of the electrical energy over the weight, per step."""

    def __init__(self, scenario: Scenario) -> None:
        self._weight = 9.81 * scenario.check().mass
        self._before = np.empty((0, 2))

    def begin(self, truth: Truth, mask: Any) -> None:
        now = np.column_stack([truth["base.position"][:, 0], truth["energy"]])
        self._before = np.where(mask[:, None], now, self._before) if len(self._before) == len(now) else now

    def __call__(self, obs: Any, truth: Truth, action: Any, after: Any) -> Array:
        now = np.column_stack([truth["base.position"][:, 0], truth["energy"]])
        way, energy = (now - self._before).T
        self._before = now
        return np.asarray(way - 0.02 * energy / self._weight)


class _Stepped:
    """Environments with spaces and a reward."""

    def __init__(self, scenario: Union[Scenario, str], n: int, reward: Union[Reward, None], settings: Mapping[str, Any]) -> None:
        self.scenario = scenario_of(scenario)
        self.envs: Episodes = start(self.scenario, n, copy=True, **settings)
        self._reward: Reward = reward or _Progress(self.scenario)
        ranges = self.scenario.check().ranges
        low, high = (np.array([float(np.clip(ranges[joint][side], -3.2, 3.2)) for joint in self.envs.joints]) for side in (0, 1))
        parts = self.envs.parts
        if parts != ["setpoint"]:
            low, high = (np.full(len(self.envs.action_columns), side) for side in (-np.inf, np.inf))
        width = len(self.envs.columns)
        self.observation = gymnasium.spaces.Box(-np.inf, np.inf, (width,), np.float64)
        self.action = gymnasium.spaces.Box(low, high, dtype=np.float64)
        self._obs = self.envs.observations

    def reset(self, mask: Any, options: Union[Mapping[str, Any], None]) -> Array:
        self._obs = self.envs.reset(mask, **(options or {}))
        if isinstance(self._reward, _Progress):
            self._reward.begin(self.envs.truth, mask)
        return self._obs

    def step(self, action: Any) -> tuple[Array, Array]:
        after = self.envs.step(action)
        reward = np.asarray(self._reward(self._obs, self.envs.truth, action, after), dtype=np.float64)
        if reward.shape != (self.envs.n,):
            raise ValueError(f"reward returned {reward.shape}; expected ({self.envs.n},)")
        self._obs = after
        return after, reward


class Env(gymnasium.Env):  # type: ignore[misc,type-arg,unused-ignore]
    """One environment. Settings are those of gaitlab.start; `options` of reset are those of Episodes.reset (angles ...). A seed of
    reset() concerns the spaces alone: the noise of the sensors follows the setting `seed` of the scenario."""

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, scenario: Union[Scenario, str], reward: Union[Reward, None] = None, **settings: Any) -> None:
        self._own = _Stepped(scenario, 1, reward, {"record": False, **settings})
        self.envs = self._own.envs
        self.observation_space, self.action_space = self._own.observation, self._own.action

    def reset(self, *, seed: Union[int, None] = None, options: Union[Mapping[str, Any], None] = None) -> tuple[Array, dict[str, Any]]:
        super().reset(seed=seed)
        return self._own.reset(np.ones(1, dtype=bool), options)[0], {}

    def step(self, action: Any) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        obs, reward = self._own.step(np.asarray(action)[None, :])
        return obs[0], float(reward[0]), bool(self.envs.terminated[0]), bool(self.envs.truncated[0]), {}


class VectorEnv(gymnasium.vector.VectorEnv):  # type: ignore[misc,type-arg,unused-ignore]
    """Many environments. autoreset: NEXT_STEP (default: the step after the end resets, with reward 0), SAME_STEP (the step of the end
    resets; its observation is in info["final_obs"]) or DISABLED (reset(options={"reset_mask": mask}))."""

    def __init__(
        self,
        scenario: Union[Scenario, str],
        n: int,
        reward: Union[Reward, None] = None,
        autoreset: Any = AutoresetMode.NEXT_STEP,
        **settings: Any,
    ) -> None:
        self._own = _Stepped(scenario, n, reward, {"record": False, **settings})
        self.envs = self._own.envs
        self.num_envs = n
        self.metadata = {"autoreset_mode": autoreset}
        self.single_observation_space, self.single_action_space = self._own.observation, self._own.action
        self.observation_space, self.action_space = batch_space(self._own.observation, n), batch_space(self._own.action, n)
        self._mode = autoreset
        self._over = np.zeros(n, dtype=bool)

    def reset(self, *, seed: Any = None, options: Union[Mapping[str, Any], None] = None) -> tuple[Array, dict[str, Any]]:
        given = dict(options or {})
        mask = np.asarray(given.pop("reset_mask", np.ones(self.num_envs, dtype=bool)))
        obs = self._own.reset(mask, given)
        self._over = self._over & ~mask
        return obs, {}

    def step(self, actions: Any) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        info: dict[str, Any] = {}
        again = self._over if self._mode == AutoresetMode.NEXT_STEP else np.zeros(self.num_envs, dtype=bool)
        if again.all():
            obs, reward = self._own.reset(again, None), np.zeros(self.num_envs)
        else:
            obs, reward = self._own.step(actions)
            if again.any():
                obs = self._own.reset(again, None)
                reward = np.where(again, 0.0, reward)
        terminated, truncated = self.envs.terminated, self.envs.truncated
        self._over = terminated | truncated
        if self._mode == AutoresetMode.SAME_STEP and self._over.any():
            info = {"final_obs": obs, "_final_obs": self._over}
            obs = self._own.reset(self._over, None)
            self._over = np.zeros(self.num_envs, dtype=bool)
        return obs, reward, terminated, truncated, info
