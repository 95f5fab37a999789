import { describe, expect, test } from 'vitest';
import { renderChart } from './chart.ts';
import { linearScale, roundStep, tickLabel } from './scale.ts';

describe('linearScale', () => {
  test('widens to round numbers and marks them', () => {
    const scale = linearScale([0.3, 9.7], [0, 100], 5);
    expect([scale.low, scale.high]).toEqual([0, 10]);
    expect(scale.ticks()).toEqual([0, 2, 4, 6, 8, 10]);
    expect(scale.pixel(5)).toBe(50);
  });

  test('keeps an exact range', () => {
    const scale = linearScale([0.5, 9.7], [0, 92], 5, true);
    expect(scale.ticks()).toEqual([2, 4, 6, 8]);
    expect(scale.pixel(9.7)).toBe(92);
  });

  test('has ticks without rounding errors, and accepts an empty range', () => {
    expect(linearScale([0, 0.7], [0, 1], 7).ticks()).toEqual([0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    expect(linearScale([3, 3], [0, 1], 4).pixel(3)).toBe(0);
  });
});

test.each([
  [0.7, 1],
  [1, 1],
  [1.1, 2],
  [30, 50],
  [0.06, 0.1],
])('the round step of at least %d is %d', (least, step) => {
  expect(roundStep(least)).toBeCloseTo(step, 12);
});

test('tick labels are short', () => {
  expect([0, 0.25, 9000, 12_500, 3e6].map(tickLabel)).toEqual(['0', '0.25', '9000', '12.5k', '3M']);
});

test('a chart draws its series, breaks lines at gaps and escapes texts', () => {
  const svg = renderChart({
    title: 'a < b & "c"',
    panels: [
      {
        xLabel: 's',
        yLabel: 'ms',
        series: [{ label: 'latency', x: [0, 1, 2, 3], y: [1, 2, Number.NaN, 4] }],
        spans: [{ from: 1, to: 2, label: 'outage' }],
      },
    ],
  });
  expect(svg.startsWith('<svg xmlns="http://www.w3.org/2000/svg"')).toBe(true);
  expect(svg).toContain('a &lt; b &amp; &quot;c&quot;');
  expect(svg).not.toContain('NaN');
  expect(svg).toContain('outage');
  const line = /<path d="([^"]*)" fill="none" stroke="#0072b2"/.exec(svg)?.[1] ?? '';
  expect(line.match(/M/g)).toHaveLength(2);
});
