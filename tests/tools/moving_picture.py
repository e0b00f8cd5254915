#!/usr/bin/env python3
"""Draws the moving picture of README.md, an animated SVG of one period of a run.

    tests/tools/moving_picture.py build/release/bin/gaitlab docs/hexapod.svg

Runs the hexapod on engine articulated and draws the robot from the poses of its bodies in trace.csv and from the shapes of its
module, in parallel projection. The last frame continues in the first one, because the travel of a period is subtracted: only
the ground moves. The same program writes the same bytes.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FRAMES, START, PERIOD = 40, 14.0, 2.0  # frames per period; start within the periodic gait, s; period, s
WIDTH, HEIGHT = 800, 520
SCALE, CENTRE = 730, (405, 238)  # px per m; px, position of the middle of the robot
AZIMUTH, ELEVATION = math.radians(-111), math.radians(32)  # direction from the robot to the eye
COLOURS = {'active': (86, 180, 233), 'link': (120, 124, 130), 'passive': (230, 159, 0)}  # as on the page
LIGHT = (0.25, -0.55, 0.8)
SEGMENTS = 8  # segments of a half cylinder
LONG, WIDE = 0.48, 0.2  # m, half length and half width of the ground


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


EYE = (math.cos(ELEVATION) * math.cos(AZIMUTH), math.cos(ELEVATION) * math.sin(AZIMUTH), math.sin(ELEVATION))
RIGHT = unit(cross((0, 0, 1), EYE))
UP = cross(EYE, RIGHT)


def screen(p):
    """Position in px of a point in m, relative to the middle of the robot."""
    return (CENTRE[0] + SCALE * dot(p, RIGHT), CENTRE[1] - SCALE * dot(p, UP))


def rotated(q, v):
    w, u = q[0], q[1:]
    t = tuple(2 * x for x in cross(u, v))
    return tuple(v[k] + w * t[k] + cross(u, t)[k] for k in range(3))


def from_rpy(rpy):
    """Quaternion of Rz(yaw) Ry(pitch) Rx(roll)."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a / 2), math.sin(a / 2)) for a in rpy)
    return (cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy)


def prism(outline, half):
    """Faces of a prism along y over an outline (x, z) that turns from z to x, and whether each face is part of a round."""
    near = [(x, -half, z) for x, z in outline]
    far = [(x, half, z) for x, z in outline]
    n = len(outline)
    sides = [([near[i], far[i], far[(i + 1) % n], near[(i + 1) % n]], n > 4 and i < n - 1) for i in range(n)]
    return [(near[::-1], False), (far, False)] + sides


def faces_of(shape):
    """Faces of a shape in the body frame, as polygons with a flag for parts of a round."""
    if 'box' in shape:
        x, y, z = (edge / 2 for edge in shape['box'])
        faces = prism([(-x, -z), (-x, z), (x, z), (x, -z)], y)
    else:
        radius, length = shape['half_cylinder']
        turn = [math.pi * k / SEGMENTS for k in range(SEGMENTS + 1)]
        faces = prism([(radius * math.sin(a), radius * math.cos(a)) for a in turn], length / 2)
    q, origin = from_rpy(shape.get('rpy', (0, 0, 0))), shape.get('origin', (0, 0, 0))
    return [([tuple(a + b for a, b in zip(origin, rotated(q, v))) for v in face], round_) for face, round_ in faces]


def outward(face, middle):
    """Unit normal of a face of a convex shape, away from the middle of the shape."""
    normal = unit(cross(tuple(b - a for a, b in zip(face[0], face[1])), tuple(b - a for a, b in zip(face[1], face[2]))))
    return normal if dot(normal, tuple(a - b for a, b in zip(face[0], middle))) > 0 else tuple(-x for x in normal)


def mean(points):
    return tuple(sum(p[k] for p in points) / len(points) for k in range(3))


def polygon(points, fill, edge):
    tenths = [(round(10 * x), round(10 * y)) for x, y in points]
    steps = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(tenths, tenths[1:])]
    d = f'M{tenths[0][0] / 10:g} {tenths[0][1] / 10:g}l' + ' '.join(f'{x / 10:g} {y / 10:g}' for x, y in steps) + 'z'
    return f'<path d="{d}" fill="{fill}" stroke="{edge}"/>'


def colour(rgb, light):
    return '#' + ''.join(f'{min(255, round(c * light)):02x}' for c in rgb)


def robot(bodies):
    """Paths of all bodies, (name, position, quaternion, shapes), from far to near."""
    parts = []
    for name, position, q, shapes in bodies:
        for faces in shapes:
            world = [([tuple(a + b for a, b in zip(position, rotated(q, v))) for v in face], r) for face, r in faces]
            middle = mean([v for face, _ in world for v in face])
            depth = dot(middle, EYE) - (0.05 if name == 'link' else 0)  # links are within the blocks
            seen = []
            for face, round_ in world:
                normal = outward(face, middle)
                if dot(normal, EYE) <= 0:
                    continue
                fill = colour(COLOURS[name], 0.62 + 0.5 * max(0, dot(normal, unit(LIGHT))))
                seen.append(polygon([screen(v) for v in face], fill, fill if round_ else colour(COLOURS[name], 0.5)))
            parts.append((depth, ''.join(seen)))
    return ''.join(text for _, text in sorted(parts))


def lines(travel, share):
    """A line across the ground for each period, which moves backwards."""
    text = ''
    for k in range(math.ceil(-LONG / travel), math.floor(LONG / travel) + 2):
        x = (k - share) * travel
        if -LONG <= x <= LONG:
            (x1, y1), (x2, y2) = screen((x, -WIDE, 0)), screen((x, WIDE, 0))
            text += f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="#c3cad3"/>'
    return text


def still_ground():
    corners = [screen((x, y, 0)) for x, y in ((-LONG, -WIDE), (LONG, -WIDE), (LONG, WIDE), (-LONG, WIDE))]
    return polygon(corners, '#e9edf1', '#c3cad3')


def discs(feet):
    """Discs on the ground below the feet that carry weight; their area is in proportion to the load."""
    text = ''
    for (x, y), load in feet:
        if load > 0.3:
            cx, cy = screen((x, y, 0))
            r = 13 * math.sqrt(load)
            text += f'<ellipse cx="{cx:.1f}" cy="{cy:.1f}" rx="{r:.1f}" ry="{r * math.sin(ELEVATION):.1f}" fill="#1a7f37" fill-opacity=".35"/>'
    return text


class Run:
    """The rows of a run in one period."""

    def __init__(self, folder):
        with open(folder / 'trace.csv', newline='') as file:
            rows = list(csv.DictReader(file))
        self.rows = [{k: float(v) for k, v in row.items()} for row in rows if START <= float(row['t']) < START + PERIOD + 1e-9]
        self.every = round(PERIOD / FRAMES / (self.rows[1]['t'] - self.rows[0]['t']))
        self.summary = json.loads((folder / 'summary.json').read_text())
        self.verdict = json.loads((folder / 'verdict.json').read_text())
        first, last = self.rows[0], self.rows[FRAMES * self.every]
        self.travel = last['com.x'] - first['com.x']
        self.drift = last['com.y'] - first['com.y']
        self.middle = (first['com.x'], first['com.y'])
        self.shapes = yaml.safe_load((ROOT / 'scenarios/modules/mtran.yaml').read_text())['bodies']

    def row(self, frame):
        return self.rows[frame * self.every]

    def offset(self, frame):
        share = frame / FRAMES
        return self.middle[0] + share * self.travel, self.middle[1] + share * self.drift

    def bodies(self, frame):
        row, (x, y) = self.row(frame), self.offset(frame)
        names = list(self.shapes)
        shapes = [[faces_of(s) for s in self.shapes[name]['shape']] for name in names]
        for module in range(self.summary['modules']):
            for name, of_shape in zip(names, shapes):
                at = f'body.m{module}/{name}.'
                position = (row[at + 'x'] - x, row[at + 'y'] - y, row[at + 'z'])
                yield name, position, tuple(row[at + c] for c in ('qw', 'qx', 'qy', 'qz')), of_shape

    def feet(self, frame):
        """Position below each foot, with its load in N: the lower block of a module that has four contact elements."""
        row, (x, y) = self.row(frame), self.offset(frame)
        count = len(self.summary['contacts']) // 4
        for foot in range(count):
            module = self.summary['modules'] - count + foot
            low = min(('active', 'passive'), key=lambda name: row[f'body.m{module}/{name}.z'])
            place = tuple(row[f'body.m{module}/{low}.{c}'] - o for c, o in (('x', x), ('y', y)))
            yield place, sum(row[f'contact.{4 * foot + k}.fn'] for k in range(4))


class Strip:
    """Torque of one joint over the period, with a line that moves."""
    left, right, top, bottom = 24, 776, 412, 474

    def __init__(self, run):
        self.run = run
        joints = run.summary['per_joint']
        self.name = max(joints, key=lambda name: joints[name]['judged']['torque']['rms'])
        module, end = self.name[1:].split('/')
        number = 2 * int(module) + (end == 'passive')
        self.values = [run.row(k)[f'joint.{number}.torque'] for k in range(FRAMES + 1)]
        self.low, self.high = min(0, *self.values), max(0, *self.values)

    def x(self, frame):
        return self.left + (self.right - self.left) * frame / FRAMES

    def y(self, value):
        return self.bottom - (self.bottom - self.top) * (value - self.low) / (self.high - self.low)

    def still(self):
        line = ' '.join(f'{self.x(k):.1f},{self.y(v):.1f}' for k, v in enumerate(self.values))
        return (f'<path d="M{self.left} {self.y(0):.1f}H{self.right}" stroke="#c3cad3"/>'
                f'<polyline points="{line}" fill="none" stroke="#0b5cad" stroke-width="2"/>'
                f'<text x="{self.left}" y="398" class="s">torque of joint {self.name}, at most '
                f'{max(abs(v) for v in self.values):.2f} N m; one period, {PERIOD:g} s</text>')

    def moving(self, frame):
        x, y = self.x(frame), self.y(self.values[frame])
        return f'<path d="M{x:.1f} {self.top}V{self.bottom}" stroke="#8b95a1"/><circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="#0b5cad"/>'


def page(run):
    """The SVG document. Every frame is visible for its part of the period."""
    strip, verdict = Strip(run), run.verdict
    tightest = next(c for c in verdict['checks'] if c['id'] == verdict['tightest'])
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img" '
            f'aria-label="A hexapod of {run.summary["modules"]} modules walks; the torque of one of its joints"><style>'
            f'g.f{{visibility:hidden;stroke-width:.7;stroke-linejoin:round;animation:f {PERIOD:g}s step-end infinite}}'
            f'@keyframes f{{0%{{visibility:visible}}{100 / FRAMES:g}%{{visibility:hidden}}}}'
            '@media (prefers-reduced-motion:reduce){g.f{animation:none}g.f:first-of-type{visibility:visible}}'
            'text{font:600 19px system-ui,sans-serif;fill:#1f2328}.s{font-weight:400;font-size:15px;fill:#59636e}</style>'
            f'<rect x=".5" y=".5" width="{WIDTH - 1}" height="{HEIGHT - 1}" rx="12" fill="#f6f8fa" stroke="#c3cad3"/>'
            f'<text x="24" y="38">{run.summary["name"]}: '
            f'<tspan fill="{"#1a7f37" if verdict["verdict"] == "feasible" else "#b3261e"}">{verdict["verdict"]}</tspan> with these motors</text>'
            f'<text x="24" y="62" class="s">{run.summary["modules"]} modules, {len(run.summary["per_joint"])} motors, '
            f'{run.summary["speed"]:.3f} m/s; tightest: {tightest["id"]} of {tightest["worst"]}, margin {100 * tightest["margin"]:.0f} %</text>'
            f'<text x="24" y="{HEIGHT - 16}" class="s">discs: load on the feet. Lines on the ground: one period apart, {1000 * run.travel:.0f} mm</text>'
            + still_ground() + strip.still())
    for frame in range(FRAMES):
        delay = PERIOD * (frame / FRAMES - 1)
        text += (f'\n<g class="f" style="animation-delay:{delay:.2f}s">' + lines(run.travel, frame / FRAMES) + discs(run.feet(frame))
                 + robot(run.bodies(frame)) + strip.moving(frame) + '</g>')
    return text + '\n</svg>\n'


def main():
    program, target = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / 'run'
        subprocess.run([program, 'run', ROOT / 'scenarios/hexapod.yaml', '--set', 'physics.engine=articulated', '--format', 'csv',
                        '--no-report', '--quiet', '--out', out], check=True)
        pathlib.Path(target).write_text(page(Run(out)), encoding='ascii')


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main()
