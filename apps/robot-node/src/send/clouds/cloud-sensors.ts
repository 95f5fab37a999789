import type { TimedBaseState } from '@farpoint/cloud-source';
import { Capture, type CaptureError, type CaptureRecording } from '../../sense/capture/capture.ts';
import type { Budgets } from '../budgets/budgets.ts';
import type { CloudClaim } from '../budgets/cloud-shares.ts';
import { CloudSensor, type CloudSensorOptions, type SensorFanOut } from './cloud-sensor.ts';
import type { FrameTarget } from './pipeline.ts';

export interface CloudSensorsEvents {
  /** The state of the base, as the first sensor reports it. */
  onState(state: TimedBaseState): void;
  onFault(sensor: CloudSensor, detail: string): void;
  /** The rings of a sensor are known, or have changed. */
  onRings(sensor: CloudSensor): void;
  /** A sensor's thread has ended; the others continue. */
  onFailure(sensor: CloudSensor, error: CaptureError): void;
}

/** All of a robot's sources of clouds. Latency tests, recordings and the reference profile use the first. */
export class CloudSensors {
  readonly all: readonly CloudSensor[];

  /**
   * Opens each source in its own thread.
   *
   * @param recording records the first source's clouds
   * @throws {CaptureError} if a source cannot be opened; the others are then closed again
   */
  static async open(
    options: readonly CloudSensorOptions[],
    recording: CaptureRecording | null,
  ): Promise<Capture[]> {
    const opening = options.map(({ capture }, i) => Capture.start(capture, i === 0 ? recording : null));
    const opened = await Promise.allSettled(opening);
    const failed = opened.find((result) => result.status === 'rejected');
    const captures = opened.flatMap((result) => (result.status === 'fulfilled' ? [result.value] : []));
    if (failed === undefined) return captures;
    await Promise.all(captures.map((capture) => capture.close()));
    throw failed.reason;
  }

  /** @param captures one for each of `options`, in the same order */
  constructor(
    options: readonly CloudSensorOptions[],
    captures: readonly Capture[],
    fanOut: SensorFanOut,
    budgets: Budgets,
    events: CloudSensorsEvents,
  ) {
    this.all = options.map((each, i) => {
      const first = i === 0;
      // Frames are logged and recorded for the first sensor only: frame numbers of several sensors would get mixed up.
      const { frameLog: _, onFrame: __, wantedAnyway: ___, ...others } = fanOut;
      const sensor = new CloudSensor(each, captures[i] as Capture, first ? fanOut : others, budgets);
      const { capture } = sensor;
      capture.onFault = (detail) => events.onFault(sensor, detail);
      capture.onRings = () => events.onRings(sensor);
      capture.onFailure = (error) => {
        sensor.fail();
        events.onFailure(sensor, error);
      };
      if (first) capture.onState = (state) => events.onState(state);
      return sensor;
    });
  }

  get first(): CloudSensor {
    return this.all[0] as CloudSensor;
  }

  /** Indexed by sensor number. */
  get claims(): readonly CloudClaim[] {
    return this.all.map(({ claim }) => claim);
  }

  /** Number of temporary faults of all sources. */
  get faults(): number {
    return this.all.reduce((sum, { capture }) => sum + capture.faults, 0);
  }

  get framesWithoutBuffer(): number {
    return this.all.reduce((sum, { capture }) => sum + capture.framesWithoutBuffer, 0);
  }

  /** Sends a target the coded streams' headers of the sensors that it wants. */
  announceTo(target: FrameTarget): void {
    for (const sensor of this.all) sensor.announceTo(target);
  }

  async close(): Promise<void> {
    await Promise.all(this.all.map(({ capture }) => capture.close()));
  }
}
