import { randomBytes } from 'node:crypto';
import { parseArgs } from 'node:util';
import {
  AUDIENCE,
  encodeTicket,
  exportOperatorKey,
  type GrantClaims,
  GrantKeysError,
  grantClaimsSchema,
  issueGrant,
  keyThumbprint,
  MAX_ROBOTS,
  makeOperatorKey,
  parseSigningKey,
  sha256Schema,
  toOperatorJwk,
} from '@farpoint/grants';
import { CommandError, type CommandRim } from './command-rim.ts';
import { tieDashValues } from './dash-values.ts';
import { readText } from './key-files.ts';

export const ISSUE_HELP = `farpoint-signaling grant issue --name NAME --robots IDS --role ROLE (--for KEY | --with-key) [options]

Issues a grant, and writes it to standard output as one line.

  --name NAME     the operator's name, as others see it
  --robots IDS    robot ids separated by commas; * in an id stands for anything
  --role ROLE     watch, drive or supervise
  --for KEY       the operator's own key: its thumbprint, or a file with the public JWK
  --with-key      make the key, too, and write a ticket of both: a secret, for this operator only
  --days DAYS     how long it is valid, 0.01–366; fractions are allowed (default: 30)
  --key FILE      the private key that signs (default: grant-key.json)
  --robot-key ID=KEY  the thumbprint of a robot's own key, which it logs when it starts: the operator's browser
                  then connects to no other robot under this id; may be repeated
  --subject TEXT  identifies the person over all its grants (default: the name)
  --issuer TEXT   who issues it (default: farpoint-signaling)
`;

const OPTIONS = {
  name: { type: 'string' },
  robots: { type: 'string' },
  role: { type: 'string' },
  for: { type: 'string' },
  'with-key': { type: 'boolean', default: false },
  days: { type: 'string', default: '30' },
  key: { type: 'string', default: 'grant-key.json' },
  'robot-key': { type: 'string', multiple: true },
  subject: { type: 'string' },
  issuer: { type: 'string', default: 'farpoint-signaling' },
} as const;

/** How messages name what is wrong with a claim. */
const FLAGS: Partial<Record<string, string>> = {
  iss: '--issuer must be 1–128 characters',
  sub: '--subject must be 1–128 characters',
  name: '--name must be 1–64 characters, without control characters',
  robots: '--robots must be 1–32 robot ids (a–z 0–9 . _ -), in which * stands for anything',
  robotKeys: `--robot-key must be ID=KEY with a robot's id and a thumbprint, ${MAX_ROBOTS} at most`,
  role: '--role must be watch, drive or supervise',
};

/** @throws {CommandError} */
export async function issue(argv: string[], { stdout, stderr, now }: CommandRim): Promise<number> {
  const { values } = parseArgs({ args: tieDashValues(argv, OPTIONS), options: OPTIONS });
  const { name, role, robots, days, issuer } = values;
  if ((values.for === undefined) !== values['with-key'])
    throw new CommandError('needs either --for KEY or --with-key');
  for (const flag of ['name', 'robots', 'role'] as const)
    if (values[flag] === undefined) throw new CommandError(`needs --${flag}`);
  const lasts = Number(days);
  if (!(lasts >= 0.01 && lasts <= 366)) throw new CommandError('--days must be a number from 0.01 to 366');
  const made = values['with-key'] ? await makeOperatorKey(true) : null;
  const jkt = made === null ? await thumbprint(values.for ?? '') : await keyThumbprint(made.publicJwk);
  const nowS = Math.floor(now() / 1000);
  const claims = checked({
    iss: issuer,
    sub: values.subject ?? name,
    name,
    aud: AUDIENCE,
    role,
    cnf: { jkt },
    iat: nowS,
    nbf: nowS,
    exp: nowS + Math.round(lasts * 86_400),
    ...robotKeys(values['robot-key'] ?? []),
    jti: randomBytes(12).toString('base64url'),
    robots: robots?.split(',').map((id) => id.trim()),
  });
  const signingKey = await parseSigningKey(readText('--key', values.key)).catch((error: unknown) => {
    if (error instanceof GrantKeysError) throw new CommandError(`--key ${values.key} ${error.message}`, 1);
    throw error;
  });
  const grant = await issueGrant(claims, signingKey);
  const until = new Date(claims.exp * 1000).toISOString();
  stderr.write(`${name} may ${role} ${claims.robots.join(', ')} until ${until} (grant ${claims.jti})\n`);
  if (made === null) {
    stdout.write(`${grant}\n`);
    return 0;
  }
  stderr.write(
    'The ticket holds a private key: give it to this person only, in a way that nobody else reads.\n',
  );
  stdout.write(`${encodeTicket({ grant, key: await exportOperatorKey(made) })}\n`);
  return 0;
}

function robotKeys(given: readonly string[]): { robotKeys?: Record<string, string> } {
  if (given.length === 0) return {};
  return { robotKeys: Object.fromEntries(given.map((each) => [each.split('=')[0], each.split('=')[1]])) };
}

function checked(claims: object): GrantClaims {
  const parsed = grantClaimsSchema.safeParse(claims);
  if (parsed.success) return parsed.data;
  const claim = String(parsed.error.issues[0]?.path[0]);
  throw new CommandError(FLAGS[claim] ?? `the claim ${claim} is invalid`);
}

async function thumbprint(key: string): Promise<string> {
  if (sha256Schema.safeParse(key).success) return key;
  const text = readText('--for', key);
  let jwk: object;
  try {
    jwk = JSON.parse(text) as object;
  } catch {
    throw new CommandError(`--for ${key} is neither a thumbprint nor a file with a JWK`);
  }
  if (typeof jwk === 'object' && jwk !== null && 'd' in jwk)
    throw new CommandError(
      `--for ${key} is a private key: its owner should keep it, and send the public one`,
    );
  try {
    return await keyThumbprint(toOperatorJwk(jwk));
  } catch {
    throw new CommandError(`--for ${key} is not a P-256 public key (JWK)`);
  }
}
