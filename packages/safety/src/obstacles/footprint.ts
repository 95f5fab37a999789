/** The robot's outline on the floor. */
export class FootprintError extends Error {
  override readonly name = 'FootprintError';
}

export interface Corner {
  /** Metres ahead of base_link. */
  x: number;
  /** Metres to the left of base_link. */
  y: number;
}

/** Points along the outline, grown by a margin, each with the direction that points outwards. */
export interface Outline {
  /** How far it is grown, metres. */
  margin: number;
  /** x, y, and the unit vector outwards, of each point. */
  points: Float64Array;
}

/** Where a point is, seen from the footprint. */
export interface Nearness {
  /** Distance from the outline, metres; negative inside. */
  distance: number;
  /** Unit vector away from the footprint. */
  x: number;
  y: number;
}

/** Of a round footprint: its corners stick out by 0.9 % of the radius. */
const DISC_CORNERS = 24;
const MOST_CORNERS = 64;
/** Of an edge: its beginning, its direction, its length. */
const EDGE_NUMBERS = 5;
/** What is farther from base_link is a mistake of the configuration, m. */
const LARGEST_M = 10;

/** A convex polygon around base_link. */
export class Footprint {
  /** Counter-clockwise. */
  readonly corners: readonly Corner[];
  /** Distance of the farthest corner from base_link, metres. */
  readonly reach: number;
  /** Distance of the nearest edge from base_link. */
  readonly #inner: number;
  readonly #edges: Float64Array;

  /** @throws {FootprintError} if the corners make no convex polygon around base_link */
  constructor(corners: readonly Corner[]) {
    if (corners.length < 3 || corners.length > MOST_CORNERS) {
      throw new FootprintError(`has ${corners.length} corners, not 3 to ${MOST_CORNERS}`);
    }
    if (!corners.every(({ x, y }) => Math.hypot(x, y) <= LARGEST_M)) {
      throw new FootprintError(`has a corner farther than ${LARGEST_M} m from base_link`);
    }
    const area = corners.reduce((sum, corner, i) => sum + cross(corner, at(corners, i + 1)), 0);
    this.corners = area < 0 ? [...corners].reverse() : [...corners];
    const turns = this.corners.map((corner, i) => {
      const [next, last] = [at(this.corners, i + 1), at(this.corners, i + 2)];
      return cross(minus(next, corner), minus(last, next));
    });
    if (!turns.every((turn) => turn > 1e-9)) {
      throw new FootprintError('is not convex, or has corners on a straight line');
    }
    if (!this.corners.every((corner, i) => cross(corner, at(this.corners, i + 1)) > 0)) {
      throw new FootprintError('must lie around base_link');
    }
    this.reach = Math.max(...corners.map(({ x, y }) => Math.hypot(x, y)));
    const edges = this.corners.map((a, i) => {
      const b = at(this.corners, i + 1);
      const length = Math.hypot(b.x - a.x, b.y - a.y);
      return [a.x, a.y, (b.x - a.x) / length, (b.y - a.y) / length, length] as const;
    });
    this.#edges = Float64Array.from(edges.flat());
    this.#inner = Math.min(...edges.map(([x, y, alongX, alongY]) => x * alongY - y * alongX));
  }

  /** A round robot, metres. */
  static disc(radius: number): Footprint {
    // Around the circle, not in it.
    const reach = radius / Math.cos(Math.PI / DISC_CORNERS);
    return new Footprint(
      Array.from({ length: DISC_CORNERS }, (_, i) => {
        const angle = (2 * Math.PI * i) / DISC_CORNERS;
        return { x: reach * Math.cos(angle), y: reach * Math.sin(angle) };
      }),
    );
  }

  /** Where (x, y) is from it. */
  nearness(x: number, y: number, into: Nearness): Nearness {
    const edges = this.#edges;
    let inside = Number.NEGATIVE_INFINITY;
    let outside = Number.POSITIVE_INFINITY;
    let away = 0;
    for (let e = 0; e < edges.length; e += EDGE_NUMBERS) {
      const dx = x - (edges[e] as number);
      const dy = y - (edges[e + 1] as number);
      const alongX = edges[e + 2] as number;
      const alongY = edges[e + 3] as number;
      // The normal of a counter-clockwise edge points to its right.
      const across = dx * alongY - dy * alongX;
      if (across > inside) {
        inside = across;
        away = e;
      }
      if (across <= 0) continue;
      const along = Math.min(edges[e + 4] as number, Math.max(0, dx * alongX + dy * alongY));
      const offX = dx - along * alongX;
      const offY = dy - along * alongY;
      const squared = offX * offX + offY * offY;
      if (squared >= outside) continue;
      outside = squared;
      into.x = offX;
      into.y = offY;
    }
    if (inside <= 0) {
      into.distance = inside;
      into.x = edges[away + 3] as number;
      into.y = -(edges[away + 2] as number);
      return into;
    }
    const distance = Math.sqrt(outside);
    into.distance = distance;
    into.x /= distance;
    into.y /= distance;
    return into;
  }

  /** Whether (x, y) is nearer than `distance` to it, or inside. */
  isWithin(x: number, y: number, distance: number, scratch: Nearness): boolean {
    const squared = x * x + y * y;
    // Most points are outside of a circle around it, or inside of one within it.
    if (squared >= (this.reach + distance) ** 2) return false;
    if (squared < (this.#inner + distance) ** 2) return true;
    return this.nearness(x, y, scratch).distance < distance;
  }

  /** @param spacing the greatest distance between neighbouring points, metres */
  outline(margin: number, spacing: number): Outline {
    const points: number[] = [];
    const { corners } = this;
    corners.forEach((corner, i) => {
      const [before, next] = [at(corners, i + corners.length - 1), at(corners, i + 1)];
      const from = outwards(before, corner);
      const to = outwards(corner, next);
      // Around the corner, then along the edge.
      const turn = Math.acos(Math.min(1, from.x * to.x + from.y * to.y));
      const start = Math.atan2(from.y, from.x);
      const arcs = Math.max(1, Math.ceil((turn * margin) / spacing));
      for (let k = 0; k < arcs; k++) {
        const angle = start + (turn * k) / arcs;
        const [nx, ny] = [Math.cos(angle), Math.sin(angle)];
        points.push(corner.x + margin * nx, corner.y + margin * ny, nx, ny);
      }
      const length = Math.hypot(next.x - corner.x, next.y - corner.y);
      const pieces = Math.max(1, Math.ceil(length / spacing));
      for (let k = 0; k < pieces; k++) {
        const share = k / pieces;
        const x = corner.x + (next.x - corner.x) * share + margin * to.x;
        const y = corner.y + (next.y - corner.y) * share + margin * to.y;
        points.push(x, y, to.x, to.y);
      }
    });
    return { margin, points: Float64Array.from(points) };
  }
}

function at(corners: readonly Corner[], i: number): Corner {
  return corners[i % corners.length] as Corner;
}

function minus(a: Corner, b: Corner): Corner {
  return { x: a.x - b.x, y: a.y - b.y };
}

function cross(a: Corner, b: Corner): number {
  return a.x * b.y - a.y * b.x;
}

/** The normal of an edge of a counter-clockwise polygon. */
function outwards(a: Corner, b: Corner): Corner {
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  return { x: (b.y - a.y) / length, y: (a.x - b.x) / length };
}
