// Marks in the 3D picture for the assembly of a robot: numbers of the faces, and hinge axes with their positive sense.
import {
  BoxGeometry,
  CanvasTexture,
  ConeGeometry,
  CylinderGeometry,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  PlaneGeometry,
  Quaternion,
  SRGBColorSpace,
  Scene,
  Vector3,
} from "three";
import type { Theme } from "../colour";
import type { Face, Meta } from "../data/format";
import { corners } from "./outline";
import type { Robot } from "./robot";
import { position, type Kinematics } from "../data/kinematics";
import { copies } from "./shapes";

/** Decals of faces with equal number, gender and orientation of the number, and the poses of these decals. */
interface Decals {
  mesh: InstancedMesh;
  places: { body: number; local: Matrix4 }[];
}

const screenUp = new Vector3(-0.25, 0.34, 0.9); // upward direction on the screen in the first view
const lift = 0.01; // height of a decal above its face, in sizes of a body

export class Marks {
  faces = false;
  axes = false;
  private readonly decals: Decals[] = [];
  private readonly parts: InstancedMesh[];
  private readonly sensors: InstancedMesh;
  // Axes are visible through bodies, because an axis often ends within the next module.
  private readonly material = new MeshBasicMaterial({ transparent: true, opacity: 0.95, depthTest: false });

  constructor(
    private readonly meta: Meta,
    private readonly kinematics: Kinematics,
    private readonly robot: Robot,
    scene: Scene,
  ) {
    const kinds = new Map<string, { face: Face; quarters: number; places: Decals["places"] }>();
    meta.bodies.forEach((b, body) => {
      for (const face of meta.faces[b.type] ?? []) {
        const quarters = this.quarters(body, face);
        const key = `${face.id}/${face.gender}/${quarters}`;
        const kind = kinds.get(key) ?? { face, quarters, places: [] };
        kind.places.push({ body, local: this.decal(b.type, face, quarters) });
        kinds.set(key, kind);
      }
    });
    for (const { face, quarters, places } of kinds.values()) {
      const look = new MeshBasicMaterial({ map: plate(face, quarters), transparent: true, depthWrite: false });
      this.decals.push({ mesh: copies(scene, new PlaneGeometry(1, 1), look, places.length, 2), places });
    }
    // An axis is a rod with a cone at its positive end.
    const rod = new CylinderGeometry(0.022, 0.022, 2, 10);
    const cone = new ConeGeometry(0.085, 0.3, 18).translate(0, 1.15, 0);
    this.parts = [rod, cone].map((part) => copies(scene, part, this.material, meta.joints.length, 5));
    // Small cubes for sensors are visible through their bodies.
    const look = new MeshBasicMaterial({ color: 0xe69f00, depthTest: false, transparent: true });
    this.sensors = copies(scene, new BoxGeometry(1, 1, 1), look, meta.sensors?.length ?? 0, 3);
  }

  /** Names and positions of the sensors at points of bodies. */
  sensorsAt(): { name: string; at: Vector3 }[] {
    const at = (body: number, p: [number, number, number]) => new Vector3(...p).applyMatrix4(this.robot.matrix(body));
    return (this.meta.sensors ?? []).map(({ name, body, position: p }) => ({ name, at: at(body, p) }));
  }

  get anyFaces(): boolean {
    return this.decals.length > 0;
  }
  hasFaces(gender: string): boolean {
    return this.meta.bodies.some((b) => this.meta.faces[b.type]?.some((f) => f.gender === gender));
  }

  set(): void {
    const matrix = new Matrix4();
    const { kinematics, robot } = this;
    for (const { mesh, places } of this.decals) {
      mesh.visible = this.faces;
      if (!this.faces) continue;
      places.forEach(({ body, local }, n) => mesh.setMatrixAt(n, matrix.multiplyMatrices(robot.matrix(body), local)));
      mesh.instanceMatrix.needsUpdate = true;
    }
    this.meta.sensors?.forEach(({ body, position: p }, n) => {
      const size = 0.14 * robot.unit;
      matrix.copy(robot.matrix(body)).multiply(new Matrix4().makeTranslation(...p));
      this.sensors.setMatrixAt(n, matrix.scale(new Vector3(size, size, size)));
      this.sensors.instanceMatrix.needsUpdate = true;
    });
    for (const mesh of this.parts) {
      mesh.visible = this.axes;
      if (!this.axes) continue;
      robot.hinges.forEach((hinge, j) => {
        const length = hinge.half + 0.3 * robot.unit;
        mesh.setMatrixAt(
          j,
          matrix.compose(
            kinematics.pivots[j],
            kinematics.pivotTurns[j].clone().multiply(hinge.turn),
            new Vector3(length, length, length),
          ),
        );
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** Position of the name of a joint, beyond the cone of its axis. */
  tip(joint: number): Vector3 {
    const { kinematics, robot } = this;
    return robot.axes[joint]
      .clone()
      .applyQuaternion(kinematics.pivotTurns[joint])
      .multiplyScalar(1.5 * (robot.hinges[joint].half + 0.3 * robot.unit))
      .add(kinematics.pivots[joint]);
  }

  paint(theme: Theme): void {
    this.material.color.set(theme === "dark" ? 0xe39cc1 : 0x9a3f70);
  }

  // Number of quarter turns from the face's reference direction after which its number is upright in the start pose.
  private quarters(body: number, face: Face): number {
    const normal = new Vector3(...face.normal);
    const reference = new Vector3(...face.reference);
    const heights = [0, 1, 2, 3].map((k) =>
      reference
        .clone()
        .applyAxisAngle(normal, (k * Math.PI) / 2)
        .applyQuaternion(this.kinematics.turns[body])
        .dot(screenUp),
    );
    return heights.indexOf(Math.max(...heights));
  }

  // Pose of the decal on a face, scaled to the width of the body across the face.
  private decal(type: string, face: Face, quarters: number): Matrix4 {
    const normal = new Vector3(...face.normal).normalize();
    const up = new Vector3(...face.reference).normalize().applyAxisAngle(normal, (quarters * Math.PI) / 2);
    const right = up.clone().cross(normal);
    const points = (this.meta.geometry[type] ?? []).flatMap(corners);
    const wide = (v: Vector3) => Math.max(...points.map((p) => p.dot(v))) - Math.min(...points.map((p) => p.dot(v)));
    const size = points.length ? 0.75 * Math.min(wide(up), wide(right)) : 0.5 * this.robot.unit;
    const turn = new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(right, up, normal));
    return new Matrix4().compose(
      position([...face.origin, 1, 0, 0, 0]).addScaledVector(normal, lift * this.robot.unit),
      turn,
      new Vector3(size, size, size),
    );
  }
}

/**
 * Picture of a face's number. It is on a filled disc for an active face, in a brown ring for a passive face, and in a
 * grey ring for a face without gender. A wedge points along the reference direction of the face.
 */
function plate({ id, gender }: Face, quarters: number): CanvasTexture {
  const canvas = document.createElement("canvas");
  const g = canvas.getContext("2d")!;
  const c = 64;
  canvas.width = canvas.height = 2 * c;
  const fill = gender === "active" ? "#0a3f66" : "#fff8e8";
  const stroke = { active: "#ffffff", passive: "#6b4300", none: "#444444" }[gender];
  g.fillStyle = fill;
  g.strokeStyle = stroke;
  g.lineWidth = 6;
  g.beginPath();
  g.arc(c, c, 46, 0, 2 * Math.PI);
  g.fill();
  g.stroke();
  g.fillStyle = stroke;
  g.beginPath();
  g.save();
  g.translate(c, c);
  g.rotate((quarters * Math.PI) / 2);
  g.moveTo(0, -64);
  g.lineTo(15, -42);
  g.lineTo(-15, -42);
  g.fill();
  g.restore();
  g.font = "700 58px system-ui, sans-serif";
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillText(String(id), c, c + 4);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
