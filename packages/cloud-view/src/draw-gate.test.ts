import { describe, expect, it } from 'vitest';
import { DrawGate } from './draw-gate.ts';

function gateWithCost(costMs: number): DrawGate {
  const gate = new DrawGate();
  for (let i = 0; i < 50; i++) gate.onCost(costMs);
  return gate;
}

describe('DrawGate', () => {
  it('lets a fast machine draw every fragment', () => {
    const gate = gateWithCost(3);
    gate.onDraw(5, 100);
    expect(gate.mayDraw(5, 101)).toBe(true);
  });

  it('makes a slow machine wait for the next whole frame', () => {
    const gate = gateWithCost(30);
    gate.onDraw(5, 100);
    expect(gate.mayDraw(5, 120)).toBe(false);
    expect(gate.mayDraw(6, 121)).toBe(true);
  });

  it('waits only briefly for a frame that lost a packet, or while nothing arrives', () => {
    const gate = gateWithCost(30);
    gate.onDraw(5, 100);
    expect(gate.mayDraw(5, 149)).toBe(false);
    expect(gate.mayDraw(5, 150)).toBe(true);
  });

  it('says what a picture costs', () => {
    expect(new DrawGate().costMs).toBe(0);
    expect(gateWithCost(30).costMs).toBeCloseTo(30, 2);
  });

  it('draws before it knows any cost', () => {
    expect(new DrawGate().mayDraw(null, 0)).toBe(true);
  });

  it('recovers from a slow period', () => {
    const gate = gateWithCost(30);
    for (let i = 0; i < 20; i++) gate.onCost(2);
    gate.onDraw(5, 100);
    expect(gate.mayDraw(5, 101)).toBe(true);
  });
});
