import { Registry } from 'prom-client';
import { describe, expect, it } from 'vitest';
import { PulledMetrics } from './pulled-metrics.ts';

describe('PulledMetrics', () => {
  it('reads each value anew for each request', async () => {
    const registry = new Registry();
    const metrics = new PulledMetrics(registry, 'rover');
    let value = 1;
    metrics.sum('frames', 'Frames', () => value);
    metrics.gauge('operators', 'Operators', () => value * 2);
    expect(await registry.metrics()).toContain('rover_frames_total 1\n');
    value = 5;
    const text = await registry.metrics();
    expect(text).toContain('# HELP rover_frames_total Frames\n# TYPE rover_frames_total counter');
    expect(text).toContain('rover_frames_total 5\n');
    expect(text).toContain('# TYPE rover_operators gauge\nrover_operators 10\n');
  });

  it('labels values, forgets labels that are gone, and adds up duplicates', async () => {
    const registry = new Registry();
    const metrics = new PulledMetrics(registry, 'rover');
    let counts: [string, number][] = [
      ['late', 2],
      ['lost', 3],
    ];
    metrics.sums('drops', 'Drops', 'reason', () => counts);
    metrics.gauges('queue', 'Queue', 'reason', () => counts);
    const before = await registry.metrics();
    expect(before).toContain('rover_drops_total{reason="late"} 2\nrover_drops_total{reason="lost"} 3');
    counts = [
      ['late', 4],
      ['late', 1],
    ];
    const after = await registry.metrics();
    expect(after).toContain('rover_queue{reason="late"} 5\n');
    expect(after).not.toContain('lost');
  });
});
