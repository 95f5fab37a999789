/** STOP and the menu on the wrist panel, for hands that have no buttons for them: pointed at, and pinched. */
import { type Object3D, Vector3 } from 'three';
import { tabWords } from '../../status/headset-menu-words.ts';
import { PANEL_ORDER } from '../../view/panel-order.ts';
import { TextPlate } from '../../view/text-plate.ts';

const WIDTH = 512;
const HEIGHT = 110;
const WIDTH_M = 0.18;
const GAP = 12;

export type TabPart = 'stop' | 'menu';

export class WristTab {
  readonly #plate = new TextPlate(
    { width: WIDTH, height: HEIGHT, pixelsPerMetre: WIDTH / WIDTH_M },
    PANEL_ORDER.wrist,
  );

  constructor() {
    const half = (WIDTH - GAP) / 2;
    this.#plate.draw(HEIGHT, (context) => {
      context.font = '700 46px system-ui, sans-serif';
      context.textAlign = 'center';
      context.textBaseline = 'middle';
      for (const [at, colour, text] of [
        [0, '#a3222a', tabWords.stop],
        [half + GAP, '#1b2833', tabWords.menu],
      ] as const) {
        context.fillStyle = colour;
        context.beginPath();
        context.roundRect(at, 0, half, HEIGHT, 20);
        context.fill();
        context.fillStyle = '#ffffff';
        context.fillText(text, at + half / 2, HEIGHT / 2 + 3);
      }
    });
    this.#plate.mesh.visible = false;
  }

  /** Its origin is in the middle of its upper edge. */
  get object(): Object3D {
    return this.#plate.mesh;
  }

  /** Middles of STOP and of the menu, in the world. */
  places(): Vector3[] {
    const { mesh } = this.#plate;
    mesh.updateWorldMatrix(true, false);
    return [-0.25, 0.25].map((share) => mesh.localToWorld(new Vector3(share * WIDTH_M, -0.5, 0)));
  }

  /** @param u of the hit, 0 at the left edge */
  partAt(u: number): TabPart {
    return u < 0.5 ? 'stop' : 'menu';
  }
}
