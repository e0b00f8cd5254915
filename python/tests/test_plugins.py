"""Pattern generators and controllers written in Python."""
import gc
import math
import os
import shutil
import tempfile
import unittest

import numpy as np

import gaitlab

from common import FAST, ROOT, caterpillar, digest, of_class


def register(name, **methods):
    """Registers a class with these methods, as gaitlab.cpg does."""
    return gaitlab.cpg(name)(type("Made", (), {"__init__": lambda self, joints, settings: None, "output": still, **methods}))


def leave(self, m, x):
    pass


def still(self, t, x, setpoint):
    setpoint[:] = 0


class Bits(unittest.TestCase):
    def test_settings_and_joints(self):
        seen = {}

        @gaitlab.cpg("test_sine", amplitude=(0.5, "rad", 0, 2, "Amplitude."), frequency=0.5)
        class Sine:
            def __init__(self, joints, settings):
                seen.update(joints=joints, settings=settings)
                self.phase = np.array([0.3 * joint.module for joint in joints])
                self.settings = settings

            def output(self, t, x, setpoint):
                setpoint[:] = self.settings["amplitude"] * np.sin(2 * math.pi * self.settings["frequency"] * t + self.phase)

        run = gaitlab.run(of_class("test_sine", **{"cpg.amplitude": 1 / 3}))
        self.assertEqual(run.outcome, "done")
        self.assertEqual(seen["settings"], {"amplitude": 1 / 3, "frequency": 0.5})
        self.assertEqual([joint.name for joint in seen["joints"]], caterpillar().joints)
        self.assertIn("amplitude: 0.3333333333333333", run.resolved)
        t, setpoint = run.trace["t"], run.trace["joint.1.setpoint"]
        wanted = np.sin(2 * math.pi * 0.5 * t) / 3
        late = wanted - setpoint  # a set point is held for a control period, 15 ms: at most the change in that time
        self.assertLess(np.abs(late).max(), 0.015 * math.pi / 3 + 1e-12)
        with self.assertRaisesRegex(gaitlab.InputError, "amplitude is 3"):
            of_class("test_sine", **{"cpg.amplitude": 3})

    def test_states_are_integrated(self):
        """x' = -x from 1: the classical Runge-Kutta method of cpg.step has an error of its fourth order."""
        kept = []
        register("test_decay", states=1, start=lambda self, x: x.fill(1), derivative=lambda self, m, x, rate: np.negative(x, rate),
                 output=lambda self, t, x, setpoint: (kept.append((t, x[0])), setpoint.fill(0))[1])
        gaitlab.run(of_class("test_decay"))
        for t, x in kept:
            self.assertAlmostEqual(x, math.exp(-t), delta=1e-8)  # h^4 / 120 for a step of 15 ms: 4e-10
        self.assertGreater(len(kept), 60)

    def test_event_and_measured(self):
        seen = []

        def event(self, m, x):
            seen.append((m.t, m.period, m.angle.shape, m.speed.shape, m.torque.shape, m.touching.shape, m.channels.shape))
            x[0] = 2

        register("test_event", states=1, event=event, output=lambda self, t, x, setpoint: setpoint.fill(0.01 * x[0]))
        run = gaitlab.run(of_class("test_event"))
        joints = len(caterpillar().joints)
        self.assertEqual(seen[0][1:], (0.015, (joints,), (joints,), (joints,), (8,), (0,)))
        self.assertEqual(run.trace["joint.0.setpoint"][-1], 0.02)

    def test_rollouts_have_the_bits_of_runs(self):
        register("test_mixed", output=lambda self, t, x, setpoint: setpoint.fill(0.3 * math.sin(3 * t)))
        table = gaitlab.rollouts(of_class("test_mixed"), [{"ground.friction": 0.4 + 0.1 * k} for k in range(6)], threads=3)
        self.assertEqual(table.outcome, ["done"] * 6)
        run = gaitlab.run(of_class("test_mixed", **{"ground.friction": 0.4 + 0.1 * 2}))
        self.assertEqual(run.summary["speed"], table["speed"][2])

    def test_arrays_are_copies(self):
        kept = []

        def output(self, t, x, setpoint):
            setpoint[:] = 0.1
            kept.append(setpoint)

        register("test_keeps", output=output)
        run = gaitlab.run(of_class("test_keeps"))
        kept[0][:] = 99
        self.assertEqual(set(run.trace["joint.0.setpoint"][1:]), {0.1})


class Exceptions(unittest.TestCase):
    def outcome(self, name, **methods):
        register(name, **methods)
        return gaitlab.run(of_class(name)).outcome

    def test_during_the_run(self):
        def fails(self, *arguments):
            arguments[-1][:] = 0
            if getattr(arguments[0], "t", arguments[0]) > 0.5:
                raise ZeroDivisionError("oops")

        for method in ("output", "derivative", "event"):
            with self.subTest(method):
                outcome = self.outcome("test_fails_" + method, states=1, **{"event": leave, method: fails})
                self.assertRegex(outcome, f"cpg 'test_fails_{method}' \\(Python\\): {method} threw: ZeroDivisionError: oops "
                                          r"\(.*test_plugins.py:\d+\)")

    def test_before_the_run(self):
        def fails(self, *arguments):
            raise KeyError("lost")

        for method in ("__init__", "start"):
            with self.subTest(method), self.assertRaisesRegex((gaitlab.InputError, gaitlab.RunError), "KeyError: 'lost'"):
                register("test_fails" + method, states=1, event=leave, **{method: fails})
                gaitlab.run(of_class("test_fails" + method))

    def test_wrong_use(self):
        outcome = self.outcome("test_resizes", output=lambda self, t, x, setpoint: setpoint.resize(3, refcheck=False))
        self.assertRegex(outcome, "the size of an array was changed")
        for method, returned in (("output", "ndarray"), ("derivative", "list")):
            outcome = self.outcome("test_returns_" + method, states=1, event=leave,
                                   **{method: lambda self, *arguments: np.zeros(9) if returned == "ndarray" else [1]})
            self.assertRegex(outcome, rf"{method}\(\) returned {returned}; expected a method that fills its argument")
        outcome = self.outcome("test_fills_none", output=lambda self, t, x, setpoint: None)
        self.assertRegex(outcome, r"output\(\) filled no set point; expected a method that fills its argument, as in setpoint\[:\]")
        with self.assertRaisesRegex(TypeError, r"Made has states, but neither derivative\(m, x, rate\) nor event\(m, x\)"):
            register("test_states", states=1)
        with self.assertRaisesRegex(TypeError, r'gaitlab.cpg\("test_none"\) decorates a class, not int'):
            gaitlab.cpg("test_none")(3)
        for value in (10**400, "high", None, (1, 2), (1, "", "low", 3, "Wrong.")):
            with self.subTest(value=str(value)[:20]), self.assertRaisesRegex(ValueError, "^setting gain is .*; expected a number, or "):
                gaitlab.cpg("test_none", gain=value)
        with self.assertRaisesRegex(TypeError, "has none"):
            gaitlab.cpg("test_none")(type("None_", (), {}))
        with self.assertRaisesRegex(gaitlab.InputError, "registered twice"):
            register("hopf")
        with self.assertRaisesRegex(gaitlab.InputError, "invalid name"):
            register("two words")

    def test_states(self):
        """An exception in `states`, and a number of states that is not one, are errors, not 0 states."""
        def broken(self):
            raise AttributeError("lost")

        for states, said in ((property(broken), "AttributeError: lost"), (-1, "states is -1; expected a whole number"),
                             (1.5, "states is 1.5; expected a whole number"), (10**12, "states is 1000000000000; expected")):
            with self.subTest(said), self.assertRaisesRegex((gaitlab.InputError, gaitlab.RunError), said):
                register("test_states", states=states, event=leave)
                gaitlab.run(of_class("test_states"))
        with self.assertRaisesRegex((gaitlab.InputError, gaitlab.RunError), "has states, but neither derivative"):
            register("test_states", __init__=lambda self, joints, settings: setattr(self, "states", 1))
            gaitlab.run(of_class("test_states"))

    def test_is_not_called_beyond_the_run(self):
        """The period of the set points is that within the run: 1 s are 67 ticks of 15 ms, in the run and three that estimate its error."""
        times = []
        register("test_counted", output=lambda self, t, x, setpoint: (times.append(t), setpoint.fill(0.1 * math.sin(t)))[1])
        scenario = of_class("test_counted")
        times.clear()
        gaitlab.run(scenario)
        self.assertLess(max(times), 1)
        self.assertLessEqual(len(times), 4 * 67)
        times.clear()
        gaitlab.rollouts(scenario, [{}], estimate_every=0)
        self.assertLess(max(times), 1)
        self.assertLessEqual(len(times), 67)

    def test_rows_of_rollouts(self):
        def fails(self, t, x, setpoint):
            raise ValueError("no")

        register("test_row_fails", output=fails)
        table = gaitlab.rollouts(of_class("test_row_fails"), [{}, {}])
        self.assertEqual(table.outcome, ["plugin", "plugin"])
        self.assertRegex(table.message[0], "ValueError: no")


class Registration(unittest.TestCase):
    def test_again_replaces(self):
        register("test_again", output=lambda self, t, x, setpoint: setpoint.fill(0.1))
        old = of_class("test_again")
        first = digest(gaitlab.run(old))
        register("test_again", output=lambda self, t, x, setpoint: setpoint.fill(0.2))
        gc.collect()
        self.assertEqual(digest(gaitlab.run(old)), first)
        self.assertEqual(gaitlab.run(of_class("test_again")).trace["joint.0.setpoint"][-1], 0.2)
        self.assertEqual(gaitlab.run(old.with_({"duration": 0.5})).trace["joint.0.setpoint"][-1], 0.2)

    def test_with_finds_a_class_of_later(self):
        scenario = gaitlab.Scenario("caterpillar", FAST)
        register("test_later")
        self.assertEqual(gaitlab.run(scenario.with_({"cpg": {"type": "test_later"}})).outcome, "done")

    def test_with_keeps_the_file_that_was_read(self):
        """After a registration the file is read again: a comment may have changed, but nothing else."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mine.yaml")
            shutil.copyfile(os.path.join(ROOT, "scenarios/pendulum.yaml"), file)
            with open(file) as text:
                read = text.read()
            scenario = gaitlab.Scenario(file, FAST)
            register("test_meanwhile")
            with open(file, "a") as text:
                text.write("# a comment\n")
            self.assertEqual(scenario.with_({"duration": 0.5}).settings["duration"], 0.5)
            register("test_meanwhile")
            with open(file, "w") as text:
                text.write(read.replace("\nname: ", "\nname: other_", 1))
            with self.assertRaisesRegex(gaitlab.InputError, "mine.yaml: error: has changed since the scenario was read"):
                scenario.with_({"duration": 0.5})

    def test_class_ends_with_its_scenarios(self):
        import weakref

        made = register("test_ends")
        ended = weakref.ref(made)
        scenario = of_class("test_ends")
        gaitlab.run(scenario)
        register("test_ends")
        del made
        gc.collect()
        self.assertIsNotNone(ended())
        del scenario
        gc.collect()
        self.assertIsNone(ended())



class Controllers(unittest.TestCase):
    def test_a_proportional_controller_has_the_bits_of_pid(self):
        """pid without integral and derivative: u = clamp(Kp e) at every tick."""

        @gaitlab.controller("test_P", unit="V", Kp=(40, "V/rad", 0, 1000, "Gain."))
        class P:
            def __init__(self, joints, settings):
                self.Kp = settings["Kp"]

            def update(self, m, setpoint, limit, x, command):
                command[:] = self.Kp * (setpoint - m.angle)

        gains = {"Kp": 30, "Ki": 0, "Kd": 0}
        own, pid = (gaitlab.run(caterpillar(**{**FAST, "controller": one})) for one in ({"type": "test_P", "Kp": 30}, {"type": "pid", **gains}))
        self.assertEqual((own.outcome, pid.outcome), ("done", "done"))
        for name in pid.trace.columns:
            self.assertTrue(np.array_equal(own.trace[name], pid.trace[name]), name)
        self.assertGreater(np.abs(pid.trace["joint.0.voltage_command"]).max(), 1)
        self.assertIn("type: test_P", own.resolved)

    def test_states_and_limits(self):
        """An integrator: u grows by the period in every tick from what start() gives, and is cut at the limit."""
        seen = []

        @gaitlab.controller("test_integrator", unit="V")
        class Integrator:
            states = 1

            def __init__(self, joints, settings):
                pass

            def start(self, x):
                x[0] = 3

            def update(self, m, setpoint, limit, x, command):
                seen.append((m.t, x[0], limit[1]))
                x[0] += 1000 * m.period
                command[:] = x[0]

        run = gaitlab.run(caterpillar(**{**FAST, "physics.estimate": "off", "controller": {"type": "test_integrator"}}))
        self.assertEqual(run.outcome, "done")
        for t, x, limit in seen:
            self.assertAlmostEqual(x, 3 + 1000 * t, places=6)
        self.assertAlmostEqual(run.trace["joint.1.voltage_command"].max(), seen[0][2], places=12)

    def test_refused(self):
        with self.assertRaisesRegex(TypeError, r"a controller has a method update\(m, setpoint, limit, x, command\); None_ has none"):
            gaitlab.controller("test_none", unit="V")(type("None_", (), {}))
        with self.assertRaisesRegex(ValueError, "setting period has the name of a key of section controller"):
            gaitlab.controller("test_none", unit="V", period=0.1)
        with self.assertRaisesRegex(ValueError, "setting Kp: the default 5 is outside 0 to 1"):
            gaitlab.controller("test_none", unit="V", Kp=(5, "V", 0, 1, "Gain."))
        with self.assertRaisesRegex(ValueError, "unit is 'A'; expected 'V', 'N m' or 'duty'"):
            gaitlab.controller("test_none", unit="A")
        with self.assertRaisesRegex(gaitlab.InputError, "pid"):
            gaitlab.controller("pid", unit="V")(type("Pid", (), {"update": leave}))

        def run_of(update, unit="V"):
            made = type("Made", (), {"__init__": lambda self, joints, settings: None, "update": update})
            gaitlab.controller("test_bad", unit=unit)(made)
            return gaitlab.run(caterpillar(**{**FAST, "controller": {"type": "test_bad"}}))

        self.assertRegex(run_of(lambda self, m, setpoint, limit, x, command: 1 / 0).outcome, "ZeroDivisionError")
        self.assertRegex(run_of(lambda self, m, setpoint, limit, x, command: setpoint - m.angle).outcome, r"update\(\) returned ndarray; expected a method that fills its argument, as in command\[:\]")
        self.assertRegex(run_of(lambda self, m, setpoint, limit, x, command: command[1:].fill(0)).outcome, r"update\(\) left command\[0\] nan")
        with self.assertRaisesRegex(gaitlab.InputError, "commands N m, but actuator .dc_motor. takes V"):
            run_of(lambda self, m, setpoint, limit, x, command: command.fill(0), unit="N m")


if __name__ == "__main__":
    unittest.main()
