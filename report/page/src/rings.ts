// Rings around the docks in the 3D picture. The ring of the chosen dock is wider.
import {
  CylinderGeometry,
  DoubleSide,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Scene,
  Vector3,
} from "three";
import type { Theme } from "./colour";
import type { Meta } from "./format";
import { position } from "./kinematics";
import { corners } from "./outline";
import type { Robot } from "./robot";

const unseen = new Matrix4().makeScale(0, 0, 0);

export class Rings {
  all = false;
  chosen = -1;
  private readonly places: ({ body: number; local: Matrix4 } | null)[];
  private readonly mesh: InstancedMesh;
  // Without depth test, because a dock would be hidden between its two bodies.
  private readonly material = new MeshBasicMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: 0.8,
    depthTest: false,
  });

  constructor(
    private readonly meta: Meta,
    private readonly robot: Robot,
    scene: Scene,
  ) {
    this.places = meta.docks.map((_, n) => this.place(n));
    this.mesh = new InstancedMesh(
      new CylinderGeometry(1, 1, 1, 36, 1, true),
      this.material,
      Math.max(meta.docks.length, 1),
    );
    this.mesh.count = meta.docks.length;
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 4;
    scene.add(this.mesh);
  }

  get any(): boolean {
    return this.places.some((p) => p);
  }

  set(): void {
    const matrix = new Matrix4();
    const thin = new Matrix4().makeScale(1, 0.4, 1);
    this.mesh.visible = this.all || this.chosen >= 0;
    if (!this.mesh.visible) return;
    this.places.forEach((p, n) => {
      const shown = p && (this.all || n === this.chosen);
      if (shown) matrix.multiplyMatrices(this.robot.matrix(p.body), p.local);
      if (shown && n !== this.chosen) matrix.multiply(thin);
      this.mesh.setMatrixAt(n, shown ? matrix : unseen);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  paint(theme: Theme): void {
    this.material.color.set(theme === "dark" ? 0xe9edf1 : 0x1b2127);
  }

  /** Pose of the ring of a dock, around the body of the docked module at its face; null if the face is not known. */
  private place(n: number): { body: number; local: Matrix4 } | null {
    const { bodies, faces, geometry, docks } = this.meta;
    const { module, face: id } = docks[n];
    const body = bodies.findIndex((b) => b.module === module && faces[b.type]?.some((f) => f.id === id));
    if (body < 0) return null;
    const { type } = bodies[body];
    const face = faces[type].find((f) => f.id === id)!;
    const normal = new Vector3(...face.normal).normalize();
    const centre = position([...face.origin, 1, 0, 0, 0]);
    const away = (p: Vector3) => p.clone().sub(centre).projectOnPlane(normal).length();
    const points = (geometry[type] ?? []).flatMap(corners);
    const radius = points.length ? 1.04 * Math.max(...points.map(away)) : 0.7 * this.robot.unit;
    return {
      body,
      local: new Matrix4().compose(
        centre,
        new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), normal),
        new Vector3(radius, 0.16 * this.robot.unit, radius),
      ),
    };
  }
}
