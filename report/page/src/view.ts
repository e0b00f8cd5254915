// The 3D picture: scene with robot, ground, arrows, marks and rings; camera, and selection of joints by the pointer.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  Line,
  LineBasicMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Theme } from "./colour";
import { Forces } from "./forces";
import { Ground, type Area } from "./ground";
import type { Ghost } from "./ghost";
import { Kinematics } from "./kinematics";
import { Marks } from "./marks";
import type { Desk } from "./panel";
import type { Recording } from "./recording";
import { Rings } from "./rings";
import { Robot } from "./robot";

export type Look = "iso" | "side" | "top" | "front";

const directions: Record<Look, Vector3> = {
  iso: new Vector3(0.55, -0.76, 0.46),
  side: new Vector3(0, -1, 0.12),
  top: new Vector3(0, -0.001, 1),
  front: new Vector3(1, 0, 0.14),
};
const looks = { light: { sky: 0xeef1f4, trail: 0x0072b2 }, dark: { sky: 0x14181d, trail: 0x5fb3e6 } };
const trailStep = 8; // rows between two points of the drawn path

export class View {
  selected = -1;
  hovered = -1;
  follow = true;
  forces = true;
  dirty = true;
  readonly kinematics: Kinematics;
  readonly robot: Robot;
  readonly marks: Marks;
  readonly rings: Rings;
  readonly arrows: Forces;
  readonly ground: Ground;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.02, 60);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 1.75);
  private readonly trail: Line;
  private readonly size: number;
  private readonly recording: Recording;
  /** Translucent robot of the second run. */
  readonly second: { ghost: Ghost; kinematics: Kinematics; robot: Robot } | null = null;
  private time = 0;
  private lightened = 0;

  constructor(
    private readonly desk: Pick<Desk, "recording" | "loads" | "ghost">,
    readonly canvas: HTMLCanvasElement,
  ) {
    const { recording, ghost } = desk;
    this.recording = recording;
    this.kinematics = new Kinematics(recording);
    this.kinematics.set(0);
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "low-power" });
    this.scene.add(new HemisphereLight(0xffffff, 0xb9c2cb, 2.15), this.sun);
    this.sun.position.set(-0.7, -0.9, 2.4);
    this.robot = new Robot(recording.meta, this.kinematics, this.scene, this.sun.position);
    if (ghost) {
      const kinematics = new Kinematics(ghost.recording);
      kinematics.set(0);
      this.second = { ghost, kinematics, robot: new Robot(ghost.recording.meta, kinematics, this.scene, null) };
    }
    this.size = this.extent();
    this.ground = new Ground(recording, this.scene, this.area(), this.size);
    this.arrows = new Forces(recording, this.scene, this.robot.unit, this.size);
    this.marks = new Marks(recording.meta, this.kinematics, this.robot, this.scene);
    this.rings = new Rings(recording.meta, this.robot, this.scene);
    this.trail = this.path();
    this.scene.add(this.trail);
    this.camera.up.set(0, 0, 1);
    this.camera.near = 0.02 * this.robot.unit;
    this.camera.far = 60 * this.size;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.maxPolarAngle = recording.meta.ground.kind === "none" ? Math.PI : 1.55;
    this.controls.minDistance = 1.2 * this.robot.unit;
    this.controls.maxDistance = 12 * this.size;
    this.controls.addEventListener("change", () => {
      this.dirty = true;
    });
  }

  paint(theme: Theme): void {
    const look = looks[theme];
    this.scene.background = new Color(look.sky);
    this.scene.fog = new Fog(look.sky, 4.5 * this.size, 14 * this.size);
    (this.trail.material as LineBasicMaterial).color.set(look.trail);
    for (const part of [this.robot, this.ground, this.arrows, this.marks, this.rings]) part.paint(theme);
    this.second?.robot.paint(theme);
    this.set(this.time);
  }

  /** Moves the camera so that the robot, or a joint, fills the picture, with space for the labels at the top. */
  look(from: Look, joint = -1): void {
    const points = joint < 0 ? this.everything() : this.robot.points(joint);
    const centre = new Box3().setFromPoints(points).getCenter(new Vector3());
    const v = new Vector3();
    let distance = joint < 0 ? this.size : 6 * this.robot.unit;
    for (let i = 0; i < 6; i++) {
      this.camera.position.copy(directions[from]).normalize().multiplyScalar(distance).add(centre);
      this.camera.lookAt(centre);
      this.camera.updateMatrixWorld();
      const seen = new Box3().setFromPoints(points.map((p) => v.copy(p).project(this.camera).clone()));
      const middle = seen.getCenter(new Vector3());
      const half = seen.getSize(new Vector3()).divideScalar(2);
      const up = distance * Math.tan((this.camera.fov * Math.PI) / 360);
      centre.add(
        v.set(middle.x * up * this.camera.aspect, (middle.y + 0.02) * up, 0).applyQuaternion(this.camera.quaternion),
      );
      distance *= Math.min(Math.max(half.x / 0.86, half.y / 0.74, 0.25), 4);
    }
    this.camera.position.copy(directions[from]).normalize().multiplyScalar(distance).add(centre);
    this.controls.target.copy(centre);
    this.controls.update();
    this.dirty = true;
  }

  set(t: number): void {
    if (this.follow) {
      const by = this.centre(t).sub(this.centre(this.time));
      this.controls.target.add(by);
      this.camera.position.add(by);
    }
    this.time = t;
    this.kinematics.set(t);
    const shares = this.recording.meta.joints.map((_, j) => this.desk.loads.shareAt(j, t));
    this.robot.set(shares, this.selected, this.hovered);
    if (this.second) {
      const { ghost, kinematics, robot } = this.second;
      robot.visible = ghost.covers(t);
      kinematics.set(ghost.time(t));
      robot.set([], -1, -1);
    }
    this.marks.set();
    this.rings.set();
    this.ground.set(t);
    this.arrows.set(t, this.forces);
    this.trail.geometry.setDrawRange(0, Math.max(2, Math.floor(this.recording.row(t) / trailStep)));
    this.dirty = true;
  }

  select(joint: number): void {
    this.selected = joint;
    this.set(this.time);
  }

  /** Draws a wide ring around a dock; -1 removes the ring. */
  mark(dock: number): void {
    this.rings.chosen = dock;
    this.set(this.time);
  }

  /** Number of the joint at a point of the window, CSS px; -1 if there is no joint. */
  pick(x: number, y: number): number {
    const r = this.canvas.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(((x - r.left) / r.width) * 2 - 1, 1 - ((y - r.top) / r.height) * 2), this.camera);
    return this.robot.pick(ray);
  }

  /** Position of a hinge on the canvas, CSS px; null if the hinge is behind the camera. */
  place(joint: number): [number, number] | null {
    return this.project(this.kinematics.pivots[joint]);
  }

  project(p: Vector3): [number, number] | null {
    this.camera.updateMatrixWorld();
    const v = p.clone().project(this.camera);
    const r = this.canvas.getBoundingClientRect();
    return v.z < 1 ? [((v.x + 1) / 2) * r.width, ((1 - v.y) / 2) * r.height] : null;
  }

  /** Matrix from world to clip coordinates, in column-major order. Tests use it. */
  get projection(): number[] {
    this.camera.updateMatrixWorld();
    return this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse).elements.slice();
  }

  resize(): void {
    const host = this.canvas.parentElement!.getBoundingClientRect();
    if (host.width < 2 || host.height < 2) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2) * (this.lightened > 1 ? 0.7 : 1));
    this.renderer.setSize(host.width, host.height, false);
    this.camera.aspect = host.width / host.height;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  /** Reduces the work per frame on a slow machine. The first call hides the shadows, the second halves the pixels. */
  lighten(): void {
    this.lightened++;
    if (this.lightened === 1) this.robot.shadows = false;
    else if (this.lightened === 2) this.resize();
    this.dirty = true;
  }

  /** Draws the scene if something has changed. Returns true if it has drawn. */
  render(): boolean {
    if (!this.dirty) return false;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    return true;
  }

  /** Data URL with the picture at the time shown, as a PNG. */
  image(): string {
    this.dirty = true;
    this.render();
    return this.canvas.toDataURL("image/png");
  }

  // Point that the camera follows: the centre of mass, or the base or the mean position of the bodies if the centre of
  // mass is not recorded. The height of a recorded point is constant, so that a walk does not shake the picture.
  private centre(t: number): Vector3 {
    const [x, y, z] = ["x", "y", "z"].map(
      (c) => this.recording.find(`com.${c}`) ?? this.recording.channel(`base.${c}`),
    );
    if (!this.recording.has("com.x") && !this.recording.has("base.x")) {
      const sum = this.kinematics.positions.reduce((s, p) => s.add(p), new Vector3());
      return sum.divideScalar(Math.max(this.kinematics.positions.length, 1));
    }
    return new Vector3(this.recording.at(x, t), this.recording.at(y, t), this.recording.at(z, 0));
  }

  private everything(): Vector3[] {
    return [...this.robot.points(), ...(this.second?.ghost.covers(this.time) ? this.second.robot.points() : [])];
  }

  private extent(): number {
    return Math.max(new Box3().setFromPoints(this.everything()).getSize(new Vector3()).length(), this.robot.unit);
  }

  private area(): Area {
    const out: Area = [Infinity, -Infinity, Infinity, -Infinity];
    for (const [k, c] of [
      [0, "x"],
      [2, "y"],
    ] as const) {
      const values = this.recording.find(`com.${c}`) ?? this.recording.channel(`base.${c}`);
      for (const v of values) {
        out[k] = Math.min(out[k], v);
        out[k + 1] = Math.max(out[k + 1], v);
      }
      // The area is limited, because positions of a run that diverged are unbounded.
      const start = values[0];
      const far = 60 * this.size;
      out[k] = Math.max(out[k], start - far);
      out[k + 1] = Math.min(out[k + 1], start + far);
    }
    return out;
  }

  private path(): Line {
    const { recording } = this;
    const n = Math.ceil(recording.rows / trailStep);
    const xyz = new Float32Array(3 * n);
    const { ground } = recording.meta;
    const [x, y, z] = ["x", "y", "z"].map((c) => recording.channel(`com.${c}`));
    const flat = ground.kind === "plane" || ground.kind === "boxes";
    for (let i = 0; i < n; i++) {
      const k = Math.min(trailStep * i, recording.rows - 1);
      xyz.set([x[k], y[k], flat ? ground.height + 0.002 * this.size : z[k]], 3 * i);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(xyz, 3));
    const line = new Line(geometry, new LineBasicMaterial());
    line.frustumCulled = false;
    line.visible = recording.ran && recording.has("com.x");
    return line;
  }
}
