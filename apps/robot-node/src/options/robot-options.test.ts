import { OptionsError, resolveOptions } from '@farpoint/service';
import { describe, expect, it } from 'vitest';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

function robot(...argv: string[]) {
  const resolved = resolveOptions(robotProgram, { argv, env: {}, readFile: () => null });
  if (resolved.action !== 'run') throw new Error('printed');
  return toRobotOptions(resolved.values, resolved.where);
}

describe('robot options', () => {
  it('make a simulated robot by default', () => {
    const options = robot();
    expect(options.capture).toMatchObject({
      source: { kind: 'sim', seed: 1, size: 480 },
      framesPerSecond: 60,
    });
    expect(options).toMatchObject({
      bitsPerSecond: 60e6,
      rateControl: 'adaptive',
      limits: { watchdogMs: 150 },
      maxOperators: 4,
    });
    expect(options.signaling.key).not.toBe(robot().signaling.key);
  });

  it('take a recorded source', () => {
    const { capture } = robot('--source', 'pcd', '--path', 'a.pcd', '--pcd-frame', 'body', '--fps', '10');
    expect(capture).toMatchObject({
      source: { kind: 'pcd', path: 'a.pcd', frame: 'body' },
      framesPerSecond: 10,
    });
  });

  it('take a source and a sink in shared memory', () => {
    const options = robot(
      ...['--source', 'shm', '--shm-layout', 'reference', '--shm-folder', '/x', '--sink', 'shm'],
    );
    expect(options.capture).toMatchObject({
      source: { kind: 'shm', layout: 'reference', folder: '/x', waitMs: 10_000 },
      framesPerSecond: 30,
    });
    expect(options.sink).toEqual({ kind: 'shm', folder: '/x', mode: 0o600, silenceMs: 150 });
    expect(robot('--sink', 'shm', '--shm-access', 'group').sink).toMatchObject({ mode: 0o660 });
    expect(robot().sink).toEqual({ kind: 'source' });
  });

  it('give UDP ports as a range', () => {
    expect(robot('--udp-ports', '40000-40010').portRange).toEqual([40_000, 40_010]);
  });

  it.each([
    [['--source', 'pcd'], '--path'],
    [['--sim-size', '479'], '--sim-size'],
    [['--signaling', 'http://x'], '--signaling'],
    [['--udp-ports', '5-4'], '--udp-ports'],
    [['--tls-ca', '/nowhere.pem'], '--tls-ca'],
    [['--id', 'Not Ok'], '--id'],
    [['--watchdog-ms', '100000'], '--watchdog-ms'],
    [['--ice-servers', 'http://x'], '--ice-servers'],
  ])('refuse %j, naming %s', (argv, where) => {
    expect(() => robot(...argv)).toThrow(OptionsError);
    expect(() => robot(...argv)).toThrow(where);
  });
});
