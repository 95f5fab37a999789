/** The small map: what is remembered around the robot from above, the way that it has driven, and the robot. */
import { palette } from '../../ground/display/palette.ts';
import type { Track } from '../../ground/telemetry/track.ts';

/** Side of what is shown, metres. A map that is turned still fills it. */
export const SHOWN_M = 16;
/** Points farther from the robot are not drawn. */
const REACH_M = SHOWN_M * Math.SQRT1_2;
/** Two points of the track that are farther apart are not joined, metres. */
const GAP_M = 1;
const SCALE_M = 5;

export interface MinimapPicture {
  /** What is remembered, its rows from the greatest y on; `null` for nothing. */
  readonly image: CanvasImageSource | null;
  /** Its place in the world, and its side, metres. */
  readonly left: number;
  readonly bottom: number;
  readonly side: number;
  /** base_link in the world: metres, and radians anticlockwise from x. */
  readonly x: number;
  readonly y: number;
  readonly yaw: number;
  /** The robot's heading is up; otherwise the world's y axis. */
  readonly headingUp: boolean;
  /** Nothing is heard of the robot. */
  readonly stale: boolean;
  readonly trail: Track;
}

/**
 * How far the map is turned, radians clockwise, from the world's y axis up.
 *
 * @param yaw of the robot, radians anticlockwise from the world's x axis
 */
export function minimapTurn(yaw: number, headingUp: boolean): number {
  return headingUp ? yaw - Math.PI / 2 : 0;
}

/** Allocates nothing. @param size of the square canvas, pixels */
export function drawMinimap(context: CanvasRenderingContext2D, size: number, map: MinimapPicture): void {
  const perMetre = size / SHOWN_M;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, size, size);
  context.translate(size / 2, size / 2);
  context.rotate(minimapTurn(map.yaw, map.headingUp));
  // Metres from the robot: x as the world's, y against it.
  context.scale(perMetre, perMetre);
  if (map.image !== null)
    context.drawImage(map.image, map.left - map.x, map.y - map.bottom - map.side, map.side, map.side);
  drawTrail(context, map, size / 60 / perMetre);
  drawRobot(context, map, (size / 22 / perMetre) * 1.2);
  drawScale(context, size, perMetre);
}

function drawTrail(
  context: CanvasRenderingContext2D,
  { trail, x, y, stale }: MinimapPicture,
  width: number,
): void {
  context.strokeStyle = stale ? palette.stale : palette.good;
  context.lineWidth = width;
  context.lineJoin = 'round';
  context.beginPath();
  let isJoined = false;
  for (let i = 0; i < trail.length; i++) {
    const east = trail.xAt(i) - x;
    const south = y - trail.yAt(i);
    if (Math.abs(east) > REACH_M || Math.abs(south) > REACH_M) {
      isJoined = false;
      continue;
    }
    const isNear =
      i > 0 && Math.hypot(trail.xAt(i) - trail.xAt(i - 1), trail.yAt(i) - trail.yAt(i - 1)) < GAP_M;
    if (isJoined && isNear) context.lineTo(east, south);
    else context.moveTo(east, south);
    isJoined = true;
  }
  if (isJoined) context.lineTo(0, 0);
  context.stroke();
}

/** An arrow in its heading. @param length metres, from the middle */
function drawRobot(context: CanvasRenderingContext2D, { yaw, stale }: MinimapPicture, length: number): void {
  context.rotate(-yaw);
  context.beginPath();
  context.moveTo(length, 0);
  context.lineTo(-0.8 * length, 0.75 * length);
  context.lineTo(-0.4 * length, 0);
  context.lineTo(-0.8 * length, -0.75 * length);
  context.closePath();
  context.fillStyle = stale ? palette.stale : palette.text;
  context.strokeStyle = palette.ground;
  context.lineWidth = 0.3 * length;
  context.stroke();
  context.fill();
}

function drawScale(context: CanvasRenderingContext2D, size: number, perMetre: number): void {
  context.setTransform(1, 0, 0, 1, 0, 0);
  const margin = size / 24;
  const bottom = size - margin;
  context.strokeStyle = palette.text;
  context.lineWidth = Math.max(1, size / 90);
  context.beginPath();
  context.moveTo(margin, bottom);
  context.lineTo(margin + SCALE_M * perMetre, bottom);
  context.stroke();
}
