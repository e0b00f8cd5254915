// Arrows in the 3D picture for the contact forces on the feet: all lengths to one scale, a dot at the point of action.
import {
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  GreaterDepth,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Scene,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
} from "three";
import type { Values } from "../data/channels";
import type { Theme } from "../colour";
import { leastLoad } from "../data/places";
import type { Recording } from "../data/recording";
import { copies, unseen } from "./shapes";

interface Arrow {
  force: Values[];
  point: Values[];
}

const up = new Vector3(0, 1, 0);

export class Forces {
  shown = true;
  /** Length of an arrow per force, m/N. */
  readonly scale: number;
  private readonly arrows: Arrow[];
  // Arrows are lighter behind bodies. Dots are visible through all bodies, because a foot covers its contact. Opaque
  // two-sided faces use the shader of the shadows, so that no further shader is compiled.
  private readonly materials = [
    new MeshBasicMaterial({ side: DoubleSide, depthFunc: GreaterDepth, depthWrite: false }),
    new MeshBasicMaterial({ side: DoubleSide }),
    new MeshBasicMaterial({ side: DoubleSide, depthTest: false }),
  ];
  private readonly shafts: InstancedMesh[];
  private readonly tips: InstancedMesh[];
  private readonly dots: InstancedMesh[];
  private readonly ends: (Vector3 | null)[] = []; // tips of the arrows at the present time; null without an arrow

  constructor(
    private readonly recording: Recording,
    scene: Scene,
    private readonly unit: number,
    size: number,
  ) {
    const { feet, weight } = recording.meta;
    // The arrow of a typical load is about as long as a few modules, and the longest arrow fits into the picture. The
    // typical load is a third of the weight, or for more than six feet twice the weight divided by their number.
    const long = Math.min(size, 14 * unit);
    this.scale = Math.min(
      (0.18 * long) / (Math.max(weight, 1e-9) / Math.max(3, feet.length / 2)),
      (0.32 * long) / this.largest(),
    );
    const none = new Float32Array(recording.rows);
    this.arrows = feet.flatMap((_, n) => {
      const values = (names: string[]) => names.map((c) => recording.find(`foot.${n}.${c}`));
      const point = values(["x", "y", "z"]);
      const force = values(["fx", "fy", "fz"]);
      if (!force[2] || point.some((p) => !p)) return [];
      return [{ force: force.map((f) => f ?? none), point: point as Values[] }];
    });
    const [hidden, seen, always] = this.materials;
    const made = (shape: BufferGeometry, materials: MeshBasicMaterial[]) =>
      materials.map((material, n) => copies(scene, shape, material, this.arrows.length, 4 + n));
    this.shafts = made(new CylinderGeometry(0.045, 0.045, 1, 10).translate(0, 0.5, 0), [hidden, seen]);
    this.tips = made(new ConeGeometry(0.13, 1, 14).translate(0, 0.5, 0), [hidden, seen]);
    this.dots = made(new SphereGeometry(0.06, 12, 8), [always]);
  }

  /** Largest force on a foot in the whole run, N. */
  private largest(): number {
    let most = 1e-9;
    this.recording.meta.feet.forEach((_, n) => {
      const [x, y, z] = ["fx", "fy", "fz"].map((c) => this.recording.find(`foot.${n}.${c}`));
      for (let i = 0; z && i < z.length; i++) most = Math.max(most, Math.hypot(x?.[i] ?? 0, y?.[i] ?? 0, z[i]));
    });
    return most;
  }

  /** Ends of the arrows that are shown, which the picture has to contain. */
  points(): Vector3[] {
    return this.shown ? this.ends.filter((end) => end !== null) : [];
  }

  get any(): boolean {
    return this.arrows.length > 0;
  }

  set(t: number): void {
    const meshes = [...this.shafts, ...this.tips, ...this.dots];
    for (const mesh of meshes) mesh.visible = this.shown && this.any;
    if (!this.shown) return;
    const at = (values: Values[]) =>
      new Vector3(...(values.map((v) => this.recording.at(v, t)) as [number, number, number]));
    this.arrows.forEach(({ force, point }, n) => this.place(n, at(force), at(point)));
    for (const mesh of meshes) mesh.instanceMatrix.needsUpdate = true;
  }

  // The whole arrow, shaft and tip, has the length of its force. The tip of a short arrow is smaller.
  private place(n: number, force: Vector3, point: Vector3): void {
    const { unit } = this;
    const newtons = force.length();
    const shown = newtons > leastLoad(this.recording.meta) / 4;
    const length = newtons * this.scale;
    const tip = Math.min(0.38 * unit, 0.5 * length);
    const wide = Math.max(tip / 0.38, 0.3 * unit);
    const turn = new Quaternion().setFromUnitVectors(up, force.divideScalar(newtons || 1));
    const put = (meshes: InstancedMesh[], along: number, size: Vector3) => {
      const middle = up.clone().applyQuaternion(turn).multiplyScalar(along).add(point);
      const matrix = shown ? new Matrix4().compose(middle, turn, size) : unseen;
      for (const mesh of meshes) mesh.setMatrixAt(n, matrix);
    };
    this.ends[n] = shown ? up.clone().applyQuaternion(turn).multiplyScalar(length).add(point) : null;
    put(this.shafts, 0, new Vector3(wide, length - tip, wide));
    put(this.tips, length - tip, new Vector3(wide, tip, wide));
    put(this.dots, 0, new Vector3(unit, unit, unit));
  }

  paint(theme: Theme): void {
    const [hidden, seen] = theme === "dark" ? [0x2a8a70, 0x2cc597] : [0x4d9c86, 0x007a59];
    this.materials.forEach((material, n) => material.color.set(n ? seen : hidden));
  }
}
