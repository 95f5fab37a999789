import { parseArgs } from 'node:util';
import { grantAlgorithms, makeSigningKey } from '@farpoint/grants';
import { CommandError, type CommandRim } from './command-rim.ts';
import { readPublicKeys, writePublicKeys, writeSecret } from './key-files.ts';

export const KEYGEN_HELP = `farpoint-signaling grant keygen [--key FILE] [--keys FILE] [--alg ALG]

Makes a key that signs grants.

  --key FILE   the private key to write, readable by you only; it must not exist yet (default: grant-key.json)
  --keys FILE  the public keys for robots (--grant-keys); the new one is added to those that are there (default: grant-keys.json)
  --alg ALG    EdDSA (Ed25519) or ES256 (P-256) (default: EdDSA)
`;

/** @throws {CommandError} */
export async function keygen(argv: string[], { stdout }: CommandRim): Promise<number> {
  const { values } = parseArgs({
    args: argv,
    options: {
      key: { type: 'string', default: 'grant-key.json' },
      keys: { type: 'string', default: 'grant-keys.json' },
      alg: { type: 'string', default: 'EdDSA' },
    },
  });
  const alg = grantAlgorithms.find((each) => each === values.alg);
  if (alg === undefined) throw new CommandError(`--alg must be one of ${grantAlgorithms.join(', ')}`);
  const known = readPublicKeys('--keys', values.keys);
  const { secretJwk, publicJwk } = await makeSigningKey(alg);
  writeSecret('--key', values.key, `${JSON.stringify(secretJwk, null, 2)}\n`);
  writePublicKeys('--keys', values.keys, [...known, publicJwk]);
  stdout.write(`Wrote ${values.key} (secret) and ${values.keys} (${known.length + 1} in all), kid ${publicJwk.kid}.
Next: give ${values.keys} to each robot as --grant-keys, keep ${values.key} away from the signaling service's machine.
`);
  return 0;
}
