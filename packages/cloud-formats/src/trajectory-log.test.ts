import { rotate } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { parseTrajectoryLog, TrajectoryError } from './trajectory-log.ts';

const quarterTurn = '0 0 1\n0 -1 0 1\n1 0 0 2\n0 0 1 -0.3\n0 0 0 1\n';

describe('parseTrajectoryLog', () => {
  it('reads camera-to-world matrices', () => {
    const [pose] = parseTrajectoryLog(quarterTurn);
    expect(pose?.position).toEqual({ x: 1, y: 2, z: -0.3 });
    const turned = rotate(pose!.orientation, { x: 1, y: 0, z: 0 });
    expect(turned.x).toBeCloseTo(0);
    expect(turned.y).toBeCloseTo(1);
  });

  it('computes the quaternion of any rotation', () => {
    const component = fc.double({ min: -1, max: 1, noNaN: true });
    fc.assert(
      fc.property(fc.tuple(component, component, component, component), ([a, b, c, d]) => {
        const norm = Math.hypot(a, b, c, d);
        fc.pre(norm > 0.1);
        const q = { x: a / norm, y: b / norm, z: c / norm, w: d / norm };
        const [i, j, k] = [
          rotate(q, { x: 1, y: 0, z: 0 }),
          rotate(q, { x: 0, y: 1, z: 0 }),
          rotate(q, { x: 0, y: 0, z: 1 }),
        ] as const;
        const rows = (['x', 'y', 'z'] as const).map((axis) => `${i[axis]} ${j[axis]} ${k[axis]} 0`);
        const [pose] = parseTrajectoryLog(`0 0 1\n${rows.join('\n')}\n0 0 0 1\n`);
        const o = pose!.orientation;
        // q and −q are the same rotation.
        expect(Math.abs(o.x * q.x + o.y * q.y + o.z * q.z + o.w * q.w)).toBeCloseTo(1, 6);
      }),
      { seed: 5 },
    );
  });

  it.each([
    ['ends within a matrix', '0 0 1\n1 0 0 0\n', 2],
    ['a missing number', quarterTurn.replace('0 0 1 -0.3', '0 0 1'), 4],
    ['a word', quarterTurn.replace('0 0 1 -0.3', '0 0 one 2'), 4],
    ['a scaled matrix', quarterTurn.replace('0 0 1 -0.3', '0 0 2 -0.3'), 1],
    ['a mirror', quarterTurn.replace('0 0 1 -0.3', '0 0 -1 -0.3'), 1],
    ['a perspective row', quarterTurn.replace('0 0 0 1\n', '0 0 1 1\n'), 1],
  ])('refuses %s', (_, text, line) => {
    expect(() => parseTrajectoryLog(text)).toThrow(
      expect.objectContaining({ name: 'TrajectoryError', line }),
    );
  });

  it('any input is parsed or throws a TrajectoryError', () => {
    const token = fc.constantFrom('0', '1', '-1', 'nan', '1e-005', '\n', ' ', 'x', '0 0 0 1\n', '1 0 0 0\n');
    fc.assert(
      fc.property(fc.array(token, { maxLength: 40 }), (tokens) => {
        try {
          parseTrajectoryLog(tokens.join(' '));
        } catch (error) {
          expect(error).toBeInstanceOf(TrajectoryError);
        }
      }),
      { seed: 6 },
    );
  });
});
