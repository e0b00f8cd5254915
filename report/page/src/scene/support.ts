// Balance in the 3D picture: the centre of mass, its projection on the ground, and the support polygon. The symbol of
// the centre of mass is an element in front of the picture (stage.ts).
import {
  BufferAttribute,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Scene,
  Vector3,
} from "three";
import type { Theme } from "../colour";
import { hull, type Point } from "./outline";
import type { Recording } from "../data/recording";
import { room } from "./shapes";

type Corner = [x: number, y: number, z: number];

const share = 0.005; // least load of a foot of the polygon, as a share of the weight (column `stability` of the trace)
const touch = 1e-4; // m, above the ground: a contact element that is lower touches it; the page rounds positions
const most = 64; // largest number of corners that are drawn

export class Support {
  shown = true;
  readonly any: boolean;
  readonly anyPolygon: boolean;
  private readonly height: number;
  /** Centre of mass at the time shown. */
  readonly centre = new Vector3();
  private readonly plumb: Line;
  private readonly foot: Mesh;
  private readonly area: Mesh;
  private readonly edge: Line;
  private readonly ink = new LineBasicMaterial();
  private readonly outline = new LineBasicMaterial();
  private readonly shade = new MeshBasicMaterial({
    transparent: true,
    opacity: 0.22,
    depthWrite: false,
  });

  /** Builds the marks. `pose` is the pose of a body at the time shown, `unit` the size of a typical body, m. */
  constructor(
    private readonly recording: Recording,
    private readonly pose: (body: number) => Matrix4,
    private readonly unit: number,
    scene: Scene,
  ) {
    const { ground } = recording.meta;
    this.height = ground.height;
    this.any = recording.ran && recording.has("com.x");
    this.anyPolygon = this.any && ground.kind === "plane" && recording.has("foot.0.x");
    this.plumb = new Line(room(2), this.ink);
    this.foot = new Mesh(fan(), new MeshBasicMaterial({ depthTest: false, transparent: true }));
    fill(this.foot, disc(0.06 * unit));
    this.area = new Mesh(fan(), this.shade);
    this.edge = new Line(room(most + 1), this.outline);
    this.parts.forEach((part, n) => {
      part.frustumCulled = false;
      part.renderOrder = n < 2 ? 1 : 9;
      part.visible = false;
      scene.add(part);
    });
  }

  private get parts() {
    return [this.area, this.edge, this.plumb, this.foot];
  }

  set(t: number): void {
    const { recording } = this;
    for (const part of this.parts) part.visible = this.any && this.shown;
    if (!this.any || !this.shown) return;
    const [x, y, z] = ["x", "y", "z"].map((c) => recording.at(recording.channel(`com.${c}`), t));
    const grounded = recording.meta.ground.kind === "plane";
    const ground = this.height + 0.004 * this.unit;
    this.centre.set(x, y, z);
    this.plumb.visible = this.foot.visible = grounded;
    this.foot.position.set(x, y, ground);
    write(this.plumb, [x, y, z, x, y, ground]);
    const corners = this.anyPolygon ? this.polygon(t).slice(0, most) : [];
    this.area.visible = this.edge.visible = corners.length > 1;
    fill(
      this.area,
      corners.map(([a, b]) => [a, b, ground]),
    );
    write(
      this.edge,
      [...corners, ...corners.slice(0, 1)].flatMap(([a, b]) => [a, b, ground]),
    );
  }

  /** Corners of the support polygon, seen from above: the hull of the contact elements that touch the ground, m. */
  polygon(t: number): Point[] {
    const { meta } = this.recording;
    const points = meta.feet.flatMap(({ body, points: elements = [] }, n) => {
      const load = this.recording.find(`foot.${n}.fz`);
      if (!load || this.recording.at(load, t) <= share * meta.weight) return [];
      const placed = elements.map(([x, y, z]) => new Vector3(x, y, z).applyMatrix4(this.pose(body)));
      const low = placed.map((p, k) => p.z - elements[k][3]);
      // The lowest element of a loaded foot always counts as touching.
      const limit = Math.max(this.height + touch, Math.min(...low));
      return placed.filter((_, k) => low[k] <= limit).map((p): Point => [p.x, p.y]);
    });
    return points.length > 2 ? hull(points) : points;
  }

  paint(theme: Theme): void {
    const colour = theme === "dark" ? 0xc9aaff : 0x5a3a96;
    for (const material of [this.shade, this.outline]) material.color.set(colour);
    this.ink.color.set(theme === "dark" ? 0xe9edf1 : 0x1b2127);
    (this.foot.material as MeshBasicMaterial).color.copy(this.ink.color);
  }
}

/** Triangles of a convex polygon, from its first corner. */
const fan = (): BufferGeometry =>
  room(most).setIndex(Array.from({ length: most - 2 }, (_, k) => [0, k + 1, k + 2]).flat());

/** Corners of a disc around the origin. */
const disc = (radius: number): Corner[] =>
  Array.from({ length: 20 }, (_, k): Corner => {
    const turn = (k * Math.PI) / 10;
    return [radius * Math.cos(turn), radius * Math.sin(turn), 0];
  });

/** Draws a convex polygon with corners in counterclockwise order. */
function fill(mesh: Mesh, corners: readonly Corner[]): void {
  write(mesh, corners.flat());
  mesh.geometry.setDrawRange(0, 3 * Math.max(corners.length - 2, 0));
}

function write({ geometry }: Line | Mesh, values: number[]): void {
  const position = geometry.getAttribute("position") as BufferAttribute;
  position.array.set(values);
  position.needsUpdate = true;
  if (!geometry.index) geometry.setDrawRange(0, values.length / 3);
}
