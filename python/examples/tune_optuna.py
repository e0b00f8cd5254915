"""Searches for the fastest feasible gait of the shipped caterpillar with Optuna (Debian: python3-optuna).

tune_optuna.py [BATCHES [SIZE]]: batches of gaits, each simulated side by side.
"""
import sys
import warnings

import gaitlab
import optuna

SPACE = {"cpg.frequency": (0.25, 1.0), "cpg.amplitude": (0.1, 1.2), "cpg.phase_lag": (0.2, 3.1)}
batches, size = (int(word) for word in [*sys.argv[1:], "5", "8"][:2])

warnings.simplefilter("ignore", gaitlab.Warning)
optuna.logging.set_verbosity(optuna.logging.WARNING)
scenario = gaitlab.Scenario("caterpillar", {"physics.engine": "articulated", "duration": 12})
study = optuna.create_study(direction="maximize", sampler=optuna.samplers.TPESampler(seed=1))
for batch in range(batches):
    trials = [study.ask() for _ in range(size)]
    points = [{key: trial.suggest_float(key, *ends) for key, ends in SPACE.items()} for trial in trials]
    table = gaitlab.rollouts(scenario, points, quantities=["speed", "margin"])
    for trial, outcome, speed, margin in zip(trials, table.outcome, table["speed"], table["margin"]):
        if outcome != "done":
            study.tell(trial, state=optuna.trial.TrialState.FAIL)
        else:  # an infeasible gait is worse than every feasible one, by its margin
            study.tell(trial, speed if margin >= 0 else margin)
print(study.best_value, study.best_params)
