"""Learns a gait by augmented random search (Mania, Guy, Recht, NeurIPS 2018) over stepped environments, and judges it.

usage: learn_walk.py [SCENARIO] [ITERATIONS] [SEED]

The policy is one layer: set point = start + 0.5 rad * tanh(W u), u: a clock, angles and speeds. Each iteration tries 32 directions in W,
both ways, one per environment, and moves W along the best ones. The reward is the way forwards in 3 s, less half of the way sideways,
what it turned, and 0.3 m for a fall. Steps are implicit (fast=True); the best policy then becomes a CPG, which the program simulates and judges with
the accuracy of the scenario.
"""
import os
import sys
import warnings

import numpy as np

import gaitlab

ENVIRONMENTS, SECONDS, FREQUENCY, SCALE = 64, 3.0, 1.0, 0.5
TRIED, KEPT, STEP, RATE = 32, 12, 0.15, 0.08


def train(scenario, iterations, seed):
    """The matrix W, and the mean and best way (m) of each iteration."""
    envs = gaitlab.start(scenario, ENVIRONMENTS, fast=True, terminate="fall")
    columns = [column.name for column in envs.columns]
    angles = [columns.index(f"angle.{joint}") for joint in envs.joints]
    speeds = [columns.index(f"speed.{joint}") for joint in envs.joints]
    start = envs.reset()[0, angles].copy()
    ticks = int(round(SECONDS / gaitlab_period(envs)))

    def ways(weights):
        """Reward of each environment under its own matrix."""
        obs = envs.reset()
        begin, facing = envs.truth["base.position"].copy(), envs.truth["base.rotation"].copy()
        for _ in range(ticks):
            phase = 2 * np.pi * FREQUENCY * envs.truth["time"][:, None]
            u = np.concatenate([np.sin(phase), np.cos(phase), obs[:, angles] - start, 0.1 * obs[:, speeds]], axis=1)
            obs = envs.step(start + SCALE * np.tanh(np.einsum("njd,nd->nj", weights, u)))
            if all(envs.ended):
                break
        way = envs.truth["base.position"] - begin
        turned = np.sum(envs.truth["base.rotation"] * facing, axis=(1, 2))  # 1 + 2 cos(turn): 3 if it faces as at the start
        return way[:, 0] - 0.5 * np.abs(way[:, 1]) - 0.5 * np.sqrt(np.maximum(0, 3 - turned)) - 0.3 * envs.terminated

    random = np.random.default_rng(seed)
    best = weights = np.zeros((len(envs.joints), 2 + 2 * len(envs.joints)))
    curve, most = [], -np.inf
    for iteration in range(iterations):
        tried = random.standard_normal((TRIED, *weights.shape))
        reward = ways(np.concatenate([weights + STEP * tried, weights - STEP * tried]))
        plus, minus = reward[:TRIED], reward[TRIED:]
        top = np.argsort(-np.maximum(plus, minus))[:KEPT]
        spread = np.concatenate([plus[top], minus[top]]).std() + 1e-9
        if reward.max() > most:
            most = reward.max()
            best = weights + STEP * (tried[plus.argmax()] if plus.max() >= minus.max() else -tried[minus.argmax()])
        weights = weights + RATE / (KEPT * spread) * np.einsum("k,kjd->jd", plus[top] - minus[top], tried[top])
        curve.append((reward.mean(), reward.max()))
        if iteration % 5 == 4:
            print(f"{iteration + 1:4d}  mean {curve[-1][0]:.3f} m, best {curve[-1][1]:.3f} m", flush=True)
    both = ways(np.concatenate([np.repeat(weights[None], TRIED, 0), np.repeat(best[None], TRIED, 0)]))
    return (weights if both[0] >= both[-1] else best), max(both[0], both[-1]), start, curve, envs


def gaitlab_period(envs):
    """The control period, s: the time of one step."""
    envs.reset()
    envs.step(np.zeros((envs.n, len(envs.joints))))
    period = envs.truth["time"][0]
    envs.reset()
    return period


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else "revolve-spider"
    iterations = int(sys.argv[2]) if len(sys.argv) > 2 else 30
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    warnings.simplefilter("ignore", gaitlab.Warning)
    scenario = gaitlab.Scenario(name, {"physics.engine": "articulated", "duration": SECONDS + 1})
    weights, way, start, _, envs = train(scenario, iterations, seed)
    joints = len(envs.joints)
    policy = gaitlab.Policy(
        envs,
        [(np.concatenate([weights[:, :2], weights[:, 2 : 2 + joints], 0.1 * weights[:, 2 + joints :]], axis=1), np.zeros(joints), "tanh")],
        inputs=["clock.sin", "clock.cos"] + [f"angle.{joint}" for joint in envs.joints] + [f"speed.{joint}" for joint in envs.joints],
        mean=np.concatenate([[0, 0], start, np.zeros(joints)]),
        clip=1e6,
        centre=start,
        scale=SCALE,
        frequency=FREQUENCY,
    )
    path = policy.save("policy.yaml")
    run = gaitlab.run(scenario.with_({"cpg": {"type": path}, "duration": 12}))
    print(f"trained: {way:.3f} m in {SECONDS:.0f} s; {iterations * ENVIRONMENTS} episodes")
    print(f"judged over 12 s: {run.summary['distance'] / 4:.3f} m in 3 s; {run.verdict['verdict']}")
    for check in run.verdict["checks"]:
        if check["status"] in ("fail", "not judged"):
            print(f"  {check['id']}: {check['text']}")
    print(f"policy: {os.path.relpath(path)}")


if __name__ == "__main__":
    main()
