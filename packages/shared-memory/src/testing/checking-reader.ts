/**
 * A process that reads frames and checks that each is consistent, until it is killed:
 * `node checking-reader.ts --layout … --folder … --points N --log FILE`. Its counts are in FILE, which survives it.
 */
import { CloudReader } from '../cloud/cloud-reader.ts';
import { PUBLISHED_OFFSET } from '../cloud/layout.ts';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile } from '../mapped-file.ts';
import { ReferenceFrameConsumer } from '../reference/frame-consumer.ts';
import { READY_OFFSET } from '../reference/layout.ts';
import { Watch, type WatchOutcome } from '../watch.ts';
import { readArguments } from './arguments.ts';
import { COUNT_BYTES, Counts } from './counts.ts';
import { arePackedWhole, areWordsWhole } from './marked-frames.ts';

const { layout, folder, points, log } = readArguments();
const counts = new Counts(MappedFile.open(log, { bytes: COUNT_BYTES, create: true }));
const room = {
  points: new Float32Array(points * 4),
  depth: new Float32Array(0),
  colour: new Uint32Array(0),
};
setInterval(() => undefined, 1000);

interface Reading {
  current: () => boolean;
  /** Returns whether there was a frame. */
  take: () => boolean;
  wait: () => Promise<WatchOutcome>;
  close: () => void;
}

function open(): Reading {
  const source = layout === 'farpoint' ? CloudReader.open(folder) : ReferenceFrameConsumer.open(folder);
  const futex = source instanceof CloudReader;
  const where = { offset: futex ? PUBLISHED_OFFSET : READY_OFFSET, futex };
  let resolve: (outcome: WatchOutcome) => void = () => undefined;
  const watch = new Watch(futex ? source.file : source.flags, where, (outcome) => resolve(outcome));
  const take = () => {
    const frame =
      source instanceof CloudReader
        ? source.read(room)
        : source.take(room.points, { bitsPerSecond: 0, latencyTest: false });
    if (frame === null) return false;
    counts.frame('form' in frame ? areWordsWhole(frame, room) : arePackedWhole(room.points, frame.points));
    return true;
  };
  return {
    current: () => source.current,
    take,
    wait: () =>
      new Promise((done) => {
        resolve = done;
        const value = source instanceof CloudReader ? source.last : 0;
        watch.arm({ value, pollMs: 0.2, timeoutMs: 20 });
      }),
    close: () => {
      watch.close();
      source.close();
    },
  };
}

console.log('working');
for (;;) {
  let reading: Reading | null = null;
  try {
    reading = open();
    while (reading.current()) if (!reading.take() && (await reading.wait()) === 'fault') break;
  } catch (error) {
    if (!(error instanceof SharedMemoryError)) throw error;
    counts.fault();
    await new Promise((resolve) => setTimeout(resolve, 2));
  } finally {
    reading?.close();
  }
}
