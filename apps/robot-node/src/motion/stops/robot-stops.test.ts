import type { RobotStopState } from '@farpoint/safety';
import { makeGuard } from '@farpoint/safety/testing';
import { afterEach, describe, expect, test, vi } from 'vitest';
import { RobotStops, stopReading } from './robot-stops.ts';
import type { StopSource } from './stop-source.ts';

class Source implements StopSource {
  readonly fault = null;
  onChange: (() => void) | null = null;
  closed = false;
  readonly stop: StopSource['stop'];
  readonly name: string;
  says: RobotStopState = 'unheard';

  constructor(stop: StopSource['stop']) {
    this.stop = stop;
    this.name = `the ${stop}`;
  }

  look(): RobotStopState {
    return this.says;
  }

  say(state: RobotStopState): void {
    this.says = state;
    this.onChange?.();
  }

  close(): void {
    this.closed = true;
  }
}

function start(...sources: Source[]) {
  const guard = makeGuard();
  const heard: string[] = [];
  const lines: string[] = [];
  const log = {
    info: (_: object, text: string) => lines.push(text),
    warn: (_: object, text: string) => lines.push(text),
  };
  const stops = new RobotStops(sources, {
    guard,
    changed: (stop, state) => heard.push(`${stop} ${state} ${guard.estopState().latched}`),
    tell: ({ topic, level }) => heard.push(`${topic} ${level}`),
    log: log as never,
    now: () => 0,
  });
  return { guard, heard, lines, stops };
}

afterEach(() => vi.useRealTimers());

describe('stops at the robot', () => {
  test('hold from the start, tell each change once, and let go one by one', async () => {
    const [line, key] = [new Source('gpio'), new Source('key')];
    key.says = 'go';
    const { guard, heard, stops, lines } = start(line, key);
    expect(guard.estopState()).toMatchObject({ latched: true, releasedAt: 'robot' });
    expect(heard.splice(0)).toEqual(['gpio unheard true', 'stop:gpio error', 'stop:key ok']);
    line.say('settling');
    line.say('settling');
    expect(heard.splice(0)).toEqual(['stop:gpio warn']);
    line.say('go');
    expect(heard.splice(0)).toEqual(['gpio go false', 'stop:gpio ok']);
    key.say('pressed');
    line.say('lost');
    expect(heard.splice(0)).toEqual([
      'key pressed true',
      'stop:key warn',
      'gpio lost true',
      'stop:gpio error',
    ]);
    expect(stops.areWell).toBe(false);
    expect([...stops.stopped]).toEqual([
      ['gpio', 2],
      ['key', 1],
    ]);
    line.say('go');
    expect(guard.estopState().latched).toBe(true);
    key.say('go');
    expect(guard.estopState().latched).toBe(false);
    expect(stops.areWell).toBe(true);
    expect(lines.length).toBeLessThanOrEqual(10);
    await stops.close();
    key.say('pressed');
    expect(guard.estopState().latched).toBe(false);
    expect([line.closed, key.closed]).toEqual([true, true]);
  });

  test('are looked at without being told', async () => {
    vi.useFakeTimers();
    const line = new Source('gpio');
    line.says = 'go';
    const { guard, stops } = start(line);
    line.says = 'pressed';
    vi.advanceTimersByTime(10);
    expect(guard.estopState().latched).toBe(true);
    await stops.close();
  });

  test('a reading fits, whatever the stop is called', () => {
    const { values } = stopReading('shm', `/dev/shm/${'x'.repeat(64)}`, 'pressed');
    expect(values).toEqual([['', 'pressed']]);
    expect(stopReading('gpio', '/dev/gpiochip0 line 3', 'go').values).toEqual([
      ['', '/dev/gpiochip0 line 3: released'],
    ]);
  });
});
