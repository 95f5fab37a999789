/** The line below a camera's picture in VR: its name, and its state unless it is live. */
import { CanvasTexture, LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import type { CameraView } from '../../ground/pictures/camera-view.ts';
import { cameraWords } from '../../words/camera-words.ts';

const WIDTH = 512;
const HEIGHT = 56;

export class SheetCaption {
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #view: CameraView;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;
  #shown = '';

  constructor(view: CameraView) {
    this.#view = view;
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: WIDTH, height: HEIGHT });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    this.mesh = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({ map: this.#texture }));
  }

  /**
   * Draws anew only what has changed: of a live camera, nothing. Call it a few times a second.
   *
   * @returns its height, metres
   */
  update(widthM: number): number {
    const { state, text, reason } = cameraWords(this.#view);
    const words = state === 'live' ? '' : ` · ${reason ?? text}`;
    const line = this.#view.camera.name + words;
    if (line !== this.#shown) this.#draw(line, words === '' ? '#9fb2c1' : '#f0b429');
    const tallM = (widthM * HEIGHT) / WIDTH;
    this.mesh.scale.set(widthM, tallM, 1);
    return tallM;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.#texture.dispose();
  }

  #draw(line: string, colour: string): void {
    this.#shown = line;
    const context = this.#context;
    context.fillStyle = '#0d141b';
    context.fillRect(0, 0, WIDTH, HEIGHT);
    context.font = '32px system-ui, sans-serif';
    context.textBaseline = 'middle';
    context.fillStyle = colour;
    context.fillText(line, 16, HEIGHT / 2, WIDTH - 32);
    this.#texture.needsUpdate = true;
  }
}
