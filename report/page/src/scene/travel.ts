// Direction of travel in the 3D picture: an arrow on the ground before the robot, and the path of the centre of mass.
import { BufferGeometry, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Scene, Vector3 } from "three";
import type { Theme } from "../colour";
import type { Recording } from "../data/recording";
import { level } from "./ground";
import { geometryOf } from "./shapes";

const colours = { light: 0x0072b2, dark: 0x5fb3e6 };
const every = 8; // rows between two points of the path

export class Travel {
  shown = true;
  readonly any: boolean;
  private readonly flat: boolean;
  private readonly line: Line;
  private readonly arrow: Mesh;
  private readonly look = new MeshBasicMaterial({ transparent: true });

  /** `unit` is the size of a typical body and `size` the size of the robot, m. */
  constructor(
    private readonly recording: Recording,
    private readonly unit: number,
    private readonly size: number,
    scene: Scene,
  ) {
    this.flat = level(recording.meta);
    this.any = recording.ran && recording.has("com.x");
    this.line = new Line(this.path(), new LineBasicMaterial());
    this.arrow = new Mesh(chevron(unit), this.look);
    this.line.frustumCulled = this.arrow.frustumCulled = false;
    scene.add(this.line, this.arrow);
  }

  /** Moves the arrow before the robot; `front` is the distance at which the robot ends in a direction. */
  set(t: number, front: (from: Vector3, way: Vector3) => number): void {
    this.line.visible = this.any && this.shown;
    if (!this.line.visible) {
      this.arrow.visible = false;
      return;
    }
    this.line.geometry.setDrawRange(0, Math.max(2, Math.floor(this.recording.row(t) / every)));
    const way = this.flat ? this.direction(t) : null;
    this.arrow.visible = !!way;
    if (!way) return;
    const centre = this.at(t);
    this.arrow.position.copy(centre).addScaledVector(way, front(centre, way) + 0.15 * this.unit);
    this.arrow.position.z = this.ground + 0.006 * this.unit;
    this.arrow.rotation.z = Math.atan2(way.y, way.x);
  }

  /** Ends of the arrow, which a view must contain; none without an arrow. */
  points(): Vector3[] {
    const { arrow, unit } = this;
    const tip = new Vector3(unit, 0, 0).applyEuler(arrow.rotation).add(arrow.position);
    return arrow.visible ? [arrow.position.clone(), tip] : [];
  }

  /** Unit vector of the motion over the period of the gait around a time; null for a robot that hardly moves. */
  direction(t: number): Vector3 | null {
    const { meta, end } = this.recording;
    const period = Math.min(meta.cycle?.period ?? 1, end);
    const from = Math.min(Math.max(t - period / 2, 0), end - period);
    const way = this.at(from + period).sub(this.at(from));
    way.z = 0;
    return way.length() > 0.005 * this.size ? way.normalize() : null;
  }

  paint(theme: Theme): void {
    this.look.color.set(colours[theme]);
    (this.line.material as LineBasicMaterial).color.set(colours[theme]);
  }

  private get ground(): number {
    return this.recording.meta.ground.height;
  }

  private at(t: number): Vector3 {
    const [x, y] = ["x", "y"].map((c) => this.recording.at(this.recording.channel(`com.${c}`), t));
    return new Vector3(x, y, 0);
  }

  private path(): BufferGeometry {
    const { recording } = this;
    const n = Math.ceil(recording.rows / every);
    const xyz = new Float32Array(3 * n);
    const [x, y, z] = ["x", "y", "z"].map((c) => recording.channel(`com.${c}`));
    for (let i = 0; i < n; i++) {
      const k = Math.min(every * i, recording.rows - 1);
      xyz.set([x[k], y[k], this.flat ? this.ground + 0.002 * this.size : z[k]], 3 * i);
    }
    return geometryOf(xyz);
  }
}

/** Flat arrow along x, as long as a body: a rectangle and a triangle. */
function chevron(unit: number): BufferGeometry {
  const tail = [0, -0.09, 0, 0.6, -0.09, 0, 0.6, 0.09, 0, 0, -0.09, 0, 0.6, 0.09, 0, 0, 0.09, 0];
  const tip = [0.6, -0.24, 0, 1, 0, 0, 0.6, 0.24, 0];
  return geometryOf([...tail, ...tip].map((x) => x * unit));
}
