import { BATCH_BYTES, Batch, DEFAULT_EXTENT, RobotClient } from '@farpoint/operator';
import { BYTES_PER_POINT, emptyPlacement } from '@farpoint/protocol';
import type { SentFrame } from './connection.ts';
import type { Direction } from './direction.ts';
import type { EventLog } from './event-log.ts';
import { Hand } from './hand.ts';
import { OperatorLink, type OperatorLinkParts } from './operator-link.ts';
import { after } from './slow-robot.ts';

/** A display frame, ms. */
const DISPLAY_MS = 16;
/** Points in a cloud. */
const POINTS = 100;

export type OperatorParts = Pick<OperatorLinkParts, 'name' | 'access' | 'robot' | 'signaling' | 'random'> & {
  up: Direction;
  down: Direction;
  log: EventLog;
};

/** An operator with the real client library, a hand, and a display that draws what has come. */
export class ScenarioOperator {
  readonly client: RobotClient;
  readonly hand = new Hand();
  readonly up: Direction;
  readonly down: Direction;
  readonly link: OperatorLink;
  /** How long its page takes to have a cloud that has come with the GPU, ms. */
  pageMs = 0;
  readonly #batch = new Batch(new ArrayBuffer(BATCH_BYTES));
  readonly #display: ReturnType<typeof setInterval>;
  #draws = true;

  constructor(parts: OperatorParts) {
    const { name, log } = parts;
    [this.up, this.down] = [parts.up, parts.down];
    this.client = new RobotClient({
      ...{ signalingUrl: 'ws://127.0.0.1/operator', name, token: undefined },
      ...{ icePolicy: 'all', transform: 'none', inputs: [this.hand] },
      openLink: (_, events) =>
        new OperatorLink(
          {
            ...parts,
            alter: (command) => this.hand.made(command),
            onFrame: (frame) => this.#onFrame(frame),
          },
          events,
        ),
    });
    this.link = this.client.link as OperatorLink;
    for (const type of ['phase', 'path', 'gripLost', 'stop'] as const)
      this.client.on(type, (value) => log.add(`${name}:${type}`, { value }));
    this.client.on('commandRejected', ({ reason }) => log.add(`${name}:rejected`, { reason }));
    this.client.on('estop', ({ latched }) => log.add(`${name}:estop`, { latched }));
    this.client.on('lease', ({ holder }) => log.add(`${name}:lease`, { holder }));
    this.#display = setInterval(() => {
      if (this.#draws) this.client.noteDrawn(performance.now());
    }, DISPLAY_MS);
  }

  /** Whether its page draws. */
  set draws(draws: boolean) {
    this.#draws = draws;
  }

  /** Loses its power. */
  vanish(): void {
    clearInterval(this.#display);
    this.link.vanish();
  }

  close(): void {
    clearInterval(this.#display);
    this.client.close();
  }

  #onFrame({ number, captureUs }: SentFrame): void {
    this.client.pointsAtMs = performance.now();
    const receivedAtMs = performance.timeOrigin + performance.now();
    after(this.pageMs, () => {
      const [bytes, batch] = [POINTS * BYTES_PER_POINT, this.#batch];
      const header = { frameNumber: number, frameLength: bytes, sequenceOffset: 0, sequenceLength: bytes };
      const look = { imageExtent: DEFAULT_EXTENT, unit: 0.001, cover: 1 };
      batch.clear();
      batch.add(header, { ...emptyPlacement(), captureTimeUs: captureUs }, POINTS, receivedAtMs, look);
      this.client.noteUploaded(batch, 0);
    });
  }
}
