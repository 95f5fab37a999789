import { expect, test } from 'vitest';
import * as z from 'zod/mini';
import { encodeJsonBytes } from '../json.ts';
import {
  applyRobotsChanged,
  MAX_SIGNALING_BYTES,
  type RobotToService,
  robotToServiceCodec,
} from './farpoint.ts';

const offerOf = (sdp: string): RobotToService => ({ type: 'session.offer', session: 's1', sdp });

test('an SDP is bounded, and the largest fits a message', () => {
  const longest = offerOf('x'.repeat(60_000));
  expect(z.safeParse(robotToServiceCodec.schema, longest).success).toBe(true);
  expect(encodeJsonBytes(robotToServiceCodec, longest).length).toBeLessThan(MAX_SIGNALING_BYTES);
  expect(z.safeParse(robotToServiceCodec.schema, offerOf('x'.repeat(60_001))).success).toBe(false);
});

const a = { id: 'a', name: 'A' };
const b = { id: 'b', name: 'B' };

test('appends new robots, keeps the place of renamed ones, removes those that are gone', () => {
  const list = [a, b];
  const renamed = { id: 'a', name: 'Anna' };
  const c = { id: 'c', name: 'C' };
  expect(applyRobotsChanged(list, { here: [c, renamed], gone: [] })).toEqual([renamed, b, c]);
  expect(applyRobotsChanged(list, { here: [], gone: ['a'] })).toEqual([b]);
  expect(list).toEqual([a, b]);
});

test('known robots and unknown removals change nothing', () => {
  expect(applyRobotsChanged([a], { here: [a], gone: ['x'] })).toEqual([a]);
});
