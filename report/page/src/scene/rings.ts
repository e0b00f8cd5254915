// Rings around the docks in the 3D picture, coloured by load between dark rims. The ring of the chosen dock is wider.
import {
  Color,
  CylinderGeometry,
  DoubleSide,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Scene,
  Vector3,
} from "three";
import { rim, ringLoad, type Theme } from "../colour";
import type { DockLoads } from "../data/dock_loads";
import type { Meta } from "../data/format";
import { position } from "../data/kinematics";
import type { Robot } from "./robot";
import { coloured, copies, unseen } from "./shapes";

export class Rings {
  all = false;
  chosen = -1;
  private readonly places: ({ body: number; local: Matrix4 } | null)[];
  private readonly rims: InstancedMesh;
  private readonly fills: InstancedMesh;
  private theme: Theme = "light";

  constructor(
    private readonly meta: Meta,
    private readonly robot: Robot,
    private readonly loads: DockLoads,
    scene: Scene,
  ) {
    this.places = meta.docks.map((_, n) => this.place(n));
    [this.rims, this.fills] = [0, 1].map((n) => hoops(scene, meta.docks.length, n));
  }

  get any(): boolean {
    return this.places.some((p) => p);
  }

  /** Position of a dock at the time shown, m; null if its face is not known. */
  centre(dock: number): Vector3 | null {
    const p = this.places[dock];
    return p && new Vector3().setFromMatrixPosition(this.robot.matrix(p.body).clone().multiply(p.local));
  }

  set(t: number): void {
    const shownAny = this.all || this.chosen >= 0;
    this.rims.visible = this.fills.visible = shownAny && this.any;
    if (!this.rims.visible) return;
    const matrix = new Matrix4();
    const colour = new Color();
    this.places.forEach((p, n) => {
      const shown = p && (this.all || n === this.chosen);
      const wide = n === this.chosen ? 1 : 0.6;
      if (shown) matrix.multiplyMatrices(this.robot.matrix(p.body), p.local);
      this.rims.setMatrixAt(n, shown ? matrix.multiply(scaled(1, wide)) : unseen);
      this.fills.setMatrixAt(n, shown ? matrix.multiply(scaled(1.004, 0.56)) : unseen);
      this.fills.setColorAt(n, coloured(ringLoad(this.theme, this.loads.shareAt(n, t)), colour));
    });
    for (const mesh of [this.rims, this.fills]) mesh.instanceMatrix.needsUpdate = true;
    this.fills.instanceColor!.needsUpdate = true;
  }

  paint(theme: Theme): void {
    this.theme = theme;
  }

  /** Pose of the ring of a dock, around the body of the docked module at its face; null if the face is not known. */
  private place(n: number): { body: number; local: Matrix4 } | null {
    const { bodies, faces, docks } = this.meta;
    const { module, face: id } = docks[n];
    const body = bodies.findIndex((b) => b.module === module && faces[b.type]?.some((f) => f.id === id));
    if (body < 0) return null;
    const { type } = bodies[body];
    const face = faces[type].find((f) => f.id === id)!;
    const normal = new Vector3(...face.normal).normalize();
    const centre = position([...face.origin, 1, 0, 0, 0]);
    const away = (p: Vector3) => p.clone().sub(centre).projectOnPlane(normal).length();
    const beside = (p: Vector3) => Math.abs(p.clone().sub(centre).dot(normal)) < 0.12 * this.robot.unit;
    const points = this.robot.surface(body).filter(beside);
    const radius = points.length ? 1.04 * Math.max(...points.map(away)) : 0.7 * this.robot.unit;
    return {
      body,
      local: new Matrix4().compose(
        centre,
        new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), normal),
        new Vector3(radius, 0.2 * this.robot.unit, radius),
      ),
    };
  }
}

const scaled = (across: number, along: number): Matrix4 => new Matrix4().makeScale(across, along, across);

/** Open cylinders, the rims (0) or their fills (1). They have no depth test, because two bodies cover a dock. */
function hoops(scene: Scene, count: number, kind: number): InstancedMesh {
  const look = new MeshBasicMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: kind ? 1 : 0.85,
    depthTest: false,
    forceSinglePass: true, // two passes would need two shaders
  });
  if (!kind) coloured(rim, look.color);
  return copies(scene, new CylinderGeometry(1, 1, 1, 36, 1, true), look, count, 10 + kind);
}
