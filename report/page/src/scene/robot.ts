// Robot in the 3D picture: bodies with their edges and shadows, in their own colours or coloured by load. Each piece of
// a body type is one instanced mesh, so that the time to draw hardly depends on the number of joints.
import {
  BufferAttribute,
  Color,
  DoubleSide,
  DynamicDrawUsage,
  EdgesGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Raycaster,
  Scene,
  Vector3,
  type Intersection,
  type Material,
} from "three";
import { bodyColours, ringLoad, type Theme } from "../colour";
import type { Meta } from "../data/format";
import { level } from "./ground";
import { axesOf, hingesOf, type Hinge } from "./hinge";
import type { Kinematics } from "../data/kinematics";
import { corners, extents, outline, type Piece } from "./outline";
import { coloured, place, room, segments } from "./shapes";

/** Meshes of a piece of a body type, for all bodies of the type. */
interface Kind {
  piece: Piece;
  bodies: number[];
  mesh: InstancedMesh;
  look: Material; // material of the mesh if the bodies have their own colours
  shadow: InstancedMesh | null;
  edges: Float32Array; // ends of the edges of one body, in the frame of the body
  first: number; // index of the first point of this kind in the edges of all kinds
}

export class Robot {
  /** Size of a typical body, m. */
  readonly unit: number;
  readonly axes: Vector3[]; // axis of each joint, in the frame of its pivot
  readonly hinges: Hinge[];
  private readonly kinds: Kind[] = [];
  private readonly outlines: LineSegments;
  private readonly chosen: LineSegments;
  private readonly materials = {
    active: new MeshLambertMaterial(),
    passive: new MeshLambertMaterial(),
    other: new MeshLambertMaterial(),
  };
  /** True if each body has the colour of the load of its hinges. */
  tinted = false;
  private readonly flat = new MeshBasicMaterial();
  private readonly hingesOn: number[][]; // joints of which a body is the parent or the child
  private readonly shade = new MeshBasicMaterial({ side: DoubleSide });
  private readonly unseen = new MeshBasicMaterial({
    colorWrite: false,
    transparent: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  private readonly matrices: Matrix4[];
  private readonly press: Matrix4 | null;
  private readonly corners = new Map<string, Vector3[]>(); // corners of the pieces, by body type
  private readonly radii: number[]; // largest distance of a corner of each body from the origin of the body, m
  private theme: Theme = "light";

  private readonly all = new Group();

  /**
   * Builds the meshes. `light` is the position of the light. A null `light` draws the robot of the second run:
   * translucent, in one colour, without shadows and hinges.
   */
  constructor(
    private readonly meta: Meta,
    private readonly kinematics: Kinematics,
    scene: Scene,
    private readonly light: Vector3 | null,
  ) {
    scene.add(this.all);
    const { bodies, ground } = meta;
    this.unit = typicalSize(meta);
    this.matrices = bodies.map(() => new Matrix4());
    // A shadow is a copy of a body that is projected onto the ground along the light. Shadows are opaque, so that
    // overlaps are invisible. A shadow map would cost 140 ms a frame without a GPU.
    this.press = light && level(meta) ? pressed(light, ground.height + 0.0008 * this.unit) : null;
    this.outlines = segments(room(this.addBodies()), new LineBasicMaterial({ transparent: true, opacity: 0.55 }));
    this.chosen = segments(
      room(Math.max(0, ...bodies.map((_, i) => this.edgesOf(i).reduce((n, k) => n + k.edges.length / 3, 0)))),
      new LineBasicMaterial(),
    );
    this.outlines.renderOrder = light ? 0 : 3;
    this.all.add(this.outlines, this.chosen);
    this.axes = axesOf(meta);
    this.radii = bodies.map(({ type }) => Math.max(0, ...(this.corners.get(type) ?? []).map((c) => c.length())));
    this.hingesOn = bodies.map((_, i) =>
      bodies.flatMap(({ joint, parent }, k) => (joint >= 0 && (k === i || parent === i) ? [joint] : [])),
    );
    this.hinges = hingesOf(meta, this.axes, this.unit);
    if (!light) this.fade();
  }

  // Adds the meshes of all bodies, type by type. Returns the number of points of their edges.
  private addBodies(): number {
    const { bodies, geometry } = this.meta;
    const types = new Map<string, number[]>();
    bodies.forEach((b, i) => types.set(b.type, [...(types.get(b.type) ?? []), i]));
    let points = 0;
    let others = 0;
    for (const [type, members] of types) {
      this.corners.set(type, (geometry[type] ?? []).flatMap(corners));
      const { role } = bodies[members[0]];
      // Body types without gender have the two colours alternately, so that the halves of a module are distinguishable.
      const look =
        role === "active" || role === "passive"
          ? role
          : role !== "other"
            ? "other"
            : others++ % 2
              ? "passive"
              : "active";
      for (const piece of outline(geometry[type] ?? [])) {
        points += this.build(piece, members, this.materials[look], points);
      }
    }
    return points;
  }

  // Adds the meshes of a piece for all bodies of a type. Returns the number of points of the added edges. `first` is
  // defined in Kind.
  private build(piece: Piece, members: number[], material: Material, first: number): number {
    const mesh = new InstancedMesh(piece.body, material, members.length);
    const shadow = this.press ? new InstancedMesh(piece.shadow, this.shade, members.length) : null;
    // A translucent robot is drawn twice, first only into the depth buffer, so that its far side is invisible.
    const depth = this.light ? null : new InstancedMesh(piece.body, this.unseen, members.length);
    if (depth) {
      depth.instanceMatrix = mesh.instanceMatrix;
      depth.renderOrder = 1;
    }
    mesh.renderOrder = this.light ? 0 : 2;
    for (const one of [depth, mesh, shadow]) {
      if (!one) continue;
      one.frustumCulled = false;
      one.instanceMatrix.setUsage(DynamicDrawUsage);
      this.all.add(one);
    }
    const edges = new EdgesGeometry(piece.body, 35).getAttribute("position").array as Float32Array;
    this.kinds.push({ piece, bodies: members, mesh, look: material, shadow, edges, first });
    return (members.length * edges.length) / 3;
  }

  private fade(): void {
    for (const material of Object.values(this.materials)) {
      Object.assign(material, {
        transparent: true,
        opacity: 0.3,
        depthWrite: false,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
    }
  }

  /** Moves the meshes to the poses of the kinematics. `shares` is the load of each joint, 0 to 1. */
  set(shares: readonly number[], selected: number): void {
    const { kinematics } = this;
    const one = new Vector3(1, 1, 1);
    const matrix = new Matrix4();
    this.matrices.forEach((m, i) => m.compose(kinematics.positions[i], kinematics.turns[i], one));
    const all = this.outlines.geometry.getAttribute("position") as BufferAttribute;
    for (const kind of this.kinds) {
      kind.bodies.forEach((body, n) => {
        kind.mesh.setMatrixAt(n, this.matrices[body]);
        if (kind.shadow && this.press) {
          kind.shadow.setMatrixAt(n, matrix.multiplyMatrices(this.press, this.matrices[body]));
        }
        place(kind.edges, this.matrices[body], all.array as Float32Array, 3 * kind.first + n * kind.edges.length);
      });
      kind.mesh.instanceMatrix.needsUpdate = true;
      kind.mesh.boundingSphere = null;
      if (kind.shadow) kind.shadow.instanceMatrix.needsUpdate = true;
    }
    all.needsUpdate = true;
    if (!this.light) return;
    this.tint(this.tinted ? shares : null);
    this.frame(this.meta.joints[selected]?.body ?? -1);
  }

  /** Colours each body by the largest load of the hinges on it; null restores the colours of the bodies. */
  private tint(shares: readonly number[] | null): void {
    const colour = new Color();
    for (const { mesh, look, bodies: members } of this.kinds) {
      if (!shares) {
        mesh.material = look;
        mesh.instanceColor = null;
        continue;
      }
      mesh.material = this.flat;
      members.forEach((body, n) => {
        const share = Math.max(0, ...this.hingesOn[body].map((j) => shares[j]));
        mesh.setColorAt(n, coloured(ringLoad(this.theme, share), colour));
      });
      mesh.instanceColor!.needsUpdate = true;
    }
  }

  paint(theme: Theme): void {
    this.theme = theme;
    const look = bodyColours[theme];
    for (const key of ["active", "passive", "other"] as const) {
      this.materials[key].color.set(this.light ? look[key] : look.ghost);
    }
    (this.outlines.material as LineBasicMaterial).color.set(this.light ? look.edge : look.ghost);
    (this.chosen.material as LineBasicMaterial).color.set(look.accent);
    this.shade.color.set(look.shadow);
  }

  get visible(): boolean {
    return this.all.visible;
  }
  set visible(on: boolean) {
    this.all.visible = on;
  }
  set shadows(on: boolean) {
    for (const kind of this.kinds) {
      if (kind.shadow) kind.shadow.visible = on;
    }
  }

  matrix(body: number): Matrix4 {
    return this.matrices[body];
  }

  /** Nearest joint of the first body on the ray; -1 if there is none. */
  pick(ray: Raycaster): number {
    const hits: Intersection[] = ray.intersectObjects(
      this.kinds.map((k) => k.mesh),
      false,
    );
    const hit = hits[0];
    if (hit?.instanceId === undefined) return -1;
    const kind = this.kinds.find((k) => k.mesh === hit.object);
    if (!kind) return -1;
    const body = kind.bodies[hit.instanceId];
    const { bodies, joints } = this.meta;
    const near = joints.flatMap((joint, j) =>
      joint.body === body || bodies[joint.body].parent === body || bodies[body].joint === j ? [j] : [],
    );
    near.sort(
      (a, b) => this.kinematics.pivots[a].distanceTo(hit.point) - this.kinematics.pivots[b].distanceTo(hit.point),
    );
    return near[0] ?? -1;
  }

  /** Distance from a point, along a horizontal unit vector, at which the robot ends at the latest, m. */
  front(from: Vector3, way: Vector3): number {
    const { positions } = this.kinematics;
    return this.radii.reduce((most, r, i) => {
      const p = positions[i];
      return Math.max(most, (p.x - from.x) * way.x + (p.y - from.y) * way.y + r);
    }, -Infinity);
  }

  /** True if a place is in sight from a direction: no body on the way is more than `slack` in front of the place, m. */
  seen(at: Vector3, from: Vector3, slack: number): boolean {
    const start = from.clone().multiplyScalar(slack).add(at);
    const meshes = this.kinds.map((k) => k.mesh);
    return !new Raycaster(start, from).intersectObjects(meshes, false).length;
  }

  /** Corners of all bodies, which a view must contain. */
  points(): Vector3[] {
    const { positions, turns } = this.kinematics;
    const found = this.meta.bodies.flatMap((b, i) =>
      (this.corners.get(b.type) ?? []).map((c) => c.clone().applyQuaternion(turns[i]).add(positions[i])),
    );
    return found.length ? found : positions;
  }

  /** Points of the surface of a body, in its frame. */
  surface(body: number): Vector3[] {
    return this.edgesOf(body).flatMap(({ piece }) => {
      const at = piece.body.getAttribute("position");
      return Array.from({ length: at.count }, (_, k) => new Vector3().fromBufferAttribute(at, k));
    });
  }

  private edgesOf(body: number): Kind[] {
    return this.kinds.filter((k) => k.bodies.includes(body));
  }

  private frame(body: number): void {
    const position = this.chosen.geometry.getAttribute("position") as BufferAttribute;
    const out = position.array as Float32Array;
    let n = 0;
    if (body >= 0) {
      for (const kind of this.edgesOf(body)) n += place(kind.edges, this.matrices[body], out, n);
    }
    position.needsUpdate = true;
    this.chosen.geometry.setDrawRange(0, n / 3);
  }
}

/** Projection onto the plane z = height along the direction of the light. */
function pressed(light: Vector3, height: number): Matrix4 {
  const x = light.x / light.z;
  const y = light.y / light.z;
  return new Matrix4().set(1, 0, -x, x * height, 0, 1, -y, y * height, 0, 0, 0, height, 0, 0, 0, 1);
}

/** Median of the sizes of the bodies, m. The size of a body is the length of its largest piece. */
function typicalSize(meta: Meta): number {
  const sizes = meta.bodies
    .flatMap((b) => {
      const pieces = meta.geometry[b.type] ?? [];
      return pieces.length ? [Math.max(...pieces.map((s) => 2 * Math.max(...extents(s).half.toArray())))] : [];
    })
    .sort((a, b) => a - b);
  return sizes[sizes.length >> 1] || 0.1;
}
