// Ground in the 3D picture: a grid on the plane, fixed and moving boxes, a heightfield.
import {
  BoxGeometry,
  BufferAttribute,
  DoubleSide,
  EdgesGeometry,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  Scene,
  Vector3,
} from "three";
import type { Theme } from "../colour";
import type { Heightfield, Meta } from "../data/format";
import { position, rotation } from "../data/kinematics";
import { rounded } from "../data/numbers";
import type { Recording } from "../data/recording";
import { copies, geometryOf, place, room, segments } from "./shapes";

const looks = {
  light: { minor: 0xcdd4da, major: 0xa3aeb8, solid: 0xc9d0d6, edge: 0x6c7680 },
  dark: { minor: 0x27303a, major: 0x44515e, solid: 0x323b45, edge: 0x0a0d10 },
};

/** True for ground with a level surface, on which shadows, a grid and the way of the robot can be drawn. */
export const level = ({ ground: { kind } }: Meta): boolean => kind === "plane" || kind === "boxes";

/** Rectangle of the ground: least and largest x, least and largest y, m. */
export type Area = [number, number, number, number];

export class Ground {
  /** Distance of the grid lines, m. */
  readonly spacing: number;
  private readonly minor = new LineBasicMaterial();
  private readonly major = new LineBasicMaterial();
  private readonly solid = new MeshLambertMaterial({ side: DoubleSide });
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.6 });
  private readonly boxes: InstancedMesh | null = null;
  private readonly outlines: LineSegments | null = null;
  private readonly cube = new EdgesGeometry(new BoxGeometry(1, 1, 1)).getAttribute("position").array as Float32Array;

  constructor(
    private readonly recording: Recording,
    scene: Scene,
    area: Area,
    size: number,
  ) {
    const { ground } = recording.meta;
    this.spacing = rounded(size / 4);
    if (ground.kind === "none") return;
    const margin = Math.max(50 * this.spacing, 5 * size);
    const step = 10 * this.spacing;
    const [x0, x1, y0, y1] = area.map(
      (v, i) => (i % 2 ? Math.ceil((v + margin) / step) : Math.floor((v - margin) / step)) * step,
    );
    if (ground.kind !== "heightfield") scene.add(this.grid([x0, x1, y0, y1], false), this.grid([x0, x1, y0, y1], true));
    if (ground.heightfield) scene.add(this.field(ground.heightfield), this.net(ground.heightfield));
    if (ground.boxes.length) {
      this.boxes = copies(scene, new BoxGeometry(1, 1, 1), this.solid, ground.boxes.length);
      this.outlines = segments(room((ground.boxes.length * this.cube.length) / 3), this.edge);
      scene.add(this.outlines);
      this.put(0, () => true);
    }
  }

  set(t: number): void {
    if (this.recording.meta.ground.boxes.some((b) => b.moves >= 0)) this.put(t, (moves) => moves >= 0);
  }

  paint(theme: Theme): void {
    const look = looks[theme];
    this.minor.color.set(look.minor);
    this.major.color.set(look.major);
    this.solid.color.set(look.solid);
    this.edge.color.set(look.edge);
  }

  private put(t: number, which: (moves: number) => boolean): void {
    const { recording, boxes, outlines } = this;
    const matrix = new Matrix4();
    if (!boxes || !outlines) return;
    const points = outlines.geometry.getAttribute("position") as BufferAttribute;
    recording.meta.ground.boxes.forEach((box, i) => {
      if (!which(box.moves)) return;
      const at = position(box.pose);
      const turn = rotation(box.pose);
      if (box.moves >= 0 && recording.has(`box.${box.moves}.x`)) {
        const now = (c: string) => recording.at(recording.channel(`box.${box.moves}.${c}`), t);
        at.set(now("x"), now("y"), now("z"));
        turn.copy(new Quaternion(now("qx"), now("qy"), now("qz"), now("qw")).normalize());
      }
      boxes.setMatrixAt(i, matrix.compose(at, turn, new Vector3(...box.size)));
      place(this.cube, matrix, points.array as Float32Array, i * this.cube.length);
    });
    boxes.instanceMatrix.needsUpdate = points.needsUpdate = true;
  }

  // Lines of the grid. A textured floor with anisotropic filtering would cost 160 ms a frame without a GPU. Each line
  // is divided into pieces of ten cells, because software GL omits a line if one end is behind the camera.
  private grid([x0, x1, y0, y1]: Area, major: boolean): LineSegments {
    const { height } = this.recording.meta.ground;
    const d = this.spacing;
    const piece = 10 * d;
    const at: number[] = [];
    const mine = (n: number) => (n % 10 === 0) === major;
    for (let i = Math.round(x0 / d); i <= Math.round(x1 / d); i++) {
      if (mine(i)) {
        for (let y = y0; y < y1 - d / 2; y += piece) at.push(i * d, y, height, i * d, y + piece, height);
      }
    }
    for (let i = Math.round(y0 / d); i <= Math.round(y1 / d); i++) {
      if (mine(i)) {
        for (let x = x0; x < x1 - d / 2; x += piece) at.push(x, i * d, height, x + piece, i * d, height);
      }
    }
    return segments(geometryOf(at), major ? this.major : this.minor);
  }

  private field({ origin, spacing, nx, ny, heights }: Heightfield): Mesh {
    const at = new Float32Array(3 * nx * ny);
    const corners: number[] = [];
    heights.forEach((z, i) =>
      at.set([origin[0] + (i % nx) * spacing[0], origin[1] + Math.floor(i / nx) * spacing[1], z], 3 * i),
    );
    for (let y = 0; y + 1 < ny; y++) {
      for (let x = 0; x + 1 < nx; x++) {
        const a = y * nx + x;
        corners.push(a, a + 1, a + nx, a + 1, a + nx + 1, a + nx);
      }
    }
    const geometry = geometryOf(at).setIndex(corners);
    geometry.computeVertexNormals();
    const mesh = new Mesh(geometry, this.solid);
    mesh.frustumCulled = false;
    return mesh;
  }

  private net({ origin, spacing, nx, ny, heights }: Heightfield): LineSegments {
    const at: number[] = [];
    const lift = 0.002 * Math.max(...spacing);
    const every = Math.max(1, Math.ceil(Math.max(nx, ny) / 120));
    const point = (x: number, y: number) =>
      at.push(origin[0] + x * spacing[0], origin[1] + y * spacing[1], heights[y * nx + x] + lift);
    for (let y = 0; y < ny; y++) {
      for (let x = 0; x < nx; x++) {
        if (x + 1 < nx && y % every === 0) {
          point(x, y);
          point(x + 1, y);
        }
        if (y + 1 < ny && x % every === 0) {
          point(x, y);
          point(x, y + 1);
        }
      }
    }
    return segments(geometryOf(at), this.minor);
  }
}
