import { compose, rotate } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { bodyToOptical } from './open-source.ts';
import { STATIC_CAMERA_POSE } from './playback-source.ts';

describe('playback', () => {
  it('a camera without poses looks along +x, with the sky above', () => {
    const { orientation } = STATIC_CAMERA_POSE;
    const forward = rotate(orientation, { x: 0, y: 0, z: 1 });
    const down = rotate(orientation, { x: 0, y: 1, z: 0 });
    expect([forward.x, forward.y, forward.z].map((c) => Math.round(c) + 0)).toEqual([1, 0, 0]);
    expect([down.x, down.y, down.z].map((c) => Math.round(c) + 0)).toEqual([0, 0, -1]);
  });

  it('a point in the body frame keeps its place, one metre up', () => {
    const points = Float32Array.of(5, 2, -1, 0);
    bodyToOptical(points);
    const [x, y, z] = points as unknown as [number, number, number];
    const { position } = compose(STATIC_CAMERA_POSE, {
      position: { x, y, z },
      orientation: { x: 0, y: 0, z: 0, w: 1 },
    });
    expect([position.x, position.y, position.z].map(Math.round)).toEqual([5, 2, 0]);
  });
});
