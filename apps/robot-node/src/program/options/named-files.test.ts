/** Every option of the robot that names a file to read: one that holds nothing is a mistake, never the same as none. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { OptionsError } from '@farpoint/service';
import { uselessFiles } from '@farpoint/service/testing/useless-files';
import { describe, expect, it, test } from 'vitest';
import { GrantKeysFile } from '../../admit/access/grant-keys-file.ts';
import { RobotKey } from '../../admit/access/robot-key-file.ts';
import { openPcdSource, openRgbdSource } from '../../sense/sources/open-source.ts';
import { RecordingSource } from '../../sense/sources/recording-source.ts';
import { robotOf } from './testing/robot-of.ts';

/** Self-signed; of nobody. */
const CERTIFICATE = `-----BEGIN CERTIFICATE-----
MIIBcjCCARegAwIBAgIUDnocXNzhsFqEWVYaXByiIarNHz0wCgYIKoZIzj0EAwIw
DTELMAkGA1UEAwwCY2EwIBcNMjYxMTI4MjI0OTA0WhgPMjEyNjExMDQyMjQ5MDRa
MA0xCzAJBgNVBAMMAmNhMFkwEwYHKoZIzj0CAQYIKoZIzj0DAQcDQgAECLaVtO4t
Jd9czqB15KSTjiV3muGhL+RImK1h2cbZflYk2NUbbY1e+jEGk4SMXCNB+f1gihmB
q3GxuEO+62UrZqNTMFEwHQYDVR0OBBYEFMfkpmye4bxyf1q6L8J9Y2ShtCSPMB8G
A1UdIwQYMBaAFMfkpmye4bxyf1q6L8J9Y2ShtCSPMA8GA1UdEwEB/wQFMAMBAf8w
CgYIKoZIzj0EAwIDSQAwRgIhAMoNDQWsr4hzuO709iqhO+STJgfCMG4vqtmD+CRX
PDXUAiEAvN0Oi55KTbVJM87BWybxzRRzkWMSHhdwWhELOj5EgQw=
-----END CERTIFICATE-----
`;

const JWK = { kty: 'OKP', crv: 'Ed25519', kid: 'k', x: 'A'.repeat(43) };

const useless = uselessFiles();
const folder = join(useless[0]?.path ?? '', '..');

const robot = (...argv: string[]) => robotOf(argv);

function refusal(...argv: string[]): string {
  try {
    robot(...argv);
  } catch (error) {
    if (error instanceof OptionsError) return error.message;
    throw error;
  }
  throw new Error(`${argv.join(' ')} is taken`);
}

function marked(name: string, text: string): string {
  const path = join(folder, name);
  writeFileSync(path, `\uFEFF${text}`);
  return path;
}

const keys = marked('own-keys', JSON.stringify({ keys: [JWK] }));
/** Each, after the options without which it is none. */
const naming: [option: string, ...others: string[]][] = [
  ['--fence'],
  ['--urdf'],
  ['--tls-ca'],
  ['--grant-keys'],
  ['--revocations', '--grant-keys', keys],
];
describe.each(naming)('%s', (option, ...others) => {
  // Revocations will be made where there are none.
  const all = option === '--revocations' ? useless.filter(({ what }) => what !== 'missing') : useless;
  it.each(all)('refuses a file that is $what', ({ path, words }) => {
    const message = refusal(...others, option, path);
    expect(message.startsWith(`${option} `)).toBe(true);
    expect(message).toContain(path);
    expect(message).toContain(words);
  });
});

test('revocations may be a file that will be made', () => {
  const path = join(folder, 'later');
  expect(robot('--grant-keys', keys, '--revocations', path).revocations).toEqual([path]);
});

/** Files that are opened when the robot starts, and what opens them. */
const opened: [string, (path: string) => Promise<unknown>][] = [
  ['grant keys', (path) => GrantKeysFile.open(path)],
  ['PCD', async (path) => openPcdSource({ path, frame: 'auto' })],
  ['RGB-D', async (path) => openRgbdSource({ path })],
  [
    'recording',
    (path) => RecordingSource.open({ path, rate: 1, fromS: 0, atEnd: 'stop', topics: [] } as never, () => 0),
  ],
];
describe.each(opened)('%s', (_, open) => {
  it.each(useless)('names the file that is $what', async ({ path }) => {
    await expect(open(path)).rejects.toThrow(path);
  });
});

test.each(useless.filter(({ what }) => what !== 'missing'))(
  'a robot key that is $what is never replaced',
  async ({ path, words }) => {
    await expect(RobotKey.open(path)).rejects.toThrow(path);
    await expect(RobotKey.open(path)).rejects.toThrow(words);
  },
);

describe('a byte order mark', () => {
  test('is no part of a fence, a model, keys or certificates', () => {
    const ring = [
      [0, 0],
      [0.01, 0],
      [0.01, 0.01],
      [0, 0],
    ];
    const geometry = { type: 'Polygon', coordinates: [ring] };
    const feature = { type: 'Feature', properties: { kind: 'allowed' }, geometry };
    const fence = JSON.stringify({ type: 'FeatureCollection', features: [feature] });
    const shape = '<visual><geometry><sphere radius="1"/></geometry></visual>';
    const urdf = `<?xml version="1.0"?><robot name="r"><link name="base_link">${shape}</link></robot>`;
    const options = robot(
      ...['--fence', marked('fence', fence), '--fence-origin', '0,0'],
      ...['--urdf', marked('urdf', urdf), '--grant-keys', marked('keys', JSON.stringify({ keys: [JWK] }))],
      ...['--tls-ca', marked('ca', CERTIFICATE)],
    );
    expect(options.fence?.fence.allowed).toHaveLength(1);
    expect(options.model?.model).toMatchObject({ kind: 'model' });
    expect(options.signaling.ca).toContain('BEGIN CERTIFICATE');
  });
});

test.each([
  ['text', 'no certificate here', 'without a certificate'],
  ['a key', '-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n', 'without a certificate'],
  ['half a certificate', '-----BEGIN CERTIFICATE-----\nAAAA\n', 'without a certificate'],
  [
    'a damaged one',
    '-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n',
    'certificate 1 cannot be read',
  ],
])('certificates to trust: %s is refused', (_, text, words) => {
  const path = join(folder, 'ca.pem');
  writeFileSync(path, text);
  const message = refusal('--tls-ca', path);
  expect(message).toContain(path);
  expect(message).toContain(words);
});

test('a folder for the state that can hold nothing is refused, in one sentence', () => {
  const [file] = useless.filter(({ what }) => what === 'empty');
  const path = join(file?.path ?? '', 'state');
  expect(refusal('--state-dir', path)).toBe(
    `--state-dir must be a folder that can be written: ${path} is below a file: ${file?.path}`,
  );
  expect(refusal('--state-dir', file?.path ?? '')).toContain('is a file, not a folder');
  expect(robot('--state-dir', join(folder, 'new', 'state')).stateFolder).toBe(join(folder, 'new', 'state'));
});
