/** The robot's map on the floor, dim, under the cloud. What is unknown is not drawn. */
import {
  DataTexture,
  DoubleSide,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  PlaneGeometry,
  RGBAFormat,
  SRGBColorSpace,
} from 'three';
import type { MapView } from '../../ground/navigation/navigation-view.ts';

/** Below the floor, so that the cloud of the floor hides it, metres. */
const DEPTH_M = 0.03;
/** Red, green, blue and opacity of each state; the unknown has the colour of its neighbours, so that edges stay clean. */
const COLOURS = [
  [96, 124, 146, 0], // unknown
  [96, 124, 146, 48], // free
  [186, 152, 96, 64], // between
  [202, 218, 230, 96], // occupied
] as const;

export class FloorMap {
  /** In the world's axes. */
  readonly object: Mesh<PlaneGeometry, MeshBasicMaterial>;
  #place: MapView['place'] | null = null;
  #changes = -1;
  #pixels = new Uint8Array();

  constructor() {
    // From the first cell's corner, which is the plane's origin.
    const geometry = new PlaneGeometry(1, 1).translate(0.5, 0.5, 0);
    const material = new MeshBasicMaterial({
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      forceSinglePass: true,
    });
    this.object = new Mesh(geometry, material);
    // Under everything else that is transparent.
    this.object.renderOrder = -1;
    this.object.visible = false;
  }

  /** What is drawn: number of cells that are not unknown; 0 while nothing is. */
  get shown(): number {
    if (!this.object.visible) return 0;
    let known = 0;
    for (let i = 3; i < this.#pixels.length; i += 4) if (this.#pixels[i] !== 0) known++;
    return known;
  }

  /** @param view `null`: nothing is shown @param ground height of the robot's ground, metres */
  show(view: MapView | null, ground: number): void {
    this.object.visible = view !== null;
    this.object.position.z = ground - DEPTH_M;
    if (view === null) return;
    const { place, cells, changes } = view;
    if (place !== this.#place) this.#begin(place);
    else if (changes === this.#changes) return;
    this.#changes = changes;
    paint(cells, this.#pixels);
    if (this.object.material.map !== null) this.object.material.map.needsUpdate = true;
  }

  #begin(place: MapView['place']): void {
    this.#place = place;
    const { width, height, cellM, origin } = place;
    this.#pixels = new Uint8Array(width * height * 4);
    const texture = new DataTexture(this.#pixels, width, height, RGBAFormat);
    texture.colorSpace = SRGBColorSpace;
    [texture.magFilter, texture.minFilter] = [NearestFilter, LinearFilter];
    const { material, scale, position, rotation } = this.object;
    // A material that has a texture for the first time is another program.
    material.needsUpdate = material.map === null;
    material.map?.dispose();
    material.map = texture;
    scale.set(width * cellM, height * cellM, 1);
    position.setX(origin.x).setY(origin.y);
    rotation.z = origin.yaw;
  }
}

function paint(cells: Uint8Array, pixels: Uint8Array): void {
  for (let i = 0; i < cells.length; i++) {
    const colour = COLOURS[cells[i] as 0 | 1 | 2 | 3];
    for (let part = 0; part < 4; part++) pixels[4 * i + part] = colour[part] as number;
  }
}
