/** The doctor's judgements of machines other than this one. */
import { chmodSync, chownSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { useFolder } from '@farpoint/service/testing/folder';
import { isAvailable } from '@farpoint/shared-memory';
import { describe, expect, it } from 'vitest';
import type { SourceOptions } from '../../sense/sources/open-source.ts';
import { findingLine, jsonReport, summaryLine } from '../commands/doctor.ts';
import { checkMonotonicClock, checkTimeOfDay } from './check-clock.ts';
import { checkRecording, checkSharedMemory } from './check-files.ts';
import { checkAddresses } from './check-ice.ts';
import { checkMemory, checkNode, checkProcessor, checkSocketBuffers, judgeCodec } from './check-machine.ts';
import { judgeClosedSource, judgeSource, trialSource } from './check-source.ts';
import { type Result, runCheck } from './finding.ts';
import type { Host } from './host.ts';
import { judgeRunning } from './running-robot.ts';
import type { SourceTrial } from './source-trial.ts';

/** A machine with these files. */
function host(files: Record<string, string>): Host {
  return {
    read: (path) => files[path] ?? null,
    list: (path) => [
      ...new Set(
        Object.keys(files)
          .filter((file) => file.startsWith(`${path}/`))
          .map((file) => file.slice(path.length + 1).split('/')[0] ?? ''),
      ),
    ],
  };
}

const verdicts = (results: readonly Result[]) => results.map(({ verdict }) => verdict);
const quad = { cores: 4, model: 'Some', load: 0.5 };
const CPU = '/sys/devices/system/cpu';

describe('machine', () => {
  it.each([
    ['24.1.0', 'ok'],
    ['22.18.0', 'warn'],
    ['22.17.9', 'fail'],
    ['18.20.0', 'fail'],
  ])('Node %s: %s', (version, verdict) => {
    expect(verdicts(checkNode(version, 'linux', 'arm64'))).toEqual([verdict]);
  });

  it.each([
    [{ '/proc/meminfo': 'MemTotal: 9 kB\nMemAvailable:    4000000 kB' }, 'ok', '4096 MB'],
    [{ '/proc/meminfo': 'MemAvailable: 300000 kB' }, 'warn', '307 MB'],
    [{ '/proc/meminfo': 'MemAvailable: 90000 kB' }, 'fail', '92 MB'],
    [
      {
        '/proc/meminfo': 'MemAvailable: 4000000 kB',
        '/sys/fs/cgroup/memory.max': '256000000',
        '/sys/fs/cgroup/memory.current': '200000000',
      },
      'fail',
      'container or unit',
    ],
    [{ '/proc/meminfo': 'MemAvailable: 4000000 kB', '/sys/fs/cgroup/memory.max': 'max' }, 'ok', '4096 MB'],
    [{}, 'warn', 'cannot be read'],
  ])('memory of %j: %s', (files, verdict, detail) => {
    const results = checkMemory(host(files as Record<string, string>));
    expect(verdicts(results)).toEqual([verdict]);
    expect(results[0]?.detail).toContain(detail);
  });

  it('socket buffers: larger for clouds through DDS', () => {
    const files = { '/proc/sys/net/core/rmem_max': '4194304', '/proc/sys/net/core/wmem_default': '212992' };
    expect(verdicts(checkSocketBuffers(host(files), false))).toEqual(['ok']);
    expect(checkSocketBuffers(host(files), true)[0]?.remedy).toContain('net.core.rmem_max=8388608`');
    const small = { '/proc/sys/net/core/rmem_max': '212992', '/proc/sys/net/core/wmem_default': '65536' };
    expect(checkSocketBuffers(host(small), false)[0]?.remedy).toContain(
      'sysctl -w net.core.rmem_max=2097152 net.core.wmem_default=212992`',
    );
    expect(verdicts(checkSocketBuffers(host({}), false))).toEqual(['warn']);
  });

  it('processor: cores, quota, load, governor, heat', () => {
    expect(verdicts(checkProcessor(host({}), quad))).toEqual(['ok']);
    expect(verdicts(checkProcessor(host({}), { ...quad, cores: 1 }))).toEqual(['warn']);
    expect(verdicts(checkProcessor(host({}), { ...quad, load: 9 }))).toEqual(['warn']);
    expect(checkProcessor(host({ '/sys/fs/cgroup/cpu.max': '150000 100000' }), quad)[0]?.detail).toContain(
      'may use 1.5',
    );
    expect(verdicts(checkProcessor(host({ '/sys/fs/cgroup/cpu.max': 'max 100000' }), quad))).toEqual(['ok']);
    const governor = { [`${CPU}/cpu0/cpufreq/scaling_governor`]: 'powersave' };
    expect(checkProcessor(host(governor), quad)[1]?.remedy).toContain('jetson_clocks');
    const driver = { ...governor, [`${CPU}/cpu0/cpufreq/scaling_driver`]: 'intel_pstate' };
    expect(verdicts(checkProcessor(host(driver), quad))).toEqual(['ok']);
    const hot = {
      [`${CPU}/cpu0/thermal_throttle/core_throttle_count`]: '2',
      [`${CPU}/cpu1/thermal_throttle/core_throttle_count`]: '3',
      '/sys/class/thermal/thermal_zone0/temp': '45000',
      '/sys/class/thermal/thermal_zone1/temp': '91000',
      '/sys/devices/platform/soc/soc:firmware/get_throttled': '50005',
    };
    const results = checkProcessor(host(hot), quad);
    expect(verdicts(results)).toEqual(['ok', 'warn', 'warn', 'warn']);
    expect(results.map(({ detail }) => detail).join()).toMatch(/0x50005.*throttled by heat 5 times.*91 °C/);
    const cool = { '/sys/class/thermal/thermal_zone0/temp': '45000' };
    expect(verdicts(checkProcessor(host(cool), quad))).toEqual(['ok', 'ok']);
  });

  it('codec: the median after warm-up', () => {
    expect(judgeCodec([90, 80, 10, 11, 12, 9])[0]).toMatchObject({
      verdict: 'ok',
      detail: expect.stringContaining('11.0 ms') as string,
    });
    expect(verdicts(judgeCodec([1, 1, 1, 50, 50, 50]))).toEqual(['warn']);
    expect(verdicts(judgeCodec([1, 1, 1, 150, 150, 150]))).toEqual(['fail']);
    expect(verdicts(judgeCodec([]))).toEqual(['fail']);
  });

  it('clocks: one that runs backwards, one that is slow to read, one that is wrong', () => {
    let reading = 0;
    const forth = () => reading++;
    const source = '/sys/devices/system/clocksource/clocksource0/current_clocksource';
    expect(verdicts(checkMonotonicClock(host({ [source]: 'tsc' }), forth))).toEqual(['ok']);
    expect(verdicts(checkMonotonicClock(host({ [source]: 'hpet' }), forth))).toEqual(['warn']);
    const back = () => (reading++ % 1000 === 0 ? reading - 50 : reading);
    expect(checkMonotonicClock(host({}), back)[0]?.detail).toMatch(/went back \d+ times/);
    const at = (askedMs: number) => checkTimeOfDay({ dateMs: 100_000, askedMs, answeredMs: askedMs + 20 })[0];
    expect(at(100_500)).toMatchObject({ verdict: 'ok' });
    expect(at(102_400)).toMatchObject({ verdict: 'ok' });
    expect(at(160_000)).toMatchObject({
      verdict: 'warn',
      detail: expect.stringContaining('59.5 s ahead of') as string,
    });
    expect(at(40_000)?.detail).toContain('behind');
  });
});

describe('network', () => {
  it('addresses', () => {
    const v4 = (address: string, internal = false) => [{ address, family: 'IPv4' as const, internal }];
    const lo = v4('127.0.0.1', true);
    const eth0 = [{ address: 'fe80::1', family: 'IPv6' as const, internal: false }];
    expect(verdicts(checkAddresses({ lo, eth0 }))).toEqual(['warn']);
    expect(
      checkAddresses({ lo, tun0: v4('10.8.0.2'), wlan0: v4('10.0.0.5'), docker0: v4('172.17.0.1') }),
    ).toMatchObject([{ verdict: 'ok', detail: 'candidates 10.0.0.5 (wlan0), 10.8.0.2 (tun0)' }]);
  });
});

describe('source', () => {
  const description = {
    kind: 'shm',
    width: 64,
    height: 48,
    capacity: 3072,
    camera: null,
    depthMeasure: 'z' as const,
  };
  const trial: SourceTrial = {
    description,
    frames: 61,
    seconds: 2,
    validPoints: 3000,
    workMs: 4,
    faults: [],
  };
  const shm = { kind: 'shm', layout: 'farpoint', folder: '/dev/shm', waitMs: 60_000 } as const;

  it('rate, size, faults, wheels', () => {
    expect(judgeSource(trial, false)).toMatchObject([
      { verdict: 'ok', detail: 'shm, 64 × 48: 30.0 frames/s, 3000 valid points, 4.0 ms of work each' },
    ]);
    expect(verdicts(judgeSource({ ...trial, frames: 0 }, false))).toEqual(['fail']);
    expect(verdicts(judgeSource({ ...trial, frames: 4 }, false))).toEqual(['warn']);
    expect(verdicts(judgeSource({ ...trial, validPoints: 0 }, false))).toEqual(['warn']);
    expect(verdicts(judgeSource({ ...trial, faults: ['torn'] }, false))).toEqual(['ok', 'warn']);
    expect(judgeSource(trial, true)[1]?.detail).toContain('nobody can drive');
    const points = { ...trial, description: { ...trial.description, camera: null } };
    expect(judgeSource(points, false, true)[1]?.detail).toContain('pictures.ofCloud has no effect');
    const camera = { fx: 1, fy: 1, cx: 0, cy: 0 };
    const images = { ...trial, description: { ...trial.description, camera } };
    expect(verdicts(judgeSource(images, false, true))).toEqual(['ok']);
  });

  it('fails to open, after a short wait', () => {
    expect(trialSource(shm, 3000)).toEqual({ ...shm, waitMs: 3000 });
    expect(judgeClosedSource(shm, new Error('/dev/shm/farpoint_cloud: ENOENT'))[0]?.remedy).toContain(
      'start the camera',
    );
    expect(
      judgeClosedSource({ kind: 'pcd', path: 'x', frame: 'auto' }, new Error('ENOENT: no such file'))[0]
        ?.remedy,
    ).toContain('source.path');
    const gone = Object.assign(new Error("ENOENT: no such file or directory, open '/a.mcap'"), {
      ...{ code: 'ENOENT', syscall: 'open', path: '/a.mcap' },
    });
    const recording = { kind: 'recording', path: '/a.mcap' } as unknown as SourceOptions;
    expect(judgeClosedSource(recording, new Error('/a.mcap: …', { cause: gone }))).toMatchObject([
      { detail: 'recording: /a.mcap does not exist', remedy: expect.stringContaining('MCAP') as string },
    ]);
  });
});

it('prints no health address for a port that is not yet chosen', () => {
  const [result] = judgeRunning({ state: 'stands' }, '127.0.0.1', 0);
  expect(result).toMatchObject({ verdict: 'ok', detail: expect.stringContaining('the log says which') });
  expect(result?.detail).not.toContain(':0');
});

describe('files', () => {
  const folder = useFolder();
  const source = { kind: 'shm', layout: 'farpoint', folder, waitMs: 0 } as const;
  const sink = { kind: 'shm', folder, mode: 0o600, silenceMs: 150 } as const;

  it.skipIf(!isAvailable())(
    'of shared memory: each fault in them is reported by its name (needs the addon: pnpm build:native)',
    () => {
      expect(checkSharedMemory({ kind: 'sim', seed: 1, size: 64 }, { kind: 'base' })).toEqual([]);
      expect(verdicts(checkSharedMemory(source, sink)).filter((verdict) => verdict === 'fail')).toEqual([]);
      const cloud = join(folder, 'farpoint_cloud');
      writeFileSync(cloud, '');
      chmodSync(cloud, 0o666);
      expect(checkSharedMemory(source, { kind: 'base' })[1]).toMatchObject({
        verdict: 'fail',
        detail: expect.stringContaining('mode 0666) is writable by everybody') as string,
      });
      chmodSync(cloud, 0o640);
      // Only root can give files away.
      if (process.geteuid?.() === 0) {
        chownSync(cloud, 54_321, 0);
        expect(checkSharedMemory(source, { kind: 'base' })[1]).toMatchObject({
          verdict: 'fail',
          remedy: expect.stringContaining('source.shmOwner: 54321') as string,
        });
        expect(verdicts(checkSharedMemory({ ...source, owner: 54_321 }, { kind: 'base' }))[1]).toBe('ok');
        chownSync(cloud, 0, 0);
      }
      expect(verdicts(checkSharedMemory(source, { kind: 'base' }))[1]).toBe('ok');
      rmSync(cloud);
      symlinkSync('/', cloud);
      expect(checkSharedMemory(source, { kind: 'base' })[1]?.detail).toContain('is not a regular file');
      rmSync(cloud);
      expect(checkSharedMemory({ ...source, folder: '/nowhere' }, { kind: 'base' })[0]?.detail).toContain(
        'is not a folder',
      );
    },
  );

  it('of recordings', () => {
    expect(checkRecording(undefined)).toEqual([]);
    const path = join(folder, 'a.mcap');
    const own = (file: string) => checkRecording({ path: file, folder: null });
    expect(verdicts(own(path))).not.toContain('fail');
    writeFileSync(path, '');
    expect(own(path)[0]?.detail).toContain('already exists');
    expect(own('/nowhere/b.mcap')[0]?.detail).toContain('is not a folder');
    const operators = (at: string) => checkRecording({ path: null, folder: { path: at, mostBytes: 1 } });
    expect(verdicts(operators(folder))).not.toContain('fail');
    expect(operators('/nowhere')[0]?.remedy).toContain('recording.folder');
  });
});

describe('running and reporting', () => {
  it('a check that hangs, throws or rejects fails without affecting the others', async () => {
    const never = new Promise<Result[]>(() => undefined);
    const hung = await runCheck({ name: 'a', withinMs: 20, run: () => never });
    expect(hung).toMatchObject([{ check: 'a', verdict: 'fail', detail: 'no answer within 0.02 s' }]);
    const thrown = await runCheck({
      ...{ name: 'b', withinMs: 1000 },
      run: () => {
        throw new Error('on purpose');
      },
    });
    expect(thrown[0]?.detail).toContain('on purpose');
    expect(
      (await runCheck({ name: 'c', withinMs: 1000, run: () => Promise.reject(new Error('also')) }))[0]
        ?.detail,
    ).toContain('also');
  });

  it('prints one line per finding, or JSON', () => {
    const findings = [
      { check: 'node', verdict: 'ok', detail: 'Node 24' },
      { check: 'source', verdict: 'fail', detail: 'gone\n  away', remedy: 'start it' },
    ] as const;
    expect(findings.map(findingLine)).toEqual([
      '✓ node            Node 24\n',
      '✗ source          gone; away → start it\n',
    ]);
    expect(summaryLine(findings)).toBe('1 to fix.\n');
    expect(summaryLine([])).toBe('Ready.\n');
    expect(JSON.parse(jsonReport(findings))).toEqual({ ready: false, findings });
  });
});
