"""Simulations stepped from Python: the bits of a run, resets, snapshots, truth, and refused arguments."""
import gc
import json
import multiprocessing
import os
import resource
import unittest

import numpy as np

import gaitlab

from common import FAST, InFolder

HEXAPOD = {**FAST, "physics.estimate": "off", "duration": 1.5}


def hexapod(**more):
    return gaitlab.Scenario("hexapod", {**HEXAPOD, **more})


def set_points(run):
    """Set points by control tick, from the poses of a run."""
    joints = len([name for name in run.poses.columns if name.endswith(".setpoint")])
    return np.array([run.poses[f"joint.{j}.setpoint"][1:] for j in range(joints)]).T


class Bits(unittest.TestCase):
    def test_set_points_of_a_run_give_its_run(self):
        scenario = hexapod(**{"physics.estimate": "full"})
        expected = gaitlab.run(scenario)
        envs = scenario.start()
        for row in set_points(expected):
            envs.step(row[None, :])
        self.assertEqual(envs.ended[0], "done")
        again = envs.run(0)
        for name in expected.trace.columns:
            if not name.startswith("cpg."):
                self.assertTrue(np.array_equal(again.trace[name], expected.trace[name]), name)

    def test_a_long_episode_has_the_verdict_of_its_run(self):
        scenario = hexapod(**{"physics.estimate": "full", "duration": 9})
        expected = gaitlab.run(scenario)
        envs = scenario.start()
        for row in set_points(expected):
            envs.step(row[None, :])
        again = envs.run(0, period=2)
        self.assertEqual(again.verdict["verdict"], expected.verdict["verdict"])
        for one, other in zip(expected.verdict["checks"], again.verdict["checks"]):
            self.assertEqual(json.dumps(one), json.dumps(other))

    def test_order_threads_and_lanes_change_no_bit(self):
        frictions = [{"ground.friction": 0.4 + 0.1 * k} for k in range(6)]
        random = np.random.default_rng(1)
        actions = 0.3 * random.standard_normal((12, 6, len(hexapod().joints)))

        def play(order, threads, lanes):
            envs = gaitlab.start(hexapod(), overrides=[frictions[k] for k in order], threads=threads, lanes=lanes, copy=True)
            rows = [envs.reset()] + [envs.step(action[order]) for action in actions]
            back = np.argsort(order)
            return np.array([row[back] for row in rows]).tobytes()

        order = np.arange(6)
        expected = play(order, 1, 1)
        for case in ((order, 1, 0), (order, 2, 4), (np.array([3, 1, 5, 0, 2, 4]), 3, 0)):
            self.assertEqual(play(*case), expected)

    def test_resets_of_some_are_fresh_episodes(self):
        envs = gaitlab.start(hexapod(), 5, copy=True)
        action = np.tile(0.2 * np.sin(np.arange(len(envs.joints))), (5, 1))
        fresh = [envs.reset()[0]] + [envs.step(action)[0] for _ in range(20)]
        random = np.random.default_rng(2)
        since = np.zeros(5, dtype=int) + 20
        for _ in range(40):
            mask = random.random(5) < 0.2
            obs = envs.reset(mask)
            since[mask] = 0
            for i in np.flatnonzero(since <= 20):
                self.assertTrue(np.array_equal(obs[i], fresh[since[i]]))
            envs.step(action)
            since += 1

    def test_a_snapshot_continues_in_another_process(self):
        envs = gaitlab.start(hexapod(), 3, copy=True)
        action = np.full((3, len(envs.joints)), 0.1)
        for _ in range(8):
            envs.step(action)
        kept = envs.snapshot()
        expected = np.array([envs.step(action) for _ in range(8)])
        with multiprocessing.get_context("fork").Pool(1) as pool:
            self.assertEqual(pool.apply(continued, (kept, action)), expected.tobytes())
        envs.restore(kept)
        self.assertEqual(np.array([envs.step(action) for _ in range(8)]).tobytes(), expected.tobytes())
        with self.assertRaisesRegex(gaitlab.InputError, "3 environments of hexapod.*2 environments of hexapod|damaged|other"):
            gaitlab.start(hexapod(), 2).restore(kept)
        with self.assertRaisesRegex(gaitlab.InputError, "expected the bytes of snapshot"):
            envs.restore(b"nothing")


def continued(kept, action):
    envs = gaitlab.start(hexapod(), 3, copy=True)
    envs.restore(kept)
    return np.array([envs.step(action) for _ in range(8)]).tobytes()


class Rows(unittest.TestCase):
    def test_truth_and_columns(self):
        envs = gaitlab.start(hexapod(**{"sensors": {"imu": {"type": "imu", "body": "m0/active"}}}), 2)
        names = [column.name for column in envs.columns]
        self.assertEqual(len(names), len(set(names)))
        for name in ("angle.m0/active", "speed.m0/active", "torque.m0/active", "load.m0/active", "touching.m0", "imu.roll"):
            self.assertIn(name, names)
        obs = envs.reset()
        self.assertEqual(obs.shape, (2, len(names)))
        with self.assertRaises(ValueError):
            obs[0, 0] = 1
        for _ in range(10):
            envs.step(np.zeros((2, len(envs.joints))))
        self.assertEqual(envs.truth["base.position"].shape, (2, 3))
        rotation = envs.truth["base.rotation"]
        self.assertLess(np.abs(rotation[0] @ rotation[0].T - np.eye(3)).max(), 1e-12)
        self.assertAlmostEqual(envs.truth["time"][0], 0.15)
        self.assertEqual(envs.truth["leg.load"].shape, (2, 6))
        self.assertEqual(gaitlab.start("caterpillar", 2).truth["leg.load"].shape, (2, 0))
        with self.assertRaisesRegex(KeyError, "no truth 'base.pose'; known: base.position"):
            envs.truth["base.pose"]
        self.assertGreater(envs.truth["energy"][0], 0)
        weight = gaitlab.Scenario("hexapod", HEXAPOD).check().mass * 9.81
        self.assertLess(abs(envs.truth["leg.load"][0].sum() / weight - 1), 0.5)  # it still swings on its contacts

    def test_angles_of_a_reset(self):
        envs = gaitlab.start(hexapod(), 2, record=True)
        angles = np.zeros((2, len(hexapod().joints)))
        angles[1] = 0.05
        obs = envs.reset(angles=angles, base_velocity=[0.1, 0, 0])
        self.assertTrue(np.all(obs[1, : angles.shape[1]] == 0.05))
        self.assertAlmostEqual(envs.truth["base.velocity"][1, 0], 0.1)
        for _ in range(20):
            envs.step(np.zeros((2, len(envs.joints))))
        envs.run(1)  # has the bits of the episode, or raises

    def test_terminate(self):
        envs = gaitlab.start(hexapod(), 2, terminate=lambda truth: truth["time"] > 0.1 * np.array([1, 5]))
        for _ in range(10):
            envs.step(np.zeros((2, len(envs.joints))))
        self.assertEqual(list(envs.ended), ["stopped", ""])
        self.assertEqual(list(envs.terminated), [True, False])
        upright = gaitlab.start(hexapod(**{"limits.tilt": 0.05}), 2, terminate="fall")
        upright.reset(base_velocity=[[0, 0, 0], [0, 0, 2]], base_angular_velocity=[[0, 0, 0], [3, 0, 0]])  # the second is thrown
        for _ in range(90):
            upright.step(np.zeros((2, len(upright.joints))))
        self.assertEqual(list(upright.ended), ["", "stopped"])
        self.assertRegex(upright.message(1), r"stopped by terminate at t = 0\.\d+ s")

    def test_commands_and_several_ticks(self):
        scenario = hexapod()
        run = gaitlab.run(scenario)
        envs = gaitlab.start(scenario, 1, action="command", copy=True)
        # The commands in force at the row of a tick end with the next tick: rows every 5 ms, ticks every 15 ms.
        volts = np.array([run.trace[f"joint.{j}.voltage_command"][1::3] for j in range(len(scenario.joints))]).T
        for row in volts[:60]:
            envs.step(row[None, :])
        at = list(run.poses["t"]).index(envs.truth["time"][0])
        self.assertEqual(envs.truth["base.position"][0, 2], run.poses["base.z"][at])
        one, three = (gaitlab.start(hexapod(duration=0.2), 2, every=every, copy=True) for every in (1, 3))
        action = np.full((2, len(one.joints)), 0.1)
        for _ in range(5):  # 14 ticks; the last step ends after two
            for _ in range(3):
                if not all(one.ended):
                    one.step(action)
            three.step(action)
        self.assertTrue(np.array_equal(one.observations, three.observations) and list(three.ended) == ["done", "done"])

    def test_steering_reaches_the_legs(self):
        sensors = {"remote": {"type": "steering", "values": {"speed": {"unit": "m/s"}, "turn": {"unit": "rad/s"}}}}
        model = {"gait": "trot", "lift": 0.034, "steering": "remote"}
        dog = gaitlab.Scenario("dog-trot", {"sensors": sensors, "cpg.model": model, "duration": 6})
        envs = gaitlab.start(dog, 3, action=["steering", "residual"], every=5, fast=True, copy=True)
        self.assertEqual(envs.action_columns, ["remote.speed", "remote.turn", *envs.joints])
        where = [column.name for column in envs.columns].index("remote.turn")
        sent = np.array([[0.19, 0.3], [0.19, 0], [0.1, -0.3]])
        while "" in list(envs.ended):
            obs = envs.step(np.hstack([sent, np.zeros((3, len(envs.joints)))]))
            self.assertEqual(list(obs[:, where]), list(sent[:, 1]))
            rotation, position = envs.truth["base.rotation"], envs.truth["base.position"]
        heading = np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0])
        self.assertGreater(heading[0], 1)  # rad, of 1.8 less the start
        self.assertLess(abs(heading[1]), 0.1)
        self.assertLess(heading[2], -1)
        self.assertGreater(position[1, 0], 0.7)  # m, of 1.14 less the start
        self.assertEqual(list(envs.reset()[:, where]), [0, 0, 0])

    def test_the_run_of_a_steered_episode_has_what_was_sent(self):
        @gaitlab.controller("test_steered", unit="V")
        class Leaning:
            def __init__(self, joints, settings):
                pass

            def update(self, m, setpoint, limit, x, command):
                lamp = m.channels[m.channel_names.index("second.lamp")]
                command[:] = 30 * (setpoint + 0.1 * lamp - m.angle)

        sensors = {
            "remote": {"type": "steering", "values": {"speed": {"unit": "m/s"}}},
            "second": {"type": "steering", "values": {"lamp": {"points": [[0, 1]]}}},
        }
        model = {"gait": "trot", "lift": 0.034, "steering": "remote"}
        settings = {"sensors": sensors, "cpg.model": model, "controller": {"type": "test_steered", "period": 0.002}, "physics.estimate": "off"}
        envs = gaitlab.start(gaitlab.Scenario("dog-trot", {**settings, "trace.columns": ["sensor.*"], "trace.period": 0.002}), 1, action="steering", copy=True)
        sent = [[0.1, 0]] * 3 + [[0.2, 0.5]] + [[0.2, -0.5]] * 4 + [[0.05, 0.3]] * 2
        for k, row in enumerate(sent):
            envs.step([row])
            if k == 4:
                kept = envs.snapshot()
        envs.restore(kept)
        for row in sent[5:]:
            envs.step([row])
        trace = envs.run(0).trace  # raises if it does not end as the episode
        self.assertEqual([[a, b] for a, b in zip(trace["sensor.remote.speed"], trace["sensor.second.lamp"])][1:], sent)


    def test_the_last_row_is_that_of_a_longer_episode(self):
        short, long = (gaitlab.start(hexapod(duration=duration), 1, copy=True) for duration in (0.15, 1))
        for _ in range(10):
            rows = [envs.step(np.full((1, len(envs.joints)), 0.1)) for envs in (short, long)]
        self.assertEqual(short.ended[0], "done")
        self.assertTrue(np.array_equal(*rows))
        for name in short.truth:
            self.assertTrue(np.array_equal(short.truth[name], long.truth[name]), name)

    def test_memory_does_not_grow(self):
        envs = gaitlab.start(hexapod(duration=1000), 8, fast=True)
        action = np.zeros((8, len(envs.joints)))
        for _ in range(50):
            envs.step(action)
        gc.collect()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(600):
            envs.step(action)
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 1024)  # kB

    def test_fast_steps_are_implicit(self):
        slow, fast = hexapod().start(), hexapod().start(fast=True)
        for _ in range(20):
            slow.step(np.zeros((1, len(slow.joints))))
            fast.step(np.zeros((1, len(fast.joints))))
        a, b = slow.truth["base.position"], fast.truth["base.position"]
        self.assertFalse(np.array_equal(a, b))
        self.assertLess(np.abs(a - b).max(), 2e-3)  # m; the feet sink by 1 mm at the landing, at times that differ by a step
        fast.run(0)
        dog = gaitlab.start("dog-trot", 2, fast=True, overrides=[{"duration": 0.5013}, {}])  # steps of 2 ms, rows every 5 ms
        for _ in range(260):
            dog.step(np.zeros((2, len(dog.joints))) + dog.observations[:, : len(dog.joints)])
        self.assertEqual(list(dog.ended), ["done", ""])


class Policies(InFolder):
    def policy(self, envs, joints):
        random = np.random.default_rng(4)
        inputs = ["angle.*", "speed.*", "load.*", "imu.roll", "previous.*", "clock.sin", "clock.cos"]
        width = 3 * len(hexapod().joints) + 1 + joints + 2
        layers = [(0.3 * random.standard_normal((16, width)), 0.1 * random.standard_normal(16), "tanh"),
                  (0.3 * random.standard_normal((joints, 16)), np.zeros(joints), "elu")]
        return gaitlab.Policy(envs, layers, inputs=inputs, mean=0.01, deviation=2.0, centre=0.02, scale=0.2, frequency=0.7)

    def test_a_policy_becomes_a_cpg(self):
        scenario = hexapod(**{"sensors": {"imu": {"type": "imu", "body": "m0/active"}}})
        envs = scenario.start()
        policy = self.policy(envs, len(envs.joints))
        policy.save("policy.yaml")
        saved = scenario.with_({"cpg": {"type": os.path.abspath("policy.yaml")}})
        self.assertIn("frequency: 0.7", saved.resolved)
        self.assertIn("type: network", saved.resolved)
        run = gaitlab.run(saved)
        first = policy.act()
        network = np.array([run.poses[f"joint.{scenario.joints.index(name)}.setpoint"][1] for name in envs.joints])
        self.assertLess(np.abs(first[0] - network).max(), 1e-12)
        for _ in range(20):
            envs.step(policy.act())
        at = list(run.poses["t"]).index(envs.truth["time"][0])
        self.assertLess(abs(run.poses["base.z"][at] - envs.truth["base.position"][0, 2]), 1e-6)
        # The network of the scenario, stepped by residuals of 0, is the run, bit for bit.
        stepped = saved.start(action="residual")
        for k in range(40):
            self.assertEqual(stepped.truth["base.position"][0, 0], run.poses["base.x"][k])
            stepped.step(np.zeros((1, len(stepped.joints))))

    def test_refused(self):
        envs = hexapod().start()
        joints = len(envs.joints)
        good = (np.zeros((joints, 1)), np.zeros(joints), "tanh")
        for text, layers, inputs in (("input 'imu.roll' is unknown", [good], ["imu.roll"]), ("expected \\(outputs, 1\\)", [(np.zeros((joints, 2)), np.zeros(joints), "tanh")], ["clock.sin"]),
                                     ("the robot has", [(np.zeros((1, 1)), np.zeros(1), "tanh")], ["clock.sin"]), ("not finite", [(np.full((joints, 1), np.nan), np.zeros(joints), "tanh")], ["clock.sin"]),
                                     ("'cos' of layer 0 is unknown", [(*good[:2], "cos")], ["clock.sin"])):
            with self.assertRaisesRegex(ValueError, text):
                gaitlab.Policy(envs, layers, inputs=inputs)


class Refused(unittest.TestCase):
    def check(self, text, call, error=ValueError):
        with self.assertRaisesRegex(error, text):
            call()

    def test_arguments(self):
        envs = gaitlab.start(hexapod(), 2)
        joints = len(envs.joints)
        good = np.zeros((2, joints))
        self.check(rf"action has the shape \(2, {joints + 1}\); expected \(2, {joints}\), for setpoint: m0/", lambda: envs.step(np.zeros((2, joints + 1))))
        bad = good.copy()
        bad[1, 3] = np.nan
        self.check("beyond 10000", lambda: envs.reset(speeds=np.full(len(hexapod().joints), 1e9)))
        self.check(r"action\[1, 3\] is nan \(m", lambda: envs.step(bad), gaitlab.InputError)
        bad[1, 3] = 57.3
        self.check(r"action\[1\]: the set point of .* is 57.3 rad.* 57.3 degrees are 1 rad", lambda: envs.step(bad), gaitlab.InputError)
        self.check(r"reset\(mask\): expected 2 truth values, got int64 of \(3,\)", lambda: envs.reset(np.zeros(3, dtype=int)))
        self.check("record=True", lambda: envs.run(0))
        self.check("angles: joint .* of environment 1 is at 3 rad; expected -1.571 to 1.571", lambda: envs.reset([False, True], angles=3 * np.ones(len(hexapod().joints))), gaitlab.InputError)
        self.check("base_velocity has a number beyond 10000", lambda: envs.reset(base_velocity=[1e5, 0, 0]))
        self.check("the robot has no motors", lambda: gaitlab.start("pendulum"), gaitlab.InputError)
        self.check("contact.law: bullet allows no snapshot", lambda: gaitlab.start(gaitlab.Scenario("hexapod", {"physics.engine": "bullet", "contact.law": "bullet"})), gaitlab.InputError)
        self.check("action steering needs a sensor of type steering", lambda: gaitlab.start(hexapod(), action="steering"), gaitlab.InputError)
        self.check("'setpoint' replaces the CPG, so that 'steering' has no effect", lambda: gaitlab.start(hexapod(), action=["setpoint", "steering"]))
        self.check("'leap' is unknown", lambda: gaitlab.start(hexapod(), action="leap"))
        self.check("expected 'fall'", lambda: gaitlab.start(hexapod(), terminate="falls"))
        self.check("2 rows for 3 environments", lambda: gaitlab.start(hexapod(), 3, overrides=[{}, {}]))
        self.check(r"overrides\[1\]: error: changes physics", lambda: gaitlab.start(hexapod(), overrides=[{}, {"physics.step": 1e-4}]), gaitlab.InputError)
        self.check(r"ground.frction=1: error: overrides\[1\]: unknown key", lambda: gaitlab.start(hexapod(), overrides=[{}, {"ground.frction": 1}]), gaitlab.InputError)
        bullet = gaitlab.start(gaitlab.Scenario("caterpillar", {"physics.engine": "bullet"}), fast=True)  # steps in the other engine
        bullet.step(np.zeros((1, len(bullet.joints))))
        for _ in range(110):
            if "" not in list(envs.ended):
                break
            envs.step(good)
        self.check("all 2 environments have ended", lambda: envs.step(good))


if __name__ == "__main__":
    unittest.main()
