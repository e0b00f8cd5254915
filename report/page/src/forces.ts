// Arrows in the 3D picture for the contact forces on the feet.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Scene, Vector3 } from "three";
import type { Theme } from "./colour";
import type { Recording } from "./recording";
import type { Values } from "./channels";

interface Arrow {
  group: Group;
  shaft: Mesh;
  tip: Mesh;
  force: Values[];
  point: Values[];
}

export class Forces {
  private readonly arrows: Arrow[];
  private readonly material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
  /** Length of an arrow per force, m/N. */
  private readonly scale: number;
  private readonly head: number;

  constructor(
    private readonly recording: Recording,
    scene: Scene,
    unit: number,
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
    this.head = 0.4 * unit;
    const shaft = new CylinderGeometry(0.052 * unit, 0.052 * unit, 1, 10).translate(0, 0.5, 0);
    const tip = new ConeGeometry(0.15 * unit, this.head, 14).translate(0, this.head / 2, 0);
    this.arrows = feet.flatMap((_, n) => {
      const values = (names: string[]) => names.map((c) => recording.find(`foot.${n}.${c}`));
      const point = values(["x", "y", "z"]);
      const force = values(["fx", "fy", "fz"]);
      const fz = force[2];
      if (!fz || point.some((p) => !p)) return [];
      const none = new Float32Array(recording.rows);
      const group = new Group();
      const a = new Mesh(shaft, this.material);
      const b = new Mesh(tip, this.material);
      a.renderOrder = b.renderOrder = 5;
      group.add(a, b);
      scene.add(group);
      return [{ group, shaft: a, tip: b, force: force.map((f) => f ?? none), point: point as Values[] }];
    });
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

  get any(): boolean {
    return this.arrows.length > 0;
  }

  set(t: number, shown: boolean): void {
    const up = new Vector3(0, 1, 0);
    const at = (values: Values[]) =>
      new Vector3(...(values.map((v) => this.recording.at(v, t)) as [number, number, number]));
    for (const { group, shaft, tip, force, point } of this.arrows) {
      const f = at(force);
      const n = f.length();
      group.visible = shown && n > 0.005 * this.recording.meta.weight;
      if (!group.visible) continue;
      group.position.copy(at(point));
      group.quaternion.setFromUnitVectors(up, f.divideScalar(n));
      shaft.scale.y = Math.max(n * this.scale - this.head, 1e-4);
      tip.position.y = shaft.scale.y;
    }
  }

  paint(theme: Theme): void {
    this.material.color.set(theme === "dark" ? 0x2cc597 : 0x007a59);
  }
}
