/** Messages played along with the clouds: at their times, whatever is done to the playback. */
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import fc from 'fast-check';
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { CloudPlayer } from './cloud-player.ts';
import type { RecordingError } from './errors.ts';
import type { PlayOptions } from './play-options.ts';
import { PlayQueue } from './play-queue.ts';
import type { RecordedMessage } from './recording.ts';
import { POINT_CLOUD2_SCHEMA } from './ros-schemas.ts';
import { FakeClock } from './testing/fake-clock.ts';
import { cloudMessage, mcapOfTopics, START_NS, writeFile } from './testing/files.ts';
import { PLAY_ALL } from './testing/play-clouds.ts';

const folder = useFolder();

const MS = 1_000_000n;
const CLOUDS = 20;
const at = (ms: number) => START_NS + BigInt(ms) * MS;
const text = (value: object) => new TextEncoder().encode(JSON.stringify(value));
const json = { messageEncoding: 'json', schemaEncoding: 'jsonschema' };
const path = join(folder, 'drive.mcap');

/** 10 clouds per second. */
const cloudTopic = (count: number) => ({
  ...{ topic: '/points', type: 'sensor_msgs/msg/PointCloud2', schema: POINT_CLOUD2_SCHEMA },
  messages: Array.from({ length: count }, (_, k) => ({ logNs: at(k * 100), data: cloudMessage(k, 3) })),
});

/** Clouds for 2 s, and texts on two topics; those of /left state their own time, ms. */
beforeAll(async () => {
  const left = Array.from({ length: 67 }, (_, n) => ({
    logNs: at(n * 30 - 15),
    data: text({ ms: n * 30 - 15 }),
  }));
  const right = [140, 150, 1990].map((ms) => ({ logNs: at(ms), data: text({ ms }) }));
  writeFile(
    path,
    await mcapOfTopics([
      cloudTopic(CLOUDS),
      { topic: '/left', type: 'left', ...json, messages: left },
      { topic: '/right', type: 'right', ...json, messages: right },
    ]),
  );
});

interface Event {
  /** `cloud`, or the topic. */
  what: string;
  /** By the clock, and by the recording. */
  atMs: number;
  ofMs: number;
  ageMs: number;
}

const PLAY: PlayOptions = { ...PLAY_ALL, path, along: ['/left', '/right', '/none'] };

/** Plays it, takes every cloud, and returns what was shown when. @param onEvent may control the player */
async function play(
  options: Partial<PlayOptions> = {},
  onEvent: (player: CloudPlayer, events: Event[]) => void = () => {},
  prepare: (player: CloudPlayer) => void = () => {},
) {
  const clock = new FakeClock();
  const player = await CloudPlayer.open({ ...PLAY, ...options }, clock);
  const into = new Float32Array(player.stream.capacity * 4);
  const events: Event[] = [];
  const faults: RecordingError[] = [];
  const add = (event: Event) => {
    events.push(event);
    onEvent(player, events);
  };
  player.onFault = (fault) => faults.push(fault);
  player.onCloud = () => {
    const cloud = player.take(into);
    if (cloud !== null) add({ what: 'cloud', atMs: clock.ms, ofMs: cloudOf(into), ageMs: 0 });
  };
  player.onAlong = ({ topic, data }, dueMs) => {
    const { ms } = topic.decode(data) as { ms: number };
    add({ what: topic.name, atMs: clock.ms, ofMs: ms, ageMs: clock.ms - dueMs });
  };
  prepare(player);
  await player.run();
  await player.close();
  return { events, faults, clock };
}

/** Its points are at (k, i, 1). */
const cloudOf = (points: Float32Array) => Math.round(points[0] as number) * 100;
const of = (events: readonly Event[], what: string) => events.filter((event) => event.what === what);

describe('messages played along', () => {
  it('arrive at their times, in order with the clouds, once each', async () => {
    const { events, faults } = await play();
    expect(faults).toEqual([]);
    expect(of(events, 'cloud')).toHaveLength(CLOUDS);
    expect(of(events, '/left').map(({ ofMs }) => ofMs)).toEqual(
      Array.from({ length: 67 }, (_, n) => n * 30 - 15),
    );
    expect(of(events, '/right').map(({ ofMs }) => ofMs)).toEqual([140, 150, 1990]);
    for (const { what, atMs, ofMs, ageMs } of events) {
      // What precedes the first cloud comes together with it, and states its age.
      expect(atMs - ageMs, what).toBeCloseTo(ofMs, 6);
      expect(ageMs).toBeCloseTo(ofMs < 0 ? 15 : 0, 6);
    }
  });

  it('follow the playing rate', async () => {
    const { events } = await play({ rate: 4 });
    expect(events).toHaveLength(CLOUDS + 70);
    for (const { atMs, ofMs, ageMs } of events) expect(atMs - ageMs).toBeCloseTo(ofMs / 4, 6);
  });

  it('that build on each other begin with the newest that does not, however old', async () => {
    // Every twentieth of /left begins a run: at -15, 585, 1185 and 1785 ms.
    const begins = ({ topic, data }: RecordedMessage) =>
      ((topic.decode(data) as { ms: number }).ms + 15) % 600 === 0;
    let passes = 0;
    const { events } = await play({ fromS: 1.716, along: ['/right'] }, undefined, (player) => {
      player.playRuns(['/left'], begins);
      player.onPass = () => passes++;
    });
    const first = events.findIndex(({ what }) => what === 'cloud');
    expect(events[first]?.ofMs).toBe(1800);
    expect(passes).toBe(1);
    const before = events.slice(0, first).map(({ ofMs, ageMs }) => [ofMs, ageMs]);
    // The message of 1785 ms begins a run, so that nothing before it is needed.
    expect(before).toEqual([[1785, 15]]);
    const early = await play({ fromS: 1.516, along: [] }, undefined, (player) =>
      player.playRuns(['/left'], begins),
    );
    const cloud = early.events.findIndex(({ what }) => what === 'cloud');
    expect(early.events.slice(0, cloud).map(({ ofMs }) => ofMs)).toEqual(
      Array.from({ length: 14 }, (_, n) => 1185 + n * 30),
    );
    for (const { atMs, ofMs, ageMs } of early.events) expect(atMs - ageMs).toBeCloseTo(ofMs - 1600, 6);
  });

  it('begin with the clouds: of earlier messages, only the newest per topic, no older than a second', async () => {
    // Counted from the first message, 15 ms before the first cloud.
    const lead = async (fromS: number) => {
      const { events } = await play({ fromS });
      const first = events.findIndex(({ what }) => what === 'cloud');
      return events.slice(0, first + 1).map(({ what, ofMs, ageMs }) => [what, ofMs, ageMs]);
    };
    expect(await lead(0.616)).toEqual([
      ['/left', 675, 25],
      ['/right', 150, 550],
      ['cloud', 700, 0],
    ]);
    expect(await lead(1.116)).toEqual([
      ['/left', 1185, 15],
      ['cloud', 1200, 0],
    ]);
  });

  it('begin anew at each repetition', async () => {
    const { events } = await play({ atEnd: 'repeat' }, (player, { length }) => {
      if (length === 2 * (CLOUDS + 70)) void player.close();
    });
    const [once, again] = [events.slice(0, CLOUDS + 70), events.slice(CLOUDS + 70)];
    expect(again.map(({ what, ofMs }) => [what, ofMs])).toEqual(once.map(({ what, ofMs }) => [what, ofMs]));
  });

  it('after a seek, none from before it arrives', async () => {
    for (const [when, to] of [
      [250, 1.5],
      [1500, 0.3],
      [1495, 1.49],
      [0, 0],
    ] as const) {
      let jumped = -1;
      const { events } = await play({}, (player, seen) => {
        if (jumped < 0 && (seen.at(-1)?.ofMs ?? -1) >= when) {
          jumped = seen.length;
          player.seek(to);
        }
      });
      const after = events.slice(jumped);
      expect(after.length).toBeGreaterThan(10);
      const firstCloud = after.find(({ what }) => what === 'cloud') as Event;
      expect(firstCloud.ofMs).toBe(Math.ceil((to * 1000) / 100) * 100);
      for (const { atMs, ofMs, ageMs } of after) {
        // Everything is timed relative to that first cloud.
        expect(atMs - ageMs - firstCloud.atMs).toBeCloseTo(ofMs - firstCloud.ofMs, 6);
        expect(ofMs).toBeGreaterThan(firstCloud.ofMs - 1000);
      }
    }
  });

  it('pause with the clouds if nobody takes those', async () => {
    const clock = new FakeClock();
    const player = await CloudPlayer.open(PLAY, clock);
    const into = new Float32Array(player.stream.capacity * 4);
    const seen: number[] = [];
    player.onAlong = ({ topic, data }) => seen.push((topic.decode(data) as { ms: number }).ms);
    const running = player.run();
    // The second cloud is due: there playback pauses, however often other tasks run.
    await vi.waitFor(() => expect(clock.ms).toBe(100), { interval: 1 });
    for (let turn = 0; turn < 100; turn++) await new Promise((resolve) => setImmediate(resolve));
    expect(clock.ms).toBe(100);
    // The first cloud waits for somebody to take it; playback continued up to the second.
    expect(Math.max(...seen)).toBe(75);
    clock.ms += 60_000;
    const paused = seen.length;
    player.onCloud = () => player.take(into);
    player.skip();
    await running;
    expect(seen.slice(paused)[0]).toBe(105);
    expect(seen).toHaveLength(70);
    await player.close();
  });

  it('are skipped if nobody wants them, even if that changes during playback', async () => {
    const { events } = await play({}, (player, seen) => {
      const now = seen.at(-1)?.ofMs ?? 0;
      player.wantsAlong = (topic) => topic === '/right' || now > 500;
    });
    expect(of(events, '/right')).toHaveLength(3);
    const left = of(events, '/left').map(({ ofMs }) => ofMs);
    // What had been read ahead before the change, and what was read after it.
    expect(left.filter((ms) => ms > 150 && ms < 500)).toEqual([]);
    expect(left.filter((ms) => ms > 700)).toHaveLength(43);
  });

  it('reports an unreadable message with topic and byte, and plays the rest', async () => {
    const bad = Array.from({ length: 10 }, (_, k) => ({
      logNs: at(k * 100 + 50),
      data: k % 2 === 0 ? text({ ms: k * 100 + 50 }) : new TextEncoder().encode('{"ms"'),
    }));
    const broken = writeFile(
      join(folder, 'broken.mcap'),
      await mcapOfTopics([cloudTopic(10), { topic: '/left', type: 'left', ...json, messages: bad }]),
    );
    const { events, faults } = await play({ path: broken });
    expect(of(events, 'cloud')).toHaveLength(10);
    expect(of(events, '/left')).toHaveLength(5);
    expect(faults).toHaveLength(5);
    for (const fault of faults) {
      expect(fault).toMatchObject({ name: 'RecordingError', code: 'bad-message', topic: '/left' });
      expect(fault.offset).toBeGreaterThan(0);
      expect(fault.message).toContain(broken);
    }
  });
});

describe('PlayQueue', () => {
  const message = (ms: number, bytes: number): RecordedMessage => ({
    topic: { name: '/left', type: '', messages: null, decode: () => null },
    ...{ logNs: at(ms), data: new Uint8Array(bytes).fill(ms), offset: 0 },
  });

  it('returns messages in order of time, drops the oldest when full, but never the cloud', () => {
    const step = fc.record({ ms: fc.nat(200), bytes: fc.nat(40) });
    fc.assert(
      fc.property(fc.array(step, { maxLength: 30 }), fc.nat(29), (steps, cloudAt) => {
        const queue = new PlayQueue(100);
        let along = 0;
        steps.forEach(({ ms, bytes }, i) => {
          if (i === cloudAt) queue.pushCloud(message(ms, 500));
          else {
            along++;
            const before = queue.dropped;
            expect(queue.pushAlong(message(ms, bytes)) === null).toBe(queue.dropped === before);
          }
        });
        const given: { logNs: bigint; bytes: number; isCloud: boolean }[] = [];
        for (let next = queue.take(null); next !== null; next = queue.take(null))
          given.push({ logNs: next.message.logNs, bytes: next.message.data.length, isCloud: next.isCloud });
        expect(given.filter(({ isCloud }) => isCloud)).toHaveLength(cloudAt < steps.length ? 1 : 0);
        expect(given.filter(({ isCloud }) => !isCloud).length + queue.dropped).toBe(along);
        const bytes = given.reduce((sum, each) => sum + (each.isCloud ? 0 : each.bytes), 0);
        expect(bytes).toBeLessThanOrEqual(100);
        for (let i = 1; i < given.length; i++)
          expect(given[i]?.logNs).toBeGreaterThanOrEqual(given[i - 1]?.logNs ?? 0n);
      }),
    );
  });

  it('keeps a copy, because the file’s memory is reused', () => {
    const queue = new PlayQueue();
    const data = Uint8Array.of(1, 2, 3);
    queue.pushAlong({ ...message(0, 0), data });
    data.fill(9);
    expect(queue.take(null)?.message.data).toEqual(Uint8Array.of(1, 2, 3));
    expect(queue.take(null)).toBeNull();
  });
});
