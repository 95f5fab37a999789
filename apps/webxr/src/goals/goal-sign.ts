/** Says in the headset, above the place, what becomes of a goal. */
import { CanvasTexture, Sprite, SpriteMaterial, SRGBColorSpace } from 'three';
import type { Words } from '../status/tone.ts';
import { fitText } from '../view/fitted-text.ts';

const WIDTH = 640;
const HEIGHT = 112;
/** Of the view's height at any distance. */
const SHARE = 0.42;
/** Above the floor, over the marker's pole, m. */
const HEIGHT_M = 0.85;
const COLOURS: Readonly<Record<Words['tone'], string>> = {
  ...{ neutral: '#e6edf3', good: '#5fe0cc', warning: '#f2b134', bad: '#ff8a8e' },
};

export class GoalSign {
  /** In the world's axes. */
  readonly object: Sprite;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;
  #said = '';

  constructor() {
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: WIDTH, height: HEIGHT });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    const material = { map: this.#texture, transparent: true, depthTest: false, sizeAttenuation: false };
    this.object = new Sprite(new SpriteMaterial(material));
    this.object.scale.set(SHARE, (SHARE * HEIGHT) / WIDTH, 1);
    this.object.renderOrder = 11;
    this.object.visible = false;
  }

  /** What it says; empty while it says nothing. */
  get said(): string {
    return this.object.visible ? this.#said : '';
  }

  hide(): void {
    this.object.visible = false;
  }

  /** @param ground height of the robot's ground, m */
  show({ x, y }: { x: number; y: number }, { text, tone }: Words, ground: number): void {
    this.object.visible = true;
    this.object.position.set(x, y, ground + HEIGHT_M);
    if (text === this.#said) return;
    this.#said = text;
    const context = this.#context;
    context.clearRect(0, 0, WIDTH, HEIGHT);
    context.fillStyle = '#0d141bee';
    context.beginPath();
    context.roundRect(0, 0, WIDTH, HEIGHT, 24);
    context.fill();
    const measure = (words: string, size: number) => {
      context.font = `600 ${size}px system-ui, sans-serif`;
      return context.measureText(words).width;
    };
    const { rows, size } = fitText(text, 44, WIDTH - 48, measure);
    measure('', size);
    Object.assign(context, { textAlign: 'center', textBaseline: 'middle', fillStyle: COLOURS[tone] });
    for (const [row, words] of rows.entries())
      context.fillText(words, WIDTH / 2, HEIGHT / 2 + (row - (rows.length - 1) / 2) * size);
    this.#texture.needsUpdate = true;
  }
}
