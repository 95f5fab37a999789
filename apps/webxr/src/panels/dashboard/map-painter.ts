/** Draws the map on one canvas: tiles or nothing, a metric grid, the track, the robot and the scale. */
import { palette } from '../../ground/display/palette.ts';
import type { Track } from '../../ground/telemetry/track.ts';
import {
  type EarthPlane,
  lengthText,
  type MapPlace,
  type MapProjection,
  roundLength,
} from './map-projection.ts';
import type { TileStore } from './tile-store.ts';

export interface PaintedMap {
  readonly projection: MapProjection;
  /** Its points as places on the map. */
  readonly track: Track;
  placeOf(first: number, second: number): MapPlace;
  /** `null` before its position is known. */
  readonly robot: MapPlace | null;
  /** Radians anticlockwise from x; `null` if unknown. */
  readonly yaw: number | null;
  readonly stale: boolean;
  /** Where tiles are drawn; `null` for none. */
  readonly earth: { readonly plane: EarthPlane; readonly tiles: TileStore | null } | null;
}

/** Sizes on the canvas, CSS pixels: the least mesh of the grid, the scale, the robot. Chosen by eye. */
const LEAST_GRID_PX = 44;
const SCALE_PX = 110;
const ROBOT_PX = 9;
/** Side of a tile, and the deepest level that servers of the usual tiles have (OpenStreetMap: 19). */
const TILE_PX = 256;
const MOST_ZOOM = 19;
/**
 * Tiles that are drawn at once. Chosen: a screen of 1920 × 1080 has some 50; more would ask a server for too
 * much.
 */
const MOST_TILES = 80;

export function paintMap(context: CanvasRenderingContext2D, map: PaintedMap, nowMs: number): void {
  const { projection } = map;
  const { width, height } = projection;
  context.fillStyle = palette.ground;
  context.fillRect(0, 0, width, height);
  const tiles = map.earth?.tiles ?? null;
  if (map.earth !== null && tiles !== null) paintTiles(context, projection, map.earth.plane, tiles, nowMs);
  else paintGrid(context, projection);
  paintTrack(context, map);
  paintRobot(context, map);
  paintScale(context, projection);
}

function paintGrid(context: CanvasRenderingContext2D, projection: MapProjection): void {
  const { width, height, metresPerPixel } = projection;
  // The next larger round length, so that lines are never too close.
  const step = roundLength(LEAST_GRID_PX * metresPerPixel * 2.5);
  const corners = [projection.toPlace(0, 0), projection.toPlace(width, height)] as const;
  const [left, right] = ordered(corners[0].x, corners[1].x);
  const [low, high] = ordered(corners[0].y, corners[1].y);
  context.lineWidth = 1;
  const line = (from: MapPlace, to: MapPlace, isAxis: boolean) => {
    const [a, b] = [projection.toScreen(from), projection.toScreen(to)];
    context.strokeStyle = isAxis ? palette.axis : palette.control;
    context.beginPath();
    context.moveTo(Math.round(a.left) + 0.5, Math.round(a.top) + 0.5);
    context.lineTo(Math.round(b.left) + 0.5, Math.round(b.top) + 0.5);
    context.stroke();
  };
  for (let i = Math.ceil(left / step); i * step <= right; i++)
    line({ x: i * step, y: low }, { x: i * step, y: high }, i === 0);
  for (let i = Math.ceil(low / step); i * step <= high; i++)
    line({ x: left, y: i * step }, { x: right, y: i * step }, i === 0);
}

function paintTiles(
  context: CanvasRenderingContext2D,
  projection: MapProjection,
  plane: EarthPlane,
  tiles: TileStore,
  nowMs: number,
): void {
  const { width, height, metresPerPixel } = projection;
  const exact = Math.log2(plane.worldM / (TILE_PX * metresPerPixel));
  const zoom = Math.min(Math.max(Math.round(exact), 0), MOST_ZOOM);
  const count = 2 ** zoom;
  // With north up, the screen's corners are the map's.
  const [west, north] = plane.toWorld(projection.toPlace(0, 0));
  const [east, south] = plane.toWorld(projection.toPlace(width, height));
  const [firstX, lastX] = [Math.floor(west * count), Math.floor(east * count)];
  const [firstY, lastY] = [
    Math.max(0, Math.floor(north * count)),
    Math.min(count - 1, Math.floor(south * count)),
  ];
  if ((lastX - firstX + 1) * (lastY - firstY + 1) > MOST_TILES) return;
  for (let y = firstY; y <= lastY; y++) {
    for (let x = firstX; x <= lastX; x++) {
      const image = tiles.image(zoom, ((x % count) + count) % count, y, nowMs);
      if (image === null) continue;
      const at = projection.toScreen(plane.ofWorld(x / count, y / count));
      const end = projection.toScreen(plane.ofWorld((x + 1) / count, (y + 1) / count));
      context.drawImage(image, at.left, at.top, end.left - at.left, end.top - at.top);
    }
  }
}

function paintTrack(
  context: CanvasRenderingContext2D,
  { projection, track, placeOf, stale }: PaintedMap,
): void {
  if (track.length < 2) return;
  context.strokeStyle = stale ? palette.stale : palette.good;
  context.lineWidth = 2;
  context.lineJoin = 'round';
  context.beginPath();
  let last = { left: Number.NaN, top: Number.NaN };
  for (let i = 0; i < track.length; i++) {
    const at = projection.toScreen(placeOf(track.xAt(i), track.yAt(i)));
    // Points of one pixel are one point.
    if (Math.abs(at.left - last.left) + Math.abs(at.top - last.top) < 1 && i < track.length - 1) continue;
    if (i === 0) context.moveTo(at.left, at.top);
    else context.lineTo(at.left, at.top);
    last = at;
  }
  context.stroke();
}

function paintRobot(context: CanvasRenderingContext2D, { projection, robot, yaw, stale }: PaintedMap): void {
  if (robot === null) return;
  const { left, top } = projection.toScreen(robot);
  context.save();
  context.translate(left, top);
  context.fillStyle = stale ? palette.stale : palette.text;
  context.strokeStyle = palette.ground;
  context.lineWidth = 2;
  context.beginPath();
  if (yaw === null) context.arc(0, 0, ROBOT_PX * 0.7, 0, 2 * Math.PI);
  else {
    context.rotate(projection.screenAngle(yaw));
    context.moveTo(0, -ROBOT_PX * 1.3);
    context.lineTo(ROBOT_PX, ROBOT_PX);
    context.lineTo(0, ROBOT_PX * 0.5);
    context.lineTo(-ROBOT_PX, ROBOT_PX);
    context.closePath();
  }
  context.fill();
  context.stroke();
  context.restore();
}

function paintScale(context: CanvasRenderingContext2D, { height, metresPerPixel }: MapProjection): void {
  const length = roundLength(SCALE_PX * metresPerPixel);
  const pixels = length / metresPerPixel;
  const [left, bottom] = [10.5, height - 10.5];
  context.strokeStyle = palette.text;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(left, bottom - 5);
  context.lineTo(left, bottom);
  context.lineTo(left + pixels, bottom);
  context.lineTo(left + pixels, bottom - 5);
  context.stroke();
  context.font = '11px system-ui, sans-serif';
  context.textBaseline = 'bottom';
  context.lineWidth = 3;
  context.strokeStyle = palette.ground;
  context.strokeText(lengthText(length), left + 4, bottom - 3);
  context.fillStyle = palette.text;
  context.fillText(lengthText(length), left + 4, bottom - 3);
}

function ordered(a: number, b: number): [number, number] {
  return a < b ? [a, b] : [b, a];
}
