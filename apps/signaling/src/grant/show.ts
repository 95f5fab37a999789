import { existsSync, readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import {
  coversRobot,
  decodeTicket,
  type GrantClaims,
  GrantKeysError,
  GrantRefusedError,
  keyThumbprint,
  parseGrantKeys,
  readGrant,
  verifyGrant,
} from '@farpoint/grants';
import { CommandError, type CommandRim } from './command-rim.ts';
import { readText } from './key-files.ts';

export const SHOW_HELP = `farpoint-signaling grant show GRANT [--keys FILE] [--robot ID]

Shows what is in a grant or a ticket, and whether it is valid now. Exit status: 0 if it is, 1 if not.

  GRANT        the text, a file with it, or - for standard input
  --keys FILE  the public keys that robots have; without it, the signature is not checked
  --robot ID   also check that it covers this robot
`;

/** @throws {CommandError} */
export async function show(argv: string[], { stdout, now }: CommandRim): Promise<number> {
  const { values, positionals } = parseArgs({
    args: argv,
    allowPositionals: true,
    options: { keys: { type: 'string' }, robot: { type: 'string' } },
  });
  const [given, ...more] = positionals;
  if (given === undefined || more.length > 0) throw new CommandError('needs one grant, file or -');
  const text = textOf(given);
  const ticket = decodeTicket(text);
  const grant = ticket?.grant ?? text;
  let read: { claims: GrantClaims; keyId: string };
  try {
    read = readGrant(grant);
  } catch (error) {
    if (!(error instanceof GrantRefusedError)) throw error;
    throw new CommandError(`neither a grant nor a ticket: ${error.message}`, 1);
  }
  const { claims, keyId } = read;
  const date = (seconds: number) => new Date(seconds * 1000).toISOString();
  const rows: [string, string][] = [
    ['name', claims.name],
    ['subject', claims.sub],
    ['role', claims.role],
    ['robots', claims.robots.join(', ')],
    ['valid', `from ${date(claims.nbf)} to ${date(claims.exp)}`],
    ['issued', `${date(claims.iat)} by ${claims.iss}`],
    ...Object.entries(claims.robotKeys ?? {}).map(([id, key]): [string, string] => [
      'robot key',
      `${id} ${key}`,
    ]),
    ['grant', claims.jti],
    ['signed by', keyId],
    ['for key', claims.cnf.jkt],
  ];
  // Never a control character: claims of a grant that is not verified are anybody's.
  for (const [what, value] of rows) stdout.write(`${what.padEnd(10)} ${value}\n`);
  const nowS = now() / 1000;
  const fault =
    (await faultOf(grant, claims, values, nowS)) ??
    (ticket === null || (await keyThumbprint(ticket.key)) === claims.cnf.jkt
      ? null
      : 'the key in the ticket is another than the grant names');
  const unchecked =
    values.keys === undefined ? ' as far as can be said without --keys: the signature is not checked' : '';
  stdout.write(fault === null ? `valid${unchecked}\n` : `not valid: ${fault}\n`);
  return fault === null ? 0 : 1;
}

async function faultOf(
  grant: string,
  claims: GrantClaims,
  { keys, robot = null }: { keys?: string | undefined; robot?: string | null | undefined },
  nowS: number,
): Promise<string | null> {
  if (keys === undefined) {
    if (claims.exp <= nowS) return 'it has expired';
    if (claims.nbf > nowS) return 'its time has not begun';
    return robot === null || coversRobot(claims.robots, robot) ? null : `it does not cover ${robot}`;
  }
  try {
    await verifyGrant(grant, { keys: await parseGrantKeys(readText('--keys', keys)), robot, nowS });
    return null;
  } catch (error) {
    if (error instanceof GrantKeysError) throw new CommandError(`--keys ${keys} ${error.message}`, 1);
    if (error instanceof GrantRefusedError) return error.message;
    throw error;
  }
}

function textOf(given: string): string {
  if (given === '-') return readFileSync(0, 'utf8').trim();
  return existsSync(given) ? readText('the grant', given).trim() : given;
}
