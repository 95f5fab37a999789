/** A camera's picture on a flat sheet in VR. */
import { CanvasTexture, LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from 'three';
import type { CameraView } from '../../ground/pictures/camera-view.ts';

const STALE_COLOUR = 0x555555;
const FRESH_COLOUR = 0xffffff;

export class PictureSheet {
  readonly view: CameraView;
  /** Its width and height are the scale's x and y, in metres. */
  readonly mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
  readonly #texture: CanvasTexture;
  #width = 0;
  #height = 0;
  /** Number of the picture that is on the GPU. */
  #picture = 0;

  constructor(view: CameraView) {
    this.view = view;
    this.#texture = new CanvasTexture(view.canvas);
    this.#texture.colorSpace = SRGBColorSpace;
    // Mipmaps would cost more than the picture, with each frame.
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    this.mesh = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({ map: this.#texture }));
    this.mesh.visible = false;
  }

  /**
   * Marks a new picture for upload to the GPU: each once. Call it within an effect, in VR only.
   *
   * @param widthM wanted width
   * @returns the sheet's height in metres; 0 before the first picture
   */
  update(widthM: number): number {
    const { view, mesh } = this;
    const newest = view.newest.value;
    mesh.visible = newest !== null;
    if (newest === null) return 0;
    const { width, height } = view.canvas;
    if (width !== this.#width || height !== this.#height) {
      // A texture cannot change its size.
      this.#texture.dispose();
      this.#width = width;
      this.#height = height;
    }
    if (this.#picture !== newest.number) this.#texture.needsUpdate = true;
    this.#picture = newest.number;
    mesh.material.color.set(view.stale.value || view.fault.value !== null ? STALE_COLOUR : FRESH_COLOUR);
    const tallM = (widthM * height) / width;
    mesh.scale.set(widthM, tallM, 1);
    return tallM;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.#texture.dispose();
  }
}
