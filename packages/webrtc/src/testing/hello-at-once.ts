import type { RTCPeerConnection } from 'werift';

interface DtlsClientShape {
  connect?: () => Promise<void>;
}

/**
 * Makes a werift peer that answers begin its DTLS handshake in the moment its own connectivity checks are through, as other
 * stacks do; werift waits 100 ms. Call it once the connection has its transport.
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
        // What becomes of it shows in the connection's state.
        connect().catch(() => undefined);
      }
      return started;
    };
  }
}
