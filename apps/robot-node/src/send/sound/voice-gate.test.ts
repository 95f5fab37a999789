import { describe, expect, it } from 'vitest';
import { VoiceGate } from './voice-gate.ts';

describe('the gate of a voice', () => {
  it('opens with the first packet while the driver holds the key, and closes when it lets go', () => {
    const gate = new VoiceGate();
    expect(gate.packet(true, 0)).toBe(false);
    gate.hold(true, 0);
    expect(gate.state(true, 10)).toBe('closed');
    expect(gate.packet(true, 10)).toBe(true);
    expect(gate.state(true, 20)).toBe('open');
    gate.hold(false, 30);
    expect(gate.state(true, 30)).toBe('closed');
    expect(gate.packet(true, 31)).toBe(false);
  });

  it('stays closed for an operator who does not drive, and for the driver who loses the lease', () => {
    const gate = new VoiceGate();
    gate.hold(true, 0);
    expect(gate.packet(false, 10)).toBe(false);
    expect(gate.state(false, 10)).toBe('not-driving');
    expect(gate.packet(true, 20)).toBe(true);
    expect(gate.packet(false, 40)).toBe(false);
    expect(gate.state(false, 40)).toBe('not-driving');
  });

  it('closes after 200 ms without a packet, until the operator says again that it holds the key', () => {
    const gate = new VoiceGate();
    gate.hold(true, 0);
    gate.packet(true, 20);
    expect(gate.state(true, 220)).toBe('open');
    expect(gate.state(true, 221)).toBe('silent');
    expect(gate.packet(true, 300)).toBe(false);
    expect(gate.state(true, 300)).toBe('silent');
    gate.hold(true, 310);
    expect(gate.packet(true, 320)).toBe(true);
    expect(gate.state(true, 320)).toBe('open');
  });

  it('closes when the operator does not repeat that it holds the key', () => {
    const gate = new VoiceGate();
    gate.hold(true, 0);
    for (let ms = 0; ms <= 1000; ms += 20) expect(gate.packet(true, ms)).toBe(true);
    expect(gate.packet(true, 1001)).toBe(false);
    expect(gate.state(true, 1001)).toBe('closed');
  });
});
