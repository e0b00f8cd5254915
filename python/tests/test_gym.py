"""gaitlab.gym against a stub of the parts of Gymnasium 1.x that it uses."""
import importlib
import sys
import types
import unittest

import numpy as np

import gaitlab

from test_episodes import hexapod


def stub():
    """Modules gymnasium, gymnasium.vector and gymnasium.vector.utils."""

    class Box:
        def __init__(self, low, high, shape=None, dtype=np.float32):
            self.shape = np.shape(low) if shape is None else shape
            self.low, self.high, self.dtype = np.broadcast_to(low, self.shape), np.broadcast_to(high, self.shape), dtype

    class Env:
        def reset(self, *, seed=None, options=None):
            self.seed = seed

    class AutoresetMode:
        NEXT_STEP, SAME_STEP, DISABLED = "NextStep", "SameStep", "Disabled"

    gymnasium, vector, utils = (types.ModuleType(name) for name in ("gymnasium", "gymnasium.vector", "gymnasium.vector.utils"))
    gymnasium.Env, gymnasium.spaces, gymnasium.vector = Env, types.SimpleNamespace(Box=Box), vector
    vector.VectorEnv, vector.AutoresetMode, vector.utils = type("VectorEnv", (), {}), AutoresetMode, utils
    utils.batch_space = lambda space, n: Box(np.tile(space.low, (n, 1)), np.tile(space.high, (n, 1)), dtype=space.dtype)
    return {module.__name__: module for module in (gymnasium, vector, utils)}


class Gym(unittest.TestCase):
    def setUp(self):
        self.before = {name: sys.modules.get(name) for name in stub()}
        sys.modules.update(stub())
        sys.modules.pop("gaitlab.gym", None)
        self.gym = importlib.import_module("gaitlab.gym")

    def tearDown(self):
        for name, module in self.before.items():
            sys.modules.pop(name) if module is None else sys.modules.update({name: module})
        sys.modules.pop("gaitlab.gym", None)

    def test_one(self):
        env = self.gym.Env(hexapod(duration=0.15))
        obs, info = env.reset(seed=3)
        self.assertEqual((obs.shape, info), (env.observation_space.shape, {}))
        self.assertTrue(np.all(env.action_space.low >= -1.6) and np.all(env.action_space.high <= 1.6))
        for k in range(10):
            obs, reward, terminated, truncated, info = env.step(np.zeros(env.action_space.shape))
            self.assertEqual((terminated, truncated), (False, k == 9))
            self.assertTrue(np.isfinite(reward))

    def test_resets_of_a_vector(self):
        own = [{"duration": 0.15}, {"duration": 0.3}, {"duration": 0.3}]
        modes = self.gym.AutoresetMode
        for mode in (modes.NEXT_STEP, modes.SAME_STEP, modes.DISABLED):
            env = self.gym.VectorEnv(hexapod(), 3, autoreset=mode, overrides=own)
            self.assertEqual(env.metadata["autoreset_mode"], mode)
            first, _ = env.reset()
            action = np.zeros(env.action_space.shape)
            for _ in range(9):
                env.step(action)
            obs, reward, terminated, truncated, info = env.step(action)
            self.assertEqual(list(truncated), [True, False, False])
            if mode == modes.SAME_STEP:
                self.assertTrue(np.array_equal(obs[0], first[0]) and not np.array_equal(info["final_obs"][0], first[0]))
                continue
            self.assertFalse(np.array_equal(obs[0], first[0]))
            last = obs[0]
            if mode == modes.DISABLED:
                env.reset(options={"reset_mask": np.array([True, False, False])})
            obs, reward, terminated, truncated, info = env.step(action)
            if mode == modes.NEXT_STEP:
                self.assertTrue(np.array_equal(obs[0], first[0]))
                self.assertEqual(reward[0], 0)
            self.assertEqual(list(truncated), [False, False, False])
            self.assertFalse(np.array_equal(obs[0], last))

    def test_a_reward_of_the_user(self):
        env = self.gym.VectorEnv(hexapod(), 2, lambda obs, truth, action, after: truth["base.position"][:, :1])
        env.reset()
        with self.assertRaisesRegex(ValueError, r"reward returned \(2, 1\); expected \(2,\)"):
            env.step(np.zeros(env.action_space.shape))

    def test_without_gymnasium(self):
        for name in self.before:
            sys.modules[name] = None
        sys.modules.pop("gaitlab.gym", None)
        with self.assertRaisesRegex(ImportError, "gaitlab.gym needs gymnasium"):
            importlib.import_module("gaitlab.gym")
        gaitlab.start(hexapod())


if __name__ == "__main__":
    unittest.main()
