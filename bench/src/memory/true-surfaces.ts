/** Distances from the surfaces of a simulated world, without its people. */
import type { Box, Ellipsoid, Panel, WorldDescription } from '@farpoint/sim';

/** A box about its own centre, and what turns the world into its axes. */
interface Solid {
  x: number;
  y: number;
  z: number;
  cos: number;
  sin: number;
  /** Half lengths, metres. */
  half: readonly [number, number, number];
}

export class TrueSurfaces {
  readonly #solids: readonly Solid[];
  readonly #ellipsoids: readonly Ellipsoid[];

  constructor({ boxes, panels, ellipsoids }: WorldDescription) {
    this.#solids = [...boxes.map(ofBox), ...panels.map(ofPanel)];
    this.#ellipsoids = ellipsoids;
  }

  /** Metres from the nearest surface. */
  distance(x: number, y: number, z: number): number {
    let least = Number.POSITIVE_INFINITY;
    for (const solid of this.#solids) least = Math.min(least, distanceTo(solid, x, y, z));
    for (const { centre, size } of this.#ellipsoids) {
      const unit = Math.hypot(
        ((x - centre.x) * 2) / size.x,
        ((y - centre.y) * 2) / size.y,
        ((z - centre.z) * 2) / size.z,
      );
      // Along the ray from the centre: never less than the true distance.
      const fromCentre = Math.hypot(x - centre.x, y - centre.y, z - centre.z);
      least = Math.min(
        least,
        unit === 0 ? Math.min(size.x, size.y, size.z) / 2 : Math.abs(1 - 1 / unit) * fromCentre,
      );
    }
    return least;
  }
}

function ofBox({ centre, size, yaw = 0 }: Box): Solid {
  return {
    ...centre,
    cos: Math.cos(yaw),
    sin: Math.sin(yaw),
    half: [size.x / 2, size.y / 2, size.z / 2],
  };
}

function ofPanel({ centre, width, height, yaw, level }: Panel): Solid {
  return {
    ...centre,
    cos: Math.cos(yaw),
    sin: Math.sin(yaw),
    half: level === undefined ? [0, width / 2, height / 2] : [height / 2, width / 2, 0],
  };
}

function distanceTo({ half, ...solid }: Solid, x: number, y: number, z: number): number {
  const [dx, dy] = [x - solid.x, y - solid.y];
  const out = [
    Math.abs(dx * solid.cos + dy * solid.sin) - half[0],
    Math.abs(dy * solid.cos - dx * solid.sin) - half[1],
    Math.abs(z - solid.z) - half[2],
  ] as const;
  const inside = Math.max(...out);
  // Inside, the nearest face; outside, the nearest place on the box.
  return inside <= 0 ? -inside : Math.hypot(...out.map((each) => Math.max(each, 0)));
}
