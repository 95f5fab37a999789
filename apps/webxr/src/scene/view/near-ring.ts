/**
 * What is near the robot, on the floor around it: a bar where something is, with a curtain over it that can be seen
 * although the floor there is out of view; and hatching where no sensor sees.
 */
import { NEAR_SECTORS, type NearSector, type RobotBody } from '@farpoint/protocol';
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, ShaderMaterial } from 'three';
import { radiusAt } from '../../ground/near-field/around-footprint.ts';
import type { NearView } from '../../ground/near-field/near-view.ts';
import { NEAR_M, VERY_NEAR_M } from '../../words/near-words.ts';

/** Above the floor, over the way of the present command, metres. */
const HEIGHT_M = 0.035;
/** How wide a bar is, metres. */
const BAR_M = 0.08;
/**
 * How high a curtain is, and before what: how high a thing really is, nobody has said, so it fades upwards.
 * Metres. Chosen by eye: within 1.2 m the floor is out of view (docs/awareness.md).
 */
const CURTAIN_M = 1;
const CURTAIN_WITHIN_M = 1.2;
const CORNERS = 4;

/** Colours of what is near. */
export type NearColours = Readonly<Record<'veryNear' | 'near' | 'far' | 'drop' | 'stale' | 'unseen', string>>;

/** On the floor of the scene, which is dark in all themes. */
export const NEAR_COLOURS: NearColours = {
  veryNear: '#e5484d',
  near: '#f2b134',
  far: '#7f9db0',
  drop: '#b57bff',
  stale: '#6b7680',
  unseen: '#8fa3b3',
};

/** How a sector's hit is coloured. */
export function hitColour(
  { kind, metres }: NonNullable<NearSector['hit']>,
  stale: boolean,
  colours: NearColours = NEAR_COLOURS,
): string {
  if (stale) return colours.stale;
  if (kind === 'drop') return colours.drop;
  if (metres < VERY_NEAR_M) return colours.veryNear;
  return metres < NEAR_M ? colours.near : colours.far;
}

/** Hatching, a bar and a curtain in each sector at most. */
const MOST_QUADS = 3 * NEAR_SECTORS;
const INDICES = 6;

/** Quadrangles in the order in which they are drawn, in one geometry: each object more is time that a software renderer takes. */
class Quads {
  readonly geometry = new BufferGeometry();
  readonly #positions = attributeOf(3);
  readonly #colours = attributeOf(4);
  readonly #striped = attributeOf(1);
  #count = 0;

  constructor() {
    this.geometry.setAttribute('position', this.#positions);
    this.geometry.setAttribute('color', this.#colours);
    this.geometry.setAttribute('striped', this.#striped);
    this.geometry.setIndex(
      Array.from({ length: MOST_QUADS }, (_, i) => CORNERS * i).flatMap((at) => [
        at,
        at + 1,
        at + 2,
        at + 1,
        at + 3,
        at + 2,
      ]),
    );
  }

  clear(): void {
    this.#count = 0;
  }

  /** Begins the next quadrangle. @param striped whether it is hatched */
  next(striped: boolean): void {
    this.#striped.array.fill(Number(striped), this.#count * CORNERS, (this.#count + 1) * CORNERS);
    this.#count++;
  }

  /** Sets a corner of the newest quadrangle: 0 and 1 at its nearer or lower edge, 2 and 3 at the other. */
  corner(corner: number, x: number, y: number, z: number, { r, g, b }: Color, alpha: number): void {
    const at = (this.#count - 1) * CORNERS + corner;
    this.#positions.setXYZ(at, x, y, z);
    this.#colours.setXYZW(at, r, g, b, alpha);
  }

  get count(): number {
    return this.#count;
  }

  upload(): void {
    this.geometry.setDrawRange(0, this.#count * INDICES);
    for (const attribute of [this.#positions, this.#colours, this.#striped]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, this.#count * CORNERS * attribute.itemSize);
      attribute.needsUpdate = this.#count > 0;
    }
  }
}

function attributeOf(itemSize: number): BufferAttribute {
  return new BufferAttribute(new Float32Array(MOST_QUADS * CORNERS * itemSize), itemSize);
}

export class NearRing {
  /** In base_link's axes. */
  readonly object = new Group();
  readonly #quads = new Quads();
  readonly #material = ringMaterial();
  readonly #mesh = new Mesh(this.#quads.geometry, this.#material);
  readonly #colour = new Color();
  #outline: RobotBody['footprint'] | null = null;
  #view: NearView | null = null;

  constructor() {
    this.#mesh.frustumCulled = false;
    this.object.add(this.#mesh);
    this.object.visible = false;
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    this.#material.depthTest = !onTop;
  }

  /** The robot's outline; `null` while it is not known: then nothing is shown. */
  set body(body: RobotBody | null) {
    const outline = body?.footprint ?? null;
    if (outline === this.#outline) return;
    this.#outline = outline;
    this.#draw();
  }

  /** Shows what is near; `null` for nothing. */
  show(view: NearView | null): void {
    const before = this.#view;
    this.#view = view;
    // Its age alone changes nothing.
    if (view?.sectors === before?.sectors && view?.stale === before?.stale) return;
    this.#draw();
  }

  /** What is drawn: bars, and sectors that are hatched. */
  get shown(): { bars: number; hatched: number; stale: boolean } | null {
    const view = this.#view;
    if (view === null || !this.object.visible) return null;
    const { sectors, stale } = view;
    return {
      bars: sectors.filter(({ hit }) => hit !== null).length,
      hatched: sectors.filter((sector) => hatchedStretch(sector) !== null).length,
      stale,
    };
  }

  #draw(): void {
    const [view, outline] = [this.#view, this.#outline];
    this.object.visible = view !== null && outline !== null;
    if (view === null || outline === null) return;
    const quads = this.#quads;
    quads.clear();
    // Hatching lies below bars, and curtains are before both.
    this.#colour.set(NEAR_COLOURS.unseen);
    for (const [i, sector] of view.sectors.entries()) {
      const stretch = hatchedStretch(sector);
      if (stretch === null) continue;
      quads.next(true);
      const [from, to] = [stretch.fromM, stretch.toM].map((metres) => radiusOf(outline, i, metres));
      this.#strip(i, from as number, to as number, view.stale ? 0.2 : 0.45);
    }
    for (const [i, { hit }] of view.sectors.entries()) {
      if (hit === null) continue;
      this.#colour.set(hitColour(hit, view.stale));
      const radius = radiusOf(outline, i, hit.metres);
      quads.next(false);
      this.#strip(i, radius, radius + BAR_M, view.stale ? 0.4 : 0.9);
    }
    for (const [i, { hit }] of view.sectors.entries()) {
      if (hit === null || hit.metres > CURTAIN_WITHIN_M) continue;
      this.#colour.set(hitColour(hit, view.stale));
      quads.next(false);
      this.#curtain(i, radiusOf(outline, i, hit.metres), view.stale ? 0.25 : 0.6);
    }
    quads.upload();
    this.#mesh.visible = quads.count > 0;
  }

  #curtain(i: number, radius: number, strength: number): void {
    for (const [corner, side] of SIDES.entries()) {
      const bearing = bearingOf(i + side);
      const isTop = corner > 1;
      const [x, y] = [radius * Math.cos(bearing), radius * Math.sin(bearing)];
      const z = isTop ? CURTAIN_M : HEIGHT_M;
      this.#quads.corner(corner, x, y, z, this.#colour, isTop ? 0.1 * strength : strength);
    }
  }

  #strip(sector: number, from: number, to: number, alpha: number): void {
    for (const [corner, side] of SIDES.entries()) {
      const bearing = bearingOf(sector + side);
      const radius = corner > 1 ? to : from;
      const [x, y] = [radius * Math.cos(bearing), radius * Math.sin(bearing)];
      this.#quads.corner(corner, x, y, HEIGHT_M, this.#colour, alpha);
    }
  }
}

/** Of a quadrangle's corners: to which side of its sector's middle they are, in sectors. */
const SIDES = [-0.5, 0.5, -0.5, 0.5] as const;

function radiusOf(outline: RobotBody['footprint'], sector: number, metres: number): number {
  return radiusAt(outline, bearingOf(sector), metres);
}

/** Where a sector is hatched, metres from the robot's edge; `null` if nowhere: what a thing hides is behind it. */
export function hatchedStretch({ hit, unseen }: NearSector): NearSector['unseen'] {
  if (unseen === null || (hit !== null && hit.metres <= unseen.fromM)) return null;
  return { fromM: unseen.fromM, toM: Math.min(unseen.toM, hit?.metres ?? unseen.toM) };
}

function bearingOf(sector: number): number {
  return (sector * 2 * Math.PI) / NEAR_SECTORS;
}

/** Colours as they are, with diagonal stripes in the robot's axes where it is striped. */
function ringMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    // Otherwise three draws the two sides one after the other, and looks their program up anew each time.
    side: DoubleSide,
    forceSinglePass: true,
    vertexShader: `
      attribute float striped;
      varying vec4 vColour;
      varying float vStriped;
      varying float vAlong;
      void main() {
        vColour = color;
        vStriped = striped;
        vAlong = position.x + position.y;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      varying vec4 vColour;
      varying float vStriped;
      varying float vAlong;
      void main() {
        if (vStriped > 0.5 && fract(vAlong / 0.14) > 0.36) discard;
        gl_FragColor = vColour;
        #include <colorspace_fragment>
      }`,
  });
}
