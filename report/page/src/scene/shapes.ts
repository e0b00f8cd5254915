// Shapes that the parts of the 3D picture share: points, lines, and copies of one geometry. None is culled, because
// three does not compute the extent of shapes that change.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Float32BufferAttribute,
  InstancedMesh,
  LineSegments,
  Matrix4,
  SRGBColorSpace,
  type LineBasicMaterial,
  type Material,
  type Scene,
} from "three";
import type { Rgb } from "../colour";

/** Matrix of a copy that is not shown. */
export const unseen = new Matrix4().makeScale(0, 0, 0);

/** Geometry with points at x, y, z, m. */
export const geometryOf = (xyz: Float32Array | number[]): BufferGeometry =>
  new BufferGeometry().setAttribute("position", new Float32BufferAttribute(xyz, 3));

/** Geometry with space for a number of points that change. */
export function room(count: number): BufferGeometry {
  const made = geometryOf(new Float32Array(3 * count));
  (made.getAttribute("position") as BufferAttribute).setUsage(DynamicDrawUsage);
  return made;
}

export function segments(geometry: BufferGeometry, material: LineBasicMaterial): LineSegments {
  const made = new LineSegments(geometry, material);
  made.frustumCulled = false;
  return made;
}

/** Adds a number of copies of a geometry to the scene. */
export function copies(
  scene: Scene,
  geometry: BufferGeometry,
  material: Material,
  count: number,
  order = 0,
): InstancedMesh {
  const made = new InstancedMesh(geometry, material, Math.max(count, 1));
  made.count = count;
  made.frustumCulled = false;
  made.renderOrder = order;
  scene.add(made);
  return made;
}

/** Sets a colour from bytes. In an empty colour space, an unlit material shows these bytes unchanged. */
export const coloured = ([r, g, b]: Rgb, colour = new Color(), space: string = SRGBColorSpace): Color =>
  colour.setRGB(r / 255, g / 255, b / 255, space);

/** Writes the points, transformed by m, into `out`, starting at index `at`. Returns the number of values written. */
export function place(points: Float32Array, m: Matrix4, out: Float32Array, at: number): number {
  const e = m.elements;
  for (let i = 0; i < points.length; i += 3) {
    const x = points[i];
    const y = points[i + 1];
    const z = points[i + 2];
    out[at + i] = e[0] * x + e[4] * y + e[8] * z + e[12];
    out[at + i + 1] = e[1] * x + e[5] * y + e[9] * z + e[13];
    out[at + i + 2] = e[2] * x + e[6] * y + e[10] * z + e[14];
  }
  return points.length;
}
