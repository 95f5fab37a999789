/** The configuration files of a Janus that only relays: the streaming plugin and the WebSocket transport. Pure. */

export interface JanusConfigurationOptions {
  /** Address on which Janus serves its WebSocket and takes the robots' packets. */
  host: string;
  /** Port of the WebSocket. */
  port: number;
  /** The address that viewers reach this machine by, if it is not one of the machine's own (1:1 NAT). */
  publicAddress: string | null;
  /** First and last UDP port for the robots' packets. */
  robotPorts: readonly [number, number];
  /** First and last UDP port for the viewers' connections. */
  viewerPorts: readonly [number, number];
  /** Without it, nobody may create a mountpoint. */
  adminKey: string;
  /** PEM files; with them, the WebSocket is encrypted (wss). */
  certificate: { certificate: string; key: string } | null;
  /** Holds the plugins that Janus loads, and no others. */
  pluginsFolder: string;
  transportsFolder: string;
}

/** A session whose peer sends nothing for this long is over, s. */
const JANUS_SESSION_TIMEOUT_S = 20;

/** @returns text by file name */
export function janusConfiguration(options: JanusConfigurationOptions): Map<string, string> {
  const { host, port, publicAddress, robotPorts, viewerPorts, adminKey, certificate } = options;
  const scheme = certificate === null ? 'ws' : 'wss';
  const janus = group('general', {
    configs_folder: null,
    plugins_folder: options.pluginsFolder,
    transports_folder: options.transportsFolder,
    debug_level: 4,
    debug_colors: false,
    session_timeout: JANUS_SESSION_TIMEOUT_S,
    server_name: 'Farpoint',
    hide_dependencies: true,
  })
    .concat(group('media', { rtp_port_range: range(viewerPorts) }))
    .concat(group('nat', { nat_1_1_mapping: publicAddress, full_trickle: true }));
  return new Map([
    ['janus.jcfg', janus],
    [
      'janus.plugin.streaming.jcfg',
      group('general', { admin_key: adminKey, rtp_port_range: range(robotPorts) }),
    ],
    [
      'janus.transport.websockets.jcfg',
      group('general', {
        json: 'compact',
        // Janus listens with either, not with both.
        ws: scheme === 'ws',
        wss: scheme === 'wss',
        [`${scheme}_port`]: port,
        [`${scheme}_ip`]: host,
        pingpong_trigger: 10,
        pingpong_timeout: 5,
      }).concat(
        certificate === null
          ? ''
          : group('certificates', { cert_pem: certificate.certificate, cert_key: certificate.key }),
      ),
    ],
  ]);
}

type Value = string | number | boolean | null;

/** One group in libconfig's syntax; members that are `null` are left out. */
function group(name: string, members: Readonly<Record<string, Value>>): string {
  const lines = Object.entries(members)
    .filter(([, value]) => value !== null)
    .map(([key, value]) => `\t${key} = ${typeof value === 'string' ? quoted(value) : String(value)}\n`);
  return `${name}: {\n${lines.join('')}}\n`;
}

function quoted(text: string): string {
  return `"${text.replaceAll(/["\\]/g, (character) => `\\${character}`)}"`;
}

function range([first, last]: readonly [number, number]): string {
  return `${first}-${last}`;
}
