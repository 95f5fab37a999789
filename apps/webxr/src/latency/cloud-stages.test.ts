import fc from 'fast-check';
import { expect, test } from 'vitest';
import { cloudStages } from './cloud-stages.ts';

const frame = { frames: 9, framesSeen: 9, firstPacketMs: 30, furtherPacketsMs: 5, drawMs: 12, totalMs: 47 };
const robot = { captureMs: 8, sampleMs: 3, packMs: 1, sendMs: 20 };

test('the robot’s measurements split what the page sees as one', () => {
  expect(cloudStages(frame, robot, 2000)).toEqual({
    ...{ captureMs: 8, encodeMs: 4, wayMs: 18, furtherMs: 5, decodeMs: 2, drawMs: 10 },
  });
});

test('what is not known stays part of the whole', () => {
  const whole = { captureMs: null, encodeMs: null, wayMs: 30, furtherMs: 5, decodeMs: null, drawMs: 12 };
  expect(cloudStages(frame, null, 0)).toEqual(whole);
  expect(cloudStages(frame, { ...robot, captureMs: 31 }, 12_001)).toEqual(whole);
});

test('whatever is measured, the stages add up and only the way may be negative', () => {
  const ms = fc.double({ min: 0, max: 1e4, noNaN: true });
  const first = fc.double({ min: -20, max: 1e4, noNaN: true });
  const stages = fc.record({ captureMs: ms, sampleMs: ms, packMs: ms, sendMs: ms });
  fc.assert(
    fc.property(
      first,
      ms,
      ms,
      fc.option(stages),
      ms,
      (firstPacketMs, furtherPacketsMs, drawMs, robot, decodeUs) => {
        const totalMs = firstPacketMs + furtherPacketsMs + drawMs;
        const made = cloudStages(
          { ...frame, firstPacketMs, furtherPacketsMs, drawMs, totalMs },
          robot,
          decodeUs,
        );
        const sum = Object.values(made).reduce<number>((sum, stage) => sum + (stage ?? 0), 0);
        expect(sum).toBeCloseTo(totalMs, 6);
        for (const stage of [made.captureMs, made.encodeMs, made.furtherMs, made.decodeMs, made.drawMs])
          expect(stage ?? 0).toBeGreaterThanOrEqual(0);
      },
    ),
    { seed: 23 },
  );
});
