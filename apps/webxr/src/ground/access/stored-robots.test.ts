import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { parseRobotKeys, robotKeysText, StoredRobots, withRobotKey } from './stored-robots.ts';

const [a, b] = ['a'.repeat(43), 'b'.repeat(43)];
const HERE = 'wss://robots.example';

describe('robots’ keys', () => {
  it('are read as they were written, for each service by itself', () => {
    let keys = withRobotKey(new Map(), HERE, 'r1', a);
    keys = withRobotKey(keys, 'wss://other.example', 'r1', b);
    keys = withRobotKey(keys, HERE, 'r2', b);
    const read = parseRobotKeys(robotKeysText(keys));
    expect(read).toEqual(keys);
    expect(read.get(HERE)?.get('r1')).toBe(a);
    expect(withRobotKey(withRobotKey(keys, HERE, 'r1', null), HERE, 'r2', null).has(HERE)).toBe(false);
  });

  it('are none in any other text, which never throws', () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (text) => {
        expect(parseRobotKeys(text)).toBeInstanceOf(Map);
      }),
    );
    for (const text of [null, '', '[[1,2]]', `[["${HERE}",[["r1","short"]]]]`, '{"keys":[]}'])
      expect(parseRobotKeys(text).size).toBe(0);
  });

  it('are forgotten oldest first beyond a bound', () => {
    let keys = withRobotKey(new Map(), HERE, 'first', a);
    for (let i = 0; i < 256; i++) keys = withRobotKey(keys, HERE, `r${i}`, a);
    expect([keys.get(HERE)?.size, keys.get(HERE)?.has('first')]).toEqual([256, false]);
  });
});

describe('in the browser', () => {
  const stored = new Map<string, string>();
  beforeEach(() => {
    stored.clear();
    vi.stubGlobal('localStorage', {
      getItem: (key: string) => stored.get(key) ?? null,
      setItem: (key: string, value: string) => stored.set(key, value),
    });
  });
  afterEach(() => vi.unstubAllGlobals());

  it('a robot is known to every tab, until it is forgotten', () => {
    const [one, two] = [new StoredRobots(HERE), new StoredRobots(HERE)];
    one.remember('r1', a);
    expect([two.get('r1'), new StoredRobots('wss://other.example').get('r1')]).toEqual([a, undefined]);
    two.forget('r1');
    expect([one.get('r1'), one.all().size]).toEqual([undefined, 0]);
  });

  it('a robot is known for this visit where nothing can be stored', () => {
    vi.stubGlobal('localStorage', {
      getItem: () => {
        throw new Error('denied');
      },
      setItem: () => {
        throw new Error('denied');
      },
    });
    const robots = new StoredRobots(HERE);
    robots.remember('r1', a);
    robots.remember('r2', b);
    expect([...robots.all()]).toEqual([
      ['r1', a],
      ['r2', b],
    ]);
  });
});
