/** Darkens the edge of the view in the headset. Panels that the operator reads are drawn over it. */
import { BackSide, Mesh, ShaderMaterial, SphereGeometry } from 'three';

/** Far away, so that both eyes see it at the same place; within what the headset draws, m. */
const RADIUS_M = 10;

const vertexShader = /* glsl */ `
varying vec3 direction;
void main() {
  direction = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform float amount;
varying vec3 direction;
void main() {
  float angle = degrees(acos(clamp(-normalize(direction).z, -1.0, 1.0)));
  // From a headset's field of view down to a tunnel of 40 degrees.
  float inner = mix(60.0, 20.0, amount);
  gl_FragColor = vec4(0.0, 0.0, 0.0, smoothstep(inner, inner + 12.0, angle));
}
`;

export class Vignette {
  /** A child of the camera. */
  readonly object: Mesh<SphereGeometry, ShaderMaterial>;
  readonly #amount = { value: 0 };

  constructor() {
    const material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: { amount: this.#amount },
      side: BackSide,
      transparent: true,
      depthTest: false,
      depthWrite: false,
    });
    this.object = new Mesh(new SphereGeometry(RADIUS_M, 32, 24), material);
    // After the cloud, before what else is transparent.
    this.object.renderOrder = -1;
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /** @param amount 0 (nothing is drawn) … 1 */
  show(amount: number): void {
    this.object.visible = amount > 0;
    this.#amount.value = amount;
  }
}
