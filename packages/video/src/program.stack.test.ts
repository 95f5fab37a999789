/** The program by itself, where its input ends or nobody takes its output. */
import { type ChildProcessWithoutNullStreams, spawn } from 'node:child_process';
import { once } from 'node:events';
import { afterEach, describe, expect, it } from 'vitest';
import { ADDON_FILE } from './build.ts';
import { openMessage } from './open-message.ts';
import { encoderNamed, VIDEO_SUITE } from './testing/helpers.ts';
import {
  type EncodedFrame,
  FROM_PROCESS,
  MessageParser,
  parseEncoded,
  writeConfigure,
  writeFrameHead,
  writeMessage,
} from './wire.ts';

let child: ChildProcessWithoutNullStreams | null = null;
afterEach(() => void child?.kill('SIGKILL'));

function start(source: 'frames' | 'test'): ChildProcessWithoutNullStreams {
  const started = spawn(ADDON_FILE, [], { stdio: ['pipe', 'pipe', 'pipe'] });
  child = started;
  started.stdin.on('error', () => undefined);
  const from =
    source === 'frames'
      ? ({ kind: 'frames' } as const)
      : ({ kind: 'test', pattern: 'ball', width: 320, height: 240, framesPerS: 30 } as const);
  started.stdin.write(openMessage(from, encoderNamed('x264enc'), ''));
  started.stdin.write(writeConfigure({ bitsPerS: 20_000_000 }));
  return started;
}

/** Takes its output until there is enough. */
async function read(program: ChildProcessWithoutNullStreams, enough: (frames: EncodedFrame[]) => boolean) {
  const frames: EncodedFrame[] = [];
  const parser = new MessageParser();
  while (!enough(frames)) {
    const [chunk] = (await once(program.stdout, 'data')) as [Buffer];
    parser.push(chunk, ({ type, payload }) => {
      if (type === FROM_PROCESS.encoded) frames.push(parseEncoded(payload));
    });
  }
  return frames;
}

describe(`farpoint-video (${VIDEO_SUITE.note})`, { skip: VIDEO_SUITE.skip }, () => {
  it.each([
    ['its input ends', (of: ChildProcessWithoutNullStreams) => void of.stdin.end()],
    ['it is told to', (of: ChildProcessWithoutNullStreams) => void of.kill('SIGTERM')],
  ])('ends when %s', async (_, end) => {
    const program = start('test');
    await once(program.stdout, 'data');
    program.stdout.resume();
    end(program);
    expect(await once(program, 'exit')).toEqual([0, null]);
  });

  it('ends when its input ends although nobody takes its output', async () => {
    const program = start('frames');
    await once(program.stdout, 'data');
    program.stdout.pause();
    await pushNoise(program, 60);
    program.stdin.end();
    const [code] = await once(program, 'exit');
    expect([0, 1]).toContain(code);
  });

  it('ends on messages that make no sense', async () => {
    const program = start('test');
    program.stdin.write(new Uint8Array([255, 255, 255, 255, 4]));
    program.stdout.resume();
    expect(await once(program, 'exit')).toEqual([0, null]);
  });

  it('goes on after raw pictures that make no sense', async () => {
    const program = start('frames');
    program.stdin.write(writeMessage(4, new Uint8Array(3)));
    program.stdin.write(writeMessage(4, new Uint8Array(30)));
    program.stdin.write(writeMessage(4, new Uint8Array(10_000).fill(255)));
    program.stdin.write(writeMessage(99, new Uint8Array(10_000)));
    await pushNoise(program, 1);
    const frames = await read(program, ({ length }) => length > 0);
    expect(frames[0]?.key).toBe(true);
  });

  it('drops pictures before the encoder while nobody takes its output, and then goes on with the newest', async () => {
    const program = start('frames');
    // Nobody reads: the output's buffer takes a few pictures, and all of these are read from the input nevertheless.
    const newest = await pushNoise(program, 200);
    const frames = await read(program, (all) => all.at(-1)?.captureNs === newest);
    expect(frames.length).toBeLessThan(100);
    expect(frames.filter(({ key }) => key)).toHaveLength(1);
    const times = frames.map(({ captureNs }) => captureNs);
    expect(times).toEqual([...times].sort((a, b) => (a < b ? -1 : 1)));
  });
});

/** Pushes pictures that are hard to encode, each as soon as the program has taken the one before. */
async function pushNoise(to: ChildProcessWithoutNullStreams, count: number): Promise<bigint> {
  const [width, height] = [320, 240];
  let captureNs = 0n;
  for (let i = 0; i < count; i++) {
    captureNs = process.hrtime.bigint();
    let seed = i + 1;
    const bytes = Uint8Array.from({ length: width * height }, () => {
      seed = (Math.imul(seed, 1_103_515_245) + 12_345) | 0;
      return (seed >>> 16) & 255;
    });
    to.stdin.write(writeFrameHead({ captureNs, format: 'gray', width, height, stride: width, bytes }));
    await new Promise((resolve) => to.stdin.write(bytes, resolve));
  }
  return captureNs;
}
