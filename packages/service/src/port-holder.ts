/**
 * Finds the program that listens on a TCP port of this machine. Linux lists it in /proc; on other systems no program is
 * found.
 */
import { readdirSync, readFileSync, readlinkSync } from 'node:fs';

export interface PortHolder {
  readonly pid: number;
  /** As people start it: the program or, for Node, Python and the like, the script. */
  readonly program: string;
}

/** State 0A of /proc/net/tcp. */
const LISTEN = '0A';

/**
 * Inodes of the sockets that listen on a port.
 *
 * @param table text of /proc/net/tcp or tcp6
 */
export function listeningInodes(table: string, port: number): string[] {
  const wanted = port.toString(16).toUpperCase().padStart(4, '0');
  return table
    .split('\n')
    .slice(1)
    .map((line) => line.trim().split(/\s+/))
    .filter((fields) => fields[3] === LISTEN && fields[1]?.endsWith(`:${wanted}`))
    .map((fields) => fields[9] ?? '')
    .filter((inode) => inode !== '' && inode !== '0');
}

const INTERPRETERS = /^(node|nodejs|bun|deno|python[\d.]*|ruby|perl|java|sh|bash)$/;

/**
 * The name by which people know a program.
 *
 * @param commandLine text of /proc/PID/cmdline: arguments that end with NUL
 */
export function programName(commandLine: string): string {
  const [first = '', ...rest] = commandLine.split('\0').filter((part) => part !== '');
  // A program that has set its own title has several words in one argument.
  const name = (first.split(' ')[0] ?? '').split('/').at(-1) ?? '';
  if (!INTERPRETERS.test(name)) return name === '' ? 'a program' : name;
  const script = rest.find((part) => !part.startsWith('-'));
  return script === undefined ? name : `${name} ${script.split('/').slice(-3).join('/')}`;
}

/** @returns `null` if none is found: nobody listens, it belongs to another user, or the system does not tell */
export function portHolder(port: number): PortHolder | null {
  const tables = ['/proc/net/tcp', '/proc/net/tcp6'];
  const inodes = new Set(
    tables.flatMap((path) => orElse<string[]>([], () => listeningInodes(readFileSync(path, 'latin1'), port))),
  );
  if (inodes.size === 0) return null;
  for (const pid of orElse<string[]>([], () => readdirSync('/proc')).filter((name) => /^\d+$/.test(name))) {
    for (const descriptor of orElse<string[]>([], () => readdirSync(`/proc/${pid}/fd`))) {
      const link = orElse('', () => readlinkSync(`/proc/${pid}/fd/${descriptor}`));
      const inode = /^socket:\[(\d+)\]$/.exec(link)?.[1];
      if (inode === undefined || !inodes.has(inode)) continue;
      const program = programName(orElse('', () => readFileSync(`/proc/${pid}/cmdline`, 'utf8')));
      return { pid: Number(pid), program };
    }
  }
  return null;
}

/** Processes may end meanwhile, and those of other users are not readable. */
function orElse<T>(otherwise: T, read: () => T): T {
  try {
    return read();
  } catch {
    return otherwise;
  }
}
