/** Where the robot is and has been on the map: by its odometry, or by satellite. */
import { type Moment, type ShownValue, shownAt } from '../../ground/telemetry/moment.ts';
import { OWN, type TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import type { Track } from '../../ground/telemetry/track.ts';
import { EarthPlane, type MapPlace } from './map-projection.ts';

/** Beyond this from the origin of the plane, its scale is wrong, m: by nearly 1 % at 48° north. */
const FAR_M = 50_000;
const RADIANS = Math.PI / 180;
const ORIGIN: MapPlace = { x: 0, y: 0 };

export interface MapPosition {
  readonly place: MapPlace;
  readonly shown: ShownValue;
}

export class RobotOnMap {
  bySatellite = false;
  readonly #recorder: TelemetryRecorder;
  #plane: EarthPlane | null = null;

  constructor(recorder: TelemetryRecorder) {
    this.#recorder = recorder;
  }

  /** Whether the robot has a satellite receiver. */
  get hasReceiver(): boolean {
    return this.#recorder.ofField('latitude', '°') !== null;
  }

  /** Where it has been; {@link placeOf} makes places of it. */
  get track(): Track {
    return this.bySatellite ? this.#recorder.fixTrack : this.#recorder.track;
  }

  /** The plane of positions by satellite; `null` before there is one, and by odometry. */
  get plane(): EarthPlane | null {
    return this.bySatellite ? this.#plane : null;
  }

  positionAt(moment: Moment): MapPosition | null {
    return this.bySatellite ? this.#byFix(moment) : this.#byOdometry(moment);
  }

  /** Radians anticlockwise from x; `null` by satellite, which does not say it. */
  yawAt(moment: Moment): number | null {
    const heading = shownAt(this.#recorder.series.get(OWN.heading.key)?.series, moment);
    return this.bySatellite || heading === null ? null : heading.value * RADIANS;
  }

  /** The place of a point of the track. */
  placeOf(first: number, second: number): MapPlace {
    return this.bySatellite ? (this.#plane?.toPlace(second, first) ?? ORIGIN) : { x: first, y: second };
  }

  /** Goes back to odometry: this robot has no receiver. */
  forgetReceiver(): void {
    this.bySatellite = false;
    this.#plane = null;
  }

  #byOdometry(moment: Moment): MapPosition | null {
    const [x, y] = [OWN.x, OWN.y].map(({ key }) => shownAt(this.#recorder.series.get(key)?.series, moment));
    return x == null || y == null ? null : { place: { x: x.value, y: y.value }, shown: x };
  }

  #byFix(moment: Moment): MapPosition | null {
    const [latitude, longitude] = ['latitude', 'longitude'].map((field) =>
      shownAt(this.#recorder.ofField(field, '°')?.series, moment),
    );
    if (latitude == null || longitude == null) return null;
    this.#plane ??= new EarthPlane(latitude.value, longitude.value);
    const { x, y } = this.#plane.toPlace(latitude.value, longitude.value);
    // Another robot: its scale is another one, too.
    if (Math.hypot(x, y) > FAR_M) this.#plane = new EarthPlane(latitude.value, longitude.value);
    return { place: this.#plane.toPlace(latitude.value, longitude.value), shown: latitude };
  }
}
