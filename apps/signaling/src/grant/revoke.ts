import { parseArgs } from 'node:util';
import {
  extendRevocations,
  GrantKeysError,
  parseGrantKeys,
  parseSigningKey,
  publicPartOf,
  type RevocationsPayload,
  RevocationsRefusedError,
  type SigningKey,
  signRevocations,
  subjectSchema,
  verifyRevocations,
} from '@farpoint/grants';
import { handleSchema } from '@farpoint/protocol';
import { CommandError, type CommandRim } from './command-rim.ts';
import { tieDashValues } from './dash-values.ts';
import { type Draft, openDraft, readIfThere, readText } from './key-files.ts';

export const REVOKE_HELP = `farpoint-signaling grant revoke --list FILE (--id ID | --subject TEXT)… [options]

Revokes grants that --key signed: makes the list of revoked grants, or adds to it.

  --list FILE     the list: give it to the signaling service (--revocations) or to robots (--revocations); keep it
  --id ID         a grant, as \`grant show\` and \`grant issue\` name it; may be repeated
  --subject TEXT  a person: all grants with this subject that were issued until now; may be repeated
  --key FILE      the private key that signed the grants (default: grant-key.json)
  --days DAYS     how long they stay in the list; no shorter than the grants are valid (default: 366)
  --issuer TEXT   who revokes them (default: farpoint-signaling)
`;

const OPTIONS = {
  list: { type: 'string' },
  id: { type: 'string', multiple: true, default: [] as string[] },
  subject: { type: 'string', multiple: true, default: [] as string[] },
  key: { type: 'string', default: 'grant-key.json' },
  days: { type: 'string', default: '366' },
  issuer: { type: 'string', default: 'farpoint-signaling' },
} as const;

/** @throws {CommandError} */
export async function revoke(argv: string[], rim: CommandRim): Promise<number> {
  const { values } = parseArgs({ args: tieDashValues(argv, OPTIONS), options: OPTIONS });
  const { list, id: ids, subject: subjects, issuer } = values;
  if (list === undefined) throw new CommandError('needs --list');
  if (ids.length + subjects.length === 0) throw new CommandError('needs --id or --subject');
  for (const id of ids)
    if (!handleSchema.safeParse(id).success) throw new CommandError(`--id ${id} is not a grant’s id`);
  for (const subject of [...subjects, issuer])
    if (!subjectSchema.safeParse(subject).success)
      throw new CommandError('--subject and --issuer must be 1–128 characters');
  const days = Number(values.days);
  if (!(days >= 0.01 && days <= 3660)) throw new CommandError('--days must be a number from 0.01 to 3660');
  const secret = readText('--key', values.key);
  const draft = openDraft('--list', list);
  try {
    return await extend(draft, { list, ids, subjects, issuer, days, key: values.key, secret }, rim);
  } finally {
    draft.drop();
  }
}

interface Extension {
  /** Path of the list. */
  list: string;
  ids: readonly string[];
  subjects: readonly string[];
  issuer: string;
  days: number;
  /** Path of the key. */
  key: string;
  /** What is in it. */
  secret: string;
}

async function extend(
  draft: Draft,
  { list, ids, subjects, issuer, days, key, secret }: Extension,
  { stdout, now }: CommandRim,
): Promise<number> {
  const nowS = now() / 1000;
  const { earlier, signingKey } = await open(key, secret, list);
  const added = { ids, subjects, expiresAtS: Math.ceil(nowS + days * 86_400) };
  const payload = extendRevocations(earlier, added, issuer, nowS);
  let text: string;
  try {
    text = await signRevocations(payload, signingKey);
  } catch (error) {
    if (!(error instanceof RevocationsRefusedError)) throw error;
    throw new CommandError(
      `--list ${list} is full: issue grants with a new key, and remove this key from the robots`,
      1,
    );
  }
  draft.publish(`${text}\n`);
  const from = new Date((Math.floor(nowS) + 1) * 1000).toISOString();
  for (const id of ids) stdout.write(`revoked: grant ${id}\n`);
  for (const subject of subjects) stdout.write(`revoked: grants to ${subject} issued before ${from}\n`);
  const kept = payload.grants.length + payload.subjects.length;
  stdout.write(
    `${earlier === null ? 'Made' : 'Extended'} ${list}: ${kept} in all, sequence ${payload.seq}, kid ${signingKey.keyId}.\n`,
  );
  return 0;
}

/** The key, and what the list says so far; `null` if there is none. */
async function open(
  key: string,
  secret: string,
  list: string,
): Promise<{ signingKey: SigningKey; earlier: RevocationsPayload | null }> {
  try {
    const signingKey = await parseSigningKey(secret);
    const text = readIfThere('--list', list);
    if (text === null) return { signingKey, earlier: null };
    const keys = await parseGrantKeys(JSON.stringify({ keys: [publicPartOf(secret)] }));
    const { payload } = await verifyRevocations(text.trim(), keys);
    return { signingKey, earlier: payload };
  } catch (error) {
    if (error instanceof GrantKeysError) throw new CommandError(`--key ${key} ${error.message}`, 1);
    if (!(error instanceof RevocationsRefusedError)) throw error;
    throw new CommandError(
      error.reason === 'revocations-untrusted'
        ? `--list ${list} was signed by another key than --key ${key}: keep a list for each key`
        : `--list ${list} is not a list of revocations: ${error.message}`,
      1,
    );
  }
}
