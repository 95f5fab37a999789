/** The doctor, as a program and in this process, with and without real servers. */
import { spawn } from 'node:child_process';
import { createSocket } from 'node:dgram';
import { writeFileSync } from 'node:fs';
import { type AddressInfo, createServer } from 'node:net';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { freePorts, hasTurnServer, LocalStack, TurnServer } from '@farpoint/local-stack';
import { useFolder } from '@farpoint/service/testing/folder';
import { isAvailable } from '@farpoint/shared-memory';
import { describe, expect, it } from 'vitest';
import { doctor as runDoctor } from '../commands/doctor.ts';
import { checkConfiguration } from './check-configuration.ts';
import { robotChecks } from './checks.ts';
import { type Finding, runCheck } from './finding.ts';

const program = fileURLToPath(new URL('../../main.ts', import.meta.url));
const folder = useFolder();

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
        { detail: expect.stringMatching(/^sim, 64 × 64: [\d.]+ frames.* [1-9]\d* valid points/) as string },
      ]);
      expect(of(report, 'clock').map(({ verdict }) => verdict)).toEqual(['ok', 'ok']);
      if (turn !== null) expect(of(report, 'STUN and TURN')[0]?.detail).toMatch(/ allocates /);
    } finally {
      await stack.stop();
      await turn?.stop();
    }
  }, 60_000);
});

/** The same, in this process. */
async function doctorHere(argv: string[]): Promise<{ code: number; out: string }> {
  let out = '';
  const write = (text: string) => {
    out += text;
    return true;
  };
  const code = await runDoctor(argv, { stdout: { write }, stderr: { write }, env: {} } as Parameters<
    typeof runDoctor
  >[1]);
  return { code, out };
}

describe('the doctor', () => {
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
      const config = join(folder, 'hanging.yaml');
      writeFileSync(
        config,
        [
          'robot:',
          `  signaling: {url: "ws://127.0.0.1:${port}"}`,
          `  source: {kind: shm, shmFolder: "${folder}", waitS: 600}`,
          `  network: {iceServers: ["stun:127.0.0.1:${blackHole.address().port}"], icePolicy: relay}`,
          `  recording: {file: /nowhere/a.mcap}`,
          `  admin: {port: ${port}}`,
        ].join('\n'),
      );
      const { robot, values, results } = checkConfiguration(['--config', config], {});
      if (robot === null || values === null) throw new Error(JSON.stringify(results));
      const findings: Finding[] = [];
      // What hangs gets no more time for being waited for longer.
      const times = { answerMs: 300, producerMs: 100, watchMs: 100 };
      const hanging = ['robot', 'signaling', 'STUN and TURN', 'source', 'recording'];
      for (const check of robotChecks(robot, values, times))
        if (hanging.includes(check.name)) findings.push(...(await runCheck(check)));
      mute.close();
      blackHole.close();
      const failed = findings.filter(({ verdict }) => verdict === 'fail');
      const said = (remedy: string) => expect.stringContaining(remedy) as string;
      expect(failed).toMatchObject([
        { check: 'robot', remedy: said('set admin.port') },
        { check: 'signaling' },
        { check: 'STUN and TURN', remedy: said('is the STUN server running') },
        { check: 'STUN and TURN', remedy: said('set up a TURN server') },
        { check: 'source', remedy: said('start the camera’s program') },
        { check: 'recording', remedy: said('create it') },
      ]);
    },
  );

  it('names every mistake in a configuration with its line, and still checks the machine', async () => {
    const config = join(folder, 'mistaken.yaml');
    writeFileSync(
      config,
      'robot:\n  soruce: {kind: sim}\n  limits:\n    maxLinear: fast\n  topics:\n    - {topic: points, as: cloud}\n',
    );
    const { code, out } = await doctorHere(['--config', config, '--json', '--watchdog-ms', '9']);
    const report = JSON.parse(out) as Report;
    expect([code, report.ready]).toEqual([1, false]);
    expect(of(report, 'configuration').map(({ detail }) => detail.replace(folder, ''))).toEqual([
      '/mistaken.yaml:2: robot.soruce is not an option (did you mean robot.source?)',
      expect.stringMatching(
        /^\/mistaken\.yaml:6: robot\.topics\.0\.topic must be a complete topic name .*, not "points"$/,
      ),
      expect.stringMatching(
        /^\/mistaken\.yaml:4: robot\.limits\.maxLinear must be a number from .*, not "fast"$/,
      ),
      '--watchdog-ms must be a number from 50 to 1000, not "9"',
    ]);
    expect(of(report, 'codec')).toHaveLength(1);
    expect(of(report, 'signaling')).toEqual([]);
  });

  it('explains itself', async () => {
    const { code, out } = await doctorHere(['--help']);
    expect([code, out]).toEqual([0, expect.stringContaining('✗ must be fixed')]);
  });
});
