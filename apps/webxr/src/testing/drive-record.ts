/** Records how the robot obeys its driver, for measurements: one row for each of its telemetry messages. */
import type { RobotClient } from '@farpoint/operator';
import type { DriveState, Intervention } from '@farpoint/protocol';
import { viewAgeMs } from '../words/motion-words.ts';

export interface DriveRow {
  /** `performance.now()` when it came. */
  atMs: number;
  /** Of the robot in the world, m. */
  x: number;
  y: number;
  drive: DriveState;
  /** Share of the wish that the robot lets through, and why not all. */
  factor: number;
  reasons: readonly Intervention[];
  /** Whether the robot demands that the hand let go first. */
  letGoFirst: boolean;
  /** Age of what is on the screen, ms. */
  seenMs: number | null;
  /** Age that the page shows: the robot's own, worst of the last second, while it is driven; ms. */
  viewMs: number | null;
  /** Whether the operator's hand holds a grip, whatever becomes of it. */
  held: boolean;
  /** Whether the grip was not read in time. */
  paused: boolean;
}

export interface DriveRecording {
  rows: DriveRow[];
  /** Why grips that were held were lost. */
  gripsLost: string[];
  /** Why the robot refused commands. */
  refusals: string[];
}

export class DriveRecord implements DriveRecording {
  readonly rows: DriveRow[] = [];
  readonly gripsLost: string[] = [];
  readonly refusals: string[] = [];
  readonly #off: (() => void)[];

  constructor(client: RobotClient) {
    const { driver, link, seen } = client;
    this.#off = [
      client.on('gripLost', (loss) => this.gripsLost.push(loss)),
      client.on('commandRejected', ({ reason }) => this.refusals.push(reason)),
      client.on('telemetry', ({ pose, drive, motion }) => {
        const atMs = performance.now();
        this.rows.push({
          ...{ atMs, x: pose.position.x, y: pose.position.y, drive },
          ...{ factor: motion?.factor ?? 1, reasons: motion?.reasons ?? [] },
          letGoFirst: motion?.letGoFirst === true,
          seenMs: seen.stampUs === null ? null : link.session.ageMs(seen.stampUs, atMs),
          viewMs: viewAgeMs(client, atMs),
          held: driver.lost !== null || driver.input !== null,
          paused: driver.paused,
        });
      }),
    ];
  }

  stop(): void {
    for (const off of this.#off) off();
  }
}
