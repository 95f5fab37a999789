import { expect, it } from 'vitest';
import { parseCameras } from './camera-list.ts';

it('reads size, rate and bit rate of each camera', () => {
  expect(parseCameras('1024x768@30:512,1920x1080@60:4096')).toEqual([
    { width: 1024, height: 768, framesPerS: 30, kbitPerS: 512 },
    { width: 1920, height: 1080, framesPerS: 60, kbitPerS: 4096 },
  ]);
});

it.each(['', '1024x768', '1024x768@30', '1024x768@30:512,', 'x@:'])('refuses `%s`', (text) => {
  expect(() => parseCameras(text)).toThrow(/--cameras: /);
});
