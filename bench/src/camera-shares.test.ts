import { describe, expect, it } from 'vitest';
import { parseShares, sharesSeen } from './camera-shares.ts';

describe('shares of the link', () => {
  it('are read as weights of the clouds and of each camera', () => {
    expect(parseShares('4:2,1', 2)).toEqual({ cloud: 4, videos: [2, 1] });
    for (const wrong of ['4', '4:', '4:1,x', '4:1', '4:1,2,3'])
      expect(() => parseShares(wrong, 2)).toThrow(wrong);
  });

  it('are compared with what was sent', () => {
    expect(sharesSeen({ cloud: 2, videos: [1, 1] }, 2000, [1000, 1000])).toEqual([
      { stream: 'clouds', asked: 0.5, seen: 0.5 },
      { stream: 'camera 1', asked: 0.25, seen: 0.25 },
      { stream: 'camera 2', asked: 0.25, seen: 0.25 },
    ]);
  });
});
