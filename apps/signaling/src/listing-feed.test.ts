import { describe, expect, test } from 'vitest';
import { ListingFeed } from './listing-feed.ts';
import { FakeClock, FakePeer } from './test-support.ts';

function setup(options: { sliceBytes?: number; bytesPerSecond?: number } = {}) {
  const clock = new FakeClock();
  const listing = {
    version: 0,
    whole: () => encode({ version: listing.version }),
    since: (version: number) => encode({ since: version, version: listing.version }),
  };
  const feed = new ListingFeed({
    clock,
    listing,
    intervalMs: 100,
    bytesPerSecond: options.bytesPerSecond ?? 1e9,
    ...(options.sliceBytes === undefined ? {} : { sliceBytes: options.sliceBytes }),
  });
  const change = () => {
    listing.version++;
    feed.changed();
  };
  const add = () => {
    const peer = new FakePeer();
    feed.add(peer);
    return peer;
  };
  return { clock, feed, change, add };
}

function encode(message: object): Uint8Array {
  return new TextEncoder().encode(JSON.stringify(message));
}

function versions(peer: FakePeer): unknown[] {
  return peer.take().map((message) => message.version);
}

describe('listing feed', () => {
  test('sends a new subscriber the list immediately, and then everything that it lacks', () => {
    const { clock, change, add } = setup();
    const peer = add();
    expect(peer.take()).toEqual([{ version: 0 }]);
    change();
    clock.advance(0);
    change();
    change();
    clock.advance(100);
    expect(peer.take()).toEqual([
      { since: 0, version: 1 },
      { since: 1, version: 3 },
    ]);
    expect(add().take()).toEqual([{ version: 3 }]);
  });

  test('sends a first change immediately, and further ones together after the interval', () => {
    const { clock, change, add } = setup();
    const peer = add();
    versions(peer);
    change();
    clock.advance(0);
    expect(versions(peer)).toEqual([1]);
    for (let i = 0; i < 50; i++) change();
    clock.advance(99);
    expect(versions(peer)).toEqual([]);
    clock.advance(1);
    expect(versions(peer)).toEqual([51]);
    clock.advance(10_000);
    expect(versions(peer)).toEqual([]);
  });

  test('2,000 changes in 2 s make at most 20 messages for each of many operators', () => {
    const { clock, change, add } = setup();
    const peers = Array.from({ length: 30 }, add);
    for (const peer of peers) versions(peer);
    for (let i = 0; i < 2000; i++) {
      change();
      clock.advance(1);
    }
    clock.advance(200);
    for (const peer of peers) {
      const seen = versions(peer);
      expect(seen.length).toBeLessThanOrEqual(21);
      expect(seen.at(-1)).toBe(2000);
    }
  });

  test('sends a big round in slices within the byte rate, and everybody ends with the newest list', () => {
    // Each list counts for about 4.1 kB: two per slice, 100 kB/s.
    const { clock, change, add } = setup({ sliceBytes: 8000, bytesPerSecond: 100_000 });
    const peers = Array.from({ length: 10 }, add);
    for (const peer of peers) versions(peer);
    change();
    clock.advance(0);
    expect(peers.flatMap(versions)).toEqual([1, 1]);
    change(); // in the middle of a round: the rest already get the newer list
    clock.advance(85);
    expect(peers.flatMap(versions)).toEqual([2, 2]);
    clock.advance(2000);
    expect(peers.flatMap(versions)).toEqual([2, 2, 2, 2, 2, 2, 2, 2]);
  });

  test('skips a peer that does not read, and later sends it the newest list', () => {
    const { clock, change, add } = setup();
    const [slow, fast] = [add(), add()];
    versions(slow);
    versions(fast);
    slow.backlog = 100_000;
    change();
    clock.advance(300);
    change();
    clock.advance(300);
    expect([versions(slow), versions(fast)]).toEqual([[], [1, 2]]);
    slow.backlog = 0;
    clock.advance(100);
    expect(versions(slow)).toEqual([2]);
  });

  test('forgets peers that left, and does nothing once stopped', () => {
    const { clock, change, add, feed } = setup();
    const [gone, here] = [add(), add()];
    versions(gone);
    versions(here);
    feed.remove(gone);
    change();
    clock.advance(0);
    expect([versions(gone), versions(here)]).toEqual([[], [1]]);
    change();
    feed.stop();
    clock.advance(1000);
    expect(versions(here)).toEqual([]);
    expect(clock.pending).toBe(0);
  });
});
