import { join } from 'node:path';
import { casesOf, longProperty } from '@farpoint/network-sim/cases';
import { useFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { RecordingError } from './errors.ts';
import { openRecording } from './open-recording.ts';
import type { Recording } from './recording.ts';
import { cloudMessage, mcapOf, writeFile } from './testing/files.ts';
import { playClouds } from './testing/play-clouds.ts';

const CLOUDS = 40;
const folder = useFolder();
let whole: Uint8Array;
beforeAll(async () => {
  // Not a Buffer: its slices share memory.
  whole = Uint8Array.from(await mcapOf(CLOUDS, (k) => cloudMessage(k, 100)));
});

async function count(recording: Recording, fromNs = recording.startNs): Promise<number[]> {
  const seen: number[] = [];
  for await (const { logNs } of recording.messages(['/points'], fromNs)) {
    seen.push(Number((logNs - 1_000_000_000n) / 100_000_000n));
  }
  return seen;
}

describe('damaged files', () => {
  it('plays an MCAP file cut short anywhere up to its last complete chunk, and says where that is', async () => {
    let partly = 0;
    await fc.assert(
      fc.asyncProperty(fc.integer({ min: 0, max: whole.length - 1 }), async (length) => {
        const path = writeFile(join(folder, 'cut.mcap'), whole.subarray(0, length));
        let recording: Recording;
        try {
          recording = await openRecording(path);
        } catch (error) {
          expect(error).toBeInstanceOf(RecordingError);
          expect((error as RecordingError).offset).toBeLessThanOrEqual(length);
          return;
        }
        expect(recording.warning).toMatch(/cut\.mcap: byte \d+: .*played up to there/);
        const seen = await count(recording);
        await recording.close();
        // The first messages, without a gap.
        expect(seen).toEqual(Array.from({ length: seen.length }, (_, k) => k));
        // All complete chunks, each with four clouds of 1.3 kB.
        expect(seen.length).toBeGreaterThanOrEqual(
          Math.floor(((length / whole.length) * CLOUDS) / 4) * 4 - 8,
        );
        if (seen.length > 0 && seen.length < CLOUDS) partly++;
      }),
      longProperty(1, 150),
    );
    expect(partly).toBeGreaterThan(casesOf(50));
  });

  it('seeks in a file without an index as in one with an index', async () => {
    const path = writeFile(join(folder, 'cut.mcap'), whole.subarray(0, Math.floor(whole.length * 0.8)));
    const recording = await openRecording(path);
    const all = await count(recording);
    for (const k of [0, 3, 7, 13, 20]) {
      expect(await count(recording, 1_000_000_000n + BigInt(k) * 100_000_000n)).toEqual(all.slice(k));
    }
    await recording.close();
  });

  it('changed bytes anywhere give typed errors with file and offset, or another picture, nothing else', async () => {
    const outcomes = new Map<string, number>();
    const change = fc.record({
      at: fc.integer({ min: 0, max: 100_000 }),
      bytes: fc.uint8Array({ minLength: 1, maxLength: 9 }),
    });
    await fc.assert(
      fc.asyncProperty(change, async ({ at, bytes }) => {
        const damaged = whole.slice();
        damaged.set(bytes, at % (whole.length - 10));
        const path = writeFile(join(folder, 'damaged.mcap'), damaged);
        let outcome: string;
        try {
          const { faults } = await playClouds({ path }, 2 * CLOUDS);
          for (const fault of faults) {
            expect(fault).toBeInstanceOf(RecordingError);
            expect(fault.message).toContain('damaged.mcap');
            expect(fault.offset).toBeGreaterThanOrEqual(0);
          }
          outcome = faults.length > 0 ? 'fault' : 'played';
        } catch (error) {
          expect(error).toBeInstanceOf(RecordingError);
          outcome = 'refused';
        }
        outcomes.set(outcome, (outcomes.get(outcome) ?? 0) + 1);
      }),
      longProperty(1, 200),
    );
    expect((outcomes.get('fault') ?? 0) + (outcomes.get('refused') ?? 0)).toBeGreaterThan(casesOf(100));
  }, 30_000);

  it('in a file with an index, skips only the damaged chunk', async () => {
    const intact = await openRecording(writeFile(join(folder, 'intact.mcap'), whole));
    const offsets: number[] = [];
    for await (const { offset } of intact.messages(['/points'], intact.startNs)) offsets.push(offset);
    await intact.close();
    const chunks = [...new Set(offsets)];
    expect(chunks.length).toBeGreaterThan(5);
    for (const chunk of [chunks[0], chunks[3], chunks.at(-1)] as number[]) {
      const damaged = whole.slice();
      // This breaks the chunk's own checksum.
      damaged[chunk + 600] = (damaged[chunk + 600] as number) ^ 0x55;
      const path = writeFile(join(folder, 'chunk.mcap'), damaged);
      const recording = await openRecording(path);
      const faults: RecordingError[] = [];
      const seen: number[] = [];
      for await (const { logNs } of recording.messages(['/points'], recording.startNs, (fault) =>
        faults.push(fault),
      ))
        seen.push(Number((logNs - 1_000_000_000n) / 100_000_000n));
      const lost = Array.from(offsets.keys()).filter((k) => offsets[k] === chunk);
      expect(seen).toEqual(Array.from(offsets.keys()).filter((k) => !lost.includes(k)));
      expect(faults).toHaveLength(1);
      expect(faults[0]?.offset).toBe(chunk);
      await expect(count(recording)).rejects.toMatchObject({ code: 'damaged', offset: chunk });
      await recording.close();
      const played = await playClouds({ path });
      expect(played.shown).toHaveLength(CLOUDS - lost.length);
      expect(played.faults.length).toBeGreaterThanOrEqual(1);
    }
  });

  it('plays or reports messages that are changed anywhere, one by one', async () => {
    const original = cloudMessage(1, 50);
    const outcomes = { shown: 0, faults: 0 };
    const change = fc.record({
      at: fc.nat(original.length - 1),
      bytes: fc.uint8Array({ minLength: 1, maxLength: 6 }),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(change, { minLength: 8, maxLength: 8 }), async (changes) => {
        // The first few are examined when the file is opened, so they stay intact.
        const bytes = await mcapOf(20, (k) => {
          const message = original.slice();
          const { at, bytes: other } = changes[k - 12] ?? { at: 0, bytes: [] };
          message.set(Uint8Array.from(other).subarray(0, message.length - at), at);
          return message;
        });
        const { shown, faults } = await playClouds({ path: writeFile(join(folder, 'messages.mcap'), bytes) });
        expect(shown.length + faults.length).toBe(20);
        for (const fault of faults) {
          expect(fault).toBeInstanceOf(RecordingError);
          expect(fault.topic).toBe('/points');
          expect(fault.offset).toBeGreaterThan(0);
        }
        outcomes.shown += shown.length;
        outcomes.faults += faults.length;
      }),
      longProperty(1, 60),
    );
    expect(outcomes.faults).toBeGreaterThan(casesOf(20));
    expect(outcomes.shown).toBeGreaterThan(12 * casesOf(60));
  }, 30_000);

  it('skips unreadable clouds and reports each with topic and offset; plays the others', async () => {
    const bytes = await mcapOf(
      10,
      (k) => {
        if (k === 4) return cloudMessage(k, 100).subarray(0, 300);
        if (k === 5) return new Uint8Array(0);
        // A cloud far larger than those at the beginning.
        return cloudMessage(k, k === 6 ? 5000 : 100);
      },
      { chunkSize: 1_000_000 },
    );
    const { shown, faults } = await playClouds({ path: writeFile(join(folder, 'some.mcap'), bytes) });
    expect(shown.length).toBeGreaterThanOrEqual(7);
    expect(faults.length + shown.length).toBe(10);
    for (const fault of faults) {
      expect(fault.topic).toBe('/points');
      expect(fault.offset).toBeGreaterThan(0);
    }
  });

  it('refuses a file with only unreadable clouds, naming the topic', async () => {
    const bytes = await mcapOf(3, () => Uint8Array.of(0, 1, 0, 0, 9, 9));
    const path = writeFile(join(folder, 'none.mcap'), bytes);
    await expect(playClouds({ path })).rejects.toMatchObject({
      code: 'bad-message',
      topic: '/points',
    });
  });

  it.each([
    ['only magic', Uint8Array.of(0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a)],
    ['a bag without a header', new TextEncoder().encode('#ROSBAG V2.0\n')],
  ])('%s is cut short', async (name, bytes) => {
    const path = writeFile(join(folder, `${name}.bin`), bytes);
    await expect(openRecording(path)).rejects.toMatchObject({
      code: 'truncated',
      message: expect.stringContaining(path),
    });
  });

  it('reports a missing file', async () => {
    await expect(openRecording(join(folder, 'nothing.mcap'))).rejects.toMatchObject({ code: 'unreadable' });
  });
});
