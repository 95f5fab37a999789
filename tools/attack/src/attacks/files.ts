import { spawn } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { type Attack, attacks } from '../attack.ts';
import { inTime, mustHold } from '../harm.ts';
import { Noise } from '../noise.ts';

const ROBOT = [
  'apps/robot-node/src/main.ts',
  '--signaling',
  'ws://127.0.0.1:9',
  '--id',
  'x',
  '--admin-port',
  '0',
];
const SIGNALING = ['apps/signaling/src/main.ts', '--port', '0', '--host', '127.0.0.1', '--no-reference'];

/** A program with a damaged file must end with one clear sentence: no stack, no hang. */
function refuses(
  name: string,
  content: Uint8Array | string,
  args: (path: string) => string[],
): Attack['run'] {
  return async (scene) => {
    const path = join(scene.folder, name);
    writeFileSync(path, content);
    const state = ['--state-dir', join(scene.folder, 'state')];
    const all = args(path);
    const child = spawn(process.execPath, all[0] === ROBOT[0] ? [...all, ...state] : all, {
      cwd: repositoryRoot,
    });
    scene.later(() => child.kill('SIGKILL'));
    let output = '';
    for (const stream of [child.stdout, child.stderr]) {
      stream.on('data', (data) => {
        output += data;
      });
    }
    const code = await inTime(
      new Promise<number | null>((resolve) => child.once('close', (status) => resolve(status))),
      `the program goes on with ${name}`,
      20_000,
    );
    mustHold(code !== 0 && code !== null, `exit status ${code}`);
    mustHold(!/\n\s+at .*\.ts:\d+/.test(output), `a stack instead of a sentence: ${output.slice(0, 200)}`);
  };
}

const noise = new Noise(41);
const pcd = (points: string, data: string) =>
  `VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH ${points}\nHEIGHT 1\nPOINTS ${points}\nDATA ${data}\n`;
const play = (kind: string) => (path: string) => [...ROBOT, '--source', kind, '--path', path];

/** Files that somebody else has made. */
export const fileAttacks = attacks('files', {
  'PCD of four billion points': refuses('many.pcd', pcd('4294967295', 'binary'), play('pcd')),
  'PCD whose compressed part lies about its size': refuses(
    'lies.pcd',
    Buffer.concat([Buffer.from(pcd('100', 'binary_compressed')), Buffer.alloc(8, 0x7f), noise.bytes(64)]),
    play('pcd'),
  ),
  'random bytes as PCD': refuses('noise.pcd', noise.bytes(5000), play('pcd')),
  'random bytes as MCAP': refuses('noise.mcap', noise.bytes(5000), play('recording')),
  'MCAP with a record of 2^60 bytes': refuses(
    'huge.mcap',
    Buffer.concat([
      Buffer.from([0x89, 77, 67, 65, 80, 48, 13, 10, 1]),
      Buffer.from([0, 0, 0, 0, 0, 0, 0, 16]),
      noise.bytes(64),
    ]),
    play('recording'),
  ),
  'bag cut off after its header': refuses('cut.bag', '#ROSBAG V2.0\n\x45\x00\x00\x00', play('recording')),
  'key file for grants that is none': refuses('keys.json', '{"keys":[{"kty":"oct","k":"AAAA"}]}', (path) => [
    ...ROBOT,
    '--grant-keys',
    path,
  ]),
  'token file that is none': refuses('tokens.yaml', '- [[[', (path) => [
    ...SIGNALING,
    '--operator-tokens',
    path,
  ]),
});
