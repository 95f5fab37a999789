/** The near field as a small picture seen from above, the robot's heading up. */
import { NEAR_SECTORS, type RobotBody } from '@farpoint/protocol';
import { radiusAt, reachOf } from '../../ground/near-field/around-footprint.ts';
import type { NearView } from '../../ground/near-field/near-view.ts';
import { hatchedStretch, hitColour, NEAR_COLOURS } from '../../scene/view/near-ring.ts';

/** What is farther from the robot's edge is not drawn, metres. */
const SHOWN_M = 1.5;
/** Circles for the eye, metres from the robot's edge. */
const MARKS_M = [0.5, 1];
const SECTOR = (2 * Math.PI) / NEAR_SECTORS;

/** Draws the view; without one, only the robot. */
export function drawNear(canvas: HTMLCanvasElement, body: RobotBody, view: NearView | null): void {
  const context = canvas.getContext('2d');
  if (context === null) return;
  const { footprint } = body;
  const reach = reachOf(footprint);
  const middle = canvas.width / 2;
  const perMetre = (middle - 2) / (reach + SHOWN_M);
  const lineWidth = canvas.width / 48;
  context.clearRect(0, 0, canvas.width, canvas.height);
  /** Follows the outline at a distance, over some sectors. */
  const trace = (metres: number, from: number, to: number) => {
    for (let i = from; i <= to; i += 0.5) {
      const radius = radiusAt(footprint, i * SECTOR, metres) * perMetre;
      context.lineTo(middle - radius * Math.sin(i * SECTOR), middle - radius * Math.cos(i * SECTOR));
    }
  };
  context.strokeStyle = '#24303b';
  context.lineWidth = 1;
  for (const metres of [...MARKS_M, SHOWN_M]) {
    context.beginPath();
    trace(metres, 0, NEAR_SECTORS);
    context.stroke();
  }
  if (view !== null) {
    const hatch = hatching(context, canvas.width, view.stale);
    for (const [i, sector] of view.sectors.entries()) {
      const stretch = hatchedStretch(sector);
      if (stretch === null || stretch.fromM >= SHOWN_M) continue;
      const to = Math.min(SHOWN_M, stretch.toM);
      context.beginPath();
      trace(stretch.fromM, i - 0.5, i + 0.5);
      // Back at the other distance.
      for (const side of [0.5, -0.5]) {
        const radius = radiusAt(footprint, (i + side) * SECTOR, to) * perMetre;
        const bearing = (i + side) * SECTOR;
        context.lineTo(middle - radius * Math.sin(bearing), middle - radius * Math.cos(bearing));
      }
      context.fillStyle = hatch;
      context.fill();
    }
    context.lineWidth = 3 * lineWidth;
    for (const [i, { hit }] of view.sectors.entries()) {
      if (hit === null || hit.metres > SHOWN_M) continue;
      context.strokeStyle = hitColour(hit, view.stale);
      context.beginPath();
      trace(hit.metres + (1.5 * lineWidth) / perMetre, i - 0.5, i + 0.5);
      context.stroke();
    }
  }
  context.beginPath();
  for (const { x, y } of footprint) context.lineTo(middle - y * perMetre, middle - x * perMetre);
  context.closePath();
  context.fillStyle = view === null || view.stale ? NEAR_COLOURS.stale : '#35c9b5';
  context.fill();
}

let [pattern, patternKey]: [CanvasPattern | null, string] = [null, ''];

/** Diagonal stripes: not to be taken for free floor, even where colours are not told apart. */
function hatching(context: CanvasRenderingContext2D, size: number, stale: boolean): CanvasPattern | string {
  const key = `${size} ${stale}`;
  if (pattern !== null && key === patternKey) return pattern;
  const tile = document.createElement('canvas');
  const side = Math.max(4, Math.round(size / 20));
  [tile.width, tile.height] = [side, side];
  const lines = tile.getContext('2d');
  if (lines === null) return NEAR_COLOURS.unseen;
  lines.strokeStyle = stale ? '#6b768080' : '#8fa3b3b0';
  lines.lineWidth = side / 4;
  lines.beginPath();
  for (const at of [-side, 0, side]) {
    lines.moveTo(at - 1, side + 1);
    lines.lineTo(at + side + 1, -1);
  }
  lines.stroke();
  pattern = context.createPattern(tile, 'repeat');
  patternKey = key;
  return pattern ?? NEAR_COLOURS.unseen;
}
