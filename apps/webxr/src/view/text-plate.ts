/** A sheet with text in VR, drawn over the world. Only what has changed is drawn and uploaded anew. */
import { CanvasTexture, LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import { drawOverWorld, type PanelOrder } from './panel-order.ts';

export interface PlateSize {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  readonly pixelsPerMetre: number;
}

export class TextPlate {
  /** Its origin is in the middle of its upper edge. */
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #size: PlateSize;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;

  constructor(size: PlateSize, order: PanelOrder) {
    const { width, height, pixelsPerMetre } = size;
    this.#size = size;
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width, height });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    const plane = new PlaneGeometry(width / pixelsPerMetre, 1).translate(0, -0.5, 0);
    this.mesh = new Mesh(plane, new MeshBasicMaterial({ map: this.#texture }));
    drawOverWorld(this.mesh, order);
    this.#cut(height);
  }

  /** Width of a text in this font, pixels. */
  readonly measure = (text: string, font: string): number => {
    this.#context.font = font;
    return this.#context.measureText(text).width;
  };

  /** Draws on the emptied sheet. @param height of what is drawn, pixels from the top: the rest is cut off */
  draw(height: number, paint: (context: CanvasRenderingContext2D) => void): void {
    const context = this.#context;
    context.clearRect(0, 0, this.#size.width, this.#size.height);
    paint(context);
    this.#cut(height);
    this.#texture.needsUpdate = true;
  }

  /** 0 … 1; at 0 it is not drawn at all. */
  set opacity(opacity: number) {
    this.mesh.visible = opacity > 0;
    this.mesh.material.opacity = opacity;
  }

  #cut(height: number): void {
    const share = Math.min(height / this.#size.height, 1);
    this.#texture.repeat.y = share;
    this.#texture.offset.y = 1 - share;
    this.mesh.scale.y = (share * this.#size.height) / this.#size.pixelsPerMetre;
  }
}
