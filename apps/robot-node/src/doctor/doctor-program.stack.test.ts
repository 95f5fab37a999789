/** The real doctor program, with and without real servers. */
import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { type AddressInfo, createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { freePorts, hasTurnServer, LocalStack, TurnServer } from '@farpoint/local-stack';
import { isAvailable } from '@farpoint/shared-memory';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Finding } from './finding.ts';

const program = fileURLToPath(new URL('../main.ts', import.meta.url));
let folder: string;
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'farpoint-doctor-program-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

interface Outcome {
  code: number | null;
  out: string;
  errors: string;
}

function doctor(yaml: string, args: string[] = [], env: Record<string, string> = {}): Promise<Outcome> {
  const config = join(folder, 'robot.yaml');
  writeFileSync(config, yaml);
  const child = spawn(process.execPath, [program, 'doctor', '--config', config, ...args], {
    env: { ...process.env, ...env },
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  let [out, errors] = ['', ''];
  child.stdout.on('data', (data: Buffer) => (out += data.toString()));
  child.stderr.on('data', (data: Buffer) => (errors += data.toString()));
  return new Promise((resolve) => child.on('close', (code) => resolve({ code, out, errors })));
}

interface Report {
  ready: boolean;
  findings: Finding[];
}

const of = ({ findings }: Report, check: string) => findings.filter((finding) => finding.check === check);

describe('the doctor’s program', () => {
  it('finds a robot ready: signaling with tokens, a TURN server if installed, a simulated camera', async () => {
    const [port] = await freePorts(1);
    const turn = hasTurnServer() ? new TurnServer(port as number) : null;
    await turn?.start();
    const tokens = join(folder, 'tokens.yaml');
    writeFileSync(tokens, 'rover-1: the-token\n');
    const stack = await LocalStack.start({
      signalingArgs: ['--robot-tokens', tokens, ...(turn === null ? [] : ['--turn-urls', turn.url])],
      ...(turn === null ? {} : { env: { FARPOINT_SIGNALING_TURN_SECRET: turn.secret } }),
      robots: [],
    });
    try {
      const yaml = `robot:\n  id: rover-1\n  signaling: {url: "${stack.signalingUrl}"}\n  source: {simSize: 64}\n  admin: {port: 0}\n`;
      const { code, out, errors } = await doctor(yaml, ['--json'], { FARPOINT_ROBOT_TOKEN: 'the-token' });
      expect(errors).toBe('');
      const report = JSON.parse(out) as Report;
      expect(report.findings.filter(({ verdict }) => verdict === 'fail')).toEqual([]);
      expect([report.ready, code]).toEqual([true, 0]);
      expect(of(report, 'signaling')).toMatchObject([{ verdict: 'ok' }]);
      expect(of(report, 'source')).toMatchObject([
        { verdict: 'ok', detail: expect.stringMatching(/^sim, 64 × 64: [\d.]+ frames/) as string },
      ]);
      expect(of(report, 'clock').map(({ verdict }) => verdict)).toEqual(['ok', 'ok']);
      if (turn !== null) expect(of(report, 'STUN and TURN')[0]?.detail).toMatch(/ allocates /);
    } finally {
      await stack.stop();
      await turn?.stop();
    }
  }, 60_000);

  it.skipIf(!isAvailable())(
    'is not blocked by anything that hangs, and names all of it (needs the addon: pnpm build:native)',
    async () => {
      const mute = createServer(() => undefined).listen(0, '127.0.0.1');
      const blackHole = createSocket('udp4').bind(0, '127.0.0.1');
      await Promise.all([
        new Promise((resolve) => mute.once('listening', resolve)),
        new Promise((resolve) => blackHole.once('listening', resolve)),
      ]);
      const { port } = mute.address() as AddressInfo;
      const yaml = [
        'robot:',
        `  signaling: {url: "ws://127.0.0.1:${port}"}`,
        `  source: {kind: shm, shmFolder: "${folder}", shmWaitS: 600}`,
        `  network: {iceServers: ["stun:127.0.0.1:${blackHole.address().port}"], icePolicy: relay}`,
        `  recording: {file: /nowhere/a.mcap}`,
        `  admin: {port: ${port}}`,
      ].join('\n');
      const { code, out, errors } = await doctor(yaml);
      mute.close();
      blackHole.close();
      expect(errors).toBe('');
      expect(code).toBe(1);
      const failed = out.split('\n').filter((line) => line.startsWith('✗'));
      for (const [check, remedy] of [
        ['robot', 'set admin.port'],
        ['signaling', '→'],
        ['STUN and TURN', 'is the STUN server running'],
        ['STUN and TURN', 'no TURN server works'],
        ['source', 'start the camera’s program'],
        ['recording', 'create it'],
      ] as const) {
        expect(
          failed.some((line) => line.slice(2).startsWith(check) && line.includes(remedy)),
          `${check}: ${remedy}\n${out}`,
        ).toBe(true);
      }
      expect(out).toMatch(/\n6 to fix/);
    },
    90_000,
  );

  it('names every mistake in a configuration with its line, and still checks the machine', async () => {
    const yaml =
      'robot:\n  soruce: {kind: sim}\n  limits:\n    maxLinear: fast\n  topics:\n    - {topic: points, as: cloud}\n';
    const { code, out } = await doctor(yaml, ['--json', '--watchdog-ms', '9']);
    const report = JSON.parse(out) as Report;
    expect([code, report.ready]).toEqual([1, false]);
    expect(of(report, 'configuration').map(({ detail }) => detail.replace(folder, ''))).toEqual([
      '/robot.yaml:2: robot.soruce is not an option (did you mean robot.source?)',
      expect.stringMatching(
        /^\/robot\.yaml:6: robot\.topics\.0\.topic must be a complete topic name .*, not "points"$/,
      ),
      expect.stringMatching(
        /^\/robot\.yaml:4: robot\.limits\.maxLinear must be a number from .*, not "fast"$/,
      ),
      '--watchdog-ms must be a number from 50 to 1000, not "9"',
    ]);
    expect(of(report, 'codec')).toHaveLength(1);
    expect(of(report, 'signaling')).toEqual([]);
  }, 60_000);

  it('explains itself', async () => {
    const { code, out } = await doctor('', ['--help']);
    expect([code, out]).toEqual([0, expect.stringContaining('✗ must be fixed')]);
  }, 30_000);
});
