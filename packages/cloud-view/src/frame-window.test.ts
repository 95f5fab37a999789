import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FrameWindow, MAX_RUNS } from './frame-window.ts';

/** The ring's vertices as on the GPU: `frame:offset` of each point's packet. */
class Ring {
  readonly window: FrameWindow;
  #cells: string[] = [];

  constructor(capacity: number, maxCapacity = capacity) {
    this.window = new FrameWindow(capacity, maxCapacity);
  }

  take(frame: number, packets: number, index: number, points = 2): string | null {
    const move = this.window.reserve(points);
    if (move !== null) {
      expect(move.from >= move.count || move.capacity > this.#cells.length).toBe(true);
      const live = this.#cells.slice(move.from, move.from + move.count);
      this.#cells = live;
      expect(this.window.tail + points).toBeLessThanOrEqual(move.capacity);
    }
    const at = this.window.tail;
    const drop = this.window.accept(frame, packets * points * 8, index * points * 8, points * 8);
    if (drop === null) {
      expect(this.window.tail).toBe(at + points);
      for (let i = 0; i < points; i++) this.#cells[at + i] = `${frame}:${index}`;
    } else {
      expect(this.window.tail).toBe(at);
    }
    return drop;
  }

  /** Packets drawn, each with the slot of its pose. */
  drawn(): Map<string, number> {
    const drawn = new Map<string, number>();
    for (let vertex = this.window.head; vertex < this.window.tail; vertex++) {
      const slot = this.window.slotOf(vertex);
      if (slot !== null) drawn.set(this.#cells[vertex] as string, slot);
    }
    return drawn;
  }

  names(): string[] {
    return [...this.drawn().keys()];
  }
}

describe('FrameWindow', () => {
  test('a frame ends with its last packet or when the next one begins, even if packets were lost', () => {
    const ring = new Ring(64);
    expect(ring.window.endedFrame).toBe(null);
    ring.take(7, 3, 0);
    expect(ring.window.endedFrame).toBe(null);
    ring.take(7, 3, 2);
    expect(ring.window.endedFrame).toBe(7);
    ring.take(8, 3, 0);
    expect(ring.window.endedFrame).toBe(7);
    ring.take(9, 3, 0);
    expect(ring.window.endedFrame).toBe(8);
    ring.take(9, 3, 2);
    expect(ring.window.endedFrame).toBe(9);
  });

  test('frame numbers wrap', () => {
    const ring = new Ring(64);
    ring.take(0xffffffff, 1, 0);
    ring.take(0, 1, 0);
    expect(ring.names()).toEqual(['0:0']);
    expect(ring.take(0xfffffffe, 1, 0)).toBe('late');
  });

  test('the ring grows as frames need it, up to its largest size', () => {
    const ring = new Ring(8, 64);
    for (let frame = 0; frame < 5; frame++) for (let i = 0; i < 8; i++) ring.take(frame, 8, i);
    expect(ring.window.capacity).toBe(64);
    expect(ring.names()).toEqual(Array.from({ length: 8 }, (_, i) => `4:${i}`));
  });

  test('starts over instead of overrunning if frames exceed the largest ring', () => {
    const ring = new Ring(16, 16);
    for (let i = 0; i < 50; i++) expect(ring.take(0, 50, i)).toBe(null);
    expect(ring.window.tail).toBeLessThanOrEqual(16);
  });

  test('agrees with the plain rule for any order of arrival', () => {
    const frames = fc.array(fc.integer({ min: 1, max: 12 }), { minLength: 1, maxLength: 8 });
    const anyArrival = frames.chain((sizes) => {
      const packets = sizes.flatMap((size, frame) =>
        Array.from({ length: size }, (_, index) => ({ frame, size, index })),
      );
      return fc
        .array(fc.record({ lost: fc.boolean(), delay: fc.integer({ min: 0, max: 9 }) }), {
          minLength: packets.length,
          maxLength: packets.length,
        })
        .map((fates) =>
          packets
            .map((packet, i) => ({ ...packet, ...fates[i]!, at: i + fates[i]!.delay }))
            .filter((packet) => !packet.lost || packet.index % 3 !== 0)
            .sort((a, b) => a.at - b.at),
        );
    });
    fc.assert(
      fc.property(anyArrival, (packets) => {
        const ring = new Ring(64, 256);
        const model = new PlainRule();
        for (const { frame, size, index } of packets) {
          const runsWereFull = ring.window.runCount >= MAX_RUNS - 3;
          const drop = ring.take(frame, size, index);
          // Another test covers what happens when all runs are in use.
          fc.pre(!runsWereFull && drop !== 'window-full');
          expect(drop).toBe(model.take(frame, size, index));
          expect(new Set(ring.names())).toEqual(model.drawn);
          // One pose per frame, never shared.
          const slots = new Map<string, Set<number>>();
          for (const [name, slot] of ring.drawn()) {
            const of = name.split(':')[0]!;
            slots.set(of, (slots.get(of) ?? new Set()).add(slot));
          }
          expect([...slots.values()].every((set) => set.size === 1)).toBe(true);
          expect(slots.size).toBe(new Set([...slots.values()].flatMap((set) => [...set])).size);
        }
      }),
      longProperty(7, 500),
    );
  });

  test('packets of the newest frame are never refused, even if all runs are in use', () => {
    const ring = new Ring(1024);
    ring.take(0, 100, 0);
    ring.take(1, 100, 0);
    for (let i = 1; i < 90; i++) {
      expect([null, 'window-full']).toContain(ring.take(0, 100, 99));
      expect(ring.take(1, 100, i)).toBe(null);
    }
    expect(ring.window.runCount).toBeLessThanOrEqual(MAX_RUNS);
    expect(ring.names().filter((name) => name.startsWith('1:'))).toHaveLength(90);
    for (let i = 0; i < 100; i++) expect(ring.take(2, 100, i)).toBe(null);
    expect(ring.names()).toHaveLength(100);
  });
});

/** The rule of frame-window.ts in its simplest form. */
class PlainRule {
  #newest = -1;
  #previous = -1;
  #progress = 0;
  #packets: { frame: number; size: number; index: number }[] = [];

  take(frame: number, size: number, index: number): string | null {
    if (frame < this.#newest) {
      if (frame !== this.#previous) return 'late';
      if (index / size < this.#progress) return 'superseded';
    }
    if (frame > this.#newest) {
      this.#previous = this.#newest;
      this.#newest = frame;
      this.#progress = 0;
    }
    if (frame === this.#newest) this.#progress = Math.max(this.#progress, (index + 1) / size);
    this.#packets.push({ frame, size, index });
    return null;
  }

  get drawn(): Set<string> {
    const drawn = this.#packets.filter(
      ({ frame, size, index }) =>
        frame === this.#newest || (frame === this.#previous && index / size >= this.#progress),
    );
    return new Set(drawn.map(({ frame, index }) => `${frame}:${index}`));
  }
}
