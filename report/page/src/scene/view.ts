// The 3D picture: scene with robot, ground, gauges, arrows and marks; camera, and selection of joints by the pointer.
import {
  Box3,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Theme } from "../colour";
import { DockLoads } from "../data/dock_loads";
import { Forces } from "./forces";
import type { Part } from "../data/format";
import { Gauges } from "./gauges";
import { Ground, type Area } from "./ground";
import type { Ghost } from "../data/ghost";
import { Kinematics } from "../data/kinematics";
import { Marks } from "./marks";
import type { Desk } from "../panel";
import type { Recording } from "../data/recording";
import { Rings } from "./rings";
import { Robot } from "./robot";
import { spot, surroundings } from "./spot";
import { Support } from "./support";
import { Travel } from "./travel";

export type Look = "iso" | "side" | "top" | "front";
/** Camera and the point that it turns to, m, both relative to the point of the robot that it follows. */
export type Pose = [position: number[], target: number[]];

const directions: Record<Look, Vector3> = {
  iso: new Vector3(0.55, -0.76, 0.46),
  side: new Vector3(0, -1, 0.12),
  top: new Vector3(0, -0.001, 1),
  front: new Vector3(1, 0, 0.14),
};
const skies = { light: 0xeef1f4, dark: 0x14181d };

export class View {
  private selected = -1;
  hovered = -1;
  follow = true;
  private dirty = true;
  readonly kinematics: Kinematics;
  readonly robot: Robot;
  readonly marks: Marks;
  readonly rings: Rings;
  readonly arrows: Forces;
  readonly support: Support;
  readonly travel: Travel;
  readonly docks: DockLoads;
  readonly ground: Ground;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.02, 60);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 1.75);
  private readonly gauges: Gauges;
  private readonly size: number;
  private height = 1; // height of the picture, CSS px
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
    this.docks = new DockLoads(recording);
    this.rings = new Rings(recording.meta, this.robot, this.docks, this.scene);
    this.gauges = new Gauges(this.kinematics, this.robot.unit, this.scene);
    this.support = new Support(recording, (body) => this.robot.matrix(body), this.robot.unit, this.scene);
    this.travel = new Travel(recording, this.robot.unit, this.size, this.scene);
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
    const { robot, ground, arrows, marks, rings, gauges, support, travel } = this;
    this.scene.background = new Color(skies[theme]);
    this.scene.fog = new Fog(skies[theme], 3 * this.size, 12 * this.size);
    for (const part of [robot, ground, arrows, marks, rings, gauges, support, travel]) part.paint(theme);
    this.second?.robot.paint(theme);
    this.set(this.time);
  }

  /**
   * Moves the camera so that the surroundings of a part, at least four bodies wide, fill the picture. Returns false,
   * without a change, if the robot has no such part or is so small that the whole of it is in the picture anyway.
   */
  near(part: Part, name: string | null): boolean {
    const { kinematics, rings } = this;
    const at = spot({ meta: this.recording.meta, kinematics, rings }, part, name);
    const r = 2.6 * this.robot.unit;
    if (!at || this.size < 3 * r) return false;
    // The camera is on the first of four sides from which no other body hides the part.
    const { x, y, z } = directions.iso;
    const sides = [
      [x, y],
      [-x, y],
      [x, -y],
      [-x, -y],
    ].map(([a, b]) => new Vector3(a, b, z).normalize());
    const open = sides.find((d) => this.robot.seen(at, d, 0.85 * this.robot.unit));
    this.look(open ?? sides[0], surroundings(at, r));
    return true;
  }

  /** Moves the camera so that points, or else the robot, fill the picture, with space for the labels at the top. */
  look(from: Look | Vector3, points = this.everything()): void {
    const direction = (typeof from === "string" ? directions[from] : from).clone().normalize();
    const centre = new Box3().setFromPoints(points).getCenter(new Vector3());
    const v = new Vector3();
    let distance = this.size;
    for (let i = 0; i < 6; i++) {
      this.camera.position.copy(direction).multiplyScalar(distance).add(centre);
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
    this.camera.position.copy(direction).multiplyScalar(distance).add(centre);
    this.controls.target.copy(centre);
    this.controls.update();
    this.dirty = true;
  }

  /** The camera relative to the point that it follows. */
  kept(): Pose {
    const from = this.centre(this.time);
    const seen = (p: Vector3) => p.clone().sub(from).toArray();
    return [seen(this.camera.position), seen(this.controls.target)];
  }

  /** Moves the camera to a place that kept() has given. */
  pose([position, target]: Pose): void {
    const from = this.centre(this.time);
    this.camera.position.fromArray(position).add(from);
    this.controls.target.fromArray(target).add(from);
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
    this.robot.set(shares, this.selected);
    this.gauges.set(shares, this.selected, this.hovered);
    if (this.second) {
      const { ghost, kinematics, robot } = this.second;
      robot.visible = ghost.covers(t);
      kinematics.set(ghost.time(t));
      robot.set([], -1);
    }
    this.marks.set();
    this.rings.set(t);
    this.ground.set(t);
    this.arrows.set(t);
    this.support.set(t);
    this.travel.set(t, (from, way) => this.robot.front(from, way));
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
    const gauge = this.gaugeAt(x - r.left, y - r.top);
    if (gauge >= 0) return gauge;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(((x - r.left) / r.width) * 2 - 1, 1 - ((y - r.top) / r.height) * 2), this.camera);
    return this.robot.pick(ray);
  }

  /** Joint of the nearest gauge at a point of the canvas, CSS px; -1 if there is no gauge. */
  private gaugeAt(x: number, y: number): number {
    const away = (j: number) => this.camera.position.distanceTo(this.kinematics.pivots[j]);
    const hit = this.kinematics.pivots
      .map((_, j) => j)
      .filter((j) => {
        const at = this.place(j);
        return at && Math.hypot(at[0] - x, at[1] - y) <= this.gauges.reach(away(j));
      });
    return hit.length ? hit.reduce((a, b) => (away(b) < away(a) ? b : a)) : -1;
  }

  /** Length on the canvas, px, of a length in m at the point to which the camera turns. */
  pixels(length: number): number {
    return length / (this.pixelAt1 * this.camera.position.distanceTo(this.controls.target));
  }

  // Size of a pixel of the canvas at the distance 1 from the camera.
  private get pixelAt1(): number {
    return (2 * Math.tan((this.camera.fov * Math.PI) / 360)) / (this.height * this.camera.zoom);
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
    this.fit(host.width, host.height, Math.min(window.devicePixelRatio || 1, 2) * (this.lightened > 1 ? 0.7 : 1));
  }

  /** Sets the size, and for `zoom` below 1 a wider field of view. */
  private fit(width: number, height: number, ratio: number, zoom = 1): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.zoom = zoom;
    this.camera.updateProjectionMatrix();
    this.gauges.pixel = this.pixelAt1;
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

  /** Draws a time with this size, px, and all that the page shows of it. The canvas keeps the size until resize(). */
  picture(t: number, width: number, height: number): HTMLCanvasElement {
    const { canvas } = this;
    const host = canvas.parentElement!.getBoundingClientRect();
    const zoom = Math.min(1, (width * host.height) / (height * host.width));
    const size = [canvas.width, canvas.height, this.renderer.getPixelRatio(), this.camera.zoom];
    if (size.some((x, k) => x !== [width, height, 1, zoom][k])) this.fit(width, height, 1, zoom);
    this.set(t);
    this.render();
    return canvas;
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
    return [
      ...this.robot.points(),
      ...this.travel.points(),
      ...this.arrows.points(),
      ...(this.second?.ghost.covers(this.time) ? this.second.robot.points() : []),
    ];
  }

  private extent(): number {
    const second = this.second?.robot.points() ?? [];
    return Math.max(
      new Box3()
        .setFromPoints([...this.robot.points(), ...second])
        .getSize(new Vector3())
        .length(),
      this.robot.unit,
    );
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
}
