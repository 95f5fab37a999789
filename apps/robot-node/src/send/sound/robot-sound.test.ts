import type { Sound } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { describe, expect, it } from 'vitest';
import type { LoudspeakerEvents, MicrophoneEvents } from '../../sense/sound/sound-devices.ts';
import type { SoundFrame } from '../../sense/sound/sound-frame.ts';
import { PathBudget } from '../budgets/path-budget.ts';
import type { SoundLine } from '../transport/peer-events.ts';
import type { StreamSender } from '../transport/stream-sender.ts';
import type { VoicePacket } from '../transport/voice-packet.ts';
import { OperatorSound } from './operator-sound.ts';
import { RobotSound, type SoundTarget } from './robot-sound.ts';

const OPUS = new Uint8Array([31 << 3, 1]);

/** An operator, with what it is sent. */
class Operator implements SoundTarget {
  readonly id: string;
  readonly operatorName = 'Ada';
  readonly streaming = true;
  readonly sound: OperatorSound;
  readonly frames: SoundFrame[] = [];
  told: Sound | null = null;
  targetBitsPerSecond = 5e6;
  readonly voice: { onPacket: ((packet: VoicePacket) => void) | null } = { onPacket: null };
  #sequence = 0;

  constructor(id: string, now: () => number) {
    this.id = id;
    this.sound = new OperatorSound(new PathBudget(), now);
    const sender = {
      addStream: () => undefined,
      enqueue: (frame: SoundFrame) => this.frames.push(frame),
    };
    Object.defineProperty(sender, 'targetBitsPerSecond', { get: () => this.targetBitsPerSecond });
    const transport = { sendReport: () => undefined };
    const line = { mid: '1', transport, voice: this.voice } as unknown as SoundLine;
    this.sound.connect(sender as unknown as StreamSender, line);
  }

  tellSound(message: Sound): void {
    this.told = message;
  }

  speak(): void {
    this.#sequence++;
    this.voice.onPacket?.({ sequence: this.#sequence, timestamp: this.#sequence * 960, payload: OPUS });
  }
}

function bench() {
  const time = { ms: 1000 };
  const now = () => time.ms;
  const operators: Operator[] = [];
  const lines: string[] = [];
  const log = { info: (...what: unknown[]) => lines.push(String(what.at(-1))) } as unknown as Logger;
  Object.assign(log, { warn: log.info });
  const device: { microphone: MicrophoneEvents | null; bits: number; loudspeaker: LoudspeakerEvents | null } =
    {
      ...{ microphone: null, bits: 0, loudspeaker: null },
    };
  const played: number[] = [];
  let driver: string | null = null;
  const sound = new RobotSound({
    devices: {
      mostBitsPerSecond: 32_000,
      microphone: (bits, events) => {
        Object.assign(device, { microphone: events, bits });
        return {
          configure: (next) => Object.assign(device, { bits: next }),
          close: async () => void Object.assign(device, { microphone: null }),
        };
      },
      loudspeaker: (events) => {
        device.loudspeaker = events;
        return {
          play: (hearAtMs) => {
            played.push(hearAtMs);
            return true;
          },
          close: async () => void Object.assign(device, { loudspeaker: null }),
        };
      },
    },
    targets: () => operators,
    driver: () => driver,
    onFrame: () => undefined,
    ...{ log, now },
  });
  const join = (id: string) => {
    const operator = new Operator(id, now);
    operators.push(operator);
    sound.welcome(operator);
    sound.update();
    return operator;
  };
  return {
    ...{ sound, device, lines, played, join, time },
    capture: () => device.microphone?.onPacket({ capturedAtMs: time.ms, bytes: OPUS }),
    drive: (id: string | null) => {
      driver = id;
      sound.update();
    },
    /** Time passes. */
    pass: (ms: number) => {
      time.ms += ms;
      sound.update();
    },
  };
}

describe('the microphone', () => {
  it('runs while somebody listens, once for all, and the log says who does', () => {
    const { sound, device, lines, join, capture } = bench();
    const [ada, bob, eve] = [join('a'), join('b'), join('c')];
    expect(device.microphone).toBe(null);
    expect(ada.told?.microphone).toEqual({ state: 'off' });
    ada.sound.listen(true);
    bob.sound.listen(true);
    sound.update();
    expect(device.bits).toBe(32_000);
    expect(ada.told?.microphone).toEqual({ state: 'starting' });
    capture();
    sound.update();
    expect(ada.told?.microphone).toEqual({ state: 'live' });
    expect([ada, bob, eve].map(({ frames }) => frames.length)).toEqual([1, 1, 0]);
    expect(bob.frames[0]).toBe(ada.frames[0]);
    ada.sound.listen(false);
    bob.sound.disconnect();
    sound.update();
    expect(device.microphone).toBe(null);
    expect(lines.filter((line) => line.includes('listen'))).toEqual([
      ...['an operator listens', 'an operator listens'],
      ...['an operator no longer listens', 'an operator no longer listens'],
      'the microphone is off: nobody listens',
    ]);
  });

  it('gets less of a narrow path, and nothing of one that has no room, until it has more than enough', () => {
    const { sound, device, join, capture } = bench();
    const ada = join('a');
    ada.sound.listen(true);
    // A third of what messages leave, less 30.4 kbit/s of headers.
    ada.targetBitsPerSecond = 20_000 + 3 * (30_400 + 20_000);
    sound.update();
    sound.update();
    expect(device.bits).toBeCloseTo(20_000);
    ada.targetBitsPerSecond = 20_000 + 3 * (30_400 + 15_000);
    sound.update();
    expect(ada.told?.microphone?.state).toBe('slow-link');
    capture();
    expect(ada.frames).toEqual([]);
    expect(device.microphone).toBe(null);
    ada.targetBitsPerSecond = 20_000 + 3 * (30_400 + 19_000);
    sound.update();
    expect(ada.told?.microphone?.state).toBe('slow-link');
    ada.targetBitsPerSecond = 20_000 + 3 * (30_400 + 20_001);
    sound.update();
    expect(ada.told?.microphone?.state).toBe('starting');
  });

  it('that fails says why, and is live again when it gives sound', () => {
    const { sound, device, join, capture } = bench();
    const ada = join('a');
    ada.sound.listen(true);
    sound.update();
    device.microphone?.onFault('unplugged');
    sound.update();
    expect(ada.told?.microphone).toEqual({ state: 'failed', detail: 'unplugged' });
    capture();
    sound.update();
    expect(ada.told?.microphone).toEqual({ state: 'live' });
  });
});

describe('the loudspeaker', () => {
  it('is open while somebody drives, and plays that operator only', () => {
    const { device, played, join, drive } = bench();
    const [ada, bob] = [join('a'), join('b')];
    expect(device.loudspeaker).toBe(null);
    drive('a');
    expect(device.loudspeaker).not.toBe(null);
    for (const operator of [ada, bob]) {
      operator.sound.speak(true);
      operator.speak();
    }
    expect(played).toHaveLength(1);
    drive('a');
    expect(ada.told?.voice).toEqual({ state: 'open' });
    expect(bob.told?.voice?.state).toBe('not-driving');
    drive(null);
    expect(ada.told?.voice?.state).toBe('not-driving');
    ada.speak();
    expect(played).toHaveLength(1);
    expect(device.loudspeaker).toBe(null);
  });

  it('closes the voice when the key is released, and when no packets come', () => {
    const { played, join, drive, pass } = bench();
    const ada = join('a');
    drive('a');
    ada.sound.speak(true);
    ada.speak();
    pass(201);
    expect(ada.told?.voice).toEqual({ state: 'silent' });
    ada.sound.speak(false);
    ada.speak();
    pass(1);
    expect(ada.told?.voice).toEqual({ state: 'closed' });
    expect(played).toHaveLength(1);
    // Without a word that the key is still held, it counts as released.
    ada.sound.speak(true);
    pass(1001);
    expect(ada.voice.onPacket).toBe(null);
  });

  it('does not send the operator its own voice back', () => {
    const { sound, join, drive, capture, pass } = bench();
    const [ada, bob] = [join('a'), join('b')];
    for (const operator of [ada, bob]) operator.sound.listen(true);
    drive('a');
    ada.sound.speak(true);
    ada.speak();
    capture();
    sound.update();
    expect([ada.frames.length, bob.frames.length]).toEqual([0, 1]);
    expect(ada.told?.microphone).toEqual({ state: 'muted' });
    ada.sound.speak(false);
    pass(201);
    capture();
    expect(ada.frames).toHaveLength(1);
    pass(0);
    expect(ada.told?.microphone).toEqual({ state: 'live' });
  });
});
