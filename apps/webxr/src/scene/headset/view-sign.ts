/** Says before the operator's eyes, for a moment, which view has begun. */
import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import { fitText } from '../fitted-text.ts';

/** The picture's size, pixels, and its width, m. Chosen by eye. */
const WIDTH = 640;
const HEIGHT = 144;
const WIDTH_M = 0.5;
/** How long the sign is before the eyes, ms. Chosen: three words are read, and the way is free again. */
const SHOWN_MS = 2500;

export class ViewSign {
  /** A child of the camera. */
  readonly object: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;
  #untilMs = 0;

  constructor() {
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: WIDTH, height: HEIGHT });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.object = new Mesh(
      new PlaneGeometry(WIDTH_M, (WIDTH_M * HEIGHT) / WIDTH),
      new MeshBasicMaterial({ map: this.#texture, transparent: true, depthTest: false, opacity: 0.9 }),
    );
    this.object.position.set(0, -0.14, -1);
    this.object.renderOrder = 2;
    this.object.visible = false;
  }

  /** @param nowMs `performance.now()` */
  say(title: string, hint: string, nowMs: number): void {
    const context = this.#context;
    context.clearRect(0, 0, WIDTH, HEIGHT);
    context.fillStyle = '#0d141bee';
    context.beginPath();
    context.roundRect(0, 0, WIDTH, HEIGHT, 24);
    context.fill();
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    this.#line(title, 600, 44, '#e6edf3', 48);
    this.#line(hint, 400, 30, '#9fb2c1', 104);
    this.#texture.needsUpdate = true;
    this.#untilMs = nowMs + SHOWN_MS;
    this.object.visible = true;
  }

  /** Call this before each display frame in VR. */
  update(nowMs: number): void {
    if (this.object.visible && nowMs >= this.#untilMs) this.object.visible = false;
  }

  #line(text: string, weight: number, largest: number, colour: string, y: number): void {
    const context = this.#context;
    const measure = (words: string, size: number) => {
      context.font = `${weight} ${size}px system-ui, sans-serif`;
      return context.measureText(words).width;
    };
    const { rows, size } = fitText(text, largest, WIDTH - 48, measure);
    measure('', size);
    context.fillStyle = colour;
    for (const [row, words] of rows.entries())
      context.fillText(words, WIDTH / 2, y + (row - (rows.length - 1) / 2) * size);
  }
}
