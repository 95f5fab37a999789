import type { RTCPeerConnection } from 'werift';

interface DtlsClientShape {
  connect?: () => Promise<void>;
}

/**
 * Makes an answering werift peer begin its DTLS handshake as soon as its own connectivity checks succeed, as other
 * stacks do; werift waits for 100 ms. Call it once the connection has its transport.
 */
export function helloAtOnce(connection: RTCPeerConnection): void {
  for (const transport of connection.dtlsTransports) {
    const start = transport.start.bind(transport);
    transport.start = () => {
      const started = start();
      const client = transport.dtls as unknown as DtlsClientShape | undefined;
      const connect = client?.connect?.bind(client);
      if (client !== undefined && connect !== undefined) {
        client.connect = async () => undefined;
        // The connection's state shows the result.
        connect().catch(() => undefined);
      }
      return started;
    };
  }
}
