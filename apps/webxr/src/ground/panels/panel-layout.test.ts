import fc from 'fast-check';
import { expect, test } from 'vitest';
import { type Box, boxOf, moved, placementOf, resized } from './panel-layout.ts';

const area: Box = { left: 0, top: 60, width: 1000, height: 500 };
const shape = { aspect: 4 / 3, besides: 30, border: 0 };

test('a panel that is moved stays where it is put, and within the area', () => {
  const box = boxOf({ x: 0, y: 0, width: 400 }, shape, area);
  expect(box).toEqual({ left: 0, top: 60, width: 400, height: 330 });
  expect(boxOf(moved(box, 30, 40, area), shape, area)).toEqual({ ...box, left: 30, top: 100 });
  expect(boxOf(moved(box, -50, 9999, area), shape, area)).toMatchObject({ left: 0, top: 230 });
});

test('a panel at an edge stays at the edge of another screen', () => {
  const atRight = { x: 1, y: 1, width: 400 };
  const small: Box = { left: 0, top: 60, width: 500, height: 300 };
  const box = boxOf(atRight, shape, small);
  expect(box.left + box.width).toBeCloseTo(500);
  expect(box.top + box.height).toBeCloseTo(360);
  // Its height leaves no room for 400 pixels; on a larger screen it has them again.
  expect(box.width).toBeCloseTo(360);
  expect(boxOf(atRight, shape, area).width).toBe(400);
});

test('a panel grows from its corner and keeps its sides’ ratio', () => {
  const box = boxOf({ x: 0.5, y: 0, width: 300 }, shape, area);
  const larger = boxOf(resized(box, shape, 60, area), shape, area);
  expect(larger.width).toBe(360);
  expect(larger.left).toBeCloseTo(box.left);
  expect((larger.height - shape.besides) * shape.aspect).toBeCloseTo(larger.width);
  expect(boxOf(resized(box, shape, -9999, area), shape, area).width).toBe(140);
});

test('the border is no part of the picture', () => {
  const box = boxOf({ x: 0, y: 0, width: 402 }, { ...shape, border: 2 }, area);
  expect(box.height).toBeCloseTo(330);
});

test('is within the area whatever was stored and whatever the screen', () => {
  const share = fc.double({ min: 0, max: 1, noNaN: true });
  const size = fc.integer({ min: 0, max: 4000 });
  fc.assert(
    fc.property(
      share,
      share,
      size,
      size,
      size,
      fc.constantFrom(null, 0.5, 1.5, 3),
      (x, y, width, w, h, aspect) => {
        const screen: Box = { left: 10, top: 60, width: w, height: h };
        const besides = Math.min(30, h);
        const box = boxOf({ x, y, width }, { aspect, besides, border: 2 }, screen);
        expect(box.left).toBeGreaterThanOrEqual(10 - 1e-9);
        expect(box.top).toBeGreaterThanOrEqual(60 - 1e-9);
        expect(box.left + box.width).toBeLessThanOrEqual(10 + w + 1e-6);
        expect(box.top + box.height).toBeLessThanOrEqual(60 + h + 1e-6);
        const again = boxOf(placementOf(box, screen), { aspect, besides, border: 2 }, screen);
        if (box.width >= 140) expect(again.left).toBeCloseTo(box.left, 6);
      },
    ),
  );
});
