// Geometry of a body from its pieces. Pieces that form one convex prism are merged, such as the box and half cylinder
// of an M-TRAN block.
import { Box3, Float32BufferAttribute, SphereGeometry, Vector3, type BufferGeometry } from "three";
import type { Pose, Shape } from "../data/format";
import { matrix, position, rotation } from "../data/kinematics";
import { geometryOf } from "./shapes";

export type Point = [number, number];

/** Geometry of a piece, and a simpler geometry for the shadow of the piece. */
export interface Piece {
  body: BufferGeometry;
  shadow: BufferGeometry;
}

/** Prism in the frame of the body, from y0 to y1 along y. The points are the outline in x and z. */
interface Prism {
  y0: number;
  y1: number;
  points: Point[];
}

export function hull(points: readonly Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list: Point[]) => {
    const out: Point[] = [];
    for (const p of list) {
      for (let n = out.length; n > 1; n = out.length) {
        const a = out[n - 2];
        const b = out[n - 1];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 1e-12) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

const area = (p: readonly Point[]): number =>
  Math.abs(p.reduce((sum, [x, y], i) => sum + x * p[(i + 1) % p.length][1] - p[(i + 1) % p.length][0] * y, 0)) / 2;

/** Prism of a shape; null for a sphere, a hull, and a shape whose axis is not along the body's y axis. */
function prism({ kind, pose, size }: Shape): Prism | null {
  const turn = rotation(pose);
  const along = new Vector3(0, 1, 0).applyQuaternion(turn);
  if (kind === "sphere" || kind === "hull" || Math.abs(Math.abs(along.y) - 1) > 1e-9) return null;
  const flat: Point[] = [];
  if (kind === "box") {
    flat.push(
      [-size[0] / 2, -size[2] / 2],
      [size[0] / 2, -size[2] / 2],
      [size[0] / 2, size[2] / 2],
      [-size[0] / 2, size[2] / 2],
    );
  } else {
    const whole = kind === "cylinder";
    const n = whole ? 36 : 18;
    for (let i = 0; i <= n; i++) {
      const a = -Math.PI / 2 + ((whole ? 2 : 1) * Math.PI * i) / n;
      flat.push([size[0] * Math.cos(a), size[0] * Math.sin(a)]);
    }
  }
  const origin = position(pose);
  const length = size[1];
  const points = flat.map(([x, z]): Point => {
    const p = new Vector3(x, 0, z).applyQuaternion(turn).add(origin);
    return [p.x, p.z];
  });
  return { y0: origin.y - length / 2, y1: origin.y + length / 2, points };
}

/** Triangles with a normal at each corner. */
class Mesh {
  private readonly at: number[] = [];
  private readonly normals: number[] = [];

  add([x, z]: Point, y: number, normal: Vector3): void {
    this.at.push(x, y, z);
    this.normals.push(normal.x, normal.y, normal.z);
  }

  /** Adds a flat end of a prism. `up` is the y component of the end's normal, 1 or -1. */
  cap(points: readonly Point[], y: number, up: number): void {
    const normal = new Vector3(0, up, 0);
    for (let i = 1; i + 1 < points.length; i++) {
      for (const k of up < 0 ? [0, i, i + 1] : [0, i + 1, i]) this.add(points[k], y, normal);
    }
  }

  /** Adds a ring of quads between two outlines. `tilt` is the y component of the normals before normalization. */
  ring(
    sides: readonly Vector3[],
    low: readonly Point[],
    y0: number,
    high: readonly Point[],
    y1: number,
    tilt = 0,
  ): void {
    sides.forEach((_, i) => {
      const k = (i + 1) % sides.length;
      const [a, b] = [0, 1].map((end) => smooth(sides, i, end).clone().setY(tilt).normalize());
      for (const [p, y, normal] of [
        [low[i], y0, a],
        [high[k], y1, b],
        [low[k], y0, b],
        [low[i], y0, a],
        [high[i], y1, a],
        [high[k], y1, b],
      ] as const) {
        this.add(p, y, normal);
      }
    });
  }

  get geometry(): BufferGeometry {
    return geometryOf(this.at).setAttribute("normal", new Float32BufferAttribute(this.normals, 3));
  }
}

/** Normal at the start (0) or end (1) of a side. Sides at an angle below 30 degrees share a normal and look round. */
function smooth(sides: readonly Vector3[], side: number, end: number): Vector3 {
  const n = sides.length;
  const meets = sides[(side + (end ? 1 : n - 1)) % n];
  return meets.dot(sides[side]) > Math.cos(Math.PI / 6) ? meets.clone().add(sides[side]).normalize() : sides[side];
}

/** Outline with each side moved inwards by `bevel`, m. */
function inset(points: readonly Point[], sides: readonly Vector3[], bevel: number): Point[] {
  const n = points.length;
  return points.map(([x, z], i) => {
    const a = sides[(i + n - 1) % n];
    const b = sides[i];
    const share = bevel / (1 + a.dot(b));
    return [x - share * (a.x + b.x), z - share * (a.z + b.z)];
  });
}

/** Surface of a prism. If `chamfered` is true, the edges of the two ends are chamfered. */
function extrude(points: readonly Point[], y0: number, y1: number, chamfered: boolean): BufferGeometry {
  const sides = points.map(([x, z], i) => {
    const [u, w] = points[(i + 1) % points.length];
    return new Vector3(w - z, 0, x - u).normalize();
  });
  const radius = Math.sqrt(area(points) / Math.PI);
  const bevel = chamfered ? Math.min(0.03 * (y1 - y0), 0.06 * radius) : 0;
  const inner = inset(points, sides, bevel);
  const mesh = new Mesh();
  mesh.cap(inner, y0, -1);
  mesh.cap(inner, y1, 1);
  mesh.ring(sides, points, y0 + bevel, points, y1 - bevel);
  if (bevel > 0) {
    mesh.ring(sides, inner, y0, points, y0 + bevel, -1);
    mesh.ring(sides, points, y1 - bevel, inner, y1, 1);
  }
  return mesh.geometry;
}

const piece = (points: readonly Point[], y0: number, y1: number): Piece => {
  const outline = hull(points);
  return { body: extrude(outline, y0, y1, true), shadow: extrude(outline, y0, y1, false) };
};

const upright: Pose = [0, 0, 0, 1, 0, 0, 0];

/** Surface of a hull, with flat faces. */
function polyhedron({ corners = [], faces = [] }: Shape): BufferGeometry {
  const at = faces.flatMap((face) =>
    face.slice(2).flatMap((_, k) => [face[0], face[k + 1], face[k + 2]].flatMap((corner) => corners[corner])),
  );
  const made = geometryOf(at);
  made.computeVertexNormals();
  return made;
}

function single(shape: Shape): Piece {
  const along = prism(shape);
  if (along) return piece(along.points, along.y0, along.y1);
  const own = prism({ ...shape, pose: upright });
  const round = shape.kind === "hull" ? polyhedron(shape) : new SphereGeometry(shape.size[0], 32, 20);
  const { body, shadow } = own ? piece(own.points, own.y0, own.y1) : { body: round, shadow: round.clone() };
  const placed = matrix(shape.pose);
  return { body: body.applyMatrix4(placed), shadow: shadow.applyMatrix4(placed) };
}

export function outline(shapes: readonly Shape[]): Piece[] {
  const prisms = shapes.map(prism);
  const first = prisms[0];
  const level = first && prisms.every((p) => p && Math.abs(p.y0 - first.y0) < 1e-9 && Math.abs(p.y1 - first.y1) < 1e-9);
  if (level && prisms.length > 1) {
    const points = prisms.flatMap((p) => p!.points);
    const sum = prisms.reduce((a, p) => a + area(hull(p!.points)), 0);
    if (Math.abs(area(hull(points)) - sum) < 0.01 * sum) return [piece(points, first.y0, first.y1)];
  }
  return shapes.map(single);
}

/** Centre and half lengths of the bounding box of a piece, in the frame of the piece. */
export function extents({ kind, size: [a, b, c], corners = [] }: Shape): { centre: Vector3; half: Vector3 } {
  if (kind === "hull") {
    const box = new Box3().setFromPoints(corners.map((corner) => new Vector3(...corner)));
    return { centre: box.getCenter(new Vector3()), half: box.getSize(new Vector3()).multiplyScalar(0.5) };
  }
  if (kind === "box") return { centre: new Vector3(), half: new Vector3(a / 2, b / 2, c / 2) };
  if (kind === "sphere") return { centre: new Vector3(), half: new Vector3(a, a, a) };
  if (kind === "cylinder") return { centre: new Vector3(), half: new Vector3(a, b / 2, a) };
  return { centre: new Vector3(a / 2, 0, 0), half: new Vector3(a / 2, b / 2, a) };
}

/** Corners of the bounding box of a piece, in the frame of the body. */
export function corners(shape: Shape): Vector3[] {
  const { centre, half } = extents(shape);
  const at = position(shape.pose);
  const turn = rotation(shape.pose);
  return [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
    half
      .clone()
      .multiply(new Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1))
      .add(centre)
      .applyQuaternion(turn)
      .add(at),
  );
}
