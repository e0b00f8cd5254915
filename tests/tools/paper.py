#!/usr/bin/env python3
"""Writes the pictures of docs/paper.md (fig09.svg and fig14.svg by their recipes, map.svg from grid.csv) and its table of settings.

    tests/tools/paper.py build/release/bin/gaitlab [--grid]

--grid renews docs/paper/grid.csv and the table first, 325 runs on engine articulated, some minutes; needed after a change of contacts or
gears.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "docs/paper"
STIFFNESS = (38.2, 75, 150, 300, 400, 500, 600, 700, 800, 1000, 1200)  # N m/rad
CONTACT = (2e3, 3e3, 5e3, 7e3, 1e4, 1.5e4, 2e4, 3e4, 4e4)  # N/m
PER_KP = 0.7 * 0.00395 * 594 / 4.3  # N m/V, eta Kt n / R of the M-TRAN's motor
HEAD = ("robot", "amplitude rad", "Kn N/m", "k N m/rad", "torque min N m", "torque max N m", "torque RMS N m", "rank by peak", "rank by RMS",
        "verdict", "decided by")
SETTINGS = ("controller.Kp=1570", "controller.Kp=100", "controller.Kp=785", "controller.Kp=1180", "controller.Kp=2356", "controller.Ki=500",
            "contact.stiffness=2e3", "contact.stiffness=5e3", "contact.stiffness=2e4", "contact.stiffness=4e4", "contact.slip_speed=0.001",
            "ground.friction=0.4", "actuator.dry_friction=0.1", "actuator.viscous_friction=0.0625", "actuator.efficiency=0.5",
            "actuator.efficiency_model=directional")
BEGIN, END = "<!-- settings: written by tests/tools/paper.py -->\n", "<!-- end of settings -->\n"
# Joint, window in s, and amplitudes in rad of each robot.
FIGURES = {"caterpillar": (7, 6, 14, (0.6,)), "hexapod": (5, 4, 8, (0.3, 0.4))}


class Result:
    """Torques of the figure's joint in its window, N m, and its ranks among all joints."""

    def __init__(self, robot, low, high, rms, peak_rank, rms_rank, verdict, decided_by=""):
        self.robot, self.low, self.high, self.rms, self.verdict, self.decided_by = robot, low, high, rms, verdict, decided_by
        self.peak_rank, self.rms_rank = peak_rank, rms_rank

    def missed(self):
        """Criteria of the figures that do not hold (docs/paper.md)."""
        out = [] if self.verdict == "feasible" else [f"feasible ({self.decided_by})"]
        if self.robot == "caterpillar":
            return out + ([] if -2 <= self.low <= -1.3 and 1.3 <= self.high <= 2 else ["axis"])
        out += [] if -1.2 <= self.low <= -1.0 else ["axis"]
        out += [] if self.high <= 0.06 else ["one sign"]
        return out + ([] if self.peak_rank == 1 else ["highest"])

    def strayed(self):
        """The project's own numbers that are wrong by 4 % or more."""
        numbers = ((-1.45, self.low), (1.44, self.high), (0.85, self.rms)) if self.robot == "caterpillar" else ((0.73, self.rms),)
        out = [f"{'RMS ' if mine in (0.85, 0.73) else ''}{value:.2f}" for mine, value in numbers if abs(value / mine - 1) >= 0.04]
        return out + ([] if self.rms_rank == 1 else ["first by RMS"])


def simulate(program, robot, keys):
    joint, start, end, _ = FIGURES[robot]
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        command = [program, "run", ROOT / f"scenarios/paper-{robot}.yaml", "--quiet", "--no-report", "--format", "csv", "--out", run]
        sets = [word for key in (*keys, "trace.columns=[joint.*.torque]") for word in ("--set", key)]
        subprocess.run(command + sets, check=False, stderr=subprocess.DEVNULL)
        with open(run / "trace.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        verdict = json.loads((run / "verdict.json").read_text())
    torques = list(zip(*([float(x) for x in row[1:]] for row in rows[1:] if start - 1e-9 <= float(row[0]) <= end + 1e-9)))
    peaks = [max(map(abs, one)) for one in torques]
    rms = [math.sqrt(sum(x * x for x in one) / len(one)) for one in torques]
    rank = lambda values: 1 + sum(value > values[joint] for value in values)  # noqa: E731
    return Result(robot, min(torques[joint]), max(torques[joint]), rms[joint], rank(peaks), rank(rms), verdict["verdict"],
                  verdict["decided_by"] or "")


def write_grid(program):
    points = [(robot, amplitude, contact, stiffness) for robot, figure in FIGURES.items() for amplitude in figure[3]
              for contact in CONTACT for stiffness in STIFFNESS]

    def row(point):
        robot, amplitude, contact, stiffness = point
        r = simulate(program, robot, [f"cpg.amplitude={amplitude}", f"contact.stiffness={contact:g}", f"controller.Kp={stiffness / PER_KP:.6g}"])
        return (robot, amplitude, f"{contact:g}", f"{stiffness:g}", f"{r.low:+.3f}", f"{r.high:+.3f}", f"{r.rms:.3f}", r.peak_rank, r.rms_rank,
                r.verdict, r.decided_by)

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(row, points))
    with open(OUT / "grid.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEAD, *rows])


def write_settings(program):
    """Replaces the table of docs/paper.md between BEGIN and END."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda key: [simulate(program, robot, [key]) for robot in FIGURES], SETTINGS))
    table = ("| setting | joint 7, N m | missed | other numbers | spine joint, N m | missed | other numbers |\n" + "|---|---|---|---|---|---|---|\n")
    for key, results in zip(SETTINGS, found):
        cells = [f"`{key}`" + (" (the scenarios')" if key == SETTINGS[0] else "")]
        for r in results:
            cells += [f"{r.low:+.2f} to {r.high:+.2f}", ", ".join(r.missed()) or "-", ", ".join(r.strayed()) or "-"]
        table += "| " + " | ".join(cells) + " |\n"
    page = ROOT / "docs/paper.md"
    text = page.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    page.write_text(head + BEGIN + "\n" + table + "\n" + END + rest.split(END)[1], encoding="utf-8")


def read_grid():
    """{(robot, amplitude, Kn, k): Result}."""
    with open(OUT / "grid.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    return {(r[0], *map(float, r[1:4])): Result(r[0], *map(float, r[4:7]), int(r[7]), int(r[8]), r[9], r[10]) for r in rows}


def draw_map():
    """One panel per robot and amplitude, a cell per point: torque and rank by peak; lines between cells on two sides of the
    torques that a figure needs at least and at most."""
    wide, high, left, top, gap = 54, 22, 70, 46, 40  # px
    panels = [(robot, amplitude) for robot, figure in FIGURES.items() for amplitude in figure[3]]
    size = (left + wide * len(STIFFNESS) + 12, len(panels) * (top + high * len(CONTACT) + gap) - gap + 62)
    rows = read_grid()
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" font-family="Helvetica, Arial, sans-serif" '
           f'font-size="11" text-anchor="middle"><rect width="100%" height="100%" fill="#fff"/>']
    text = lambda x, y, words, more="": out.append(f'<text x="{x:g}" y="{y:g}"{more}>{words}</text>')  # noqa: E731
    for panel, (robot, amplitude) in enumerate(panels):
        y0 = panel * (top + high * len(CONTACT) + gap) + top
        cells = {key[2:]: result for key, result in rows.items() if key[:2] == (robot, amplitude)}
        of, levels = "Joint 7 of the caterpillar (figure 9)", (1.3, 2)
        if robot == "hexapod":
            of, levels = "Central spine joint of the hexapod (figure 14)", (1.0, 1.2)
        text(left, y0 - 26, f"{of}, amplitude {amplitude} rad: largest torque (N m) / its rank", ' text-anchor="start" font-weight="bold"')
        for i, stiffness in enumerate(STIFFNESS):
            text(left + (i + 0.5) * wide, y0 - 6, f"{stiffness:g}")
        for j, contact in enumerate(reversed(CONTACT)):
            text(left - 6, y0 + (j + 0.7) * high, f"{contact:g}", ' text-anchor="end"')
            for i, stiffness in enumerate(STIFFNESS):
                row, x, y = cells[contact, stiffness], left + i * wide, y0 + j * high
                fill = "#bfe3c5" if not row.missed() else "#eceff3" if row.verdict == "feasible" else "#f6d5d0"
                out.append(f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" fill="{fill}" stroke="#fff"/>')
                text(x + wide / 2, y + 15, f"{max(-row.low, row.high):.2f} / {row.peak_rank}")
        for level, colour in zip(levels, ("#1f5fa8", "#a33b1f")):
            above = lambda n, k: max(-cells[n, k].low, cells[n, k].high) >= level  # noqa: B023, E731
            path = ""
            for j, contact in enumerate(reversed(CONTACT)):
                for i, stiffness in enumerate(STIFFNESS):
                    x, y = left + i * wide, y0 + j * high
                    if i and above(contact, stiffness) != above(contact, STIFFNESS[i - 1]):
                        path += f"M{x} {y}v{high}"
                    if j and above(contact, stiffness) != above(CONTACT[-j], stiffness):
                        path += f"M{x} {y}h{wide}"
            out.append(f'<path d="{path}" stroke="{colour}" stroke-width="2.5" fill="none"/>')
        text(12, y0 + high * len(CONTACT) / 2, "Kn (N/m)", f' transform="rotate(-90 12 {y0 + high * len(CONTACT) / 2:g})"')
        text(left + wide * len(STIFFNESS) / 2, y0 + high * len(CONTACT) + 16, "stiffness k of the position loop (N m/rad)")
    words = (("#bfe3c5", "fits, feasible"), ("#eceff3", "feasible"), ("#f6d5d0", "infeasible"))
    y, offsets = size[1] - 22, (0, 140, 210)
    for k, (colour, word) in enumerate(words):
        out.append(f'<rect x="{left + offsets[k]}" y="{y - 11}" width="14" height="14" fill="{colour}"/>')
        text(left + 20 + offsets[k], y, word, ' text-anchor="start"')
    for k, (colour, level) in enumerate((("#1f5fa8", "above 1.3 or 1.0 N m"), ("#a33b1f", "above 2 or 1.2 N m"))):
        x = left + 300 + 152 * k
        out.append(f'<path d="M{x} {y - 4}h18" stroke="{colour}" stroke-width="2.5"/>')
        text(x + 24, y, level, ' text-anchor="start"')
    (OUT / "map.svg").write_text("\n".join(out) + "\n</svg>\n", encoding="utf-8")


def draw_figures(program):
    with tempfile.TemporaryDirectory() as folder:
        for name, robot in (("fig09", "caterpillar"), ("fig14", "hexapod")):
            run = pathlib.Path(folder) / robot
            subprocess.run([program, "run", ROOT / f"scenarios/paper-{robot}.yaml", "--quiet", "--no-report", "--out", run], check=True,
                           stderr=subprocess.DEVNULL)
            subprocess.run([program, "figure", ROOT / f"scenarios/figures/{name}.yaml", "--run", f"{robot}={run}", "-o", OUT / f"{name}.svg",
                            "--csv", pathlib.Path(folder) / f"{name}.csv"],
                           check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--grid", action="store_true", help="run the grid and the table of settings again")
    given = parser.parse_args()
    OUT.mkdir(exist_ok=True)
    if given.grid:
        write_grid(given.program)
        write_settings(given.program)
    draw_map()
    draw_figures(given.program)


if __name__ == "__main__":
    main()
