/** Draws a scene into memory: the colours, and how far along the line of sight each pixel lies. */
import {
  DepthTexture,
  FloatType,
  GLSL3,
  Mesh,
  OrthographicCamera,
  type PerspectiveCamera,
  PlaneGeometry,
  RawShaderMaterial,
  RGBAFormat,
  Scene,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';

export interface DrawnPicture {
  /** R, G, B, 255 of each pixel, from the upper left. */
  colour: Uint8Array;
  /** Depth along z, metres; 0 where nothing is drawn. */
  depth: Float32Array;
  /** Time of drawing, until the GPU has finished. */
  drawMs: number;
}

const vertexShader = `in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const fragmentShader = `precision highp float;
precision highp sampler2D;
uniform sampler2D depthMap;
uniform vec2 range;
out vec4 metres;
void main() {
  float depth = texelFetch(depthMap, ivec2(gl_FragCoord.xy), 0).r;
  float ndc = 2.0 * depth - 1.0;
  float z = 2.0 * range.x * range.y / (range.y + range.x - ndc * (range.y - range.x));
  metres = vec4(depth < 1.0 ? z : 0.0, 0.0, 0.0, 1.0);
}`;

export class PictureDrawer {
  readonly #renderer: WebGLRenderer;
  readonly #size: number;
  readonly #target: WebGLRenderTarget;
  readonly #metres: WebGLRenderTarget;
  readonly #quad: Mesh<PlaneGeometry, RawShaderMaterial>;
  readonly #quadScene = new Scene();
  readonly #quadCamera = new OrthographicCamera();

  /** @param size of the square picture, pixels */
  constructor(renderer: WebGLRenderer, size: number) {
    this.#renderer = renderer;
    this.#size = size;
    const depthTexture = new DepthTexture(size, size, FloatType);
    this.#target = new WebGLRenderTarget(size, size, { depthTexture });
    this.#metres = new WebGLRenderTarget(size, size, { type: FloatType, format: RGBAFormat });
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      depthTest: false,
      depthWrite: false,
      uniforms: { depthMap: { value: depthTexture }, range: { value: [0, 0] } },
    });
    this.#quad = new Mesh(new PlaneGeometry(2, 2), material);
    this.#quad.frustumCulled = false;
    this.#quadScene.add(this.#quad);
  }

  draw(scene: Scene, camera: PerspectiveCamera): DrawnPicture {
    const [renderer, size] = [this.#renderer, this.#size];
    const rgba = new Uint8Array(size * size * 4);
    const beganMs = performance.now();
    renderer.setRenderTarget(this.#target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(this.#target, 0, 0, size, size, rgba);
    const drawMs = performance.now() - beganMs;
    this.#quad.material.uniforms.range!.value = [camera.near, camera.far];
    renderer.setRenderTarget(this.#metres);
    renderer.render(this.#quadScene, this.#quadCamera);
    const metres = new Float32Array(size * size * 4);
    renderer.readRenderTargetPixels(this.#metres, 0, 0, size, size, metres);
    renderer.setRenderTarget(null);
    const colour = new Uint8Array(rgba.length);
    const depth = new Float32Array(size * size);
    // WebGL counts rows from the bottom.
    for (let y = 0; y < size; y++) {
      const from = (size - 1 - y) * size;
      colour.set(rgba.subarray(from * 4, (from + size) * 4), y * size * 4);
      for (let x = 0; x < size; x++) depth[y * size + x] = metres[(from + x) * 4] as number;
    }
    return { colour, depth, drawMs };
  }
}
