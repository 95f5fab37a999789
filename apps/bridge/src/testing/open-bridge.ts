import { type Logger, silentLogger } from '@farpoint/service';
import { Bridge, type BridgeOptions, monotonicMs } from '../bridge.ts';

/** A bridge on free ports of this machine, for tests. @param signaling the service's port for clients */
export function openBridge(
  signaling: number,
  options: Partial<BridgeOptions> = {},
  log: Logger = silentLogger(),
): Promise<Bridge> {
  return Bridge.open(
    {
      signaling: `ws://127.0.0.1:${signaling}/`,
      host: '127.0.0.1',
      controlPort: 0,
      telemetryPort: 0,
      streamingPort: 0,
      allowedOrigins: [],
      maxRobots: 100,
      maxPoints: 200_000,
      reorderMs: 20,
      startBitsPerSecond: 100e6,
      maxBitsPerSecond: 100e6,
      ...options,
    },
    log,
    monotonicMs,
  );
}
