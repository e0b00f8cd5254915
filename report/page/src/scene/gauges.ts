// Gauges of the joints in the 3D picture: an unlit ring at each hinge that faces the reader. Its coloured arc is the
// load. A ring is in front of the two bodies of its hinge. Behind other bodies it is faint, unless its joint is chosen.
import {
  Color,
  DynamicDrawUsage,
  GreaterDepth,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LessEqualDepth,
  Mesh,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  type DepthModes,
} from "three";
import { bodyColours, rim, ringLoad, type Theme } from "../colour";
import type { Kinematics } from "../data/kinematics";
import { coloured } from "./shapes";

const radius = 0.2; // radius of a ring, in sizes of a body
const least = 4.5; // smallest radius of a ring, in a picture of the whole of a long robot, px
const most = 17; // largest radius of a ring, px
const depth = 0.85; // distance by which a ring is in front of its pivot, in sizes of a body

// The ring lies in the plane of the screen. Its depth is that of a point nearer to the camera.
const vertex = `
attribute vec3 centre;
attribute vec3 tint;
attribute vec2 state;
uniform float size;
uniform float ahead;
uniform float pixel;
varying vec2 at;
varying float px;
varying vec3 colour;
varying vec2 load;
void main() {
  vec4 eye = modelViewMatrix * vec4(centre, 1.0);
  float scale = -eye.z * pixel;
  float r = clamp(size, ${least.toFixed(1)} * scale, ${most.toFixed(1)} * scale) * (1.0 + 0.3 * state.y);
  at = 1.1 * position.xy;
  px = r / scale;
  colour = tint;
  load = state;
  gl_Position = projectionMatrix * vec4(eye.xy + at * r, eye.z, 1.0);
  vec4 front = projectionMatrix * vec4(eye.xy, min(eye.z + ahead * (state.y > 0.9 ? 9.0 : 1.0), 0.1 * eye.z), 1.0);
  gl_Position.z = front.z / front.w * gl_Position.w;
}`;

const fragment = `
uniform vec3 rim;
uniform vec3 none;
uniform vec3 accent;
uniform float opacity;
varying vec2 at;
varying float px;
varying vec3 colour;
varying vec2 load;
void main() {
  float d = length(at) * px;
  float edge = clamp(0.11 * px, 1.0, 3.0);
  float hole = px < 7.0 ? -9.0 : 0.42 * px;
  float shown = min(clamp(px - d + 0.5, 0.0, 1.0), clamp(d - hole + 0.5, 0.0, 1.0));
  if (shown < 0.02) discard;
  float turn = fract(atan(at.x, at.y) / 6.2831853);
  vec3 fill = px < 7.0 || turn < load.x ? colour : none;
  float inside = min(clamp(px - edge - d + 0.5, 0.0, 1.0), clamp(d - hole - edge + 0.5, 0.0, 1.0));
  vec3 border = load.y > 0.9 && d > 0.7 * px ? accent : rim;
  gl_FragColor = vec4(mix(border, fill, inside), shown * opacity);
}`;

export class Gauges {
  private readonly centres: InstancedBufferAttribute;
  private readonly tints: InstancedBufferAttribute;
  private readonly states: InstancedBufferAttribute; // share; 1 for the chosen joint, 0.5 under the pointer
  private readonly meshes: Mesh<InstancedBufferGeometry, ShaderMaterial>[];
  private readonly colours = {
    rim: { value: coloured(rim, new Color(), "") },
    none: { value: new Color() },
    accent: { value: new Color() },
    pixel: { value: 1 },
  };
  private theme: Theme = "light";

  constructor(
    private readonly kinematics: Kinematics,
    private readonly unit: number,
    scene: Scene,
  ) {
    const count = kinematics.pivots.length;
    const column = (n: number) =>
      new InstancedBufferAttribute(new Float32Array(n * count), n).setUsage(DynamicDrawUsage);
    const geometry = new InstancedBufferGeometry().copy(new PlaneGeometry(2, 2) as unknown as InstancedBufferGeometry);
    geometry.instanceCount = count;
    [this.centres, this.tints, this.states] = [column(3), column(3), column(2)];
    geometry.setAttribute("centre", this.centres);
    geometry.setAttribute("tint", this.tints);
    geometry.setAttribute("state", this.states);
    this.meshes = [this.mesh(geometry, GreaterDepth, 0.34), this.mesh(geometry, LessEqualDepth, 1)];
    this.meshes.forEach((mesh, n) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = 6 + n;
      mesh.visible = count > 0;
      scene.add(mesh);
    });
  }

  set(shares: readonly number[], selected: number, hovered: number): void {
    this.kinematics.pivots.forEach((p, j) => {
      this.centres.setXYZ(j, p.x, p.y, p.z);
      this.states.setXY(j, shares[j], j === selected ? 1 : j === hovered ? 0.5 : 0);
      const [r, g, b] = ringLoad(this.theme, shares[j]);
      this.tints.setXYZ(j, r / 255, g / 255, b / 255);
    });
    for (const one of [this.centres, this.tints, this.states]) one.needsUpdate = true;
  }

  paint(theme: Theme): void {
    this.theme = theme;
    coloured(ringLoad(theme, 0), this.colours.none.value, "");
    this.colours.accent.value.setHex(bodyColours[theme].accent, "");
  }

  set visible(on: boolean) {
    for (const mesh of this.meshes) mesh.visible = on && this.kinematics.pivots.length > 0;
  }

  /** Sets the size of a pixel at the distance 1 from the camera. */
  set pixel(size: number) {
    this.colours.pixel.value = size;
  }

  /** Radius of the ring of a joint at a distance from the camera, px. */
  reach(distance: number): number {
    return Math.min(Math.max((radius * this.unit) / (distance * this.colours.pixel.value), least), most);
  }

  private mesh(geometry: InstancedBufferGeometry, depthFunc: DepthModes, opacity: number) {
    const material = new ShaderMaterial({
      vertexShader: vertex,
      fragmentShader: fragment,
      uniforms: {
        ...this.colours,
        size: { value: radius * this.unit },
        ahead: { value: depth * this.unit },
        opacity: { value: opacity },
      },
      transparent: true,
      depthFunc,
      depthWrite: depthFunc === LessEqualDepth,
    });
    return new Mesh(geometry, material);
  }
}
