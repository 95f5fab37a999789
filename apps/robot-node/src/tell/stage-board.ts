import {
  type CommandTimes,
  type FrameTimes,
  MOST_STAGE_ROWS,
  MOST_STAGE_US,
  type StageTimes,
  stampUsOf,
} from '@farpoint/protocol';

/**
 * Interval between two messages, ms, to a wide path and to a narrow one. Chosen: four times a second are as often as people
 * read figures; of 30 frames and 40 commands a second they take 25 kbit/s with all headers, each message one packet.
 */
const [EVERY_MS, NARROW_EVERY_MS] = [250, 1000];
/** Rows of each kind in a message to a narrow path: of the newest. With its interval, 6 kbit/s. */
const NARROW_ROWS = 8;

/** When a frame passed the stations on the robot, ms on its clock. */
export interface FrameStations {
  capturedAtMs: number;
  inMemoryMs: number;
  readyMs: number;
  firstLeftMs: number;
  lastLeftMs: number;
}

/** One operator's frames and commands that have passed the robot's stations, until the operator is told of them. */
export class StageBoard {
  #frames: FrameTimes[] = [];
  #commands: CommandTimes[] = [];
  #nextMs = 0;

  /** A frame has left for the operator, or the part of it that was sent. */
  frame(sensor: number, frameNumber: number, at: Readonly<FrameStations>): void {
    const { capturedAtMs } = at;
    const memoryUs = sinceUs(at.inMemoryMs, capturedAtMs, 0);
    const encodedUs = sinceUs(at.readyMs, capturedAtMs, memoryUs);
    const firstUs = sinceUs(at.firstLeftMs, capturedAtMs, encodedUs);
    const lastUs = sinceUs(at.lastLeftMs, capturedAtMs, firstUs);
    const captureUs = stampUsOf(capturedAtMs);
    keep(this.#frames, [sensor, frameNumber, captureUs, memoryUs, encodedUs, firstUs, lastUs]);
  }

  /** The robot has made of a command what it makes of it. @param wheelsMs `null`: it was refused */
  command(sequence: number, receivedMs: number, judgedMs: number, wheelsMs: number | null): void {
    const judgedUs = sinceUs(judgedMs, receivedMs, 0);
    const wheelsUs = wheelsMs === null ? null : sinceUs(wheelsMs, receivedMs, judgedUs);
    keep(this.#commands, [sequence, stampUsOf(receivedMs), judgedUs, wheelsUs]);
  }

  /**
   * What the operator is to be told now; `null`: nothing. If more has passed than a message holds, the oldest is left out.
   *
   * @param isNarrow whether the path carries so little that it is told less
   */
  due(nowMs: number, isNarrow: boolean): StageTimes | null {
    if (nowMs < this.#nextMs || this.#frames.length + this.#commands.length === 0) return null;
    this.#nextMs = nowMs + (isNarrow ? NARROW_EVERY_MS : EVERY_MS);
    const most = isNarrow ? NARROW_ROWS : MOST_STAGE_ROWS;
    const message: StageTimes = {
      type: 'stages',
      frames: this.#frames.slice(-most),
      commands: this.#commands.slice(-most),
    };
    this.clear();
    return message;
  }

  /** Forgets what waits: there is nobody to tell. */
  clear(): void {
    this.#frames = [];
    this.#commands = [];
  }
}

/** @param leastUs the station before: clocks of sources may be a little off */
function sinceUs(atMs: number, fromMs: number, leastUs: number): number {
  return Math.min(MOST_STAGE_US, Math.max(leastUs, Math.round((atMs - fromMs) * 1000)));
}

function keep<Row>(rows: Row[], row: Row): void {
  rows.push(row);
  if (rows.length > MOST_STAGE_ROWS) rows.shift();
}
