/**
 * What is near the robot, on the floor around it: a bar where something is, with a curtain over it that can be seen
 * although the floor there is out of view; and hatching where no sensor sees.
 */
import { NEAR_SECTORS, type NearSector, type RobotBody } from '@farpoint/protocol';
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  ShaderMaterial,
} from 'three';
import { radiusAt } from '../near-field/around-footprint.ts';
import type { NearView } from '../near-field/near-view.ts';
import { NEAR_M, VERY_NEAR_M } from '../status/near-words.ts';

/** Above the floor, over the way of the present command, metres. */
const HEIGHT_M = 0.035;
/** How wide a bar is, metres. */
const BAR_M = 0.08;
/** How high a curtain is, and before what: how high a thing really is, nobody has said, so it fades upwards. Metres. */
const CURTAIN_M = 1;
const CURTAIN_WITHIN_M = 1.2;
const CORNERS = 4;

export const NEAR_COLOURS = {
  veryNear: '#e5484d',
  near: '#f2b134',
  far: '#7f9db0',
  drop: '#b57bff',
  stale: '#6b7680',
  unseen: '#8fa3b3',
} as const;

/** How a sector's hit is coloured. */
export function hitColour({ kind, metres }: NonNullable<NearSector['hit']>, stale: boolean): string {
  if (stale) return NEAR_COLOURS.stale;
  if (kind === 'drop') return NEAR_COLOURS.drop;
  if (metres < VERY_NEAR_M) return NEAR_COLOURS.veryNear;
  return metres < NEAR_M ? NEAR_COLOURS.near : NEAR_COLOURS.far;
}

/** A quadrangle for each sector; unused ones have no area. */
class Quads {
  readonly geometry = new BufferGeometry();
  readonly #positions = new Float32Array(NEAR_SECTORS * CORNERS * 3);
  readonly #colours: Float32Array;
  readonly #channels: 3 | 4;

  constructor(channels: 3 | 4) {
    this.#channels = channels;
    this.#colours = new Float32Array(NEAR_SECTORS * CORNERS * channels);
    this.geometry.setAttribute('position', new BufferAttribute(this.#positions, 3));
    this.geometry.setAttribute('color', new BufferAttribute(this.#colours, channels));
    this.geometry.setIndex(
      Array.from({ length: NEAR_SECTORS }, (_, i) => CORNERS * i).flatMap((at) => [
        ...[at, at + 1, at + 2],
        ...[at + 1, at + 3, at + 2],
      ]),
    );
  }

  clear(): void {
    this.#positions.fill(0);
  }

  /** Sets a corner of a sector's quadrangle: 0 and 1 at its nearer or lower edge, 2 and 3 at the other. */
  corner(sector: number, corner: number, x: number, y: number, z: number, colour: Color, alpha = 1): void {
    const at = sector * CORNERS + corner;
    this.#positions[3 * at] = x;
    this.#positions[3 * at + 1] = y;
    this.#positions[3 * at + 2] = z;
    const c = this.#channels * at;
    this.#colours[c] = colour.r;
    this.#colours[c + 1] = colour.g;
    this.#colours[c + 2] = colour.b;
    if (this.#channels === 4) this.#colours[c + 3] = alpha;
  }

  upload(): void {
    for (const attribute of Object.values(this.geometry.attributes))
      (attribute as BufferAttribute).needsUpdate = true;
  }
}

export class NearRing {
  /** In base_link's axes. */
  readonly object = new Group();
  readonly #bars = new Quads(3);
  readonly #curtain = new Quads(4);
  readonly #hatch = new Quads(3);
  readonly #materials: readonly (MeshBasicMaterial | ShaderMaterial)[];
  readonly #hatching: ShaderMaterial;
  readonly #barMaterial: MeshBasicMaterial;
  readonly #colour = new Color();
  #outline: RobotBody['footprint'] | null = null;
  #view: NearView | null = null;

  constructor() {
    const flat = {
      ...{ vertexColors: true, transparent: true, depthWrite: false },
      // Otherwise three draws the two sides one after the other, and looks their program up anew each time.
      ...{ side: DoubleSide, forceSinglePass: true },
    } as const;
    this.#barMaterial = new MeshBasicMaterial({ ...flat, opacity: 0.9 });
    const curtain = new MeshBasicMaterial(flat);
    this.#hatching = hatching();
    this.#materials = [this.#barMaterial, curtain, this.#hatching];
    const parts = [
      new Mesh(this.#hatch.geometry, this.#hatching),
      new Mesh(this.#bars.geometry, this.#barMaterial),
      new Mesh(this.#curtain.geometry, curtain),
    ];
    for (const part of parts) part.frustumCulled = false;
    this.object.add(...parts);
    this.object.visible = false;
  }

  /** Whether nearer points do not hide it. */
  set onTop(onTop: boolean) {
    for (const material of this.#materials) material.depthTest = !onTop;
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
    for (const quads of [this.#bars, this.#curtain, this.#hatch]) quads.clear();
    for (const [i, sector] of view.sectors.entries()) {
      const { hit } = sector;
      if (hit !== null) this.#drawHit(i, hit, outline, view.stale);
      const stretch = hatchedStretch(sector);
      if (stretch === null) continue;
      this.#colour.set(NEAR_COLOURS.unseen);
      const [from, to] = [stretch.fromM, stretch.toM].map((metres) => this.#radius(outline, i, metres));
      this.#strip(this.#hatch, i, from as number, to as number);
    }
    for (const quads of [this.#bars, this.#curtain, this.#hatch]) quads.upload();
    this.#barMaterial.opacity = view.stale ? 0.4 : 0.9;
    this.#hatching.uniforms.opacity!.value = view.stale ? 0.2 : 0.45;
  }

  #drawHit(
    i: number,
    hit: NonNullable<NearSector['hit']>,
    outline: RobotBody['footprint'],
    stale: boolean,
  ): void {
    this.#colour.set(hitColour(hit, stale));
    const radius = this.#radius(outline, i, hit.metres);
    this.#strip(this.#bars, i, radius, radius + BAR_M);
    if (hit.metres > CURTAIN_WITHIN_M) return;
    const strength = stale ? 0.25 : 0.6;
    for (const [corner, side] of [-0.5, 0.5, -0.5, 0.5].entries()) {
      const bearing = bearingOf(i + side);
      const isTop = corner > 1;
      const [x, y] = [radius * Math.cos(bearing), radius * Math.sin(bearing)];
      const z = isTop ? CURTAIN_M : HEIGHT_M;
      this.#curtain.corner(i, corner, x, y, z, this.#colour, isTop ? 0.1 * strength : strength);
    }
  }

  #radius(outline: RobotBody['footprint'], sector: number, metres: number): number {
    return radiusAt(outline, bearingOf(sector), metres);
  }

  #strip(quads: Quads, sector: number, from: number, to: number): void {
    for (const [corner, side] of [-0.5, 0.5, -0.5, 0.5].entries()) {
      const bearing = bearingOf(sector + side);
      const radius = corner > 1 ? to : from;
      const [x, y] = [radius * Math.cos(bearing), radius * Math.sin(bearing)];
      quads.corner(sector, corner, x, y, HEIGHT_M, this.#colour);
    }
  }
}

/** Where a sector is hatched, metres from the robot's edge; `null` if nowhere: what a thing hides is behind it. */
export function hatchedStretch({ hit, unseen }: NearSector): NearSector['unseen'] {
  if (unseen === null || (hit !== null && hit.metres <= unseen.fromM)) return null;
  return { fromM: unseen.fromM, toM: Math.min(unseen.toM, hit?.metres ?? unseen.toM) };
}

function bearingOf(sector: number): number {
  return (sector * 2 * Math.PI) / NEAR_SECTORS;
}

/** Diagonal stripes in the robot's axes. */
function hatching(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { opacity: { value: 0.45 } },
    vertexColors: true,
    transparent: true,
    side: DoubleSide,
    depthWrite: false,
    vertexShader: `
      varying vec3 vColour;
      varying float vAlong;
      void main() {
        vColour = color;
        vAlong = position.x + position.y;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform float opacity;
      varying vec3 vColour;
      varying float vAlong;
      void main() {
        if (fract(vAlong / 0.14) > 0.36) discard;
        gl_FragColor = vec4(vColour, opacity);
        #include <colorspace_fragment>
      }`,
  });
}
