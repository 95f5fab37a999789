import { expect, test } from 'vitest';
import { NO_BENCH, readBenchSettings } from './bench-settings.ts';

const read = (query: string) => readBenchSettings(new URLSearchParams(query));

test('an address that asks for nothing gives the page as people see it, but no first drive in the way of a test', () => {
  expect(read('robot=sim-1')).toEqual({ ...NO_BENCH, tour: false });
  expect(NO_BENCH.tour).toBe(true);
});

test('reads what tests and benchmarks ask for', () => {
  expect(read('canvas=640x360&measure=1&every=8&barcode=1&tour=1')).toEqual({
    canvas: { width: 640, height: 360 },
    measure: true,
    drawEvery: 8,
    barcode: true,
    tour: true,
  });
});

test('waits for the GPU only where a time is measured', () => {
  expect(read('canvas=320x180').measure).toBe(false);
});

test.each(['640', '0x0', '99999x5', '64x64x64', '-1x50'])('ignores the canvas size %s', (canvas) => {
  expect(read(`canvas=${canvas}`).canvas).toBeNull();
});

test.each(['0', '1.5', '1025', 'all', ''])('ignores every=%s', (every) => {
  expect(read(`every=${every}`).drawEvery).toBeNull();
});
