/** A sheet with text in VR, drawn over the world. Only what has changed is drawn and uploaded anew. */
import { CanvasTexture, LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';

/**
 * After everything of the world, and after the red edge of the view (blocked-edge.ts); the later of two covers the other. Chosen:
 * what matters more is above.
 */
export const PLATE_ORDER = { wrist: 20, label: 24, menu: 30, mark: 31, notice: 40, pointer: 50 } as const;

export interface PlateSize {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  readonly pixelsPerMetre: number;
  readonly order: (typeof PLATE_ORDER)[keyof typeof PLATE_ORDER];
}

export class TextPlate {
  /** Its origin is in the middle of its upper edge. */
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #size: PlateSize;
  readonly #context: CanvasRenderingContext2D;
  readonly #texture: CanvasTexture;

  constructor(size: PlateSize) {
    const { width, height, pixelsPerMetre, order } = size;
    this.#size = size;
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width, height });
    this.#context = canvas.getContext('2d')!;
    this.#texture = new CanvasTexture(canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    this.mesh = new Mesh(
      new PlaneGeometry(width / pixelsPerMetre, 1).translate(0, -0.5, 0),
      // Transparent things are drawn last: a sheet that is opaque would be covered, whatever its order.
      new MeshBasicMaterial({ map: this.#texture, transparent: true, depthTest: false, depthWrite: false }),
    );
    this.mesh.renderOrder = order;
    this.#cut(height);
  }

  /** Width of a text in this font, pixels. */
  readonly measure = (text: string, font: string): number => {
    this.#context.font = font;
    return this.#context.measureText(text).width;
  };

  /**
   * Draws on the emptied sheet.
   *
   * @param height of what is drawn, pixels from the top: the rest is cut off
   * @param width likewise, from the left
   */
  draw(height: number, paint: (context: CanvasRenderingContext2D) => void, width = this.#size.width): void {
    const context = this.#context;
    context.clearRect(0, 0, this.#size.width, this.#size.height);
    paint(context);
    this.#cut(height, width);
    this.#texture.needsUpdate = true;
  }

  /** 0 … 1; at 0 it is not drawn at all. */
  set opacity(opacity: number) {
    this.mesh.visible = opacity > 0;
    this.mesh.material.opacity = opacity;
  }

  #cut(height: number, width = this.#size.width): void {
    const share = height / this.#size.height;
    this.#texture.repeat.x = width / this.#size.width;
    this.mesh.scale.x = width / this.#size.width;
    this.#texture.repeat.y = share;
    this.#texture.offset.y = 1 - share;
    this.mesh.scale.y = height / this.#size.pixelsPerMetre;
  }
}
