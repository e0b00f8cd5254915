"""gaitlab: gaits of modular robots, simulated and judged. All numbers are in SI units, angles in rad.

    import gaitlab
    scenario = gaitlab.Scenario("hexapod", {"physics.engine": "articulated", "duration": 6})
    run = gaitlab.run(scenario)
    print(run.verdict["verdict"], run.summary["speed"])
    torque = run.trace["joint.0.torque"]        # N m, a value per row
    table = gaitlab.rollouts(scenario, [{"cpg.frequency": f} for f in (0.5, 1.0)]).to_pandas()

Names of settings, columns and quantities, and their definitions, are those of the program gaitlab.
"""
from ._native import InputError, RunError, build
from ._plugins import Joint, controller, cpg
from ._episodes import Column, Episodes, Truth, start
from ._evaluator import Evaluator
from ._policy import Policy
from ._rollouts import Rollouts, quantities, rollouts
from ._run import Run, read, run
from ._scenario import Check, Leg, Scenario
from ._search import Search
from ._study import Study, study
from ._table import Table
from ._warnings import Warning

__version__ = build.partition("+")[0]

for _error in (InputError, RunError):
    _error.__module__ = "gaitlab"
del _error

__all__ = [
    "Check",
    "Column",
    "Episodes",
    "Evaluator",
    "InputError",
    "Joint",
    "Leg",
    "Policy",
    "Rollouts",
    "Run",
    "RunError",
    "Scenario",
    "Search",
    "Study",
    "Table",
    "Truth",
    "Warning",
    "build",
    "controller",
    "cpg",
    "quantities",
    "read",
    "rollouts",
    "run",
    "start",
    "study",
]
