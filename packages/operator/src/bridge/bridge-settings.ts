/** The addresses of a bridge's three sockets. */
export interface BridgeAddress {
  /** WebSocket address for commands. */
  control: string;
  /** WebSocket address for the robot's state. */
  telemetry: string;
  /** WebSocket address for point clouds. */
  streaming: string;
  /** Address of the clients' port of the signaling service that the bridge is to use; `null`: leave it unchanged. */
  signaling: string | null;
}

const PORTS = { control: 8085, telemetry: 8090, streaming: 8095 };

/**
 * Reads the address of a bridge: `ws://localhost`, or with all three ports (control, telemetry, streaming)
 * `ws://localhost:8085,8090,8095`.
 *
 * @param text the bridge's address
 * @param signaling address of a signaling service: the released bridge has none until a page sends it one
 * @returns `null` if the text is not such an address
 */
export function parseBridge(text: string, signaling: string | null = null): BridgeAddress | null {
  const match =
    /^(?<scheme>wss?:\/\/)?(?<host>[a-z0-9.-]+|\[[0-9a-f:]+\])(?::(?<ports>\d{1,5},\d{1,5},\d{1,5}))?\/?$/i.exec(
      text.trim(),
    );
  const { scheme = 'ws://', host, ports } = match?.groups ?? {};
  if (host === undefined) return null;
  const [control, telemetry, streaming] =
    ports === undefined ? [PORTS.control, PORTS.telemetry, PORTS.streaming] : ports.split(',').map(Number);
  if ([control, telemetry, streaming].some((port) => port === undefined || port < 1 || port > 65_535))
    return null;
  const at = (port: number | undefined) => `${scheme.toLowerCase()}${host}:${port}/`;
  const named = URL.parse(signaling?.trim() ?? '');
  return {
    control: at(control),
    telemetry: at(telemetry),
    streaming: at(streaming),
    signaling: named !== null && /^wss?:$/.test(named.protocol) ? named.href : null,
  };
}
