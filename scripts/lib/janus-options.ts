/** The options of `pnpm janus`. */
import { isIP } from 'node:net';
import { parseArgs } from 'node:util';
import type { JanusServerOptions } from '@farpoint/local-stack';
import { closest } from '@farpoint/service';

export const JANUS_HELP = `pnpm janus [options]

Starts Janus with a configuration of its own: the WebSocket and the streaming plugin, nothing else. A robot feeds it with
--broadcast-janus and --broadcast-admin-key; viewers open watch.html?janus=…

  --host ADDRESS          where it listens for robots and for the page (127.0.0.1); 0.0.0.0 for all networks
  --port N                port of the WebSocket (8188)
  --public-address IP     the address that viewers reach this machine by, if it is behind a 1:1 NAT
  --robot-ports N-N       UDP ports for the robots' packets (20000-20199)
  --viewer-ports N-N      UDP ports for the viewers (20200-20999)
  --admin-key KEY         whoever has it may create mountpoints; default: a new one, which is printed
  --tls-cert FILE         PEM certificate chain; with --tls-key, the WebSocket is wss://
  --tls-key FILE          its private key
  --folder FOLDER         where the configuration is written; default: a temporary folder
  --verbose               show Janus' log
`;

const OPTIONS = {
  host: { type: 'string' },
  port: { type: 'string' },
  'public-address': { type: 'string' },
  'robot-ports': { type: 'string' },
  'viewer-ports': { type: 'string' },
  'admin-key': { type: 'string' },
  'tls-cert': { type: 'string' },
  'tls-key': { type: 'string' },
  folder: { type: 'string' },
  verbose: { type: 'boolean' },
  help: { type: 'boolean', short: 'h' },
} as const;
const NAMES = Object.keys(OPTIONS).map((name) => `--${name}`);
const DEFAULT_PORT = 8188;

export interface JanusScriptOptions {
  server: JanusServerOptions;
  verbose: boolean;
}

/** A mistake on the command line: one sentence. */
export class JanusOptionError extends Error {
  override readonly name = 'JanusOptionError';
}

/**
 * @returns `null` if help was requested
 * @throws {JanusOptionError}
 */
export function readJanusOptions(argv: readonly string[]): JanusScriptOptions | null {
  const { values, tokens } = parseArgs({
    args: [...argv],
    options: OPTIONS,
    strict: false,
    tokens: true,
    allowPositionals: true,
  });
  for (const token of tokens) {
    if (token.kind === 'positional')
      throw new JanusOptionError(`${JSON.stringify(token.value)} does not belong to an option`);
    if (token.kind !== 'option') continue;
    if (!Object.hasOwn(OPTIONS, token.name))
      throw new JanusOptionError(`${token.rawName} is not an option${closest(token.rawName, NAMES)}`);
    const takesValue = OPTIONS[token.name as keyof typeof OPTIONS].type === 'string';
    if (takesValue !== (token.value !== undefined))
      throw new JanusOptionError(`${token.rawName} ${takesValue ? 'needs a value' : 'takes no value'}`);
  }
  if (values.help === true) return null;
  const text = (name: keyof typeof OPTIONS): string | null => {
    const value = values[name];
    return typeof value === 'string' ? value : null;
  };
  const host = text('host') ?? '127.0.0.1';
  if (isIP(host) === 0) throw new JanusOptionError('--host must be an IP address of this machine');
  const publicAddress = text('public-address');
  if (publicAddress !== null && isIP(publicAddress) === 0)
    throw new JanusOptionError('--public-address must be an IP address');
  const [certificate, key] = [text('tls-cert'), text('tls-key')];
  if ((certificate === null) !== (key === null))
    throw new JanusOptionError('--tls-cert and --tls-key belong together');
  const folder = text('folder');
  const adminKey = text('admin-key');
  const robotPorts = readRange('--robot-ports', text('robot-ports') ?? '20000-20199');
  const viewerPorts = readRange('--viewer-ports', text('viewer-ports') ?? '20200-20999');
  const port = readPort('--port', text('port') ?? String(DEFAULT_PORT));
  return {
    verbose: values.verbose === true,
    server: {
      host,
      port,
      publicAddress,
      ...(folder === null ? {} : { folder }),
      ...(adminKey === null ? {} : { adminKey }),
      robotPorts,
      viewerPorts,
      ...(certificate === null || key === null ? {} : { certificate: { certificate, key } }),
    },
  };
}

function readPort(flag: string, text: string): number {
  const port = Number(text);
  if (/^\d+$/.test(text) && port >= 1 && port <= 65_535) return port;
  throw new JanusOptionError(`${flag} must be a port from 1 to 65535, not ${JSON.stringify(text)}`);
}

function readRange(flag: string, text: string): [number, number] {
  const [first = '', last = '', ...more] = text.split('-');
  const range: [number, number] = [readPort(flag, first), readPort(flag, last)];
  if (more.length > 0 || range[0] > range[1])
    throw new JanusOptionError(`${flag} must be two ports, the lower first, e.g. 20000-20199`);
  return range;
}
