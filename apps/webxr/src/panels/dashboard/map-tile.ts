/** The tile with the map: where the robot is and has been, by its odometry or by satellite. */
import type { MapTiles } from '../../ground/telemetry/map-tiles.ts';
import { type ShownValue, shownAt } from '../../ground/telemetry/moment.ts';
import { OWN, type TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { quietButton } from '../ui/panel-parts.ts';
import { listenToGestures } from './map-gestures.ts';
import { type PaintedMap, paintMap } from './map-painter.ts';
import { EarthPlane, type MapPlace, MapProjection } from './map-projection.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';
import { TileStore } from './tile-store.ts';

/** Telemetry comes 20 times a second. */
const UPDATE_MS = 50;
const BUTTON_ZOOM = 1.6;
const FAR_M = 50_000;
const RADIANS = Math.PI / 180;

interface Position {
  readonly place: MapPlace;
  readonly shown: ShownValue;
}

export function mapTile(recorder: TelemetryRecorder, tiles: MapTiles | null): Tile {
  const element = part('map');
  const canvas = document.createElement('canvas');
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'img');
  canvas.ariaLabel = 'Map: arrow keys move it, plus and minus zoom';
  const buttons = part('buttons');
  const attribution = part('attribution', 'p');
  element.append(canvas, buttons, attribution);
  const context = canvas.getContext('2d')!;
  const projection = new MapProjection();
  const store = tiles === null ? null : new TileStore(tiles);
  let follow = true;
  let bySatellite = false;
  let plane: EarthPlane | null = null;
  let dirty = true;
  let painted = '';

  const press = (text: string, title: string, act: () => void) => {
    const button = quietButton(text, title, () => {
      act();
      dirty = true;
    });
    button.ariaLabel = title;
    buttons.append(button);
    return button;
  };
  press('+', 'Zoom in', () => projection.zoom(BUTTON_ZOOM));
  press('−', 'Zoom out', () => projection.zoom(1 / BUTTON_ZOOM));
  const following = press('Follow', 'Keep the robot in the middle', () => {
    follow = !follow;
    following.ariaPressed = String(follow);
  });
  following.ariaPressed = 'true';
  const turning = press('North up', 'Which direction is up', () => {
    projection.up = projection.up === 'north' ? 'x' : 'north';
    setText(turning, projection.up === 'north' ? 'North up' : 'x up');
  });
  const source = press('Odometry', 'Where the position comes from', () => {
    bySatellite = !bySatellite;
    follow = true;
    following.ariaPressed = 'true';
    showSource();
  });
  function showSource(): void {
    setText(source, bySatellite ? 'Satellite' : 'Odometry');
    // Tiles have north up.
    turning.disabled = bySatellite;
    if (bySatellite) projection.up = 'north';
    setText(turning, projection.up === 'north' ? 'North up' : 'x up');
    attribution.hidden = !bySatellite || store === null;
    setText(attribution, store?.attribution ?? '');
  }
  showSource();
  if (store !== null)
    store.onReady = () => {
      dirty = true;
    };
  listenToGestures(canvas, projection, (panned) => {
    if (panned) {
      follow = false;
      following.ariaPressed = 'false';
    }
    dirty = true;
  });
  const resizing = new ResizeObserver(() => {
    const { clientWidth, clientHeight } = canvas;
    const ratio = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.max(1, Math.round(clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    Object.assign(projection, { width: Math.max(1, clientWidth), height: Math.max(1, clientHeight) });
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    dirty = true;
  });
  resizing.observe(canvas);

  function byOdometry({ moment }: TileFrame): Position | null {
    const [x, y] = [OWN.x, OWN.y].map(({ key }) => shownAt(recorder.series.get(key)?.series, moment));
    return x == null || y == null ? null : { place: { x: x.value, y: y.value }, shown: x };
  }

  function byFix({ moment }: TileFrame): Position | null {
    const [latitude, longitude] = ['latitude', 'longitude'].map((field) =>
      shownAt(recorder.ofField(field, '°')?.series, moment),
    );
    if (latitude == null || longitude == null) return null;
    plane ??= new EarthPlane(latitude.value, longitude.value);
    const { x, y } = plane.toPlace(latitude.value, longitude.value);
    // Another robot: its scale is another one, too.
    if (Math.hypot(x, y) > FAR_M) plane = new EarthPlane(latitude.value, longitude.value);
    return { place: plane.toPlace(latitude.value, longitude.value), shown: latitude };
  }

  function paint(frame: TileFrame): void {
    const heading = shownAt(recorder.series.get(OWN.heading.key)?.series, frame.moment);
    const position = bySatellite ? byFix(frame) : byOdometry(frame);
    const { shown = null, place = null } = position ?? {};
    const stale = shown?.stale ?? true;
    const yaw = bySatellite || heading === null ? null : heading.value * RADIANS;
    const track = bySatellite ? recorder.fixTrack : recorder.track;
    const key = `${place?.x} ${place?.y} ${yaw} ${stale} ${track.length}`;
    if (!dirty && key === painted) return;
    dirty = false;
    painted = key;
    if (follow && place !== null) projection.centre = place;
    const map: PaintedMap = {
      projection,
      track,
      robot: place,
      yaw,
      stale,
      placeOf: (first, second) =>
        bySatellite ? (plane?.toPlace(second, first) ?? ORIGIN) : { x: first, y: second },
      earth: bySatellite && plane !== null ? { plane, tiles: store } : null,
    };
    paintMap(context, map, frame.nowMs);
    element.dataset.stale = String(stale);
  }

  return {
    element,
    everyMs: () => UPDATE_MS,
    update(frame) {
      // A robot without a satellite receiver has only its odometry.
      source.hidden = recorder.ofField('latitude', '°') === null;
      if (source.hidden && bySatellite) {
        bySatellite = false;
        plane = null;
        showSource();
      }
      paint(frame);
    },
    dispose() {
      resizing.disconnect();
      store?.close();
    },
  };
}

const ORIGIN: MapPlace = { x: 0, y: 0 };
