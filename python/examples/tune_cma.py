"""Searches for the fastest feasible gait of the shipped caterpillar with a CMA-ES (Hansen 2016, arXiv:1604.00772).

tune_cma.py [GENERATIONS]: a generation's gaits are simulated side by side.
"""
import sys
import warnings

import gaitlab
import numpy as np

SPACE = {"cpg.frequency": (0.25, 1.0), "cpg.amplitude": (0.1, 1.2), "cpg.phase_lag": (0.2, 3.1)}
LOW, HIGH = np.array(list(SPACE.values())).T
scenario = gaitlab.Scenario("caterpillar", {"physics.engine": "articulated", "duration": 12})
warnings.simplefilter("ignore", gaitlab.Warning)


def costs(points):
    """Of points in the unit box: minus the speed (m/s); for an infeasible gait minus its margin, for a failed one 10."""
    settings = [dict(zip(SPACE, LOW + point * (HIGH - LOW))) for point in points]
    table = gaitlab.rollouts(scenario, settings, quantities=["speed", "margin"])
    cost = np.where(table["margin"] >= 0, -table["speed"], -table["margin"])
    return np.where(np.isfinite(cost), cost, 10.0)


class CmaEs:
    """The (mu/mu_w, lambda) strategy with cumulative step-size adaptation, rank-one and rank-mu update."""

    def __init__(self, mean, sigma, seed):
        self.mean, self.sigma, self.random = np.array(mean, float), sigma, np.random.default_rng(seed)
        n = self.n = len(mean)
        self.size = 4 + int(3 * np.log(n))
        weights = np.log(self.size / 2 + 0.5) - np.log(np.arange(1, self.size // 2 + 1))
        self.weights = weights / weights.sum()
        mu = self.mu = 1 / (self.weights**2).sum()
        self.c_sigma, self.c_c = (mu + 2) / (n + mu + 5), (4 + mu / n) / (n + 4 + 2 * mu / n)
        self.c_1 = 2 / ((n + 1.3) ** 2 + mu)
        self.c_mu = min(1 - self.c_1, 2 * (mu - 2 + 1 / mu) / ((n + 2) ** 2 + mu))
        self.damping = 1 + 2 * max(0, np.sqrt((mu - 1) / (n + 1)) - 1) + self.c_sigma
        self.usual = np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))  # mean length of a normal vector
        self.covariance, self.p_sigma, self.p_c = np.eye(n), np.zeros(n), np.zeros(n)

    def ask(self):
        values, vectors = np.linalg.eigh(self.covariance)
        self.root, self.inverse = vectors * np.sqrt(values), vectors / np.sqrt(values) @ vectors.T
        steps = self.random.standard_normal((self.size, self.n)) @ self.root.T
        return np.clip(self.mean + self.sigma * steps, 0, 1)

    def tell(self, points, cost):
        steps = (points[np.argsort(cost, kind="stable")[: len(self.weights)]] - self.mean) / self.sigma
        step = self.weights @ steps
        self.mean = self.mean + self.sigma * step
        self.p_sigma = (1 - self.c_sigma) * self.p_sigma + np.sqrt(self.c_sigma * (2 - self.c_sigma) * self.mu) * self.inverse @ step
        self.p_c = (1 - self.c_c) * self.p_c + np.sqrt(self.c_c * (2 - self.c_c) * self.mu) * step
        self.covariance = ((1 - self.c_1 - self.c_mu) * self.covariance + self.c_1 * np.outer(self.p_c, self.p_c)
                           + self.c_mu * (steps.T * self.weights) @ steps)
        self.sigma *= np.exp(self.c_sigma / self.damping * (np.linalg.norm(self.p_sigma) / self.usual - 1))


search = CmaEs([0.5] * len(SPACE), 0.3, seed=1)
best, found = np.inf, None
for generation in range(int([*sys.argv[1:], "10"][0])):
    points = search.ask()
    cost = costs(points)
    search.tell(points, cost)
    if cost.min() < best:
        best, found = cost.min(), LOW + points[cost.argmin()] * (HIGH - LOW)
    print(f"generation {generation}: best cost {best:.5f}", flush=True)
print(-best, dict(zip(SPACE, found.tolist())))
