import type { CloudView } from '@farpoint/cloud-view';
import { signal } from '@preact/signals-core';
import { describe, expect, it } from 'vitest';
import type { Switches } from '../state/switches.ts';
import { SensorClouds, type SensorCloudsParts } from './sensor-clouds.ts';

describe('SensorClouds', () => {
  it.each([
    { isSurface: true, isThinned: false, drawn: 4 },
    { isSurface: false, isThinned: true, drawn: 12 },
    // Samples are all drawn, however slow the computer is.
    { isSurface: false, isThinned: false, drawn: 1 },
  ])('says what part of the first sensor’s cloud is drawn: %o', ({ drawn, ...first }) => {
    const parts: Pick<SensorCloudsParts, 'first' | 'sensors' | 'pointScale'> = {
      first: { ...first, colouring: {} } as CloudView,
      sensors: { all: signal([]) } as unknown as Switches,
      pointScale: signal(1),
    };
    expect(new SensorClouds(parts as SensorCloudsParts).drawnOneOf(12)).toBe(drawn);
  });
});
